//! The body along its path: the rows that are shown, and the size of the outlines.

use crate::accuracy::Accuracy;
use motiform_dynamics::escape::norm;
use motiform_dynamics::sample::ascending;
use motiform_dynamics::{Model, Outcome, Outline};
use motiform_models::ModelInfo;
use motiform_store::table::Table;
use motiform_study::quantity::state::SPEED;
use motiform_study::{Dataset, Dimension, Error, Shown};
use std::ops::Range;

/// A dataset with its model, and the choices that all figures share.
pub(super) struct Body<'d> {
    pub(super) dataset: &'d Dataset,
    pub(super) info: &'static ModelInfo,
    pub(super) model: Box<dyn Model>,
    /// The errors of the numbers of the run.
    pub(super) accuracy: Accuracy,
    /// The speed below which the centre stays while it is shown, if that is none within the errors of the run (model units).
    pub(super) rests: Option<f64>,
    rows: Range<usize>,
    /// `true` if the last rows before a blow-up are left out.
    cut: bool,
    /// Physical units, if the study has them.
    units: Shown,
    /// Undeformed radius R0 (model length).
    pub(super) radius: f64,
    /// Ratio of the drawn size of an outline to its true size relative to the path.
    pub(super) scale: f64,
}

/// Approximate size of an undeformed outline relative to the longer side of the path.
const TARGET: f64 = 0.032;

/// A shape this many times as large as usual leaves the scale of the figures of a run that blows up.
const LARGE: f64 = 10.0;

/// The largest deformation, as a fraction of the radius, if R0 is chosen automatically.
const DEFORMATION: f64 = 0.45;

impl<'d> Body<'d> {
    pub(super) fn new(dataset: &'d Dataset) -> Result<Self, Error> {
        let plan = &dataset.manifest.plan;
        let info = plan.info()?;
        let model = plan.body()?;
        let rows = window(&dataset.trajectory, plan.figure.from, plan.figure.to);
        let mut body = Self {
            dataset,
            info,
            model,
            accuracy: Accuracy::of(&dataset.manifest),
            rests: None,
            rows,
            cut: false,
            units: Shown::parse(&plan.figure.units)?,
            radius: 1.0,
            scale: 1.0,
        };
        if matches!(dataset.manifest.outcome.outcome, Outcome::Escaped { .. }) {
            body.leave_out_blow_up();
        }
        body.rests = body.resting_speed();
        body.radius = match body.model.radius() {
            Some(fixed) => fixed,
            None if plan.figure.radius > 0.0 => plan.figure.radius,
            None => body.fitting_radius(),
        };
        body.scale = if plan.figure.scale > 0.0 { plan.figure.scale } else { body.readable_scale(TARGET) };
        Ok(body)
    }

    /// Ends the rows that are shown where the shape is ten times its median size: beside later rows the motion before would not be visible.
    fn leave_out_blow_up(&mut self) {
        let size = |row: usize| self.model.deformation(&self.shape(row));
        let mut usual: Vec<f64> = self.rows().map(size).collect();
        ascending(&mut usual);
        let Some(&median) = usual.get(usual.len() / 2) else { return };
        let end = self.rows().find(|&row| size(row) > LARGE * median).unwrap_or(self.rows.end);
        let end = end.max(self.rows.start + 2).min(self.rows.end);
        self.cut = end < self.rows.end;
        self.rows.end = end;
    }

    /// The largest of the speeds from which the shown shapes are known to move, if none of them moves as fast.
    fn resting_speed(&self) -> Option<f64> {
        let speeds = self.column(SPEED.name);
        self.rows().try_fold(0.0, |most: f64, row| {
            let least = self.accuracy.least_speed(self.model.as_ref(), &self.shape(row));
            (speeds[row] <= least).then(|| most.max(least))
        })
    }

    /// The part of its size from which differences of the velocity are known (those of the shape where it follows from that): also the
    /// least angle (rad) that the heading is known to turn by.
    pub(super) fn known_velocity(&self) -> f64 {
        let size = match self.model.velocities() {
            0 => self.rows().map(|row| norm(&self.shape(row))).fold(0.0, f64::max),
            _ => self.column(SPEED.name)[self.rows()].iter().copied().fold(0.0, f64::max),
        };
        self.accuracy.part(size)
    }

    /// Returns `true` if the last rows before a blow-up are left out.
    pub(super) fn cut(&self) -> bool {
        self.cut
    }

    /// The rows that are shown.
    pub(super) fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    pub(super) fn column(&self, name: &str) -> &[f64] {
        self.dataset.trajectory.get(name).unwrap_or(&[])
    }

    /// The units of the figures.
    pub(super) fn units(&self) -> &Shown {
        &self.units
    }

