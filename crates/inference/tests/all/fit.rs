//! Fits of simulated cells: errors, coverage, terms found.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Equations, Experiment, FULL, full};
use motiform_inference::{Fit, Library, Settings, Track, fit, select};

/// What became of one cell.
struct Outcome {
    /// Error of each true coefficient relative to the mean size of true coefficients' values, fitted with the true terms.
    errors: Vec<f64>,
    /// True coefficients within their 95 % intervals: (with all terms, with the true ones).
    covered: [usize; 2],
    exact: bool,
    tied: bool,
}

fn covered(found: &Fit, equations: &Equations) -> usize {
    let held = |(name, (_, c, _)): (&&str, &(usize, motiform_dynamics::Complex<f64>, Vec<i32>))| {
        let [low, high] = found.coefficient(name).unwrap().estimate.interval;
        (low..=high).contains(&c.re)
    };
    FULL.iter().zip(equations).filter(|pair| held(*pair)).count()
}

fn outcome(track: Track, equations: &Equations) -> Outcome {
    let tracks = [track];
    let whole = fit(&tracks, &Settings::default()).unwrap();
    let selection = select(&tracks, &whole).unwrap();
    let library = Library::tensor().select(&FULL).unwrap();
    let truth = fit(&tracks, &Settings { library, ..Settings::default() }).unwrap();
    let mut names = FULL.map(str::to_owned).to_vec();
    names.sort();
    let same = |set: &[String]| {
        let mut set = set.to_vec();
        set.sort();
        set == names
    };
    let error = |(name, (_, c, _)): (&&str, &(usize, motiform_dynamics::Complex<f64>, Vec<i32>))| {
        (truth.coefficient(name).unwrap().estimate.value / c.re - 1.0).abs()
    };
    Outcome {
        errors: FULL.iter().zip(equations).map(error).collect(),
        covered: [covered(&whole, equations), covered(&truth, equations)],
        exact: same(&selection.subsets.best().unwrap().names),
        tied: selection.subsets.ties.iter().any(|set| same(&set.names)),
    }
}

/// Median error, coverage with all and with the true terms, share with the exact set, share with it among the ties.
fn figures(runs: u64, experiment: impl Fn(u64) -> Experiment) -> [f64; 5] {
    let outcomes: Vec<Outcome> = (0..runs)
        .map(|seed| {
            let experiment = experiment(seed);
            outcome(experiment.track(), &experiment.equations)
        })
        .collect();
    let mut errors: Vec<f64> = outcomes.iter().flat_map(|o| o.errors.clone()).collect();
    errors.sort_by(f64::total_cmp);
    let share = |of: &dyn Fn(&Outcome) -> f64| outcomes.iter().map(of).sum::<f64>() / runs as f64;
    let all = FULL.len() as f64;
    let found = [
        errors[errors.len() / 2],
        share(&|o| o.covered[0] as f64 / all),
        share(&|o| o.covered[1] as f64 / all),
        share(&|o| f64::from(u8::from(o.exact))),
        share(&|o| f64::from(u8::from(o.tied))),
    ];
    println!("{runs} runs: median error, coverage (all, true terms), exact, among ties: {found:.4?}");
    found
}

#[test]
#[ignore = "a minute: figures in docs/inference.md"]
fn chaotic() {
    figures(60, |seed| Experiment::new(full(0.5, 0.1), 0.02, 100 + seed));
}

#[test]
#[ignore = "a minute: figures in docs/inference.md"]
fn zigzag() {
    figures(60, |seed| Experiment::new(full(0.9, 0.1), 0.02, 500 + seed));
}
