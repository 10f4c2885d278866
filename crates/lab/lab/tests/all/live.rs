//! A body that is watched moves as the run of its plan does, and what is computed from its record is that of the run.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::{InPlane, Model, Outcome};
use motiform_lab::live::{Record, Stretch, crossings_of_path, dataset, maxima_of_speed, spectra};
use motiform_lab::simulate::simulate;
use motiform_models::ModelInfo;
use motiform_store::table::same_bits;
use motiform_study::study::ReturnMapSettings;
use motiform_study::{RunPlan, Study, presets};
use std::time::Duration;

const PLENTY: Duration = Duration::from_secs(60);

fn study(model: &str, preset: &str) -> Study {
    presets::find(ModelInfo::find(model).unwrap(), preset).unwrap()
}

fn built(plan: &RunPlan) -> (Box<dyn Model>, Vec<f64>) {
    let model = plan.body().unwrap();
    let values = plan.computation.initial.values();
    let mut state = values.clone();
    model.encode(&values[..model.dim()], &mut state[..values.len() - 2]);
    (model, state)
}

/// Moves a plan's body to its end in looks of length `look`.
fn watched(plan: &RunPlan, look: f64) -> (Record, Box<dyn Model>, Option<Outcome>, Vec<f64>) {
    let (model, state) = built(plan);
    let mut record = Record::new(model.as_ref(), &plan.computation, 100_000);
    let (outcome, end) = {
        let body = InPlane(model.as_ref());
        let mut stretch = Stretch::new(plan, &body, 0.0, &state, 0).unwrap();
        let mut t = 0.0;
        while t < plan.computation.t_end {
            t = (t + look).min(plan.computation.t_end);
            assert!(stretch.advance(t, PLENTY, &mut record, model.as_ref()));
        }
        (stretch.outcome(), stretch.state().to_vec())
    };
    (record, model, outcome, end)
}

/// The display shows what `simulate` records, and the frequency of looking changes no bit.
#[test]
fn looking_does_not_change_the_motion() {
    for (model, preset, t_end) in [("tensor", "fig5b", 30.0), ("cell", "fig6a", 100.0)] {
        let mut study = study(model, preset);
        (study.run.transient, study.run.t_end) = (0.0, t_end);
        let plan = RunPlan::new(&study).unwrap();
        let simulated = simulate(&plan, &()).unwrap();
        let once = watched(&plan, t_end);
        let often = watched(&plan, 0.037 * t_end);
        for (record, model, outcome, _) in [&once, &often] {
            let seen = dataset(&plan, model.as_ref(), record, *outcome, None).unwrap().unwrap();
            // The last step of a run is cut at its end, that of a body goes on: all samples but those of that step agree.
            let rows = simulated.trajectory.rows() - 40;
            let cut = |table: &motiform_store::table::Table| {
                let mut table = table.clone();
                table.columns.iter_mut().for_each(|column| column.values.truncate(rows));
                table
            };
            assert!(same_bits(&cut(&seen.trajectory), &cut(&simulated.trajectory)), "{preset}");
        }
        assert_eq!(once.3, often.3, "the state that is shown");
    }
}

/// A record forgets the oldest samples, and its memory is bounded.
#[test]
fn a_record_keeps_the_last_samples() {
    let plan = RunPlan::new(&study("tensor", "fig5a")).unwrap();
    let (model, state) = built(&plan);
    let body = InPlane(model.as_ref());
    let mut record = Record::new(model.as_ref(), &plan.computation, 50);
    let mut stretch = Stretch::new(&plan, &body, 7.0, &state, 0).unwrap();
    for k in 1..40 {
        stretch.advance(7.0 + 0.5 * f64::from(k), PLENTY, &mut record, model.as_ref());
        assert!(record.len() <= 50);
    }
    let times: Vec<f64> = record.rows().map(|row| row.t).collect();
    let last = 7.0 + 0.05 * (19.5_f64 / 0.05).round();
    assert_eq!(times.len(), 50);
    assert!((times[49] - last).abs() < 1e-9 && times.windows(2).all(|w| (w[1] - w[0] - 0.05).abs() < 1e-9));
}

/// A velocity under white noise has no derivative, so its heading has no rate; under noise on the shape alone it has one.
#[test]
fn noise_on_the_velocity_leaves_no_turning_rate() {
    for (noise, noise_velocity, turns) in
        [(0.0, None, true), (0.01, Some(0.0), true), (0.0, Some(0.01), false)]
    {
        let mut study = study("tensor", "fig5a");
        (study.run.noise, study.run.noise_velocity) = (noise, noise_velocity);
        (study.run.transient, study.run.t_end) = (0.0, 5.0);
        let plan = RunPlan::new(&study).unwrap();
        let (record, ..) = watched(&plan, 1.0);
        assert!(record.rows().all(|row| row.read[1].is_nan() != turns), "{noise} {noise_velocity:?}");
        let simulated = simulate(&plan, &()).unwrap();
        let rates = simulated.trajectory.columns.iter().find(|column| column.name == "turning_rate").unwrap();
        assert!(rates.values.iter().all(|rate| rate.is_nan() != turns), "{noise} {noise_velocity:?}");
    }
}

