//! Starts of exact symmetry: noticed, perturbed, and named as a typical start is.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_analysis::regime::{Attractor, Regime, Verdict};
use motiform_lab::analyse;
use motiform_models::ModelInfo;
use motiform_study::{RunPlan, ScanPlan, Study, presets};

fn study(model: &str, preset: Option<&str>, initial: &[(&str, f64)]) -> Study {
    let info = ModelInfo::find(model).unwrap();
    let mut study = preset.map_or_else(|| Study::of_model(info), |name| presets::find(info, name).unwrap());
    for (name, value) in initial {
        study.set_initial(name, *value).unwrap();
    }
    study
}

fn verdict(study: &Study) -> Verdict {
    analyse::classify(&RunPlan::new(study).unwrap(), 0.0, &()).unwrap().unwrap()
}

/// Model, preset, initial values.
type Start = (&'static str, Option<&'static str>, &'static [(&'static str, f64)]);

/// The commands that called a body at rest chaotic.
#[test]
fn a_symmetric_start_is_named_like_a_typical_one_and_an_exact_one_by_what_it_does() {
    let starts: [Start; 6] = [
        ("tensor", Some("fig1"), &[("v1", 1.0)]),
        ("tensor", None, &[("v1", 0.0)]),
        ("cell", None, &[("c1", 0.0)]),
        ("tensor", Some("fig4"), &[("v1", -1.0), ("s11", 0.5), ("u111", 1.0)]),
        ("tensor", Some("fig5b"), &[("v1", -1.0), ("s11", 0.5), ("u111", 1.0)]),
        ("tensor", Some("fig2"), &[("v1", 0.1)]),
    ];
    for (model, preset, initial) in starts {
        let exact = study(model, preset, initial);
        let (typical, perturbation) = exact.perturbed().unwrap();
        let perturbation = perturbation.unwrap();
        assert!(!perturbation.names.iter().any(|name| initial.contains(&(name.as_str(), 1.0))));
        let (found, random) = (verdict(&typical), verdict(&study(model, preset, &[])));
        println!("{model} {preset:?}: {} ({perturbation}); typical {}", found.regime, random.regime);
        // where b3 = d3 = 0 large starts may blow up
        assert!([random.regime, Regime::BlowUp].contains(&found.regime), "{}", found.why);
        let stays = verdict(&exact);
        println!("   exactly: {} {:?}: {}", stays.regime, stays.attractor, stays.why);
        assert_ne!(stays.regime, Regime::Chaotic, "{}", stays.why);
        if stays.attractor == Attractor::Unstable {
            assert!(stays.margin.is_none() && stays.exponents[0].value > 0.0);
        }
    }
}

#[test]
fn random_and_complete_starts_stay_as_they_are() {
    let all = [("v1", 0.1), ("v2", 0.2), ("s11", -0.1), ("s12", 0.3), ("u111", 0.1), ("u222", 0.05)];
    let mut exact = study("tensor", Some("fig1"), &[("v1", 1.0)]);
    exact.perturb = 0.0;
    for same in [study("tensor", Some("fig1"), &[]), study("tensor", None, &all), exact] {
        let (after, perturbation) = same.perturbed().unwrap();
        assert!(perturbation.is_none());
        assert_eq!(RunPlan::new(&after).unwrap().hash(), RunPlan::new(&same).unwrap().hash());
    }
}

#[test]
fn a_perturbation_is_small_drawn_from_the_seed_and_written_in_the_plan() {
    let mut start = study("tensor", Some("fig1"), &[("v1", 0.5)]);
    start.scan.axes = vec![motiform_lab::scan::Axis::parse("kappa2=-0.2:0.2:3").unwrap()];
    let (first, perturbation) = start.perturbed().unwrap();
    let perturbation = perturbation.unwrap();
    assert_eq!(perturbation.names, ["v2", "s11", "s12", "u111", "u222"]);
    assert!((perturbation.size - 5e-7).abs() < 1e-20);
    let plan = ScanPlan::new(&first).unwrap();
    assert_eq!(plan.computation.initial.get("v1"), Some(0.5));
    for name in &perturbation.names {
        let value = plan.computation.initial.get(name).unwrap();
        assert!(value != 0.0 && value.abs() <= 5e-7);
    }
    start.run.seed += 1;
    assert_ne!(
        ScanPlan::new(&start.perturbed().unwrap().0).unwrap().computation.initial,
        plan.computation.initial
    );
    start.perturb = -1.0;
    assert!(start.perturbed().unwrap_err().to_string().contains("initial.perturb"));
}

/// A scan over the number of modes has coordinates that exist in some cells only.
#[test]
fn coordinates_that_some_cells_lack_are_left_alone() {
    let mut start = study("cell", None, &[("c1", 0.1)]);
    start.scan.axes = vec![motiform_lab::scan::Axis::parse("modes=16,24").unwrap()];
    let (study, perturbation) = start.perturbed().unwrap();
    assert!(perturbation.unwrap().names.iter().all(|name| name != "c17" && name != "s24"));
    ScanPlan::new(&study).unwrap();
}
