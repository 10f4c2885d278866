//! Comparison of two motions up to the symmetry and time.

use super::point::Motion;
use super::shooting::shape_after;
use motiform_analysis::equilibrium::{Units, size_beside};
use motiform_analysis::linear::norm;
use motiform_analysis::periodic::Flow;
use motiform_analysis::symmetry::align;
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium};
use motiform_dynamics::Equivariant;

/// A shape smaller than this, in the unit of shapes, is as good as nothing.
const NOTHING: f64 = 1e-12;

/// Places along an orbit at which it is compared.
const PLACES: usize = 200;

/// Returns `true` if two motions of one body are images of each other under rotations, the mirror and shifts of time, up to the part
/// `tolerance` of their size.
///
/// # Checked by  tests/all/continuation.rs: copies of one orbit, and different ones of the same period
pub fn same_motion(body: &dyn Equivariant, a: &Motion, b: &Motion, flow: &Flow, tolerance: f64) -> bool {
    match (a, b) {
        (Motion::Equilibrium(a), Motion::Equilibrium(b)) => same_shape(body, a, b, tolerance),
        (Motion::Orbit { orbit: a, .. }, Motion::Orbit { orbit: b, .. }) => {
            same_orbit(body, a, b, flow, tolerance)
        }
        _ => false,
    }
}

fn same_shape(
    body: &dyn Equivariant,
    a: &RelativeEquilibrium,
    b: &RelativeEquilibrium,
    tolerance: f64,
) -> bool {
    let size = size_beside(body, &a.shape).max(size_beside(body, &b.shape));
    distance(body, &a.shape, &b.shape) <= tolerance * size.max(NOTHING * Units::of(body).length)
}

/// Distance of two shapes up to rotations and the mirror.
fn distance(body: &dyn Equivariant, a: &[f64], b: &[f64]) -> f64 {
    align(body, a, b, false).distance.min(align(body, a, b, true).distance)
}

fn same_orbit(
    body: &dyn Equivariant,
    a: &PeriodicOrbit,
    b: &PeriodicOrbit,
    flow: &Flow,
    tolerance: f64,
) -> bool {
    if (a.period() / b.period() - 1.0).abs() > tolerance {
        return false;
    }
    let flow = (flow, Units::of(body).length);
    let span = b.period() / PLACES as f64;
    let mut places = vec![b.shape.clone()];
    while places.len() < PLACES {
        let Ok(next) = shape_after(body, &places[places.len() - 1], span, flow, &()) else { return false };
        places.push(next);
    }
    let apart: Vec<f64> = places.iter().map(|place| distance(body, &a.shape, place)).collect();
    let best = (0..PLACES).min_by(|&i, &j| apart[i].total_cmp(&apart[j])).unwrap_or(0);
    // before the first place comes the last one of the period
    let start = &places[(best + PLACES - 1) % PLACES];
    nearest(body, &a.shape, start, 2.0 * span, flow) <= tolerance * norm(&a.shape)
}

/// Distance of `shape` from the stretch of orbit of length `span` from `start` on: the smallest of a function with one minimum, by
/// golden sections.
fn nearest(body: &dyn Equivariant, shape: &[f64], start: &[f64], span: f64, flow: (&Flow, f64)) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let at = |t: f64| {
        shape_after(body, start, t, flow, &()).map_or(f64::INFINITY, |place| distance(body, shape, &place))
    };
    let (mut low, mut high) = (0.0, span);
    let (mut a, mut b) = (high - golden * (high - low), low + golden * (high - low));
    let (mut fa, mut fb) = (at(a), at(b));
    for _ in 0..50 {
        if fa < fb {
            (high, b, fb) = (b, a, fa);
            a = high - golden * (high - low);
            fa = at(a);
        } else {
            (low, a, fa) = (a, b, fb);
            b = low + golden * (high - low);
            fb = at(b);
        }
    }
    fa.min(fb)
}
