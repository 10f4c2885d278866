//! What a body does on a periodic orbit that is given, stable or not.

use super::form::Form;
use super::motion::Path;
use super::recurrence::symmetry_of;
use super::settings::Settings;
use super::verdict::Spread;
use super::words::{NO_TURN, SAMPLES};
use crate::periodic::PeriodicOrbit;
use motiform_dynamics::{Equivariant, Watch};

/// What a body does over one period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repeating {
    /// The kind of the motion.
    pub form: Form,
    /// Speed of the centre of mass (model length per model time).
    pub speed: Option<Spread>,
    /// Mean turning rate of the heading (rad per model time), exactly 0 where a symmetry makes it so; `None` where the body stops on
    /// the way.
    pub turning_rate: Option<f64>,
    /// Distance travelled per period (model length).
    pub drift: f64,
    /// The largest size `|u|` of a shape.
    pub size: f64,
}

/// The motion on a relative periodic orbit, by its symmetry and its path. Method and tolerance are those of `settings`; its looks
/// and budgets do not matter.
///
/// # Errors
/// What the numerics refuse.
pub fn repeating<B: Equivariant + ?Sized>(
    body: &B,
    orbit: &PeriodicOrbit,
    settings: &Settings,
    watch: &dyn Watch,
) -> crate::Result<Repeating> {
    let path = Path::follow(body, &orbit.shape, orbit.period(), SAMPLES, settings, watch)?;
    let symmetry = symmetry_of(body, orbit, settings, watch)?;
    let form = Form::of(&symmetry, orbit, &path, NO_TURN.max(settings.accuracy()));
    let straight = orbit.mirrored || symmetry.mirror.is_some();
    let turning_rate = if straight { Some(0.0) } else { path.turning_rate() };
    Ok(Repeating { form, speed: path.speed(), turning_rate, drift: path.drift(), size: path.largest })
}
