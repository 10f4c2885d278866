//! From the kind of reduced orbit to the motion, with its numbers in words.

use super::heteroclinic::Cycle;
use super::motion::Path;
use super::recurrence::Recurrence;
use super::settings::Settings;
use super::verdict::{Attractor, Regime, Spread, Verdict};
use crate::equilibrium::RelativeEquilibrium;
use crate::periodic::PeriodicOrbit;
use crate::{Estimate, Result};
use motiform_dynamics::Equivariant;

/// Samples of a period: enough for the legs of its path.
const SAMPLES: usize = 720;

/// Net rotations below this part of a turn per period are none.
const NO_TURN: f64 = 1e-6;

/// A run that left every bound at time `t`.
pub(super) fn blow_up(singular: bool, t: f64, time: f64) -> Verdict {
    let why = if singular {
        format!("the shape grows like a singularity of finite time, t* = {t:.6}")
    } else {
        format!("the shape left every bound at t = {t:.6}")
    };
    let mut verdict = Verdict::new(Regime::BlowUp, Attractor::Escape, why, time);
    verdict.escape_time = Some(t);
    verdict
}

/// Speeds below this part of the largest shape on the way are what is left of it: Newton's method goes no further.
const REST: f64 = 1e-13;

/// A stable relative equilibrium, reached up to `distance` (against its size) by an orbit that was as large as `largest`.
pub(super) fn equilibrium<B: Equivariant + ?Sized>(
    body: &B,
    found: &RelativeEquilibrium,
    (distance, largest): (f64, f64),
    settings: &Settings,
    time: f64,
) -> Verdict {
    let speed = found.speed();
    let least_speed = body
        .speed_resolution(&found.shape, settings.atol())
        .max(1e-9 * found.scale * settings.accuracy())
        .max(REST * largest);
    let least_turn = (1e3 * found.resolution()).max(1e-12);
    let turns = found.turning_rate.abs() > least_turn;
    let moves = speed > least_speed;
    let regime = match (moves, turns) {
        (false, false) => Regime::Motionless,
        (true, false) => Regime::Straight,
        (_, true) => Regime::Circular,
    };
    let growth = found.growth();
    let why = format!(
        "a fixed shape{}, reached to {distance:.0e}; stable: its leading eigenvalue is {growth:.2e}",
        match (regime, moves) {
            (Regime::Motionless, _) => " at rest".to_owned(),
            (Regime::Straight, _) => format!(" that moves at {speed:.4e} without turning"),
            (_, false) => format!(" that turns on the spot at {:.4e}", found.turning_rate),
            (_, true) => format!(" that moves at {speed:.4e} and turns at {:.4e}", found.turning_rate),
        }
    );
    let mut verdict = Verdict::new(regime, Attractor::Equilibrium, why, time);
    let sure =
        |value: f64, least: f64| if value > least { value / least } else { least / value.max(1e-3 * least) };
    let margins =
        [-growth / found.resolution(), sure(speed, least_speed), sure(found.turning_rate.abs(), least_turn)];
    verdict.margin = Some(margins.into_iter().fold(f64::MAX, f64::min));
    verdict.speed = Some(Spread { mean: speed, min: speed, max: speed });
    verdict.turning_rate = moves.then_some(if turns { found.turning_rate } else { 0.0 });
    let error = found.resolution();
    let neutral = std::iter::repeat_n(0.0, found.neutral);
    let mut values: Vec<f64> = found.eigenvalues.iter().map(|value| value.0).chain(neutral).collect();
    values.sort_by(|a, b| b.total_cmp(a));
    verdict.exponents = values.into_iter().map(|value| Estimate { value, error }).collect();
    verdict
}

