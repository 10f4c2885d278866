//! Equations given as text, through studies, plans, classification and scans.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_analysis::regime::{Course, Form};
use motiform_lab::analyse;
use motiform_models::amplitudes::NAME;
use motiform_study::presets::{EXTENSIONS, find_any};
use motiform_study::scan::Axis;
use motiform_study::{RunPlan, ScanPlan, Study};

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
            assert_eq!(RunPlan::new(&back).unwrap().hash(), RunPlan::new(&study).unwrap().hash());
        }
    }
}

#[test]
fn plans_hold_their_equations() {
    let plan = RunPlan::new(&preset("chiral")).unwrap();
    let text = serde_json::to_string(&plan).unwrap();
    let back: RunPlan = serde_json::from_str(&text).unwrap();
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
    analyse::classify(&RunPlan::new(study).unwrap(), 0.0, &()).unwrap().unwrap()
}

/// The Brusselator `x' = 1 - 4x + x^2 y, y' = 3x - x^2 y` for `x + iy = z2`: rates times `rate`, shapes times `length`.
fn brusselator(rate: f64, length: f64) -> Study {
    let equation = "s*(l - 4*re(z2) + re(z2)^2*im(z2)/l^2 + i*(3*re(z2) - re(z2)^2*im(z2)/l^2))";
    let head = "[model.amplitudes]\nmodes = [2]\nsymmetry = \"none\"\nvelocity = \"z2\"\n";
    let parameters = format!("[model.amplitudes.parameters]\ns = {rate:?}\nl = {length:?}\n");
    let start = format!("[initial]\nz2_re = {:?}\nz2_im = {:?}\n", 1.2 * length, 3.0 * length);
    let text = format!("{head}{parameters}[model.amplitudes.equations]\nz2 = \"{equation}\"\n{start}");
    Study::parse(&text, "text", "test").unwrap()
}

/// Its period by SciPy's DOP853 with rtol 1e-12. Newton's method on periodic orbits solves for a time beside a shape: in these units one is
/// larger than the other by up to 1e15.
#[test]
fn a_period_is_found_in_any_units() {
    for (rate, length) in [
        (1.0, 1.0),
        (1e-3, 1e-6),
        (1e-6, 1.0),
        (1.0, 1e-9),
        (1e-6, 1e-6),
        (1e3, 1e6),
        (1e-8, 1.0),
        (1e-9, 1e-3),
    ] {
        let mut study = brusselator(rate, length);
        let verdict = verdict(&study);
        let period = rate * verdict.period.unwrap_or_else(|| panic!("{rate} {length}: {}", verdict.why));
        assert!((period - 7.156_919_921_2).abs() < 2e-9, "{rate} {length}: {period}");
        assert_eq!(verdict.regime.name(), "zigzag");
        (study.run.t_end, study.run.transient) = (200.0 / rate, 40.0 / rate);
        let plan = RunPlan::new(&study).unwrap();
        let found = analyse::lyapunov(&plan, 2, analyse::Spans::default(), &()).unwrap();
        assert!(
            (found.exponents[1].value / rate + 1.1579).abs() < 0.01,
            "{rate} {length}: {:?}",
            found.exponents
        );
    }
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
    let text = "[model.amplitudes]\nmodes = [1]\n[model.amplitudes.parameters]\nomega = \
        0.3\n[model.amplitudes.equations]\nz1 = \"(1 + i*omega - |z1|^2)*z1\"";
    let verdict = verdict(&Study::parse(text, "text", "circle").unwrap());
    assert_eq!(verdict.regime.name(), "circular");
    assert!((verdict.turning_rate.unwrap() + 0.3).abs() < 1e-9, "{:?}", verdict.turning_rate);
}

/// The plane (omega, kappa2) from starts on the mirror's axis: cell by cell, the left half is the mirror image of the right one.
#[test]
fn the_map_of_a_handed_body_is_symmetric() {
    let mut study = preset("chiral");
    study.set_initial("v1", 0.5).unwrap();
    for omega in [0.05, 0.2] {
        for kappa2 in [0.6, 0.9, 1.2, 1.5] {
            let both = [omega, -omega].map(|omega| {
                let mut study = study.clone();
                study.set("omega", omega).unwrap();
                study.set("kappa2", kappa2).unwrap();
                verdict(&study)
            });
            let regimes = both.each_ref().map(|verdict| verdict.regime);
            assert_eq!(regimes[0], regimes[1], "{omega} {kappa2}: {} | {}", both[0].why, both[1].why);
            let courses = both.each_ref().map(|verdict| verdict.course);
            if regimes[0].name() == "circular" {
                assert!(courses[0].is_some() && courses[0] != courses[1], "{omega} {kappa2}: {courses:?}");
            }
        }
    }
}