/// Short of time, a body is shown where it got to.
#[test]
fn a_body_that_is_late_says_so() {
    let plan = RunPlan::new(&study("tensor", "fig5b")).unwrap();
    let (model, state) = built(&plan);
    let body = InPlane(model.as_ref());
    let mut record = Record::new(model.as_ref(), &plan.computation, 50);
    let mut stretch = Stretch::new(&plan, &body, 0.0, &state, 0).unwrap();
    assert!(!stretch.advance(1e6, Duration::from_millis(1), &mut record, model.as_ref()));
    assert!(stretch.t() > 0.0 && stretch.t() < 1e6 && stretch.outcome().is_none());
}

/// The blow-up of the full model ends the motion, at the time that `simulate` finds.
#[test]
fn a_blow_up_is_an_end() {
    let mut study = study("tensor", "fig4");
    study.set("kappa2", 0.2).unwrap();
    study.set("kappa3", 0.1).unwrap();
    for (name, value) in [("v1", 8.0), ("v2", 1.0), ("s11", 30.0), ("u111", -20.0)] {
        study.set_initial(name, value).unwrap();
    }
    (study.run.transient, study.run.dt_out) = (0.0, 0.001);
    let plan = RunPlan::new(&study).unwrap();
    let (_, _, outcome, _) = watched(&plan, 1.0);
    let simulated = simulate(&plan, &()).unwrap().manifest.outcome.outcome;
    assert!(matches!(simulated, Outcome::Escaped { singular: true, .. }));
    assert!((outcome.unwrap().t() - simulated.t()).abs() < 1e-9);
}

/// The return map of Fig. 3 from the record of a body is that of `simulate`, which locates crossings by steps of the method.
#[test]
fn crossings_of_the_path_are_those_of_the_run() {
    let mut study = study("tensor", "fig3");
    (study.run.transient, study.run.t_end) = (3000.0, 9000.0);
    let plan = RunPlan::new(&study).unwrap();
    let dataset = simulate(&plan, &()).unwrap();
    let expected = dataset.crossings.as_ref().unwrap().get("x").unwrap().to_vec();
    // The same motion from the start of the recording, which the run moved to put its centre on the origin.
    let row = |name: &str| dataset.trajectory.get(name).unwrap()[0];
    for name in ["v1", "v2", "s11", "s12", "u111", "u222", "x", "y"] {
        study.set_initial(name, row(name)).unwrap();
    }
    study.run.transient = 0.0;
    let plan = RunPlan::new(&study).unwrap();
    let (record, model, _, _) = watched(&plan, 11.0);
    let settings = plan.computation.return_map.clone().unwrap();
    let (found, centre) = crossings_of_path(&record, model.as_ref(), &settings);
    let found = found.get("x").unwrap();
    assert!(centre[0].hypot(centre[1]) < 1e-6, "{centre:?}");
    assert_eq!(found.len(), expected.len());
    assert!(found.len() > 60, "{}", found.len());
    for (a, b) in found.iter().zip(&expected) {
        assert!((a - b).abs() < 1e-4, "{a} {b}");
    }
    let whole_line = ReturnMapSettings { x_min: -1e300, x_max: 1e300, ..settings };
    assert!(crossings_of_path(&record, model.as_ref(), &whole_line).0.rows() >= found.len());
}

/// The zigzag swings through the middle twice per period: its speed has a period of its own, and a line in every spectrum.
#[test]
fn maxima_and_spectra_of_a_periodic_motion() {
    let mut study = study("tensor", "fig5a");
    (study.run.transient, study.run.t_end) = (1000.0, 1500.0);
    let plan = RunPlan::new(&study).unwrap();
    let after = simulate(&plan, &()).unwrap();
    for name in ["v1", "v2", "s11", "s12", "u111", "u222"] {
        study.set_initial(name, after.trajectory.get(name).unwrap()[0]).unwrap();
    }
    study.run.transient = 0.0;
    let plan = RunPlan::new(&study).unwrap();
    let (record, model, _, _) = watched(&plan, 3.0);
    let maxima = maxima_of_speed(&record);
    let highest = maxima.iter().copied().fold(0.0, f64::max);
    assert!(maxima.len() > 20, "{}", maxima.len());
    let verdict = motiform_lab::analyse::classify(&plan, 0.0, &()).unwrap().unwrap();
    let period = verdict.period.unwrap();
    let per_period = maxima.len() as f64 * period / plan.computation.t_end;
    assert!((per_period - per_period.round()).abs() < 0.05, "{per_period}");
    // In a periodic motion the same maxima come again.
    let again = maxima.iter().filter(|v| (*v - highest).abs() < 1e-6).count() as f64;
    assert!(again * period > 0.9 * plan.computation.t_end, "{again} {period}");
    let found = spectra(&record, model.as_ref(), plan.computation.dt_out);
    assert_eq!(found.curves.iter().map(|curve| curve.0).collect::<Vec<_>>(), ["speed", "s_norm", "u_norm"]);
    let (_, _, power) = &found.curves[0];
    let peak = (0..power.len()).max_by(|&a, &b| power[a].total_cmp(&power[b])).unwrap();
    let harmonics = found.frequencies[peak] * period;
    let resolution = found.frequencies[0] * period;
    assert!((harmonics - harmonics.round()).abs() < resolution && harmonics > 0.5, "{harmonics}");
}
