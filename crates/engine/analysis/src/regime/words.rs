//! From the kind of reduced orbit to the motion, with its numbers in words.

use super::case::Case;
use super::course::Direction;
use super::form::Form;
use super::heteroclinic::Cycle;
use super::moments::symmetry_of;
use super::motion::{CLEAR_TURN, Path};
use super::period::Period;
use super::recurrence::Recurrence;
use super::verdict::{Attractor, Regime, Spread, Verdict};
use crate::equilibrium::RelativeEquilibrium;
use crate::periodic::PeriodicOrbit;
use crate::{Estimate, Result, SteadyMotion, sort_by_number};
use motiform_dynamics::Equivariant;
use motiform_dynamics::digits::{decimals, six_decimals};

/// Samples of a period: enough for the legs of its path.
pub(super) const SAMPLES: usize = 720;

/// Net rotations below this part of a turn per period are none.
pub(super) const NO_TURN: f64 = 1e-6;

/// A run that left every bound at time `t`.
pub(super) fn blow_up(singular: bool, t: f64, time: f64) -> Verdict {
    let when = six_decimals(t);
    let why = if singular {
        format!("the shape grows like a singularity of finite time, t* = {when}")
    } else {
        format!("the shape left every bound at t = {when}; its law of growth gives no finite time t*")
    };
    let mut verdict = Verdict::new(Regime::BlowUp, Attractor::Escape, why, time);
    verdict.escape_time = Some(t);
    verdict
}

/// The motion of a body at a relative equilibrium, in words.
fn what(steady: &SteadyMotion) -> String {
    let (speed, turning) = (steady.speed.value, steady.turning_rate.value);
    match (steady.moves(), steady.turns()) {
        (false, false) => "a fixed shape at rest".to_owned(),
        (true, false) => format!("a fixed shape that moves at {speed:.4e} without turning"),
        (false, true) => format!("a fixed shape that turns on the spot at {turning:.4e}"),
        (true, true) => format!("a fixed shape that moves at {speed:.4e} and turns at {turning:.4e}"),
    }
}

/// A verdict with the numbers of an equilibrium.
fn at_equilibrium(
    body: &dyn Equivariant,
    found: &RelativeEquilibrium,
    steady: &SteadyMotion,
    attractor: Attractor,
    why: String,
    time: f64,
) -> Verdict {
    let mut verdict = Verdict::new(steady.regime(), attractor, why, time);
    let speed = steady.speed.value;
    verdict.speed = Some(Spread { mean: speed, min: speed, max: speed, error: Some(steady.speed.error) });
    verdict.turning_rate = steady.turning();
    let values = found.eigenvalues.iter().zip(&found.errors);
    let mut exponents: Vec<Estimate> =
        values.map(|(value, &error)| Estimate { value: value.0, error }).collect();
    // what is missing are the neutral directions: of the rotations, and of a family that the equilibrium lies in
    let neutral = body.dim().saturating_sub(exponents.len());
    exponents.extend(std::iter::repeat_n(Estimate { value: 0.0, error: 0.0 }, neutral));
    sort_by_number(&mut exponents, |a| -a.value);
    verdict.exponents = exponents;
    Direction { course: verdict.course, heading: verdict.heading } = steady.direction(body, found);
    verdict
}

/// A stable relative equilibrium, reached up to `distance` (against its size).
pub(super) fn equilibrium(
    body: &dyn Equivariant,
    found: &RelativeEquilibrium,
    distance: f64,
    time: f64,
) -> Verdict {
    let steady = SteadyMotion::of(body, found);
    let growth = found.growth();
    let family = found.eigenvalues.len() + found.neutral < body.dim();
    let why = format!(
        "{}, reached to {distance:.0e}; stable{}: its leading eigenvalue is {growth:.2e}",
        what(&steady),
        if family {
            " across a family of such shapes (a phase that nothing fixes, or another symmetry)"
        } else {
            ""
        }
    );
    let mut verdict = at_equilibrium(body, found, &steady, Attractor::Equilibrium, why, time);
    let stability = -growth / found.growth_error().max(f64::MIN_POSITIVE);
    verdict.margin = Some(stability.min(steady.margin()).min(f64::MAX));
    verdict
}

/// A time in words: whole units of time, or two digits of a shorter one.
pub(super) fn lasting(time: f64) -> String {
    let places =
        if time > 0.0 { (1.0 - libm::floor(libm::log10(time))).clamp(0.0, 15.0) as usize } else { 0 };
    format!("{time:.places$}")
}

/// An unstable relative equilibrium that the orbit never leaves, after a stay of `stay`. It has no margin: what is decided is where this
/// orbit is, not what the body does from a typical start.
pub(super) fn unstable(body: &dyn Equivariant, found: &RelativeEquilibrium, stay: f64, time: f64) -> Verdict {
    let steady = SteadyMotion::of(body, found);
    let why = format!(
        "{}, but unstable, growth rate {:.4e}: this start has an exact symmetry, and its orbit stayed for a \
        time of {}; a typical start leaves it",
        what(&steady),
        found.growth(),
        lasting(stay)
    );
    at_equilibrium(body, found, &steady, Attractor::Unstable, why, time)
}

