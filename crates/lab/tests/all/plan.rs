//! A plan is all that the numbers depend on: its hash changes with each of them and with nothing else, and the same
//! plan gives the same bits.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{column, preset, run};
use motiform_store::table::same_bits;
use motiform_study::study::ReturnMapSettings;
use motiform_study::{RunPlan, Study};

type Change = (&'static str, fn(&mut Study));

fn hash(study: &Study) -> String {
    RunPlan::new(study).unwrap().hash()
}

const COMPUTING: &[Change] = &[
    ("parameter", |s| s.set("a6", 1e-300).unwrap()),
    ("last bit of a parameter", |s| s.set("kappa2", 0.9_f64.next_up()).unwrap()),
    ("initial", |s| s.set_initial("s12", 1e-9).unwrap()),
    ("position", |s| s.set_initial("x", 1.0).unwrap()),
    ("drawn start", |s| s.initial.clear()),
    ("seed", |s| s.run.seed = 2),
    ("transient", |s| s.run.transient = 999.0),
    ("t_end", |s| s.run.t_end = 161.0),
    ("dt_out", |s| s.run.dt_out = 0.025),
    ("stepper", |s| s.run.stepper = "dopri5".into()),
    ("fixed stepper", |s| s.run.stepper = "rk4".into()),
    ("rtol", |s| s.run.rtol = 1e-10),
    ("atol", |s| s.run.atol = Some(1e-13)),
    ("max_steps", |s| s.run.max_steps = 5),
    ("escape_norm", |s| s.run.escape_norm = 1e5),
    ("return map", |s| {
        s.return_map = Some(ReturnMapSettings { y: 0.0, x_min: -1.0, x_max: 1.0, centre: false });
    }),
    ("centred return map", |s| {
        s.return_map = Some(ReturnMapSettings { y: 0.0, x_min: -1.0, x_max: 1.0, centre: true });
    }),
];

const SHOWING: &[Change] = &[
    ("name", |s| s.name = "mine".into()),
    ("title", |s| s.title = "Mine".into()),
    ("about", |s| s.about = "Mine.".into()),
    ("free", |s| s.free = vec!["gamma".into()]),
    ("radius", |s| s.figure.radius = 2.0),
    ("scale", |s| s.figure.scale = 2.0),
    ("outlines", |s| s.figure.outlines = 7),
    ("from", |s| s.figure.from = 1.0),
    ("to", |s| s.figure.to = 2.0),
    ("animation", |s| s.figure.animation = false),
    ("size of a random start, not in use", |s| s.random = Some(0.5.into())),
    ("a value set to what it is", |s| s.set("kappa2", 0.9).unwrap()),
];

#[test]
fn the_hash_covers_what_is_computed_and_nothing_else() {
    let start = preset("fig5a", |_| {});
    let mut seen = vec![hash(&start)];
    for (what, change) in COMPUTING {
        let changed = hash(&preset("fig5a", change));
        assert!(!seen.contains(&changed), "{what}");
        seen.push(changed);
    }
    for (what, change) in SHOWING {
        assert_eq!(hash(&preset("fig5a", change)), seen[0], "{what}");
    }
    let fixed = |step: f64| {
        hash(&preset("fig5a", |s| {
            s.run.stepper = "rk4".into();
            s.run.step = Some(step);
        }))
    };
    assert_ne!(fixed(1e-3), fixed(2e-3));
    let random = |size: f64| {
        hash(&preset("fig5a", |s| {
            s.initial.clear();
            s.random = Some(size.into());
        }))
    };
    assert_ne!(random(0.01), random(0.02));
}

/// A plan read back from JSON, by whatever program wrote it, is the same plan.
#[test]
fn plans_survive_json() {
    for (what, change) in COMPUTING.iter().chain(SHOWING) {
        let plan = RunPlan::new(&preset("fig5a", change)).unwrap();
        for text in [serde_json::to_string(&plan).unwrap(), serde_json::to_string_pretty(&plan).unwrap()] {
            let read: RunPlan = serde_json::from_str(&text).unwrap();
            assert_eq!(read, plan, "{what}");
            assert_eq!(read.hash(), plan.hash(), "{what}");
        }
    }
}

#[test]
fn the_same_plan_gives_the_same_bits_and_another_seed_others() {
    let study = |seed| {
        preset("fig5b", |study| {
            study.run.seed = seed;
            (study.run.transient, study.run.t_end) = (10.0, 50.0);
        })
    };
    let (one, again, other) = (run(&study(1)), run(&study(1)), run(&study(2)));
    assert!(same_bits(&one.trajectory, &again.trajectory));
    assert_eq!(one.manifest, again.manifest);
    assert!(!same_bits(&one.trajectory, &other.trajectory));
    assert_ne!(one.manifest.plan_hash, other.manifest.plan_hash);
}

/// Settings of the display do not change the computation, nor does the interval of the output.
#[test]
fn rows_do_not_move_the_orbit() {
    let study = |dt_out| {
        preset("fig5b", |study| {
            (study.run.transient, study.run.t_end, study.run.dt_out) = (10.0, 50.0, dt_out);
        })
    };
    let (coarse, fine) = (run(&study(0.5)), run(&study(0.25)));
    assert_eq!(coarse.manifest.state, fine.manifest.state);
    let every_other: Vec<f64> = column(&fine, "x").iter().copied().step_by(2).collect();
    assert_eq!(column(&coarse, "x"), every_other);
}
