//! Orbits as a problem that a branch is followed through: their special points, their symmetries, their accuracy.

use super::{Local, Orbits, reduced_rates};
use crate::allowance::Allowance;
use crate::classes::{Classes, GAINED};
use crate::homoclinic::Saddle;
use crate::levels::{ALONG_FAMILY, Level, across_family};
use crate::normal_form::{NormalForm, Order};
use crate::normal_forms::of_orbit;
use crate::passages::Passages;
use crate::point::Motion;
use crate::problem::{Border, Problem};
use crate::reduced_maps::reduced_maps;
use crate::shooting::shape_after;
use crate::special::{Broken, Special};
use motiform_analysis::linear::norm;
use motiform_analysis::symmetry::{align, wrap};
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium, logarithms_of_product};
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Equivariant, Watch};

/// Parts over which a deviation grows by more than this are halved.
const GROWTH: f64 = 1000.0;

/// Least part of the size of a shape by which it changes along an orbit that is none of an equilibrium.
const EXTENDED: f64 = 100.0 * GAINED;

/// An orbit has a mirror axis where its shapes change by more than this multiple of what they may differ from their images by.
const BEYOND: f64 = 10.0;

/// Error of orbits, and of the logarithms of their multipliers near the unit circle, by the flow of ordinary models and by that of stiff
/// ones.
const EXPLICIT: f64 = 1e-10;
const STIFF: f64 = 1e-8;

/// Most parts of an orbit.
const PARTS: usize = 64;

