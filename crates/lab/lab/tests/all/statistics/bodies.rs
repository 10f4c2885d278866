//! Bodies that are simulated: against single runs, for any number of threads, and after an interruption.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::Watch;
use motiform_lab::simulate::simulate;
use motiform_lab::statistics::{Measurement, simulated, summary, tables};
use motiform_statistics::{Settings, Track, Tracks, statistics};
use motiform_study::{RunPlan, Study};
use std::sync::atomic::{AtomicUsize, Ordering};

fn study(text: &str) -> Study {
    Study::parse(text, "text", "test").unwrap()
}

const NOISY: &str = "[model.tensor]\ngamma = 1\nkappa2 = 2\nkappa3 = 2\n[run]\nt_end = 40\ntransient = 5\ndt_out = 0.1\nnoise = 0.2";
const IN_EQUATIONS: &str = "[model.amplitudes]\nmodes = [1, 2]\n[model.amplitudes.equations]\nz1 = \"(1 - \
    |z1|^2)*z1\"\nz2 = \"-2*z2\"\n[model.amplitudes.noise]\nz1 = \"0.2*z1\"\nz2 = \"0.1\"\n[initial]\nv1 = \
    1.0\n[run]\nt_end = 40\ntransient = 5\ndt_out = 0.1";
const SILENT: &str = "preset = \"fig5b\"\n[run]\nt_end = 40\ntransient = 5\ndt_out = 0.1";

fn run(
    text: &str,
    count: usize,
    threads: usize,
    watch: &dyn Watch,
) -> motiform_lab::statistics::Result<Measurement> {
    simulated(&study(text), count, &Settings::default(), threads, watch)
}

/// Body k is the run with the seed `seed + k`: statistics of single runs, put together here, are the same.
#[test]
fn bodies_are_single_runs() {
    for (text, places) in [(NOISY, 1e-15), (SILENT, 1e-6)] {
        let found = run(text, 9, 2, &()).unwrap();
        assert_eq!(found.seeds, (1..10).collect::<Vec<u64>>());
        let bodies = (1..10).map(|seed| {
            let mut study = study(text);
            study.run.seed = seed;
            let table = simulate(&RunPlan::new(&study).unwrap(), &()).unwrap().trajectory;
            let column = |name: &str| table.get(name).unwrap().to_vec();
            let pair = |a: &str, b: &str| -> Vec<[f64; 2]> {
                column(a).into_iter().zip(column(b)).map(|(a, b)| [a, b]).collect()
            };
            Track {
                position: pair("x", "y"),
                velocity: pair("v1", "v2"),
                modes: vec![pair("s11", "s12"), pair("u111", "u222")],
                rates: Vec::new(),
            }
        });
        let names = vec!["s".to_owned(), "u".to_owned()];
        let tracks = Tracks::new(0.1, names, bodies.collect()).unwrap();
        let alone = statistics(&tracks, &Settings::default()).unwrap();
        assert_eq!(found.statistics.samples, [401, 401]);
        for (one, other) in found.statistics.displacement.points().iter().zip(alone.displacement.points()) {
            // in lanes the transient is a part of the orbit: other steps, the same motion to the tolerance of the run
            assert!((one.value.value / other.value.value - 1.0).abs() <= places, "{one:?} {other:?}");
        }
        assert!((found.statistics.mean_speed.value / alone.mean_speed.value - 1.0).abs() <= places);
    }
}

#[test]
fn threads_do_not_matter() {
    for text in [NOISY, SILENT, IN_EQUATIONS] {
        let [one, three] = [1, 3].map(|threads| run(text, 70, threads, &()).unwrap());
        assert_eq!(one, three);
    }
}

/// Stops after some reports of progress.
struct Impatient(AtomicUsize, usize);

impl Watch for Impatient {
    fn progress(&self, _: f64) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }

    fn stopped(&self) -> bool {
        self.0.load(Ordering::Relaxed) >= self.1
    }
}

