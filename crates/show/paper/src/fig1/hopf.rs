//! The dotted line: where straight motion loses its stability, and what it turns into.

use super::grid::Grid;
use super::{Claim, Context, claim};
use crate::claims::differs;
use motiform_analysis::regime::{Regime, Verdict};
use motiform_models::tensor::reduced::{Line, Motion, Reduced};
use motiform_study::{Error, Study};

/// `kappa2` at which the line is crossed, right and left of where its kind changes.
const RIGHT: [f64; 3] = [-0.02, -0.035, -0.05];
const LEFT: [f64; 2] = [-0.1, -0.14];

/// The distances beyond the line (in gamma) at which runs are made at the right: a step, and four times that.
const BEYOND: [f64; 2] = [1e-4, 4e-4];

/// The same at the left, where the orbit does not return.
const FAR: f64 = 3e-3;

/// The distance before the line at which both motions are looked for, at the left.
const BEFORE: f64 = 1e-3;

/// Time in which the oscillation beside the line settles: its amplitude does so at rates of some 1e-4.
const SETTLE: f64 = 1.2e5;

pub(super) fn claims(context: &Context<'_>, grid: &Grid) -> Result<[Claim; 2], Error> {
    Ok([limit(grid), kind(context)?])
}

/// The claim that the stability of straight motion ends there.
fn limit(grid: &Grid) -> Claim {
    let (before, beyond) = grid.beside_hopf();
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

/// A study that begins a part `off` off the straight motion of the line at `kappa2`, `beyond` the line; turned by a little, so
/// that no mirror symmetry is left.
fn beside(context: &Context<'_>, kappa2: f64, beyond: f64, off: f64) -> Result<Study, Error> {
    let (s, gamma) = Reduced::PAPER.on_line(Line::StraightHopf, kappa2).unwrap_or((f64::NAN, f64::NAN));
    context.preset("fig1", |study| {
        study.set("kappa2", kappa2)?;
        study.set("gamma", gamma + beyond)?;
        let speed = (gamma - 2.0 * Reduced::PAPER.a1 * s).sqrt();
        let start = [("v1", (1.0 + off) * speed), ("v2", 1e-4 * speed), ("s11", 2.0 * s), ("s12", 0.0)];
        start.iter().try_for_each(|(name, value)| study.set_initial(name, *value))?;
        (study.run.rtol, study.run.atol) = (1e-10, Some(1e-14));
        (study.run.transient, study.run.t_end, study.run.dt_out) = (SETTLE, 2000.0, 1.0);
        Ok(())
    })
}

/// The motion that straight motion becomes beyond the line, at the right.
struct Crossed {
    kappa2: f64,
    /// Smallest and largest speed, at each distance.
    speeds: Vec<[f64; 2]>,
    /// The motion at the larger distance.
    verdict: Verdict,
}

impl Crossed {
    fn at(context: &Context<'_>, kappa2: f64) -> Result<Self, Error> {
        let (mut speeds, mut last) = (Vec::new(), None);
        for beyond in BEYOND {
            let study = beside(context, kappa2, beyond, 0.02)?;
            let run = context.simulate(&study)?;
            let column = run.trajectory.get("speed").unwrap_or(&[]);
            speeds.push(column.iter().fold([f64::INFINITY, 0.0], |[low, high], v| [v.min(low), v.max(high)]));
            last = Some((study, run));
        }
        let Some((mut study, run)) = last else { return Err(Error::Interrupted) };
        for (name, value) in &run.manifest.state.0 {
            study.set_initial(name, *value)?;
        }
        Ok(Self { kappa2, speeds, verdict: context.classify(&study)? })
    }

    /// The swing of the speed at four times the distance over that at the distance: 2 for a supercritical bifurcation.
    fn growth(&self) -> f64 {
        let swing = |[low, high]: [f64; 2]| high - low;
        swing(self.speeds[1]) / swing(self.speeds[0])
    }

    fn words(&self) -> String {
        let [low, high] = self.speeds[1];
        format!(
            "{} at *κ*_2 = {} (period {:.1}, speed {low:.4} to {high:.4}, net rotation {:.0e}; its swing is \
            {:.2} times that at a quarter of the distance)",
            self.verdict.regime,
            self.kappa2,
            self.verdict.period.unwrap_or(f64::NAN),
            self.verdict.net_rotation.unwrap_or(f64::NAN).abs(),
            self.growth()
        )
    }
}

/// At the left: the motions before the line, from a start near the straight motion and from one near the ellipse at rest, and that
/// of a start near the straight motion beyond it.
struct Bistable {
    kappa2: f64,
    straight: Regime,
    ellipse: Regime,
    beyond: Regime,
}

impl Bistable {
    fn at(context: &Context<'_>, kappa2: f64) -> Result<Self, Error> {
        let near_straight = beside(context, kappa2, -BEFORE, 0.02)?;
        let (mut near_ellipse, mut beyond) = (near_straight.clone(), beside(context, kappa2, FAR, 0.1)?);
        let r2 = Reduced::PAPER.ellipse(kappa2).unwrap_or(f64::NAN);
        for (name, value) in [("v1", 0.01), ("v2", 0.001), ("s11", -1.8 * r2), ("s12", 0.001)] {
            near_ellipse.set_initial(name, value)?;
        }
        // at rest digits must stay relative
        (near_ellipse.run.atol, beyond.run.atol) = (Some(1e-30), Some(1e-30));
        let name = |study: &Study| Ok::<_, Error>(context.classify(study)?.regime);
        Ok(Self {
            kappa2,
            straight: name(&near_straight)?,
            ellipse: name(&near_ellipse)?,
            beyond: name(&beyond)?,
        })
    }

    fn is_so(&self) -> bool {
        self.straight == Regime::Straight
            && self.ellipse == Regime::Rectangular
            && self.beyond == Regime::Rectangular
    }

    fn words(&self) -> String {
        format!(
            "at *κ*_2 = {}, {BEFORE} before the line, {} from near the straight motion and {} from near the \
            ellipse at rest; {FAR} beyond it {} from near the straight motion",
            self.kappa2, self.straight, self.ellipse, self.beyond
        )
    }
}

/// Subcritical at the left, supercritical at the right.
fn kind(context: &Context<'_>) -> Result<Claim, Error> {
    let turns = Reduced::PAPER.bautin().map_or(f64::NAN, |at| at[0]);
    let right = RIGHT.iter().map(|k| Crossed::at(context, *k)).collect::<Result<Vec<_>, _>>()?;
    let left = LEFT.iter().map(|k| Bistable::at(context, *k)).collect::<Result<Vec<_>, _>>()?;
    let finds = format!(
        "the first Lyapunov coefficient changes its sign at *κ*_2 = {turns:.4}. Left of it: {}. Right of it, {} beyond the line: {}",
        left.iter().map(Bistable::words).collect::<Vec<_>>().join("; "),
        BEYOND[1],
        right.iter().map(Crossed::words).collect::<Vec<_>>().join("; "),
    );
    Ok(differs(
        &[94],
        "The dotted line is the subcritical Hopf bifurcation line from the straight motion to the rectangular motion.",
        finds,
        "the first coefficient of the normal form from the formulas; starts 2 % (at the left 10 %) off the straight motion, beside \
         the line, named by the classifier; a swing that doubles (to 15 %) at four times the distance is the square root of a \
         supercritical bifurcation",
        &format!(
            "it is subcritical, and leads to rectangular motion, only for *κ*_2 < {turns:.4}. Between there and 0 it is supercritical: \
             straight motion turns into a stable pulsating straight motion (fixed heading, stop-and-go speed), which the paper does not \
             name; it is no zigzag, and exists in a narrow strip above the line, thinner than the cells of the diagram"
        ),
        right.iter().all(|at| {
            at.verdict.regime == Regime::PulsatingStraight && (at.growth() / 2.0 - 1.0).abs() < 0.15
        }) && left.iter().all(Bistable::is_so)
            && RIGHT.iter().all(|kappa2| *kappa2 > turns)
            && LEFT.iter().all(|kappa2| *kappa2 < turns),
    ))
}