impl Problem for Orbits<'_> {
    fn levels(&self, x: &[f64], local: &Local) -> Option<Vec<Vec<Level>>> {
        let maps = reduced_maps(self, x, local);
        if maps.iter().flatten().any(|map| !map.is_square()) {
            return None;
        }
        let all: Option<Vec<Vec<Level>>> =
            maps.iter().map(|maps| logarithms_of_product(maps).map(|v| Level::of_pairs(&v))).collect();
        all.map(|levels| across_family(levels, self.family.len()))
    }

    fn family(&self) -> &[Border] {
        &self.family
    }

    fn set_family(&mut self, borders: Vec<Border>) {
        self.family = borders;
    }

    fn accuracy(&self) -> f64 {
        let relative = match self.flow.method {
            Method::Explicit(_) => EXPLICIT,
            Method::Exponential(_) => STIFF,
        };
        relative * self.offset + self.drift
    }

    fn noise(&self, _levels: &[Vec<Level>]) -> f64 {
        self.accuracy()
    }

    fn classify(&self, _x: &[f64], critical: Level, class: usize) -> Special {
        if critical.angle == 0.0 {
            return match class {
                1 => Special::Pitchfork { breaks: Broken::Mirror },
                _ => Special::BranchPoint,
            };
        }
        if critical.angle.abs() < std::f64::consts::PI {
            return Special::Torus { angle: critical.angle.abs() };
        }
        if self.mirrored { Special::SymmetryBreaking } else { Special::PeriodDoubling }
    }

    fn motion(&self, x: &[f64], local: &Local, levels: &[Vec<Level>]) -> Motion {
        let nodes: Vec<Vec<f64>> = (0..self.parts).map(|i| self.node(x, i).to_vec()).collect();
        let multiplier = |level: &Level| {
            let (sin, cos) = libm::sincos(level.angle);
            let modulus = libm::exp(level.growth);
            (modulus * cos, if level.angle.abs() == std::f64::consts::PI { 0.0 } else { modulus * sin })
        };
        let along = std::iter::repeat_n(&ALONG_FAMILY, self.family.len());
        let mut all: Vec<&Level> = levels.iter().flatten().chain(along).collect();
        all.sort_by(|a, b| b.growth.total_cmp(&a.growth).then(b.angle.total_cmp(&a.angle)));
        let orbit = PeriodicOrbit {
            shape: nodes[0].clone(),
            time: x[self.parts * self.dim],
            angle: wrap(self.angle(x)),
            mirrored: self.mirrored,
            residual: norm(&local.linear.residual),
            multipliers: all.into_iter().map(multiplier).collect(),
            errors: Vec::new(),
        };
        Motion::Orbit { orbit, nodes }
    }

    fn refine(&mut self, x: &[f64], local: &Local, watch: &dyn Watch) -> Option<Vec<f64>> {
        let grown = local.segments.iter().any(|segment| norm(&segment.tangents) > GROWTH);
        if !grown || self.parts >= PARTS {
            return None;
        }
        let half = 0.5 * self.span(x);
        let mut out = Vec::new();
        for i in 0..self.parts {
            let node = self.node(x, i);
            out.extend_from_slice(node);
            out.extend(shape_after(local.body.as_ref(), node, half, (&self.flow, self.length), watch).ok()?);
        }
        out.extend_from_slice(&x[self.parts * self.dim..]);
        self.parts *= 2;
        Some(out)
    }

    fn coarsen(&mut self) {
        self.parts /= 2;
    }

    fn normal_form(&self, x: &[f64], order: Order, doubled: bool) -> NormalForm {
        of_orbit(self, x, order, doubled)
    }

    fn body<'l>(&self, local: &'l Local) -> &'l dyn Equivariant {
        local.body.as_ref()
    }

    fn size(&self, x: &[f64]) -> f64 {
        (0..self.parts).map(|i| norm(self.node(x, i))).fold(0.0, f64::max)
    }

    fn is_spent(&self) -> bool {
        self.bodies.allowance().is_some_and(Allowance::is_spent)
    }

    fn time(&self) -> Option<usize> {
        Some(self.parts * self.dim)
    }

    fn swing(&self, local: &Local) -> Option<Vec<f64>> {
        Some(reduced_rates(local).concat())
    }

    fn gains(&self, x: &[f64], local: &Local, same: f64) -> Option<(Broken, Vec<f64>)> {
        let body = local.body.as_ref();
        let nodes: Vec<&[f64]> = (0..self.parts).map(|i| self.node(x, i)).collect();
        let rate = reduced_rates(local).iter().map(|rate| norm(rate)).fold(0.0, f64::max);
        let amplitude = rate * self.span(x) * self.parts as f64 / std::f64::consts::TAU;
        if amplitude < BEYOND * same * self.size {
            return None; // it shrinks to an equilibrium, whose axis is none of the orbit
        }
        let found = Classes::within(body, &nodes, same);
        if found.axis.is_some() && self.classes.axis.is_none() {
            let mut symmetric = x.to_vec();
            for node in symmetric[..self.parts * self.dim].chunks_exact_mut(self.dim) {
                found.tidy(body, node);
            }
            return Some((Broken::Mirror, symmetric));
        }
        if self.mirrored || !self.parts.is_multiple_of(2) {
            return None;
        }
        let (first, half) = (nodes[0], self.parts / 2);
        let extent = |node: &&[f64]| align(body, node, first, false).distance;
        if nodes.iter().map(extent).fold(0.0, f64::max) < EXTENDED * self.size {
            return None; // it shrinks to an equilibrium, which has all symmetries of time
        }
        // an orbit that rests at a saddle for long is there at both times: all of it must come back
        let is = |mirrored| {
            let back = |i: usize| align(body, nodes[i + half], nodes[i], mirrored).distance;
            (0..half).map(back).fold(0.0, f64::max) < same * self.size
        };
        let gained = match (is(false), is(true) && body.symmetry().mirror) {
            (true, _) => Broken::HalfPeriod,
            (_, true) => Broken::MirrorAfterHalf,
            _ => return None,
        };
        Some((gained, x.to_vec()))
    }

    fn saddle(&self, x: &[f64], local: &Local, parameter: f64) -> Option<Saddle> {
        let mut there = x.to_vec();
        *there.last_mut()? = parameter;
        let body = self.bodies.at(&there).ok()?;
        let slowest = self.slowest(local)?;
        let found = RelativeEquilibrium::find(body.as_ref(), self.node(x, slowest))?;
        let rates = self.kept_rates(body.as_ref(), &found, (0..self.parts).map(|i| self.node(x, i)));
        let away = |i: usize| align(body.as_ref(), &found.shape, self.node(x, i), false).distance;
        let near = away(slowest) / (0..self.parts).map(away).fold(0.0, f64::max);
        Some(Saddle { found, rates, near })
    }

    fn passages(&self, x: &[f64], local: &Local) -> Option<Passages> {
        self.passed(x, local, &())
    }
}
