//! Motions classified in lanes.

use crate::kernel::{Common, FromModel, Kernel, TEXT, Text};
use motiform_analysis::Result;
use motiform_analysis::regime::{Candidate, Settings, Verdict, classify_in_lanes};
use motiform_dynamics::{Model, Watch};

/// One body to classify.
pub struct Row {
    /// The key that is returned with its verdict.
    pub key: usize,
    /// The body.
    pub body: Box<dyn Model>,
    /// Its shape at the start.
    pub start: Vec<f64>,
}

/// Provides the next row; `None` at the end.
type Next<'n> = &'n mut dyn FnMut() -> Option<Row>;

/// Receives a verdict with its row's key.
type Done<'d> = &'d mut dyn FnMut(usize, Result<Option<Verdict>>);

/// Classifies the motion of all rows that `next` gives, all of which `kernel` must compute; amplitude equations must be those of the
/// first row, with any parameters. Each verdict goes to `done` with the row's key. Verdicts are those of [`motiform_analysis::classify`]
/// to the last bit. When `watch` stops it, the rest is left.
pub fn classify_rows(kernel: Kernel, settings: &Settings, next: Next<'_>, done: Done<'_>, watch: &dyn Watch) {
    match kernel {
        Kernel::Tensor => classify::<Common, 6, 12>(settings, next, done, watch),
        Kernel::Amplitudes(1) if TEXT => classify::<Text<2>, 2, 4>(settings, next, done, watch),
        Kernel::Amplitudes(2) if TEXT => classify::<Text<4>, 4, 8>(settings, next, done, watch),
        Kernel::Amplitudes(3) if TEXT => classify::<Text<6>, 6, 12>(settings, next, done, watch),
        Kernel::Amplitudes(_) if TEXT => classify::<Text<8>, 8, 16>(settings, next, done, watch),
        Kernel::Amplitudes(_) => {}
    }
}

fn classify<F: FromModel, const N: usize, const D: usize>(
    settings: &Settings,
    next: Next<'_>,
    done: Done<'_>,
    watch: &dyn Watch,
) {
    let mut candidate = || {
        let Row { key, body, start } = next()?;
        Some(Candidate { key, field: F::from_model(body.as_ref())?, body, start: start.try_into().ok()? })
    };
    classify_in_lanes::<F, N, D>(settings, &mut candidate, done, watch);
}
