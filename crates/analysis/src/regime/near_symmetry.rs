//! Does an orbit come nearer to symmetric shapes than its states are accurate?
//!
//! Shapes of one symmetry are an invariant subspace, and the saddles of a robust heteroclinic cycle lie in such subspaces (Krupa and
//! Melbourne 1995). An orbit that approaches such a cycle comes nearer to the subspace from rest to rest, until the errors of its
//! steps keep it off. Then these set the length of its rests, and it may close into a periodic orbit that the equations do not have.

use super::settings::Settings;
use crate::linear::{add, norm};
use crate::symmetry::align;
use motiform_dynamics::drive::drive;
use motiform_dynamics::{Equivariant, Sink};
use std::f64::consts::TAU;

/// An orbit whose shapes all differ from an image by less than this part of their size has that symmetry.
const SYMMETRIC: f64 = 1e-6;

/// Rotations by 1/2, 1/3, ... of a turn, up to this part, are asked for.
const MOST_FOLDS: usize = 6;

/// By how much the shapes of an orbit differ from an image of theirs, against their size: the least and the largest.
#[derive(Clone, Copy, Debug)]
struct Range {
    least: f64,
    largest: f64,
}

/// The ranges for the mirror image, and for the rotations by 1/2, 1/3, ... of a turn.
struct Asymmetry<'b, B: ?Sized> {
    body: &'b B,
    mirror: Range,
    folds: Vec<Range>,
}

impl Range {
    const EMPTY: Self = Self { least: f64::INFINITY, largest: 0.0 };

    fn add(&mut self, distance: f64) {
        self.least = self.least.min(distance);
        self.largest = self.largest.max(distance);
    }
}

impl<B: Equivariant + ?Sized> Sink for Asymmetry<'_, B> {
    fn step(&mut self, _t: f64, shape: &[f64], _slope: &[f64]) {
        let size = norm(shape);
        self.mirror.add(align(self.body, shape, shape, true).distance / size);
        for (index, range) in self.folds.iter_mut().enumerate() {
            let mut image = shape.to_vec();
            self.body.rotate(TAU / (index + 2) as f64, &mut image);
            add(&mut image, -1.0, shape);
            range.add(norm(&image) / size);
        }
    }
}

/// Whether the orbit from `shape` is symmetric to within the errors of its steps at some moment of `time`, and not at others.
pub(super) fn passes_symmetric_shapes<B: Equivariant + ?Sized>(
    body: &B,
    shape: &[f64],
    time: f64,
    settings: &Settings,
) -> Result<bool, motiform_dynamics::Error> {
    if !body.is_symmetric() {
        return Ok(false);
    }
    let mut flow = settings.method.shape_orbit(body, settings.control, 0.0, shape)?;
    let folds = vec![Range::EMPTY; MOST_FOLDS - 1];
    let mut seen = Asymmetry { body, mirror: Range::EMPTY, folds };
    drive(flow.as_mut(), &settings.request(time, body.dim()), &mut seen)?;
    let ranges = seen.folds.iter().chain([&seen.mirror]);
    Ok(ranges.into_iter().any(|range| range.least < settings.hovering() && range.largest > SYMMETRIC))
}
