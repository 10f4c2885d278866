//! Equilibria that lie in a family: neighbours are equilibria as well.
//!
//! Where the equations have more symmetry than stated (`symmetry = "none"` on equations without a preferred direction, a mode whose phase
//! nothing fixes) an eigenvalue is 0 that belongs to no symmetry which is divided out. Deviations along the
//! family neither grow nor decay; what the body does is the same on all of its members, up to that symmetry.

use super::{RelativeEquilibrium, Units, linearisation, neutral_direction};
use crate::linear::{add, basis, dot, norm, null_space};
use crate::lyapunov::SplitMix;
use crate::symmetry::align;
use motiform_dynamics::Equivariant;

/// Neighbours are looked for at this distance, against the size of the shape,
const BESIDE: f64 = 1e-2;

/// and are others where they stay at this part of it: at a bifurcation Newton's method comes far closer.
const MEMBER: f64 = 0.5;

/// Longest step along a family, against the size of the shape.
const STEP: f64 = 0.1;

/// Most steps from one member to another one.
const STEPS: usize = 200;

/// A step that does not shorten the way by this factor leads nowhere.
const SHORTER: f64 = 0.999;

/// On a family that is curved the nearest point may be none of both: so many other ways to begin are tried,
const TRIES: u64 = 12;

/// each with up to so many steps in one direction.
const AROUND: u64 = 60;

impl RelativeEquilibrium {
    /// For each eigenvalue, whether it vanishes within its error.
    pub(crate) fn vanishing(&self) -> Vec<bool> {
        let zero = |(value, error): (&(f64, f64), &f64)| libm::hypot(value.0, value.1) <= *error;
        self.eigenvalues.iter().zip(&self.errors).map(zero).collect()
    }

    /// Number of eigenvalues that vanish within their errors: those of the family that it lies in, or of a
    /// bifurcation.
    pub fn vanishing_count(&self) -> usize {
        self.vanishing().iter().filter(|&&zero| zero).count()
    }

    /// This equilibrium without the eigenvalues 0 of the family that it lies in; `None` where it is alone.
    ///
    /// Newton's method takes the smallest step to an equilibrium: from a shape beside a member, along a
    /// direction in which nothing grows or decays, it goes to another member, and at a bifurcation it comes
    /// back. The family must have as many dimensions as there are eigenvalues 0.
    pub(crate) fn across_family(&self, body: &dyn Equivariant) -> Option<Self> {
        let size = norm(&self.shape);
        if self.vanishing_count() == 0 || size == 0.0 {
            return None;
        }
        let directions = self.along_family(body)?;
        for direction in &directions {
            let mut beside = self.shape.clone();
            add(&mut beside, BESIDE * size, direction);
            let way = self.way(body, &Self::find(body, &beside)?);
            let apart = dot(&way, direction) / (BESIDE * size);
            if !(MEMBER..1.0 / MEMBER).contains(&apart) {
                return None;
            }
        }
        let free = self.vanishing();
        let among: Vec<usize> = (0..free.len()).filter(|&place| !free[place]).collect();
        let eigenvalues = among.iter().map(|&place| self.eigenvalues[place]).collect();
        let errors = among.iter().map(|&place| self.errors[place]).collect();
        (directions.len() == self.vanishing_count()).then(|| Self { eigenvalues, errors, ..self.clone() })
    }

    /// The dimension of the family of equilibria that it lies in; 0 where it is alone.
    pub fn family_dimension(&self, body: &dyn Equivariant) -> usize {
        self.across_family(body).map_or(0, |_| self.vanishing_count())
    }

    /// Returns `true` if a path of equilibria leads from this one to `other`, the straight way along the
    /// family: towards `other`, in short steps.
    ///
    /// # Checked by  lab: tests/all/equilibria/families.rs: circles, tori, an ellipse, rotated copies; bifurcations, which are none
    pub fn leads_to(&self, body: &dyn Equivariant, other: &Self) -> bool {
        if self.vanishing_count() == 0 || self.vanishing_count() != other.vanishing_count() {
            return false;
        }
        let step = STEP * norm(&self.shape).max(norm(&other.shape));
        let (mut here, mut left, unit) = (self.clone(), f64::INFINITY, Units::of(body).length);
        for _ in 0..STEPS {
            if here.is_same(body, other, unit) {
                return true;
            }
            let way = here.way(body, other);
            if norm(&way) > SHORTER * left {
                return false;
            }
            left = norm(&way);
            let Some(next) = here.moved(body, &way, step) else { return false };
            here = next;
        }
        false
    }

    /// As [`RelativeEquilibrium::leads_to`], also by other ways, which begin with some steps in a random direction along the family.
    pub fn is_in_family_of(&self, body: &dyn Equivariant, other: &Self) -> bool {
        let ways = |seed: u64| {
            let begun = self.wandered(body, AROUND * (1 + seed / 2) / (1 + TRIES / 2), &mut SplitMix(seed));
            begun.leads_to(body, other)
        };
        self.leads_to(body, other) || self.vanishing_count() > 0 && (0..TRIES).any(ways)
    }

    /// The member of the family after so many steps in one direction, or where it ends.
    fn wandered(&self, body: &dyn Equivariant, steps: u64, random: &mut SplitMix) -> Self {
        let step = STEP * norm(&self.shape);
        let mut here = self.clone();
        let mut way: Vec<f64> = here.shape.iter().map(|_| step * random.next()).collect();
        for _ in 0..steps {
            let along = norm(&way);
            way.iter_mut().for_each(|x| *x *= 10.0 * step / along); // its part along the family is a whole step
            let Some(next) = here.moved(body, &way, step) else { break };
            way = here.way(body, &next);
            if norm(&way) == 0.0 {
                break;
            }
            here = next;
        }
        here
    }

    /// The member of the family beside this one, towards `way`, at most `step` away; `None` where Newton's method leads elsewhere.
    fn moved(&self, body: &dyn Equivariant, way: &[f64], step: f64) -> Option<Self> {
        let mut along = vec![0.0; way.len()];
        for direction in self.along_family(body)? {
            add(&mut along, dot(&direction, way), &direction);
        }
        let factor = (step / norm(&along)).min(1.0);
        let mut beside = self.shape.clone();
        add(&mut beside, if factor.is_finite() { factor } else { 0.0 }, &along);
        let found = Self::find(body, &beside)?;
        let near = self.distance(body, &found.shape) <= 2.0 * step;
        (near && found.vanishing_count() == self.vanishing_count()).then_some(found)
    }

    /// The shape of `other`, turned to be near, minus this one.
    fn way(&self, body: &dyn Equivariant, other: &Self) -> Vec<f64> {
        let mut way = other.shape.clone();
        body.rotate(align(body, &self.shape, &other.shape, false).angle, &mut way);
        add(&mut way, -1.0, &self.shape);
        way
    }

    /// Unit vectors along the family, across the group.
    fn along_family(&self, body: &dyn Equivariant) -> Option<Vec<Vec<f64>>> {
        let mut directions = neutral_direction(body, &self.shape);
        let group = directions.len();
        let columns = linearisation(body, &self.shape, self.turning_rate);
        directions.extend(null_space(&columns, group + self.vanishing_count())?);
        let directions: Vec<&[f64]> = directions.iter().map(Vec::as_slice).collect();
        Some(basis(&directions, 1e-6).into_iter().skip(group).take(self.vanishing_count()).collect())
    }
}
