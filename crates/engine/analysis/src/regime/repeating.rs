//! The motion of a body on a periodic orbit that is given, stable or not.

use super::case::Case;
use super::course::Direction;
use super::form::Form;
use super::moments::common_symmetry;
use super::motion::Path;
use super::period::Period;
use super::settings::Settings;
use super::verdict::{Regime, Spread};
use super::words::{NO_TURN, SAMPLES};
use crate::periodic::PeriodicOrbit;
use motiform_dynamics::{Equivariant, Watch};

/// The motion of a body over one period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repeating {
    /// The kind of the motion.
    pub form: Form,
    /// The time after which the body is as it was, up to the net rotation (model time).
    pub period: f64,
    /// The net rotation over it (rad, in -pi..pi).
    pub net_rotation: f64,
    /// Speed of the centre of mass (model length per model time).
    pub speed: Option<Spread>,
    /// Mean turning rate of the heading (rad per model time), exactly 0 where a symmetry makes it so; `None` where the body stops on
    /// the way.
    pub turning_rate: Option<f64>,
    /// The direction of the motion, as far as the symmetry of the model distinguishes directions.
    pub direction: Direction,
    /// The largest size `|u|` of a shape.
    pub size: f64,
}

/// The motion on a relative periodic orbit, by its symmetry and its path. `nodes` are shapes along it at equal times, the first one
/// that of the orbit: a long integration leaves an unstable orbit, so each part is followed from its own node. Method and
/// tolerance are those of `settings`; its looks and budgets do not matter.
///
/// # Errors
/// Input that the numerics refuse.
pub fn repeating(
    body: &dyn Equivariant,
    orbit: &PeriodicOrbit,
    nodes: &[Vec<f64>],
    settings: &Settings,
    watch: &dyn Watch,
) -> crate::Result<Repeating> {
    let case = Case { body, settings, watch };
    let span = orbit.time / nodes.len() as f64;
    let follow = |samples: usize| -> crate::Result<Path> {
        let part = |node: &Vec<f64>| Path::follow(case, node, span, samples.div_ceil(nodes.len()));
        let [first, others @ ..] = nodes else {
            return Err(crate::Error::Shape { what: "the list of nodes", expected: 1, got: 0 });
        };
        others.iter().try_fold(part(first)?, |path, node| Ok(path.joined(&part(node)?)))
    };
    let path = Path::turning_clearly(SAMPLES, follow)?;
    let symmetry = common_symmetry(body, nodes);
    let no_turn = NO_TURN.max(settings.accuracy());
    let form = Form::of(&symmetry, orbit, &path, no_turn);
    let period = Period::of(form, &symmetry, orbit, no_turn);
    let straight = orbit.mirrored || form.regime() == Regime::PulsatingStraight;
    let turning_rate = if straight { Some(0.0) } else { path.turning_rate() };
    let turning = turning_rate.filter(|_| form.regime() != Regime::Zigzag && !straight);
    // where half a period was followed, its displacement is not that of the whole
    let drift = if period.time > orbit.time { [0.0; 2] } else { path.displacement(no_turn) };
    let direction = Direction::of(body, turning, drift);
    let (period, net_rotation) = (period.time, period.rotation);
    let (speed, size) = (path.speed(), path.largest);
    Ok(Repeating { form, period, net_rotation, speed, turning_rate, direction, size })
}
