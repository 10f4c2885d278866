//! Equations given as text in lanes, through scans, samples, exponents and ensembles; the presets of the tensor model as text.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::scan_lanes::{in_lanes, one_by_one, regimes, text};
use motiform_dynamics::VectorField;
use motiform_kernels::Kernel;
use motiform_lab::ensemble::{random_members, tracks};
use motiform_lab::samples::{self, Samples};
use motiform_lab::{analyse, scan::Axis};
use motiform_models::amplitudes::{Definition, NAME, ParameterDefinition, info};
use motiform_study::presets::{find_any, names_of};
use motiform_study::{Random, RunPlan, ScanPlan, Study};

/// All terms of the tensor model: (Z1), (Z2), (Z3) with the paper's table of coefficients.
const TENSOR: [&str; 3] = [
    "(gamma - |z1|^2 - 8*a4*|z2|^2 - 16*a5*|z3|^2)*z1 - 2*a1*conj(z1)*z2 - 2*a2*conj(z1)^2*z3 - 8*a3*conj(z2)*z3 + 16*a6*conj(z3)*z2^2",
    "(-kappa2 - b4*|z1|^2 - 8*b3*|z2|^2 - 16*b5*|z3|^2)*z2 + b1/4*z1^2 + b2*conj(z1)*z3 + 2*b6*z1*conj(z2)*z3",
    "(-kappa3 - d4*|z1|^2 - 8*d5*|z2|^2 - 16*d3*|z3|^2)*z3 + d1/8*z1^3 + d2/2*z1*z2 + 2*d6*conj(z1)*z2^2",
];

fn plan(name: &str, axes: &[&str], change: impl FnOnce(&mut Study)) -> ScanPlan {
    let mut study = find_any(name, NAME).unwrap();
    study.scan.axes = axes.iter().map(|text| Axis::parse(text).unwrap()).collect();
    study.scan.samples = 2;
    study.scan.budget = 3000.0;
    change(&mut study);
    ScanPlan::new(&study).unwrap()
}

/// One, two and three modes; handed equations; a field that breaks rotations.
#[test]
fn rows_of_amplitude_equations_are_those_of_single_orbits() {
    for (name, axes) in [
        ("chiral", &["omega=-0.2:0.2:3", "kappa2=0.5:1.3:3"][..]),
        ("ohta-ohkuma", &["gamma=0.5:1.0:4"]),
        ("force", &["gamma=0.5:1.0:4"]),
        ("elongating-field", &["gamma=0.5:1.0:3"]),
    ] {
        let plan = plan(name, axes, |_| {});
        assert!(Kernel::of(plan.model_of(0).unwrap().as_ref()).is_some(), "{name}");
        let (lanes, single) = (in_lanes(&plan), one_by_one(&plan));
        for (row, (a, b)) in lanes.iter().zip(&single).enumerate() {
            assert_eq!(text(a), text(b), "{name} row {row}");
        }
        assert!(!regimes(&lanes).is_empty());
    }
}

#[test]
fn samples_exponents_and_tracks_are_those_of_single_orbits() {
    for name in ["chiral", "force"] {
        check_samples(&RunPlan::new(&find_any(name, NAME).unwrap()).unwrap());
    }
}

fn check_samples(plan: &RunPlan) {
    let count = plan.info().unwrap().build(&plan.computation.parameters.values()).unwrap().dim();
    let many = |count| Samples { count, random: 0.1.into(), given: false, threads: 2 };
    let verdicts = samples::classify(plan, many(5), 0.0, &()).unwrap().unwrap();
    assert_eq!(verdicts[0], analyse::classify(plan, 0.0, &()).unwrap().unwrap());
    let spans = analyse::Spans { transient: Some(50.0), t_end: Some(200.0) };
    let found = samples::lyapunov(plan, many(9), count, spans, &()).unwrap().unwrap();
    assert_eq!(found.orbits[0], analyse::lyapunov(plan, count, spans, &()).unwrap());
    let members = random_members(plan, 19, Random::Within(0.3)).unwrap();
    let times = [0.0, 3.0, 30.0];
    let lanes = tracks(plan, &members, &times, 2, &()).unwrap().unwrap();
    for (member, track) in members.iter().zip(&lanes) {
        let two = [member.clone(), member.clone()];
        assert_eq!(&tracks(plan, &two, &times, 1, &()).unwrap().unwrap()[1], track);
    }
}

/// A preset of the tensor model with its equations as text.
fn as_text(preset: &Study) -> Study {
    let specs = preset.info().unwrap().parameters();
    let definition = Definition {
        modes: vec![1, 2, 3],
        velocity: None,
        symmetry: None,
        parameters: specs.iter().map(|spec| ParameterDefinition::new(spec.name, spec.default)).collect(),
        equations: TENSOR.map(str::to_owned).to_vec(),
        noise: std::collections::BTreeMap::new(),
    };
    let mut study = Study::of_model(info(&definition).unwrap());
    let c = RunPlan::new(preset).unwrap().computation;
    for (name, value) in &c.parameters.0 {
        study.set(name, *value).unwrap();
    }
    let [v1, v2, s11, s12, u111, u222] = c.initial.values()[..6].try_into().unwrap();
    let amplitudes = [("v1", v1), ("v2", v2), ("z2_re", s11 / 2.0), ("z2_im", -s12 / 2.0)];
    for (name, value) in amplitudes.into_iter().chain([("z3_re", u111 / 2.0), ("z3_im", u222 / 2.0)]) {
        study.set_initial(name, value).unwrap();
    }
    study.run = preset.run.clone();
    study
}

/// Every preset of the tensor model written as amplitude equations and read back as a file: the same rates to rounding, the same regime.
#[test]
fn presets_of_the_tensor_model_are_amplitude_files_too() {
    let presets = names_of("tensor");
    assert!(presets.len() >= 6, "{presets:?}");
    for name in presets {
        let study = find_any(name, "tensor").unwrap();
        let file = as_text(&study).to_toml().unwrap();
        let text = Study::parse(&file, "text", name).unwrap();
        let (plan, plan_of_text) = (RunPlan::new(&study).unwrap(), RunPlan::new(&text).unwrap());
        let body =
            |plan: &RunPlan| plan.info().unwrap().build(&plan.computation.parameters.values()).unwrap();
        let bodies = [&plan, &plan_of_text].map(body);
        for sample in 0..20_u32 {
            let u: [f64; 6] = std::array::from_fn(|i| (f64::from(7 * sample) + 1.7 * i as f64).sin());
            let mut rates = [[0.0; 6]; 2];
            for (body, rate) in bodies.iter().zip(&mut rates) {
                VectorField::<f64>::eval(body.as_ref(), 0.0, &u, rate);
            }
            let size = rates[0].iter().fold(1.0, |size: f64, x| size.max(x.abs()));
            for (a, b) in rates[0].iter().zip(rates[1]) {
                assert!((a - b).abs() < 4e-15 * size, "{name}: {a} {b}");
            }
        }
        let verdict = |plan| analyse::classify(plan, 0.0, &()).unwrap().unwrap().regime;
        assert_eq!(verdict(&plan), verdict(&plan_of_text), "{name}");
    }
}
