//! The names of a motion and of its figures: by a short look, by the parameters, never by another motion's
//! preset. And the report of a run that does not survive its transient.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{column, preset, run};
use motiform_dynamics::Outcome;
use motiform_lab::{draw, naming};
use motiform_models::ModelInfo;
use motiform_study::{Dataset, Manifest, RunPlan, Study};

fn named(study: &Study) -> (Dataset, Option<String>) {
    let mut dataset = run(study);
    let name = naming::name(&dataset.manifest, &()).unwrap().map(|verdict| verdict.regime.name().to_owned());
    dataset.manifest.regime.clone_from(&name);
    (dataset, name)
}

#[test]
fn a_run_is_named_by_what_it_does() {
    let circular = preset("fig5a", |study| {
        study.set("kappa2", 0.5).unwrap();
        study.set("kappa3", 0.4).unwrap();
    });
    let (dataset, name) = named(&circular);
    assert_eq!(name.as_deref(), Some("circular"));
    assert_eq!(dataset.title(), "Circular motion: *κ*_2\u{a0}=\u{a0}0.5, *κ*_3\u{a0}=\u{a0}0.4");
    assert!(draw::still(&dataset, "path").unwrap().unwrap().contains("Circular motion"));
    let (dataset, name) = named(&preset("fig5a", |_| ()));
    assert_eq!((name.as_deref(), dataset.title().as_str()), (Some("zigzag"), "Zigzag motion"));
}

#[test]
fn no_name_without_evidence() {
    let noisy = preset("fig5a", |study| study.run.noise = 1e-3);
    assert_eq!(named(&noisy).1, None);
    let dataset = run(&preset("fig5a", |_| ()));
    let stopped = std::sync::atomic::AtomicBool::new(true);
    assert!(naming::name(&dataset.manifest, &stopped).unwrap().is_none());
    let broken = preset("fig5a", |study| (study.run.max_steps, study.run.transient) = (10, 0.0));
    assert_eq!(named(&broken).1, None);
}

#[test]
fn titles_follow_the_parameters() {
    let title = |study: &Study| RunPlan::new(study).unwrap().title();
    let mut study = preset("fig5a", |_| ());
    study.set("kappa2", 0.9).unwrap();
    assert_eq!(title(&study), "Zigzag motion", "the value that it has");
    study.set("kappa2", 0.5).unwrap();
    assert_eq!(title(&study), "Tensor model: *κ*_2\u{a0}=\u{a0}0.5");
    assert_eq!(study.about, "");
    let other_start = preset("fig5a", |study| study.set_initial("v1", -1.0).unwrap());
    assert_eq!(title(&other_start), "Tensor model");
    assert_eq!(title(&Study::of_model(ModelInfo::find("cell").unwrap())), "Cell model");
    let text = "title = \"Mine\"\npreset = \"fig5a\"\n[model.tensor]\nkappa2 = 0.5\n[initial]\nv1 = 0.1\n";
    assert_eq!(title(&Study::parse(text, "text", "mine").unwrap()), "Mine", "typed for these parameters");
    let scan = preset("fig5a", |study| {
        study.scan.axes = vec![motiform_lab::scan::Axis::parse("kappa2=0.1,0.2").unwrap()];
    });
    assert_eq!(motiform_study::ScanPlan::new(&scan).unwrap().title, "Motions of the tensor model");
}

/// A start from which the full model blows up at once.
fn doomed(transient: f64) -> Study {
    preset("fig4", |study| {
        for (name, value) in [("kappa2", 0.2), ("kappa3", 0.1)] {
            study.set(name, value).unwrap();
        }
        for (name, value) in [("v1", 8.0), ("v2", 1.0), ("s11", 30.0), ("u111", -20.0)] {
            study.set_initial(name, value).unwrap();
        }
        (study.run.transient, study.run.dt_out) = (transient, 0.001);
    })
}

#[test]
fn a_blow_up_in_the_transient_has_a_positive_time_and_a_picture() {
    let (at_once, early) = (run(&doomed(0.0)), run(&doomed(1000.0)));
    let (expected, outcome) = (at_once.manifest.outcome, early.manifest.outcome);
    assert!(expected.during.is_none() && matches!(outcome.outcome, Outcome::Escaped { singular: true, .. }));
    // the shape's own run, without a position in its error norm: times agree to what tolerance 1e-9 leaves
    assert!(
        (outcome.outcome.t() - expected.outcome.t()).abs() < 1e-6 && outcome.outcome.t() > 0.0,
        "{outcome} {expected}"
    );
    assert!(outcome.to_string().ends_with(", during the transient"), "{outcome}");
    let json = serde_json::to_value(&early.manifest).unwrap();
    assert_eq!(
        (&json["outcome"]["kind"], &json["outcome"]["during"]),
        (&"escaped".into(), &"transient".into())
    );
    let back: Manifest = serde_json::from_value(json).unwrap();
    assert_eq!(back, early.manifest);
    assert!(early.manifest.steps > 10);
    let times = column(&early, "t");
    assert!(
        times.len() > 20 && times[0] == 0.0 && times[times.len() - 1] <= outcome.outcome.t(),
        "{times:?}"
    );
    let path = draw::still(&early, "path").unwrap().unwrap();
    assert!(path.contains("did not survive"), "{path}");
}

/// A body that leaves later than the recording is long: its last time units are shown, as many as were to be recorded.
#[test]
fn the_end_of_a_long_transient_is_shown() {
    let study = preset("fig4", |study| {
        for (name, value) in [("kappa2", 0.2), ("kappa3", 0.1)] {
            study.set(name, value).unwrap();
        }
        (study.run.transient, study.run.t_end, study.run.seed) = (1e5, 20.0, 7);
    });
    let dataset = run(&study);
    let outcome = dataset.manifest.outcome;
    assert!(!outcome.is_complete() && outcome.during.is_some() && outcome.outcome.t() > 20.0, "{outcome}");
    let times = column(&dataset, "t");
    assert!((times[0] - (outcome.t_last() - 20.0)).abs() < 1e-6, "{} {outcome}", times[0]);
    assert!(times[times.len() - 1] - times[0] > 19.0);
}

/// The registry, from which the page, Python and the figures are built, has a name, a meaning and a mark of its own for each motion.
#[test]
fn every_motion_has_a_name_a_meaning_and_a_mark_of_its_own() {
    let registry = motiform_lab::registry::registry().unwrap();
    let regimes = registry["regimes"].as_array().unwrap();
    assert_eq!(regimes.len(), 11);
    for key in ["name", "meaning", "glyph", "colour"] {
        let all: std::collections::BTreeSet<String> =
            regimes.iter().map(|one| one[key].to_string()).collect();
        assert_eq!(all.len(), regimes.len(), "{key}: {all:?}");
    }
    assert!(regimes.iter().any(|one| one["name"] == "spinning"));
}
