//! A curve of special points to both sides of where it is entered.

use super::curve::{Curve, CurvePoint};
use super::family::Family2;
use super::point::{End, Point};
use super::settings::Settings;
use motiform_analysis::Result;
use motiform_dynamics::Watch;

/// A curve of special points, followed to both its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeCurve {
    /// Its points in order: the last ones lie where [`Curve`] goes first; arclengths before the point of entry are negative.
    pub points: Vec<CurvePoint>,
    /// Why it ended at the first point and at the last one.
    pub ends: [End; 2],
}

impl WholeCurve {
    /// The curve through a special point: [`Curve::of`] with the settings and with the reversed ones.
    ///
    /// # Errors
    /// As [`Curve::of`].
    pub fn through(
        family: &dyn Family2,
        point: &Point,
        second: f64,
        settings: &Settings,
        range: (f64, f64),
        watch: &dyn Watch,
    ) -> Result<Self> {
        let side = |settings: &Settings| -> Result<(Vec<CurvePoint>, End)> {
            let mut curve = Curve::of(family, point, second, settings, range, watch)?;
            let points = curve.by_ref().collect();
            Ok((points, curve.end().cloned().unwrap_or(End::Stopped)))
        };
        let (mut points, before) = side(&settings.reversed())?;
        let (ahead, after) = side(settings)?;
        points.reverse();
        for point in &mut points {
            point.arclength = -point.arclength;
            point.direction = point.direction.map(|part| -part);
        }
        points.extend(ahead.into_iter().skip(1)); // the point itself is the first of both
        Ok(Self { points, ends: [before, after] })
    }
}
