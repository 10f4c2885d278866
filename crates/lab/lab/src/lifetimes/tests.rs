//! Lanes against single orbits.

use super::follow::{Followed, Follower};
use crate::pool::{Jobs, spread};
use motiform_study::{ScanPlan, Study};

/// Ends and times are those of single orbits, to the bit.
#[test]
fn lanes_give_the_lives_of_single_orbits() {
    let text = "preset = \"fig4\"\n[model.tensor]\nkappa3 = 0.1\n[scan]\naxes = [\"kappa2=0.2,1.4\"]\nsamples = 5\nbudget = 1000\n";
    let plan = ScanPlan::new(&Study::parse(text, "text", "test").unwrap()).unwrap();
    let follower = Follower::new(&plan, &()).unwrap();
    let all = |single: bool| {
        let work =
            |jobs: &Jobs<'_, Followed>| if single { follower.one_by_one(jobs) } else { follower.run(jobs) };
        spread(plan.rows(), 2, &(), work).unwrap().unwrap()
    };
    assert_eq!(all(false), all(true));
}