#[test]
fn an_interruption_keeps_the_bodies_that_are_finished() {
    let alone = format!("{NOISY}\nstepper = \"rk4\"\nstep = 0.05"); // a method without lanes
    let found = run(&alone, 60, 1, &Impatient(AtomicUsize::new(0), 20)).unwrap();
    assert!(!found.complete && found.statistics.bodies == 20 && found.seeds == (1..21).collect::<Vec<u64>>());
    assert!(found.notes[0].contains("40 of 60 bodies were not finished"), "{:?}", found.notes);
    let lanes = run(SILENT, 200, 1, &Impatient(AtomicUsize::new(0), 65)).unwrap();
    assert!(!lanes.complete && lanes.statistics.bodies == 64); // the first 64 are together
    let noisy = run(NOISY, 200, 1, &Impatient(AtomicUsize::new(0), 2 * 64 + 1)).unwrap();
    // In lanes 64 transients, then as many recordings; without them one run after the other.
    let finished = if motiform_dynamics::simd::has_lanes() { 64 } else { 129 };
    assert!(!noisy.complete && noisy.statistics.bodies == finished, "{}", noisy.statistics.bodies);
    let error = run(NOISY, 60, 2, &Impatient(AtomicUsize::new(0), 0)).unwrap_err();
    assert_eq!(error.to_string(), "interrupted");
}

#[test]
fn bodies_that_blow_up_are_left_out_and_counted() {
    let text = "[model.tensor]\ngamma = 1\nkappa2 = -1\nkappa3 = 1\n[run]\nt_end = 40";
    let error = run(text, 4, 1, &()).unwrap_err().to_string();
    assert!(error.contains("no body completed its run, of 4 (seed 1: "), "{error}");
    // a pure growth of the shape, dS/dt = S, leaves every bound before 40
    let at: f64 = error.split("= ").nth(1).and_then(|t| t.split([' ', ')']).next()?.parse().ok()).unwrap();
    assert!(at < 40.0, "{error}");
}

#[test]
fn what_is_wrong_is_named() {
    let given = format!("{SILENT}\n[initial]\nv1 = 0.1");
    let told = |text: &str, count| run(text, count, 1, &()).unwrap_err().to_string();
    assert!(told(&given, 3).contains("without noise all bodies with this start are the same"));
    assert!(told(NOISY, 0).contains("bodies = 0"));
    let short = SILENT.replace("dt_out = 0.1", "dt_out = 10");
    assert!(told(&short, 8).contains("fewer than 16: record longer, or more often"));
    assert!(run(&given, 1, 1, &()).is_ok());
}

/// Tables have equally long columns, and the summary holds no null.
#[test]
fn tables_and_summary_are_whole() {
    let found = run(NOISY, 12, 2, &()).unwrap();
    for table in tables(&found.statistics) {
        let lengths = motiform_store::columns::to_csv(&table.columns);
        assert!(String::from_utf8(lengths).unwrap().lines().count() > 1, "{}", table.name);
    }
    let text = summary(&found).to_string();
    assert!(!text.contains("NaN"));
    let object = summary(&found);
    assert!(
        object["persistent_walk"]["persistence"]["value"].is_f64()
            || object["persistent_walk"]["persistence"]["reason"].is_string()
    );
    assert_eq!(object["errors"]["over"], "bodies");
}

/// The cell has no velocity among its coordinates: it is computed from the shape.
#[test]
fn a_cell_is_measured_too() {
    let text = "[model.cell]\nlength = 13.2\n[run]\nt_end = 100\ntransient = 100\ndt_out = 1";
    let found = run(text, 8, 2, &()).unwrap();
    let names: Vec<&str> = found.statistics.autocorrelations.iter().map(|a| a.quantity.name()).collect();
    assert_eq!(names, ["velocity", "heading", "speed", "mode1", "mode2", "mode3", "mode4"]);
    // the velocity is the derivative of the position
    assert!(found.statistics.rms_speed.value > 0.0);
}
