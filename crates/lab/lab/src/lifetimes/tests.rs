//! Lanes against single orbits.

use super::follow::{Followed, Follower};
use crate::pool::{Jobs, spread};
use motiform_study::{ScanPlan, Study};

/// Ends and times are those of single orbits, to the bit; also where looks differ along the axis.
#[test]
fn lanes_give_the_lives_of_single_orbits() {
    let tensor = "preset = \"fig4\"\n[model.tensor]\nkappa3 = 0.1\n[scan]\naxes = [\"kappa2=0.2,1.4\"]\nbudget = 1000\n";
    let rates = "[model.amplitudes]\nmodes = [1]\nsymmetry = \"none\"\n[model.amplitudes.parameters]\nk = 1\n\
                 [model.amplitudes.equations]\nz1 = \"k*(im(z1) + i*(re(z1) - re(z1)^3 - 0.3*im(z1)))\"\n\
                 [scan]\naxes = [\"k=1,1000,30\"]\n";
    for text in [tensor, rates] {
        let plan =
            ScanPlan::new(&Study::parse(&format!("{text}samples = 5\n"), "text", "test").unwrap()).unwrap();
        let follower = Follower::new(&plan, &()).unwrap();
        let all = |single: bool| {
            let work = |jobs: &Jobs<'_, Followed>| {
                if single { follower.one_by_one(jobs) } else { follower.run(jobs) }
            };
            spread(plan.rows(), 2, &(), work).unwrap().unwrap()
        };
        assert_eq!(all(false), all(true), "{text}");
    }
}
