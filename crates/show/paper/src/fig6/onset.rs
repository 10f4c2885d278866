//! The onset of growth of each mode of the circle: measured from runs, and compared with the windows.

use super::super::claims::{claim, differs};
use super::super::context::Context;
use super::edges::Edges;
use super::lengths::study;
use super::windows::number;
use motiform_figures::report::Claim;
use motiform_study::Error;
use std::f64::consts::TAU;

/// Modes that are looked at.
const MODES: [u16; 4] = [1, 2, 3, 4];

/// The start, and the time in which its growth is read off: small enough that the quadratic terms are below round-off.
const START: f64 = 1e-7;
const TIME: f64 = 50.0;

/// The paper's windows of modes 2, 3, 4.
pub(super) const WINDOWS: [(f64, f64); 3] = [(12.0, 14.4), (21.0, 21.9), (29.0, 29.9)];

/// The lengths at which modes 1 to 4 begin to grow.
pub(super) struct Onsets(pub(super) [f64; 4]);

impl Onsets {
    /// Bisection in the length: does a small mode `n` grow or decay in a run?
    pub(super) fn find(context: &Context<'_>) -> Result<Self, Error> {
        let found = context.kept.once("onsets of Fig. 6", || context.each(&MODES, |n| onset(context, *n)))?;
        let found: Vec<f64> = found.into_iter().map(|length| context.number(length)).collect();
        found.try_into().map(Self).map_err(|_| Error::Interrupted)
    }

    /// Sentence 143, sentence 144.
    pub(super) fn claims(&self, edges: &Edges) -> [Claim; 2] {
        [self.each(), self.inside(edges)]
    }

    fn each(&self) -> Claim {
        let off = MODES.iter().zip(&self.0).map(|(n, l)| (l / (TAU * f64::from(*n)) - 1.0).abs());
        let worst = off.fold(0.0, f64::max);
        let found: Vec<String> = self.0.iter().map(|l| format!("{l:.5}")).collect();
        claim(
            &[143],
            "The linear stability analysis shows that the mode-*n* deformation of the circle becomes unstable at *L* = 2π*n*.",
            format!(
                "it begins to grow at *L* = {} for *n* = 1 to 4; within {worst:.0e} of 2π*n*",
                found.join(", ")
            ),
            "runs of the whole equation from a circle with 10^{-7} of mode *n* alone, 50 time units each: bisection of growth \
             against decay in the length",
            worst < 1e-5,
        )
    }

    fn inside(&self, edges: &Edges) -> Claim {
        let says = "Actually mode 2 becomes unstable in *W*_1 (*L* ~ 4π), mode 3 in *W*_2 (*L* ~ 6π) and mode 4 in *W*_3 (*L* ~ 8π).";
        let how = "the lengths at which modes begin to grow in runs, against the paper's windows; edges of steady shapes from their \
                   eigenvalues";
        let within = |i: usize| WINDOWS[i].0 <= self.0[i + 1] && self.0[i + 1] <= WINDOWS[i].1;
        let words = |i: usize| {
            let (from, to) = WINDOWS[i];
            let place =
                if within(i) { "inside".to_owned() } else { format!("{:.1} before", from - self.0[i + 1]) };
            format!("mode {} at *L* = {:.2}, {place} *W*_{} = [{from}, {to}]", i + 2, self.0[i + 1], i + 1)
        };
        let finds = (0..3).map(words).collect::<Vec<_>>().join("; ");
        if (0..3).all(within) {
            return claim(&[144], says, finds, how, true);
        }
        let two_fold = number(edges.two_fold_end);
        differs(
            &[144],
            says,
            finds,
            how,
            &format!(
                "that holds for *W*_1 alone. At the onsets of modes 3 and 4 the circle has long been unstable, and the stable shape there \
                 is the two-fold or the three-fold one at rest. *W*_2 begins where the two-fold shape loses its stability \
                 (*L* = {two_fold:.2}), not where mode 3 of the circle does"
            ),
            within(0)
                && (1..3).all(|i| self.0[i + 1] < WINDOWS[i].0 - 1.0)
                && (two_fold - WINDOWS[1].0).abs() < 0.3
                && number(edges.two_fold) < self.0[2]
                && edges.three_fold.0.is_some_and(|from| from < self.0[3]),
        )
    }
}

fn onset(context: &Context<'_>, n: u16) -> Result<f64, Error> {
    let (mut low, mut high) = (5.0 * f64::from(n), 8.0 * f64::from(n));
    while high - low > 1e-7 * high {
        let middle = 0.5 * (low + high);
        if growth(context, n, middle)? > 0.0 { high = middle } else { low = middle }
    }
    Ok(0.5 * (low + high))
}

/// `ln(c_n(T)/c_n(0))/T` in a run.
fn growth(context: &Context<'_>, n: u16, length: f64) -> Result<f64, Error> {
    let mut study = study(length, 20)?;
    let name = format!("c{n}");
    study.set_initial(&name, START)?;
    (study.run.transient, study.run.t_end, study.run.dt_out) = (0.0, TIME, TIME);
    (study.run.rtol, study.run.atol) = (1e-10, Some(1e-17));
    let end = context.simulate(&study)?.manifest.state.get(&name).unwrap_or(f64::NAN);
    Ok((end / START).ln() / TIME)
}
