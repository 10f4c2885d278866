//! Simulated, drawn as outlines, written, read, fitted: the same motion and the same equations.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use super::bodies::{cell, preset, sampled};
use motiform_analysis::regime::Regime;
use motiform_cells::{Agreement, CellFit, FitOptions, FitWork, Fitted, fit_cell, fits_json};
use motiform_inference::Placement;
use motiform_lab::scan::Opening;
use motiform_study::Study;
use std::fs;

fn fitted(study: &Study, options: &FitOptions) -> (motiform_cells::Sample, CellFit) {
    let sample = cell(study, 0.01);
    let fit = fit_cell(&sample.cells[0], options, &()).unwrap();
    (sample, fit)
}

fn regime(fitted: &Fitted) -> Option<Regime> {
    fitted.regime.as_ref().and_then(|found| found.regime)
}

#[test]
fn a_chaotic_cell_is_found_chaotic_at_its_place() {
    let study = preset("fig5b", 0.01, (0.5, 600));
    let (sample, fit) = fitted(&study, &FitOptions { draws: 20, drift: false, ..FitOptions::default() });
    let found = fit.fitted.as_ref().unwrap();
    assert_eq!(regime(found), Some(Regime::Chaotic), "{:?}", found.regime);
    assert!(!found.is_handed() && found.is_identifiable());
    let Placement::Placed(place) = &found.places[0] else { panic!("{:?}", found.places[0]) };
    for (coordinate, truth) in place.coordinates.iter().zip([0.5, 0.1]) {
        let off = (coordinate.estimate.value - truth).abs();
        assert!(
            off < 4.0 * coordinate.estimate.error && off < 0.05,
            "{} {:?}",
            coordinate.name,
            coordinate.estimate
        );
    }
    // the files: a summary, tables, and a study file that reads back as the fitted model
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("fitted");
    let json = fits_json(&sample, std::slice::from_ref(&fit));
    assert_eq!(json["cells"][0]["regime"], "chaotic");
    assert!(
        json["cells"][0]["coefficients"]["z1: z1* z2"]["value"]
            .as_f64()
            .is_some_and(|a| (a - 2.0).abs() < 0.1)
    );
    let weak = json["cells"][0]["coefficients"]["z1: z1* z2"]["weak_form"].as_f64().unwrap();
    assert!((weak - 2.0).abs() < 0.4, "{weak}");
    let innovations = json["cells"][0]["innovations"].as_object().unwrap();
    assert!(
        innovations.len() == 6 && innovations.values().all(|one| one["p_value"].as_f64().unwrap() > 1e-4)
    );
    let cells = [&sample.cells[0]];
    let work = FitWork::open(&target, &sample, &cells, &FitOptions::default(), Opening::New).unwrap();
    work.write(&sample, std::slice::from_ref(&fit), true).unwrap();
    let path = work.path();
    assert_eq!(motiform_store::kind_of(path), Some(motiform_store::Kind::Fits));
    let back = Study::read(&path.join("cell-1.toml")).unwrap();
    assert!(back.model.definition().is_some() && back.run.noise > 0.0);
    says_where_it_comes_from(&fs::read_to_string(path.join("cell-1.toml")).unwrap(), &back, &fit);
}