/// A heteroclinic cycle.
pub(super) fn rectangular(case: Case<'_>, cycle: &Cycle, shape: &[f64], time: f64) -> Result<Verdict> {
    let (out, inward) = (cycle.saddle.out, cycle.saddle.inward);
    let [growth, decay] = [out, inward].map(|rate| decimals(rate, 4));
    let why = format!(
        "rests near motionless shapes that are saddles, reached to {:.0e}; lambda_+ = {growth} and lambda_- = {decay} \
         have a negative sum: a heteroclinic cycle that attracts",
        cycle.closest
    );
    let mut verdict = Verdict::new(Regime::Rectangular, Attractor::Heteroclinic, why, time);
    verdict.margin = Some((-(out + inward) / cycle.saddle.error.max(f64::MIN_POSITIVE)).min(f64::MAX));
    verdict.rests.clone_from(&cycle.rests);
    verdict.saddle = Some(cycle.saddle);
    // Rests may be known of which none was seen whole.
    let longest = cycle.rests.iter().copied().fold(0.0, f64::max);
    let time = if longest > 0.0 { 6.0 * longest } else { case.settings.first_look };
    let path = Path::follow(case, shape, time, 4 * SAMPLES)?;
    verdict.speed = path.speed();
    verdict.legs = super::legs::between_rests(&path);
    Ok(verdict)
}

/// A stable relative periodic orbit.
pub(super) fn periodic(
    case: Case<'_>,
    orbit: &PeriodicOrbit,
    recurrence: &Recurrence,
    time: f64,
) -> Result<Verdict> {
    let follow = |samples| Path::follow(case, &orbit.shape, orbit.period(), samples);
    let path = Path::turning_clearly(SAMPLES, follow)?;
    let no_turn = NO_TURN.max(case.settings.accuracy());
    let symmetry = symmetry_of(case, orbit)?;
    let form = Form::of(&symmetry, orbit, &path, no_turn);
    let Period { time: period, rotation } = Period::of(form, &symmetry, orbit, no_turn);
    let what = match form.regime() {
        Regime::QuasiPeriodic => format!("{}; turned by {rotation:.6} rad each period", form.meaning()),
        _ => form.meaning().to_owned(),
    };
    let returns = match recurrence.returns {
        1 => "one return".to_owned(),
        more => format!("{more} returns"),
    };
    let exponents = super::floquet::exponents(case, orbit);
    let (growth, error) = exponents.growth;
    let largest = match exponents.leading {
        Some(leading) => format!("{leading:.3e}"),
        None => format!("at most {:.0e}", growth + error),
    };
    let over = if period > orbit.time { " over half of it" } else { "" };
    let why = format!(
        "{what}; period {}, largest multiplier {largest}{over}: stable; it closes after {returns} to its section",
        six_decimals(period)
    );
    let mut verdict = Verdict::new(form.regime(), Attractor::Periodic, why, time);
    verdict.form = Some(form);
    let stability = ((1.0 - growth) / error.max(f64::MIN_POSITIVE)).min(f64::MAX);
    let turning = if orbit.mirrored || form.regime() == Regime::PulsatingStraight {
        f64::MAX
    } else {
        rotation.abs() / no_turn
    };
    let turning = if turning < 1.0 { 1.0 / turning.max(1e-3) } else { turning };
    verdict.margin = Some(stability.min(turning).min(sense_margin(form, &path)));
    verdict.period = Some(period);
    verdict.net_rotation = Some(rotation);
    verdict.speed = path.speed();
    verdict.exponents = exponents.all;
    if path.moves() {
        // on a line the way back undoes the way forth
        let undone = period > orbit.period();
        verdict.drift = Some(if undone { 0.0 } else { path.drift() });
        let straight = form.regime() == Regime::PulsatingStraight;
        // exactly 0 where the second half of the period mirrors the first, and where the heading keeps to a mirror axis
        verdict.turning_rate = if orbit.mirrored || straight { Some(0.0) } else { path.turning_rate() };
        let turning = verdict.turning_rate.filter(|_| form.regime() != Regime::Zigzag && !straight);
        verdict.directed(case.body, turning, if undone { [0.0; 2] } else { path.displacement(no_turn) });
        if !straight {
            super::legs::describe(&mut verdict, &path, rotation);
        }
    }
    Ok(verdict)
}

/// The margin of the full turns of the heading where a name depends on them: below 1 where it turns by more than a quarter turn between two
/// samples, whose sense is not known.
fn sense_margin(form: Form, path: &Path) -> f64 {
    let step = match form {
        Form::AsymmetricZigzag | Form::DriftingCircular => path.largest_turn(),
        _ => None,
    };
    let unclear = step.filter(|&step| step > CLEAR_TURN);
    unclear.map_or(f64::MAX, |step| CLEAR_TURN / step)
}

/// The reason why a motion that stays on a periodic orbit has no name.
pub(super) fn not_stable(orbit: &PeriodicOrbit) -> String {
    let (growth, error) = (orbit.growth(), orbit.growth_error());
    if orbit.is_unstable() {
        format!("the orbit stays on an unstable periodic orbit (largest multiplier {growth:.3})")
    } else {
        format!(
            "the orbit stays on a periodic orbit that is neutral in a direction beside those of its \
            symmetry (largest multiplier {growth:.6} +- {error:.0e}): it is one of the \
            orbits around a centre (a disturbance neither decays nor grows), or the equations have more symmetry than stated, or the \
            orbit bifurcates"
        )
    }
}

/// Speeds and turning along a stretch of an orbit that does not repeat.
pub(super) fn along(verdict: &mut Verdict, case: Case<'_>, shape: &[f64], time: f64) -> Result<()> {
    let path = Path::follow(case, shape, time, SAMPLES)?;
    verdict.speed = path.sampled_speed();
    let turning = path.sampled_turning_rate();
    verdict.turning_rate = turning.map(|rate| rate.value);
    verdict.turning_error = turning.map(|rate| rate.error).filter(|error| error.is_finite());
    Ok(())
}
