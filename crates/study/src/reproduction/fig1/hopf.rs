//! The dotted line: where straight motion loses its stability, and what it turns into.

use super::grid::Grid;
use super::{Claim, Context, claim};
use crate::Error;
use crate::draw::number;
use crate::reproduction::claims::differs;
use motiform_analysis::regime::Regime;
use motiform_models::tensor::reduced::{Motion, Reduced};

/// `kappa2` at which the line is crossed, right and left of where its kind changes.
const RIGHT: [f64; 3] = [-0.02, -0.035, -0.05];
const LEFT: [f64; 2] = [-0.1, -0.14];

/// How far beyond the line (in gamma) runs are made: first a step, then four times that.
const BEYOND: [f64; 2] = [1e-4, 4e-4];

pub(super) fn claims(context: &Context<'_>, grid: &Grid) -> Result<[Claim; 2], Error> {
    Ok([limit(grid), kind(context, grid)?])
}

/// Whether the stability of straight motion ends there.
fn limit(grid: &Grid) -> Claim {
    let (before, beyond) = grid.beside_hopf(0.0);
    let straight =
        |cells: &[&super::grid::Cell]| cells.iter().filter(|cell| cell.has(Motion::Straight)).count();
    let finds = format!(
        "beyond the analytic line {} of {} cells hold straight motion; before it {} of {} do",
        straight(&beyond),
        beyond.len(),
        straight(&before),
        before.len()
    );
    claim(
        &[95],
        "The dotted line has been obtained as the stability limit of the straight motion.",
        finds,
        "cells from half a cell to six cells off the line and more than one and a half from every other",
        straight(&beyond) == 0 && !beyond.is_empty() && straight(&before) > 0,
    )
}

/// What a start near the straight motion becomes beyond the line.
struct Crossed {
    kappa2: f64,
    /// The motion, the period where it has one, and the extremes of the speed, at each distance.
    found: Vec<(Regime, Option<f64>, [f64; 2])>,
}

impl Crossed {
    fn at(context: &Context<'_>, kappa2: f64) -> Result<Self, Error> {
        let one = |beyond: &f64| {
            let ([_, gamma], s) = line_at(kappa2);
            let study = context.preset("fig1", |study| {
                study.set("kappa2", kappa2)?;
                study.set("gamma", gamma + beyond)?;
                // the straight motion at the line, turned by a little so that no mirror symmetry is left
                let speed = (gamma - 2.0 * Reduced::PAPER.a1 * s).sqrt();
                study.set_initial("v1", 1.02 * speed)?;
                study.set_initial("v2", 1e-4 * speed)?;
                study.set_initial("s11", 2.0 * s)?;
                (study.run.rtol, study.run.atol) = (1e-10, Some(1e-30));
                Ok(())
            })?;
            let verdict = context.classify(&study)?;
            let speed = verdict.speed.map_or([f64::NAN; 2], |speed| [speed.min, speed.max]);
            Ok((verdict.regime, verdict.period, speed))
        };
        Ok(Self { kappa2, found: BEYOND.iter().map(one).collect::<Result<_, Error>>()? })
    }

    fn all(&self, regime: Regime) -> bool {
        self.found.iter().all(|found| found.0 == regime)
    }

    /// The swing of the speed at four times the distance over that at the distance: 2 for a supercritical bifurcation.
    fn growth(&self) -> f64 {
        let swing = |i: usize| self.found[i].2[1] - self.found[i].2[0];
        swing(1) / swing(0)
    }

    fn words(&self) -> String {
        let one = |(regime, period, [low, high]): &(Regime, Option<f64>, [f64; 2])| {
            let period = period.map_or_else(String::new, |period| format!(", period {period:.1}"));
            format!("{regime}{period}, speed {} to {}", number(*low), number(*high))
        };
        let found: Vec<String> = self.found.iter().map(one).collect();
        format!("*κ*_2 = {}: {}", self.kappa2, found.join("; then "))
    }
}

/// The point of the line at `kappa2`, and its ellipse `s`, by bisection in s.
fn line_at(kappa2: f64) -> ([f64; 2], f64) {
    let (mut low, mut high) = (-0.125 * Reduced::PAPER.b1 * (1.0 - 1e-9), 0.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if Reduced::PAPER.straight_hopf(middle)[0] < kappa2 { low = middle } else { high = middle }
    }
    let s = 0.5 * (low + high);
    (Reduced::PAPER.straight_hopf(s), s)
}

/// Where the first Lyapunov coefficient changes sign along the line.
fn bautin() -> [f64; 2] {
    let (mut low, mut high) = (line_at(-0.2).1, line_at(-0.005).1);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if Reduced::PAPER.straight_hopf_criticality(middle) > 0.0 { low = middle } else { high = middle }
    }
    Reduced::PAPER.straight_hopf(0.5 * (low + high))
}

/// Subcritical at the left, supercritical at the right.
fn kind(context: &Context<'_>, grid: &Grid) -> Result<Claim, Error> {
    let turns = bautin()[0];
    let crossed =
        |places: &[f64]| places.iter().map(|k| Crossed::at(context, *k)).collect::<Result<Vec<_>, _>>();
    let (right, left) = (crossed(&RIGHT)?, crossed(&LEFT)?);
    let (before, _) = grid.beside_hopf(turns);
    let both = before.iter().filter(|cell| cell.has(Motion::Rectangular)).count();
    let pulsating =
        right.iter().all(|at| at.found.iter().all(|found| found.0.name() == "pulsating-straight"));
    let growth: Vec<String> = right.iter().map(|at| format!("{:.2}", at.growth())).collect();
    let finds = format!(
        "The first Lyapunov coefficient changes its sign at *κ*_2 = {turns:.4}. Left of it ({} and {} beyond the line): {}; \
         before the line {both} of {} cells hold rectangular motion beside straight motion. Right of it: {}; there the swing of the \
         speed grows by {} for a fourfold distance",
        BEYOND[0],
        BEYOND[1],
        left.iter().map(Crossed::words).collect::<Vec<_>>().join("; "),
        before.len(),
        right.iter().map(Crossed::words).collect::<Vec<_>>().join("; "),
        growth.join(", "),
    );
    Ok(differs(
        &[94],
        "The dotted line is the subcritical Hopf bifurcation line from the straight motion to the rectangular motion.",
        finds,
        "the normal form's first coefficient from the formulas; starts 2 % off the straight motion, a little beyond the line, named \
         by the classifier; a swing that doubles (to 15 %) at four times the distance is the square root of a supercritical \
         bifurcation",
        &format!(
            "it is subcritical, and leads to rectangular motion, only for *κ*_2 < {turns:.4}. Between there and 0 it is supercritical: \
             straight motion turns into a stable pulsating straight motion (fixed heading, stop-and-go speed), which the paper does not \
             name; it is no zigzag, and exists in a narrow strip above the line, thinner than the cells of the paper's diagram"
        ),
        pulsating
            && right.iter().all(|at| (at.growth() / 2.0 - 1.0).abs() < 0.15)
            && left.iter().all(|at| at.all(Regime::Rectangular))
            && both > 0
            && RIGHT.iter().all(|kappa2| *kappa2 > turns)
            && LEFT.iter().all(|kappa2| *kappa2 < turns),
    ))
}
