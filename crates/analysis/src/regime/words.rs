//! From the kind of reduced orbit to the motion, with its numbers in words.

use super::form::Form;
use super::heteroclinic::Cycle;
use super::motion::Path;
use super::recurrence::{Recurrence, symmetry_of};
use super::settings::Settings;
use super::verdict::{Attractor, Regime, Spread, Verdict};
use crate::equilibrium::RelativeEquilibrium;
use crate::periodic::PeriodicOrbit;
use crate::{Estimate, Result};
use motiform_dynamics::{Equivariant, Watch};

/// Samples of a period: enough for the legs of its path.
pub(super) const SAMPLES: usize = 720;

/// Net rotations below this part of a turn per period are none.
pub(super) const NO_TURN: f64 = 1e-6;

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
const REST: f64 = 1e-11;

/// What a body does at a relative equilibrium.
struct Steady {
    regime: Regime,
    /// In words.
    what: String,
    moves: bool,
    turns: bool,
    /// Speeds and turning rates below these are zero.
    least: (f64, f64),
}

impl Steady {
    /// At this equilibrium, for an orbit that was as large as `largest`.
    fn of<B: Equivariant + ?Sized>(
        body: &B,
        found: &RelativeEquilibrium,
        largest: f64,
        settings: &Settings,
    ) -> Self {
        let speed = found.speed();
        let least_speed = body
            .speed_resolution(&found.shape, settings.atol())
            .max(1e-9 * found.scale * settings.accuracy())
            .max(REST * largest);
        let least_turn = (1e3 * found.resolution()).max(1e-12);
        let (moves, turns) = (speed > least_speed, found.turning_rate.abs() > least_turn);
        let regime = match (moves, turns) {
            (false, false) => Regime::Motionless,
            (true, false) => Regime::Straight,
            (_, true) => Regime::Circular,
        };
        let what = match (moves, turns) {
            (false, false) => "a fixed shape at rest".to_owned(),
            (true, false) => format!("a fixed shape that moves at {speed:.4e} without turning"),
            (false, true) => format!("a fixed shape that turns on the spot at {:.4e}", found.turning_rate),
            (true, true) => {
                format!("a fixed shape that moves at {speed:.4e} and turns at {:.4e}", found.turning_rate)
            }
        };
        Self { regime, what, moves, turns, least: (least_speed, least_turn) }
    }

    /// Notes the direction of the motion.
    fn direct<B: Equivariant + ?Sized>(&self, verdict: &mut Verdict, body: &B, found: &RelativeEquilibrium) {
        let drift = if self.moves { found.velocity } else { [0.0; 2] };
        verdict.directed(body, self.turns.then_some(found.turning_rate), drift);
    }

    /// A verdict with the numbers of the equilibrium.
    fn verdict(&self, found: &RelativeEquilibrium, attractor: Attractor, why: String, time: f64) -> Verdict {
        let mut verdict = Verdict::new(self.regime, attractor, why, time);
        let speed = found.speed();
        verdict.speed = Some(Spread { mean: speed, min: speed, max: speed });
        verdict.turning_rate = self.moves.then_some(if self.turns { found.turning_rate } else { 0.0 });
        let error = found.resolution();
        let neutral = std::iter::repeat_n(0.0, found.neutral);
        let mut values: Vec<f64> = found.eigenvalues.iter().map(|value| value.0).chain(neutral).collect();
        values.sort_by(|a, b| b.total_cmp(a));
        verdict.exponents = values.into_iter().map(|value| Estimate { value, error }).collect();
        verdict
    }
}