/// A heteroclinic cycle.
pub(super) fn rectangular<B: Equivariant + ?Sized>(
    body: &B,
    cycle: &Cycle,
    shape: &[f64],
    settings: &Settings,
    time: f64,
) -> Result<Verdict> {
    let (out, inward) = (cycle.saddle.out, cycle.saddle.inward);
    let why = format!(
        "rests near motionless shapes that are saddles, reached to {:.0e}; lambda_+ = {out:.4} and lambda_- = {inward:.4} \
         have a negative sum: a heteroclinic cycle that attracts",
        cycle.closest
    );
    let mut verdict = Verdict::new(Regime::Rectangular, Attractor::Heteroclinic, why, time);
    verdict.margin = Some(-(out + inward) / (1e3 * cycle.equilibrium.resolution()));
    verdict.rests.clone_from(&cycle.rests);
    verdict.saddle = Some(cycle.saddle);
    let longest = cycle.rests.iter().copied().fold(0.0, f64::max);
    let path = Path::follow(body, shape, 6.0 * longest, 4 * SAMPLES, settings)?;
    verdict.speed = path.speed();
    verdict.legs = super::legs::between_rests(&path);
    Ok(verdict)
}

/// A stable relative periodic orbit.
pub(super) fn periodic<B: Equivariant + ?Sized>(
    body: &B,
    orbit: &PeriodicOrbit,
    recurrence: &Recurrence,
    settings: &Settings,
    time: f64,
) -> Result<Verdict> {
    let path = Path::follow(body, &orbit.shape, orbit.period(), SAMPLES, settings)?;
    let rotation = orbit.net_rotation();
    let no_turn = NO_TURN.max(settings.accuracy());
    let (regime, what) = match (path.moves(), orbit.mirrored, rotation.abs() < no_turn) {
        (false, ..) => (Regime::Motionless, "the centre rests while the shape repeats".to_owned()),
        (true, true, _) => (
            Regime::Zigzag,
            "half a period later the motion is its own mirror image, so it has no net rotation".to_owned(),
        ),
        (true, false, true) => (Regime::Zigzag, "the shape repeats without net rotation".to_owned()),
        (true, false, false) => {
            (Regime::QuasiPeriodic, format!("the shape repeats, turned by {rotation:.6} rad each time"))
        }
    };
    let returns = match recurrence.returns {
        1 => "one return".to_owned(),
        more => format!("{more} returns"),
    };
    let why = format!(
        "{what}; period {:.6}, largest multiplier {:.3e}: stable; it closes after {returns} to its section",
        orbit.period(),
        orbit.growth()
    );
    let mut verdict = Verdict::new(regime, Attractor::Periodic, why, time);
    let stability = (1.0 - orbit.growth()) / settings.accuracy();
    let turning = if orbit.mirrored { f64::MAX } else { rotation.abs() / no_turn };
    verdict.margin = Some(stability.min(if turning < 1.0 { 1.0 / turning.max(1e-3) } else { turning }));
    verdict.period = Some(orbit.period());
    verdict.net_rotation = Some(rotation);
    verdict.speed = path.speed();
    let error = settings.accuracy() / orbit.time;
    let neutral = if body.is_symmetric() { 2 } else { 1 };
    let mut values: Vec<f64> = orbit.exponents().into_iter().filter(|x| x.is_finite()).collect();
    values.extend(std::iter::repeat_n(0.0, neutral));
    values.sort_by(|a, b| b.total_cmp(a));
    verdict.exponents = values.into_iter().map(|value| Estimate { value, error }).collect();
    if path.moves() {
        verdict.drift = Some(path.drift());
        // exactly 0 where the second half of the period mirrors the first
        verdict.turning_rate = path.turning_rate().map(|rate| if orbit.mirrored { 0.0 } else { rate });
        super::legs::describe(&mut verdict, &path, rotation);
    }
    Ok(verdict)
}

/// Speeds and turning along a stretch of an orbit that does not repeat.
pub(super) fn along<B: Equivariant + ?Sized>(
    verdict: &mut Verdict,
    body: &B,
    shape: &[f64],
    time: f64,
    settings: &Settings,
) -> Result<()> {
    let path = Path::follow(body, shape, time, SAMPLES, settings)?;
    verdict.speed = path.speed();
    verdict.turning_rate = path.turning_rate();
    Ok(())
}