/// The covariance is that of the parameters of the file: `b1/4*z1^2` has a coefficient with a quarter of the error of `b1`.
fn says_where_it_comes_from(text: &str, study: &Study, fit: &CellFit) {
    let table: toml::Table = text.parse().unwrap();
    let own = table["fit"].as_table().unwrap();
    assert_eq!(own["cells"].as_array().unwrap()[0].as_str(), Some("1"));
    assert_eq!(own["frames"].as_integer(), i64::try_from(fit.frames).ok());
    assert_eq!(own["sha256_of_frames"].as_array().unwrap()[0].as_str().unwrap().len(), 64);
    let names: Vec<&str> =
        own["parameters"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    let parameters = &study.model.definition().unwrap().parameters;
    assert_eq!(names, parameters.iter().map(|one| one.name.as_str()).collect::<Vec<_>>());
    let rows = own["covariance"].as_array().unwrap();
    let model = fit.fitted.as_ref().unwrap().model();
    for (i, (coefficient, parameter)) in model.coefficients.iter().zip(parameters).enumerate() {
        let variance = rows[i].as_array().unwrap()[i].as_float().unwrap();
        let ratio = coefficient.estimate.value / parameter.default;
        let error = coefficient.estimate.error / ratio.abs();
        assert!((variance.sqrt() / error - 1.0).abs() < 1e-9, "{}: {variance} {error}", parameter.name);
    }
}

/// Equations with z4, as a user types them: found again among 45 terms, with the same motion, and compared in all its modes.
#[test]
fn a_cell_with_a_square_mode() {
    let text = r#"
        [model.amplitudes]
        modes = [1, 2, 3, 4]
        [model.amplitudes.equations]
        z1 = "z1 + 2*conj(z1)*z2 - |z1|^2*z1"
        z2 = "-0.5*z2 - 0.125*z1^2 + 0.3*conj(z1)*z3 + 0.4*conj(z2)*z4"
        z3 = "-0.1*z3 + 0.4*z1*z2 + 0.0125*z1^3 - 0.2*conj(z1)*z4"
        z4 = "-0.6*z4 + 2*z2^2 + 0.5*z1*z3"
    "#;
    let mut study = Study::parse(text, "text", "square").unwrap();
    sampled(&mut study, 0.01, (0.5, 600));
    let options = FitOptions { modes: 4, drift: false, simulations: 39, ..FitOptions::default() };
    let (_, fit) = fitted(&study, &options);
    let found = fit.fitted.as_ref().unwrap();
    assert_eq!(regime(found), Some(Regime::Chaotic), "{:?} {:?}", found.regime, found.warnings);
    let square = found.model().coefficient("z4: z2^2").unwrap().estimate;
    assert!((square.value - 2.0).abs() < 4.0 * square.error && square.error < 0.2, "{square:?}");
    let prediction = fit.prediction.unwrap();
    assert_eq!(prediction.comparisons.len(), 11);
    assert_eq!(prediction.count(Agreement::Differs), 0, "{:?}", prediction.comparisons);
    assert!(found.study("1", 2.0).unwrap().model.definition().unwrap().modes.len() == 4);
}

#[test]
fn a_zigzag_is_found_a_zigzag() {
    let (_, fit) = fitted(
        &preset("fig5a", 0.005, (0.5, 600)),
        &FitOptions { draws: 20, drift: false, ..FitOptions::default() },
    );
    let found = fit.fitted.unwrap();
    assert_eq!(regime(&found), Some(Regime::Zigzag), "{:?} {:?}", found.regime, found.warnings);
}

/// omega = 0.2: real coefficients cannot describe it.
#[test]
fn a_handed_cell_is_found_handed_and_has_no_place() {
    let mut study = preset("chiral", 0.01, (0.5, 600));
    study.set("omega", 0.2).unwrap();
    study.set("kappa2", 0.5).unwrap();
    let (_, fit) = fitted(&study, &FitOptions { draws: 10, drift: false, ..FitOptions::default() });
    let found = fit.fitted.unwrap();
    assert!(found.is_handed(), "p = {}", found.handedness.p_value);
    assert!(found.places.iter().all(|place| matches!(place, Placement::Refused { .. })));
}

#[test]
fn a_short_record_is_undecided() {
    let (_, fit) =
        fitted(&preset("fig5a", 0.01, (1.0, 25)), &FitOptions { draws: 10, ..FitOptions::default() });
    let found = fit.fitted.unwrap();
    assert_eq!(regime(&found), None);
    assert!(found.places.iter().all(|place| matches!(place, Placement::Refused { .. })));
    let (_, few) = fitted(&preset("fig5a", 0.01, (1.0, 5)), &FitOptions::default());
    assert!(few.fitted.unwrap_err().contains("at least 8"));
}

/// A short, noisy circle whose fitted equations blow up in 40 of 41 models: no name of a tracked cell.
#[test]
fn equations_that_blow_up_are_no_name() {
    use super::bodies::{cell_of, preset as circle};
    for seed in 500..506 {
        let mut study = circle("fig4", 0.02, (0.5, 80));
        study.set("kappa2", 0.5).unwrap();
        study.set("kappa3", 0.5).unwrap();
        study.run.seed = seed;
        let sample = cell_of(&study, 0.6, 0.03);
        let options = FitOptions { draws: 10, drift: false, ..FitOptions::default() };
        let found = fit_cell(&sample.cells[0], &options, &()).unwrap().fitted.unwrap();
        if found.regime.as_ref().is_some_and(|regime| regime.best == Regime::BlowUp) {
            assert!(found.places.iter().all(|place| matches!(place, Placement::Refused { .. })));
        }
        assert!([None, Some(Regime::Circular)].contains(&regime(&found)), "seed {seed}: {:?}", found.regime);
    }
}