    /// A time in the units of the figures.
    pub(super) fn time(&self, row: usize) -> f64 {
        self.column("t")[row] * self.units.factor(Dimension::TIME)
    }

    /// A position in the units of the figures.
    pub(super) fn position(&self, row: usize) -> [f64; 2] {
        [self.column("x")[row], self.column("y")[row]].map(|x| x * self.units.factor(Dimension::LENGTH))
    }

    /// The shape at a row.
    pub(super) fn shape(&self, row: usize) -> Vec<f64> {
        let named: Vec<f64> = self.model.coordinates().iter().map(|c| self.column(c.name)[row]).collect();
        self.model.encoded(&named)
    }

    /// The outline at a row, in the plane, at `scale` times its size; `None` if the shape is not a curve.
    pub(super) fn outline(&self, row: usize, scale: f64, points: usize) -> Option<Vec<[f64; 2]>> {
        let [x, y] = self.position(row);
        match self.model.outline(&self.shape(row), self.radius, points) {
            Outline::Curve(curve) => {
                let scale = scale * self.units.factor(Dimension::LENGTH);
                Some(curve.iter().map(|p| [x + scale * p[0], y + scale * p[1]]).collect())
            }
            Outline::NotACurve { .. } | Outline::NotClosed { .. } => None,
        }
    }

    /// The boundary's field at a row, for models that have one.
    pub(super) fn profile(&self, row: usize, points: usize) -> Option<Vec<f64>> {
        self.model.profile(&self.shape(row), points)
    }

    /// Length of the undeformed boundary.
    pub(super) fn arc_length(&self) -> f64 {
        std::f64::consts::TAU * self.radius
    }

    /// Longer side of the box around the shown path.
    pub(super) fn extent(&self) -> f64 {
        let side = |name| {
            let shown = &self.column(name)[self.rows()];
            let (low, high) = shown.iter().fold((f64::MAX, f64::MIN), |(a, b), &x| (a.min(x), b.max(x)));
            high - low
        };
        f64::max(side("x"), side("y"))
    }

    /// Length of the shown path.
    pub(super) fn length(&self) -> f64 {
        self.rows().skip(1).map(|row| distance(self.position(row - 1), self.position(row))).sum()
    }

    /// Rows at equal distances along the path, about `count` of them, the first and the last included; the first alone at rest.
    pub(super) fn rows_along(&self, count: usize) -> Vec<usize> {
        if self.rests.is_some() {
            return vec![self.rows.start];
        }
        let spacing = self.length() / (count.max(2) - 1) as f64;
        let mut chosen = vec![self.rows.start];
        let (mut travelled, mut next) = (0.0, spacing);
        for row in self.rows().skip(1) {
            travelled += distance(self.position(row - 1), self.position(row));
            if spacing > 0.0 && travelled >= next - 1e-9 * spacing {
                chosen.push(row);
                next = (travelled / spacing).floor().mul_add(spacing, spacing);
            }
        }
        let last = self.rows.end - 1;
        if spacing > 0.0 && chosen.last() != Some(&last) {
            chosen.push(last);
        }
        chosen
    }

    /// R0 does not enter the dynamics: a round number that shows the deformation and keeps the outline a curve.
    fn fitting_radius(&self) -> f64 {
        let deformation = self.rows().map(|row| self.model.deformation(&self.shape(row))).fold(0.0, f64::max);
        radius_for(deformation)
    }

    /// 1 at rest, or if an undeformed outline at its true size is about `target` of the longer side of the path, otherwise a round
    /// factor that makes it so.
    pub(super) fn readable_scale(&self, target: f64) -> f64 {
        let share = self.radius / self.extent();
        if self.rests.is_some() || !share.is_finite() || (0.5 * target..=1.6 * target).contains(&share) {
            1.0
        } else {
            round_up(target / share / 1.3)
        }
    }
}

/// A round undeformed radius for a body whose largest deformation (as in [`Model::deformation`]) is this.
pub fn radius_for(deformation: f64) -> f64 {
    if deformation < 1e-6 || !deformation.is_finite() { 1.0 } else { round_up(deformation / DEFORMATION) }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}

/// The next of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten.
fn round_up(x: f64) -> f64 {
    let power = libm::pow(10.0, x.log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    let mantissa = steps.into_iter().find(|step| step * power >= x * (1.0 - 1e-12)).unwrap_or(10.0);
    mantissa * power
}

/// The rows with `from <= t <= to` (`to = 0`: the end).
fn window(trajectory: &Table, from: f64, to: f64) -> Range<usize> {
    let times = trajectory.get("t").unwrap_or(&[]);
    let start = times.partition_point(|&t| t < from);
    let end = if to == 0.0 { times.len() } else { times.partition_point(|&t| t <= to) };
    start..end.max(start)
}
