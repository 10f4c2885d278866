//! The leading Floquet exponents of an orbit in a large system.
//!
//! A shape at a distance from the periodic orbit within its tolerance is not close enough: in directions that
//! shrink by orders of magnitude, that distance changes the map of a period by more than what is left of
//! them. So Newton's method goes on until the orbit closes to far below the tolerance. Then two periods of
//! the flow bring a dozen directions across the flow and the group to the leading ones.

use crate::Estimate;
use crate::linear::norm;
use crate::lyapunov::SplitMix;
use crate::newton_picard::Newton;
use crate::periodic::{Flow, PeriodicOrbit};
use motiform_dynamics::drive::drive;
use motiform_dynamics::{Equivariant, Request, VectorField, Watch};

/// Directions that Newton's method follows,
const FOLLOWED: usize = 5;

/// and those whose multipliers are computed in the end.
const DIRECTIONS: usize = 12;

/// The largest residual of a closed orbit, against the accuracy of the flow.
const CLOSED: f64 = 1e-5;

/// Most steps of Newton's method until then.
const STEPS: usize = 8;

/// Shapes along an orbit that are looked at for the fastest change.
const PLACES: usize = 64;

/// The leading exponents, largest first; `None` where the orbit cannot be closed.
pub(crate) fn leading_exponents(
    body: &dyn Equivariant,
    orbit: &PeriodicOrbit,
    flow: &Flow,
    watch: &dyn Watch,
) -> Option<Vec<Estimate>> {
    let dim = orbit.shape.len();
    let mut random = SplitMix(4);
    let mut any =
        |count: usize| (0..count).map(|_| (0..dim).map(|_| random.next()).collect()).collect::<Vec<_>>();
    let mut newton = Newton::at(body, &fastest(body, orbit, flow, watch)?);
    newton.follow(&any(FOLLOWED), FOLLOWED);
    // Directions that are not yet the leading ones would lead away from the orbit.
    newton.follow(&newton.image(flow, watch)?.directions, FOLLOWED);
    let mut found = close(&mut newton, flow, watch)?;
    found.extend(any(DIRECTIONS));
    newton.follow(&found, DIRECTIONS);
    newton.follow(&newton.image(flow, watch)?.directions, DIRECTIONS);
    let closed = newton.describe(&newton.image(flow, watch)?, orbit.residual, flow.accuracy())?;
    let exponent = |(m, error): (&(f64, f64), &f64)| {
        let size = libm::hypot(m.0, m.1);
        Estimate { value: libm::log(size) / closed.time, error: error / size / closed.time }
    };
    Some(closed.multipliers.iter().zip(&closed.errors).map(exponent).collect())
}

/// The same orbit from where its shape changes fastest: where it nearly rests, the direction of the flow is lost in the errors of a period.
fn fastest(
    body: &dyn Equivariant,
    orbit: &PeriodicOrbit,
    flow: &Flow,
    watch: &dyn Watch,
) -> Option<PeriodicOrbit> {
    let dim = orbit.shape.len();
    let mut run = flow.method.shape_orbit(body, flow.control, 0.0, &orbit.shape).ok()?;
    let (mut most, mut shape, mut rate) = (0.0, orbit.shape.clone(), vec![0.0; dim]);
    for place in 1..=PLACES {
        let until = orbit.time * place as f64 / PLACES as f64;
        let request = Request { max_steps: flow.max_steps, watch, ..Request::around(until, &orbit.shape) };
        drive(run.as_mut(), &request, &mut ()).ok()?;
        VectorField::<f64>::eval(body, 0.0, run.state(), &mut rate);
        if norm(&rate) > most {
            most = norm(&rate);
            shape.copy_from_slice(run.state());
        }
    }
    Some(PeriodicOrbit { shape, ..orbit.clone() })
}

/// Steps of Newton's method until the orbit closes; the images of the directions that it follows.
fn close(newton: &mut Newton<'_>, flow: &Flow, watch: &dyn Watch) -> Option<Vec<Vec<f64>>> {
    for _ in 0..STEPS {
        let image = newton.image(flow, watch)?;
        if norm(&image.rest) <= CLOSED * flow.accuracy() * norm(&newton.shape) {
            return Some(image.directions);
        }
        newton.step(&image)?;
        newton.follow(&image.directions, FOLLOWED);
    }
    None
}
