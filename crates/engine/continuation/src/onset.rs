//! The motions that begin at a Hopf bifurcation.

use super::beginning::{Begin, nothing};
use super::branch::Branch;
use super::correct::scaled;
use super::oscillation::{Oscillation, rotating};
use super::problem::Equations;
use super::switch::{Departure, those_found};
use motiform_analysis::linear::add;
use motiform_analysis::{RelativeEquilibrium, Result};
use motiform_dynamics::Equivariant;
use std::f64::consts::TAU;

/// Nodes of the orbits that begin.
const NODES: usize = 8;

/// Directions that are critical beside that along the orbits: one for a pair of eigenvalues, three where the shape's symmetry makes it a
/// double one.
const BESIDE: (usize, usize) = (1, 3);

/// Orbits, one branch for each kind of oscillation; from a circle the relative equilibria that begin as an oscillation which only turns
/// too. With [`super::settings::Settings::steady`] these alone.
pub(super) fn onset<'f>(
    from: Departure<'_, 'f>,
    start: &RelativeEquilibrium,
    frequency: f64,
) -> Result<Vec<Vec<Branch<'f>>>> {
    let Departure { family, point, settings, .. } = from;
    let body = family.at(point.parameter)?;
    let oscillations =
        if settings.steady { Vec::new() } else { Oscillation::all(body.as_ref(), &start.shape, frequency) };
    let rotating = rotating(body.as_ref(), &start.shape, frequency);
    if oscillations.is_empty() && rotating.is_none() {
        return Err(nothing(point.parameter));
    }
    let several = oscillations.len() + usize::from(rotating.is_some()) > 1;
    // each other pair that is critical grows or decays on the branch as at the point
    let pairs = 2 * point.critical.saturating_sub(1);
    let most = pairs + if several { BESIDE.1 } else { BESIDE.0 };
    let growing = point.unstable..=point.unstable + most;
    let turning = rotating.map(|(direction, rate)| {
        let turning = RelativeEquilibrium { turning_rate: rate, ..start.clone() };
        let x = [&start.shape[..], &[rate, point.parameter]].concat();
        let along = [&direction[..], &[0.0, 0.0]].concat();
        from.cross(&turning, &Begin::new(&x, &along, growing.clone()))
    });
    let body = body.as_ref();
    let orbits = oscillations.into_iter().map(|oscillation| {
        let oscillation = (oscillation.upright(body), start.turning_rate, frequency);
        swinging(from, body, oscillation, growing.clone())
    });
    those_found(orbits.chain(turning))
}

/// The orbits that begin as one oscillation, over the part of the period after which they are back but for a rotation or the mirror.
fn swinging<'f>(
    from: Departure<'_, 'f>,
    body: &dyn Equivariant,
    (oscillation, turning_rate, frequency): (Oscillation, f64, f64),
    growing: std::ops::RangeInclusive<usize>,
) -> Result<Branch<'f>> {
    let Oscillation { shape, re, im, across, part, turned } = oscillation;
    let time = TAU / frequency * part;
    let (mut nodes, mut swings) = (Vec::new(), Vec::new());
    for i in 0..NODES {
        let t = time * i as f64 / NODES as f64;
        let (sin, cos) = libm::sincos(frequency * t);
        let (mut node, mut swing) = (shape.clone(), vec![0.0; shape.len()]);
        add(&mut swing, cos, &re);
        add(&mut swing, -sin, &im);
        body.rotate(turning_rate * t, &mut node);
        body.rotate(turning_rate * t, &mut swing);
        nodes.push(node);
        swings.push(swing);
    }
    let along = (time, turning_rate * time + turned, across.is_some());
    let (problem, x) = from.orbits(body, &nodes, along);
    let mut direction = swings.concat();
    direction.resize(x.len(), 0.0);
    let direction = scaled(direction, &problem.weights(&x)).ok_or_else(|| nothing(from.point.parameter))?;
    from.oscillate(problem, &Begin::new(&x, &direction, growing))
}
