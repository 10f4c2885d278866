//! A plan is all that the numbers depend on: its hash changes with each of them and with nothing else, and the same
//! plan gives the same bits.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{column, preset, run};
use motiform_store::table::same_bits;
use motiform_study::branches::{Along, BranchSettings};
use motiform_study::curves::{CurveKind, CurveSettings, Plane};
use motiform_study::scan::Axis;
use motiform_study::study::ReturnMapSettings;
use motiform_study::{
    AtlasPlan, BranchPlan, CurvePlan, Plan, Provenance, Question, RunPlan, ScanPlan, Study,
};

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
    ("escape_norm", |s| s.run.escape_norm = Some(1e5)),
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

/// The manifest of a plan of any kind: it reads back, gives its folder, and neither a changed plan nor one of another kind passes.
fn manifests<C: Question>(plan: &Plan<C>, folder: &str) {
    assert_eq!(plan.default_folder(), folder);
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join(C::MANIFEST);
    let provenance = Provenance::new(plan, Some(false));
    let bytes = provenance.encode(place.path()).unwrap();
    std::fs::write(&path, &bytes).unwrap();
    assert_eq!(plan.check_folder(place.path()).unwrap(), provenance);
    let text = String::from_utf8(bytes).unwrap();
    assert!(text.contains(&format!("\n  \"{}\": {{", C::KEY)), "{text}");
    let mut other = plan.clone();
    other.name = "another".to_owned();
    assert!(other.check_folder(place.path()).is_ok(), "the name is no part of the computation");
    std::fs::write(&path, text.replacen("0.9", "0.8", 1)).unwrap();
    let error = plan.check_folder(place.path()).unwrap_err().to_string();
    assert!(error.contains("was changed: its plan does not give its hash"), "{error}");
}

#[test]
fn plans_of_all_kinds_have_one_manifest() {
    let mut study = preset("fig5a", |_| {});
    manifests(&RunPlan::new(&study).unwrap(), "tensor-fig5a");
    let along = Along::parse("kappa2=0.85:1").unwrap();
    let branches = BranchPlan::new(&study, &BranchSettings::over(along)).unwrap();
    manifests(&branches, "tensor-fig5a-branches");
    let plane = Plane::parse("kappa2=0.5:1,kappa3=0.1:1").unwrap();
    let settings = CurveSettings { kinds: CurveKind::ALL.to_vec(), plane };
    manifests(&CurvePlan::new(&study, branches, &settings).unwrap(), "tensor-fig5a-curves");
    study.scan.axes = vec![Axis::parse("kappa2=0.85:1:3").unwrap(), Axis::parse("kappa3=0.1:0.9:3").unwrap()];
    manifests(&ScanPlan::new(&study).unwrap(), "tensor-fig5a-scan");
    manifests(&AtlasPlan::new(&study).unwrap(), "tensor-fig5a-atlas");
    study.name = "tensor".to_owned();
    manifests(&ScanPlan::new(&study).unwrap(), "tensor-scan");
    manifests(&RunPlan::new(&study).unwrap(), "tensor");
}