/// A circle swimmer in a field: locked where the field is strong, else it circles and drifts; never a zigzag.
#[test]
fn a_circle_swimmer_in_a_field_locks_or_drifts() {
    let text = "[model.amplitudes]\nmodes = [1]\nsymmetry = \"none\"\n[model.amplitudes.parameters]\nomega = 0.5\ng = 0.1\n\
                [model.amplitudes.equations]\nz1 = \"(1 + i*omega - |z1|^2)*z1 + g\"";
    let mut study = Study::parse(text, "text", "text").unwrap();
    let drifting = verdict(&study);
    assert_eq!(
        (drifting.regime.name(), drifting.form),
        ("circular", Some(Form::DriftingCircular)),
        "{}",
        drifting.why
    );
    assert_eq!(drifting.course, Some(Course::Clockwise));
    // one turn of the heading in a period: Adler's equation for a fast return to the circle, period 2 pi/sqrt(omega^2 - g^2)
    let (rate, period) = (drifting.turning_rate.unwrap(), drifting.period.unwrap());
    assert!((rate * period + std::f64::consts::TAU).abs() < 1e-6, "{rate} {period}");
    assert!((period / (std::f64::consts::TAU / libm::sqrt(0.25 - 0.01)) - 1.0).abs() < 0.02, "{period}");
    study.set("g", 0.8).unwrap();
    let locked = verdict(&study);
    assert_eq!((locked.regime.name(), locked.form), ("straight", None), "{}", locked.why);
    assert!(locked.heading.is_some() && locked.course.is_none());
}

/// `v^2 = gamma + |a1| E^2/(2 kappa2)`: along the field for a1 < 0, across it for a1 > 0.
#[test]
fn a_field_that_stretches_a_body_directs_it() {
    for (a1, courses) in [(-0.5, [Course::AlongField, Course::AgainstField]), (0.5, [Course::AcrossField; 2])]
    {
        let mut study = preset("elongating-field");
        study.set("a1", a1).unwrap();
        let verdict = verdict(&study);
        assert!(courses.contains(&verdict.course.unwrap()), "{a1}: {:?}", verdict.course);
        assert!((verdict.speed.unwrap().mean - libm::sqrt(0.5 + 0.5 * 0.64)).abs() < 1e-9, "{}", verdict.why);
    }
}

/// Under a force along x a body moves straight along it, whatever the start; at rest without it.
#[test]
fn a_body_falls_along_a_force() {
    let mut study = preset("force");
    study.set("gamma", -0.5).unwrap();
    let falling = verdict(&study);
    assert_eq!(falling.regime.name(), "straight", "{}", falling.why);
    assert_eq!(falling.course, Some(Course::AlongField));
    assert!(falling.heading.unwrap().abs() < 1e-9, "{:?}", falling.heading);
    study.set("g", 0.0).unwrap();
    assert_eq!(verdict(&study).regime.name(), "motionless");
}

#[test]
fn errors_are_shown_at_their_place_in_the_file() {
    let file = |equation: &str| {
        format!(
            "[model.amplitudes]\nmodes = [1, 2]\n[model.amplitudes.parameters]\nkappa = \
            0.5\n[model.amplitudes.equations]\nz1 = \"{equation}\"\nz2 = '''\n-kappa*z2'''"
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

/// Multipliers of strongly contracting directions are lost in the matrix of a period: their exponents are
/// measured along the orbit. The mean divergence is their sum, and the mirror image has the same.
#[test]
fn exponents_of_contracting_orbits() {
    let text = "[model.amplitudes]\nmodes = [1]\nsymmetry = \"none\"\n[model.amplitudes.equations]\n\
                z1 = \"(1 + 0.3*i - |z1|^2)*z1 + 0.1\"";
    let plan = RunPlan::new(&Study::parse(text, "text", "drift").unwrap()).unwrap();
    let found = analyse::classify(&plan, 0.0, &()).unwrap().unwrap();
    // the mean of the divergence 2 - 4 |z|^2 over a long orbit, by the trapezoidal rule
    let (mut z, h) = ([1.0_f64, 0.0_f64], 1e-3);
    let (mut sum, mut count) = (0.0, 0);
    for step in 0..300_000 {
        let rate = |[x, y]: [f64; 2]| {
            let g = 1.0 - x * x - y * y;
            [g * x - 0.3 * y + 0.1, g * y + 0.3 * x]
        };
        let first = rate(z);
        let middle = rate([z[0] + 0.5 * h * first[0], z[1] + 0.5 * h * first[1]]);
        z = [z[0] + h * middle[0], z[1] + h * middle[1]];
        if step > 78_090 {
            sum += 2.0 - 4.0 * (z[0] * z[0] + z[1] * z[1]);
            count += 1;
        }
    }
    let divergence = sum / f64::from(count);
    let last = found.exponents[1];
    assert_eq!(found.exponents.len(), 2);
    assert!((last.value - divergence).abs() < last.error.max(3e-3), "{last:?} {divergence}");
    let of = |omega: f64| {
        let mut study = find_any("chiral", NAME).unwrap();
        study.set("omega", omega).unwrap();
        analyse::classify(&RunPlan::new(&study).unwrap(), 0.0, &()).unwrap().unwrap().exponents
    };
    let (left, right) = (of(0.05), of(-0.05));
    assert_eq!((left.len(), right.len()), (6, 6));
    for (a, b) in left.iter().zip(&right) {
        assert!((a.value - b.value).abs() <= 2.0 * (a.error + b.error) + 1e-4, "{left:?} {right:?}");
    }
}
