//! Numbers over cells: intervals cover, shares count what is undecided.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::bodies::{RADIUS, cell_of, preset};
use motiform_cells::{CellFit, FitOptions, fit_cell, fitted_population, over_cells};
use motiform_dynamics::Normal;

#[test]
fn intervals_over_cells_cover() {
    let (runs, cells) = (400_u16, 8);
    let mut random = Normal::new(5, 0);
    let mut covered = [0_u16; 2];
    for _ in 0..runs {
        let values: Vec<f64> = (0..cells).map(|_| 3.0 + random.next()).collect();
        let found = over_cells(&values).unwrap();
        for (count, interval) in covered.iter_mut().zip([found.mean_interval, found.median_interval]) {
            let [low, high] = interval.unwrap();
            *count += u16::from(low < 3.0 && 3.0 < high);
        }
    }
    println!("covered {covered:?} of {runs}");
    // 95 % of 400 are 380 -+ 4.4; quantiles of resamples alone hold 364 of 8 cells
    assert!(covered.iter().all(|&count| (370..=396).contains(&count)), "{covered:?}");
}

#[test]
fn the_mean_of_a_known_sample_and_its_interval() {
    let values: Vec<f64> = (0..100).map(f64::from).collect();
    let found = over_cells(&values).unwrap();
    assert_eq!((found.cells, found.mean, found.median), (100, 49.5, 49.5));
    // the standard error of the mean is 29.01/10
    let [low, high] = found.mean_interval.unwrap();
    assert!((low - (49.5 - 1.96 * 2.901)).abs() < 0.6 && (high - (49.5 + 1.96 * 2.901)).abs() < 0.6);
    assert_eq!(over_cells(&values).unwrap(), found, "the same cells give the same intervals");
    assert!(over_cells(&values[..7]).unwrap().mean_interval.is_none() && over_cells(&[]).is_none());
}

/// Turning rates of mirrored cells: the mean and the interval of the opposite values are opposite.
#[test]
fn mirrored_values_have_mirrored_intervals() {
    let mut random = Normal::new(6, 0);
    let values: Vec<f64> = (0..10).map(|_| libm::exp(random.next()) - 1.0).collect();
    let mirrored: Vec<f64> = values.iter().map(|value| -value).collect();
    let [one, other] = [values, mirrored].map(|values| over_cells(&values).unwrap());
    for (a, b) in [(one.mean_interval, other.mean_interval), (one.median_interval, other.median_interval)] {
        let ([low, high], [below, above]) = (a.unwrap(), b.unwrap());
        assert!((low + above).abs() < 1e-12 && (high + below).abs() < 1e-12, "{a:?} {b:?}");
    }
}

#[test]
fn cells_without_a_fit_are_undecided_and_counted() {
    let fits: Vec<CellFit> = (0..3)
        .map(|number| CellFit {
            name: number.to_string(),
            frames: 4,
            fitted: Err("too short".to_owned()),
            prediction: None,
            bifurcations: Vec::new(),
        })
        .collect();
    let found = fitted_population(&fits);
    assert_eq!((found.cells, found.fitted, found.coefficients.len()), (3, 0, 0));
    assert_eq!((found.regimes[0].name, found.regimes[0].share.count), ("undecided", 3));
    assert!(found.regimes[0].share.lower < 0.5, "three cells say little");
}

/// Of handed cells everything is of the model that describes them, and not of the mirror-symmetric one that their data reject: checks, what
/// the data determine, and the means over cells, which have the true imaginary part.
#[test]
fn handed_cells_have_the_numbers_of_their_own_model() {
    let mut study = preset("chiral", 0.01, (0.5, 400));
    study.set("omega", 0.05).unwrap();
    study.set("kappa2", 0.5).unwrap();
    let sample = cell_of(&study, RADIUS, 0.01);
    let options = FitOptions { draws: 40, simulations: 0, ..FitOptions::default() };
    let one = fit_cell(&sample.cells[0], &options, &()).unwrap();
    let fitted = one.fitted.as_deref().unwrap();
    let model = fitted.model();
    assert!(fitted.is_handed() && model.handed, "{:?} {:?}", fitted.handedness.p_value, fitted.doubts);
    let drift = fitted.drift.as_ref().unwrap();
    assert_eq!(drift.changes.len(), model.coefficients.len());
    assert_eq!(fitted.determined().0, &fitted.known);
    let found = fitted_population(&[one.clone(), one.clone()]);
    println!("{:?} {:?}", found.law, fitted.why());
    assert!(found.handed && found.fitted == 2 && found.coefficients.len() == model.coefficients.len());
    let imaginary = found.coefficients.iter().find(|c| c.imaginary && c.term == "z1: z1").unwrap();
    let error = model.coefficients.iter().find(|c| c.imaginary && c.name == "z1: z1").unwrap().estimate.error;
    println!("{} +- {error}", imaginary.over.mean);
    assert!((imaginary.over.mean.abs() - 0.05).abs() < 4.0 * error && error < 0.03);
}