/// A stable relative equilibrium, reached up to `distance` (against its size) by an orbit that was as large as `largest`.
pub(super) fn equilibrium<B: Equivariant + ?Sized>(
    body: &B,
    found: &RelativeEquilibrium,
    (distance, largest): (f64, f64),
    settings: &Settings,
    time: f64,
) -> Verdict {
    let steady = Steady::of(body, found, largest, settings);
    let growth = found.growth();
    let why =
        format!("{}, reached to {distance:.0e}; stable: its leading eigenvalue is {growth:.2e}", steady.what);
    let mut verdict = steady.verdict(found, Attractor::Equilibrium, why, time);
    steady.direct(&mut verdict, body, found);
    let sure =
        |value: f64, least: f64| if value > least { value / least } else { least / value.max(1e-3 * least) };
    let margins = [
        -growth / found.resolution(),
        sure(found.speed(), steady.least.0),
        sure(found.turning_rate.abs(), steady.least.1),
    ];
    verdict.margin = Some(margins.into_iter().fold(f64::MAX, f64::min));
    verdict
}

/// An unstable relative equilibrium that the orbit never leaves, after a stay of `stay`. It has no margin: what is decided is where this
/// orbit is, not what the body does from a typical start.
pub(super) fn unstable<B: Equivariant + ?Sized>(
    body: &B,
    found: &RelativeEquilibrium,
    largest: f64,
    stay: f64,
    settings: &Settings,
    time: f64,
) -> Verdict {
    let steady = Steady::of(body, found, largest, settings);
    let why = format!(
        "{}, but unstable, growth rate {:.4e}: this start has an exact symmetry, and its orbit stayed for a time of {stay:.0}; a typical start leaves it",
        steady.what,
        found.growth()
    );
    let mut verdict = steady.verdict(found, Attractor::Unstable, why, time);
    steady.direct(&mut verdict, body, found);
    verdict
}

/// A heteroclinic cycle.
pub(super) fn rectangular<B: Equivariant + ?Sized>(
    body: &B,
    cycle: &Cycle,
    shape: &[f64],
    settings: &Settings,
    time: f64,
    watch: &dyn Watch,
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
    // Rests may be known of which none was seen whole.
    let longest = cycle.rests.iter().copied().fold(0.0, f64::max);
    let time = if longest > 0.0 { 6.0 * longest } else { settings.first_look };
    let path = Path::follow(body, shape, time, 4 * SAMPLES, settings, watch)?;
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
    watch: &dyn Watch,
) -> Result<Verdict> {
    let path = Path::follow(body, &orbit.shape, orbit.period(), SAMPLES, settings, watch)?;
    let rotation = orbit.net_rotation();
    let no_turn = NO_TURN.max(settings.accuracy());
    let symmetry = symmetry_of(body, orbit, settings, watch)?;
    let form = Form::of(&symmetry, orbit, &path, no_turn, body.symmetry());
    let what = match form.regime() {
        Regime::QuasiPeriodic => format!("{}; turned by {rotation:.6} rad each period", form.meaning()),
        _ => form.meaning().to_owned(),
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
    let mut verdict = Verdict::new(form.regime(), Attractor::Periodic, why, time);
    verdict.form = Some(form);
    let stability = (1.0 - orbit.growth()) / settings.accuracy();
    let turning =
        if orbit.mirrored || symmetry.mirror.is_some() { f64::MAX } else { rotation.abs() / no_turn };
    verdict.margin = Some(stability.min(if turning < 1.0 { 1.0 / turning.max(1e-3) } else { turning }));
    verdict.period = Some(orbit.period());
    verdict.net_rotation = Some(rotation);
    verdict.speed = path.speed();
    verdict.exponents = super::floquet::exponents(body, orbit, settings, watch)?;
    if path.moves() {
        verdict.drift = Some(path.drift());
        let straight = symmetry.mirror.is_some();
        // exactly 0 where the second half of the period mirrors the first, and where the heading keeps to a mirror axis
        verdict.turning_rate = if orbit.mirrored || straight { Some(0.0) } else { path.turning_rate() };
        let turning = verdict.turning_rate.filter(|_| form.regime() != Regime::Zigzag && !straight);
        verdict.directed(body, turning, path.displacement(no_turn));
        if !straight {
            super::legs::describe(&mut verdict, &path, rotation);
        }
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
    watch: &dyn Watch,
) -> Result<()> {
    let path = Path::follow(body, shape, time, SAMPLES, settings, watch)?;
    verdict.speed = path.speed();
    verdict.turning_rate = path.turning_rate();
    Ok(())
}
