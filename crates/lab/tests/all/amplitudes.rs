//! Equations given as text, through studies, plans, classification and scans.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_lab::analyse;
use motiform_models::amplitudes::NAME;
use motiform_study::presets::{EXTENSIONS, find_any};
use motiform_study::scan::Axis;
use motiform_study::{Plan, ScanPlan, Study};

fn preset(name: &str) -> Study {
    find_any(name, NAME).unwrap()
}

#[test]
fn presets_read_back_as_they_are() {
    for known in EXTENSIONS {
        let mut study = preset(known.name);
        for change in [None, Some(0.1 + 0.2)] {
            if let Some(value) = change {
                let name = study.info().unwrap().parameters()[0].name;
                study.set(name, value).unwrap();
            }
            let back = Study::parse(&study.to_toml().unwrap(), "text", &study.name).unwrap();
            assert_eq!(back, study, "{}", study.to_toml().unwrap());
            assert_eq!(Plan::new(&back).unwrap().hash(), Plan::new(&study).unwrap().hash());
        }
    }
}

#[test]
fn plans_hold_their_equations() {
    let plan = Plan::new(&preset("chiral")).unwrap();
    let text = serde_json::to_string(&plan).unwrap();
    let back: Plan = serde_json::from_str(&text).unwrap();
    assert_eq!(back, plan);
    assert_eq!(back.info().unwrap().parameters()[1].name, "omega");
    let mut study = preset("chiral");
    study.scan.axes = vec![Axis::parse("omega=-0.3:0.3:3").unwrap()];
    let plan = ScanPlan::new(&study).unwrap();
    let back: ScanPlan = serde_json::from_str(&serde_json::to_string(&plan).unwrap()).unwrap();
    assert_eq!(back, plan);
    assert_eq!(plan.cells(), 3);
}

/// The regime and the verdict's numbers of a study.
fn verdict(study: &Study) -> motiform_analysis::Verdict {
    analyse::classify(&Plan::new(study).unwrap(), 0.0, &()).unwrap().unwrap()
}

/// Straight below gamma_c = kappa^2/(a b) + kappa/2 = 0.75, circular above it: Ohta and Ohkuma (2009).
#[test]
fn an_elliptic_body_turns_above_its_critical_gamma() {
    for (gamma, regime) in [(0.74, "straight"), (0.76, "circular")] {
        let mut study = preset("ohta-ohkuma");
        study.set("gamma", gamma).unwrap();
        assert_eq!(verdict(&study).regime.name(), regime, "{gamma}");
    }
}

/// Omega and -omega are mirror images: the same regime, and opposite turning.
#[test]
fn a_handed_body_and_its_mirror_image() {
    for (kappa2, omega) in [(0.9, 0.02), (0.5, 0.1), (1.4, 0.2)] {
        let both = [omega, -omega].map(|omega| {
            let mut study = preset("chiral");
            study.set("kappa2", kappa2).unwrap();
            study.set("omega", omega).unwrap();
            study.set_initial("v1", 0.5).unwrap();
            verdict(&study)
        });
        assert_eq!(both[0].regime, both[1].regime, "{kappa2} {omega}: {} {}", both[0].why, both[1].why);
        if let (Some(left), Some(right)) = (both[0].turning_rate, both[1].turning_rate) {
            assert!((left + right).abs() < 1e-5 * left.abs().max(1e-3), "{left} {right}");
        }
    }
}

/// A constant rate of turning alone: a circle at -omega (`z1 = v1 - i v2`).
#[test]
fn a_circle_swimmer_turns_at_its_rate() {
    let text = "[model.amplitudes]\nmodes = [1]\n[model.amplitudes.parameters]\nomega = 0.3\n[model.amplitudes.equations]\nz1 = \"(1 + i*omega - |z1|^2)*z1\"";
    let verdict = verdict(&Study::parse(text, "text", "circle").unwrap());
    assert_eq!(verdict.regime.name(), "circular");
    assert!((verdict.turning_rate.unwrap() + 0.3).abs() < 1e-9, "{:?}", verdict.turning_rate);
}

/// Under a force along x a body moves straight along it, whatever the start; at rest without it.
#[test]
fn a_body_falls_along_a_force() {
    let mut study = preset("force");
    study.set("gamma", -0.5).unwrap();
    let falling = verdict(&study);
    assert_eq!(falling.regime.name(), "straight", "{}", falling.why);
    study.set("g", 0.0).unwrap();
    assert_eq!(verdict(&study).regime.name(), "motionless");
}

#[test]
fn errors_are_shown_at_their_place_in_the_file() {
    let file = |equation: &str| {
        format!(
            "[model.amplitudes]\nmodes = [1, 2]\n[model.amplitudes.parameters]\nkappa = 0.5\n[model.amplitudes.equations]\nz1 = \"{equation}\"\nz2 = '''\n-kappa*z2'''"
        )
    };
    let refusal = |text: &str| Study::parse(text, "my.toml", "my").unwrap_err().to_string();
    assert!(Study::parse(&file("z1 - |z1|^2*z1"), "my.toml", "my").is_ok());
    assert!(refusal(&file("z1 - kapa*z1")).contains("my.toml:6:12: unknown name kapa (did you mean kappa?)"));
    assert!(refusal(&file("z1*z2")).contains("my.toml:6:7: the term z1*z2 breaks rotations"));
    assert!(refusal("[model.amplitudes]\nmodes = [1]").contains("needs equations"));
    assert!(
        refusal("[model.amplitudes]\nmodes = [0]\n[model.amplitudes.equations]\nz0 = \"1\"")
            .contains("from 1 to 64")
    );
    assert!(
        refusal("[model.amplitudes]\nmodes = [1]\n[model.amplitudes.equations]\nz1 = \"z1\"\nz2 = \"1\"")
            .contains("unknown key")
    );
}
