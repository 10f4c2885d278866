//! One `rtol` means accuracy: the global error follows the request, for both models.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;
use crate::samples::draws;

use common::{preset, run};
use motiform_models::ModelInfo;
use motiform_study::plan::Control;
use motiform_study::{RunPlan, Study};

const REQUESTS: [f64; 4] = [1e-6, 1e-8, 1e-10, 1e-12];

fn cell(length: f64) -> Study {
    let mut study = Study::of_model(ModelInfo::find("cell").unwrap());
    study.set("length", length).unwrap();
    for (name, value) in [("c1", 0.3), ("s1", 0.1), ("s2", 0.2), ("c3", 0.1), ("c4", 0.02)] {
        study.set_initial(name, value).unwrap();
    }
    study
}

fn tensor(name: &str, start: &[(&str, f64)]) -> Study {
    preset(name, |study| {
        (study.initial, study.return_map) = (Vec::new(), None);
        start.iter().for_each(|(name, value)| study.set_initial(name, *value).unwrap());
    })
}

/// The shape after t = 40.
fn after(study: &Study, rtol: f64, atol: Option<f64>) -> Vec<f64> {
    let mut study = study.clone();
    (study.run.transient, study.run.t_end, study.run.dt_out) = (0.0, 40.0, 40.0);
    (study.run.rtol, study.run.atol) = (rtol, atol);
    run(&study).manifest.state.values()
}

fn norm(x: impl Iterator<Item = f64>) -> f64 {
    x.map(|x| x * x).sum::<f64>().sqrt()
}

/// The truth is a run with a request of a hundredth, or a tenth, of the finest one.
///
/// Errors relative to the size of the state, over the request. Local errors add up over 40 time units of motions that do not
/// contract everywhere: up to 26 times the request for the cell (length 29.2), 0.7 times for the tensor model.
#[test]
fn the_global_error_follows_rtol_alone() {
    let cases = [
        (cell(13.2), 1e-15, 40.0),
        (cell(21.6), 1e-15, 40.0),
        (cell(29.2), 1e-15, 40.0),
        (tensor("fig5a", &[("v1", -0.5), ("v2", 0.3), ("s11", 0.1)]), 1e-17, 1.0),
        (tensor("fig3", &[("v1", 0.1), ("v2", 0.05), ("s12", 0.03)]), 1e-17, 1.0),
    ];
    for (study, finest, factor) in cases {
        let truth = after(&study, draws(1e-12, 1e-13), Some(draws(10.0 * finest, finest)));
        let size = norm(truth.iter().copied());
        let error = |rtol| norm(after(&study, rtol, None).iter().zip(&truth).map(|(a, b)| a - b)) / size;
        let requests = &REQUESTS[..draws(3, 4)];
        let errors: Vec<f64> = requests.iter().map(|rtol| error(*rtol)).collect();
        for (error, rtol) in errors.iter().zip(requests) {
            assert!(*error < factor * rtol, "{} {rtol}: {errors:?}", study.model);
        }
        for pair in errors.windows(2) {
            // at 1e-6 the longest step of the cell, and not the tolerance, limits its error
            assert!(pair[1] < pair[0] / 10.0, "a hundredth of the request: {errors:?}");
        }
    }
}

#[test]
fn the_absolute_tolerance_follows_unless_it_is_given() {
    let control = |study: &Study| RunPlan::new(study).unwrap().computation.control;
    for (model, rtol, atol) in [("tensor", 1e-9, 1e-12), ("cell", 1e-6, 1e-7)] {
        let mut study = Study::of_model(ModelInfo::find(model).unwrap());
        assert_eq!(control(&study), Control::Adaptive { rtol, atol }, "the default pair");
        study.run.rtol = 0.01 * rtol;
        let Control::Adaptive { atol: finer, .. } = control(&study) else { unreachable!() };
        assert!((finer / (0.01 * atol) - 1.0).abs() < 1e-12, "{finer}");
        study.run.atol = Some(0.25);
        assert_eq!(control(&study), Control::Adaptive { rtol: 0.01 * rtol, atol: 0.25 });
        assert_eq!(control(&study).to_string(), format!("rtol {:e}, atol 2.5e-1", 0.01 * rtol));
    }
    // fig2 gives both: its rests are approaches to zero
    assert_eq!(control(&preset("fig2", |_| ())), Control::Adaptive { rtol: 1e-12, atol: 1e-300 });
}
