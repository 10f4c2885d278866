//! Everything about the shape of one frame.

use super::crossing::{Crossing, crossing};
use super::fit::{RadiusFit, fit_radius};
use super::flag::Flag;
use super::star::fold;
use super::tangent::{TangentModes, tangent_modes};
use crate::form::{Form, form};
use crate::geometry::{area, centroid, distinct, edges, perimeter};
use motiform_dynamics::sample::median;
use serde::Serialize;

/// Settings of the modes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ModeOptions {
    /// Largest n of z_n, from 3 on.
    pub highest: usize,
    /// Fewest distinct vertices of an outline; never fewer than the unknowns of the fit and 4.
    pub least_vertices: usize,
    /// |ln(area/median)| from which on an area jumps, where the areas do not scatter more.
    pub jump: f64,
}

impl Default for ModeOptions {
    /// z2 to z5, 16 vertices, a jump of the area by a third.
    fn default() -> Self {
        Self { highest: 5, least_vertices: 16, jump: 0.3 }
    }
}

impl ModeOptions {
    pub(super) fn least(&self) -> usize {
        self.least_vertices.max(3 + 2 * (self.highest.max(3) - 1) + 4)
    }
}

/// Shape of one frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrameModes {
    /// Number of the frame.
    pub frame: i64,
    /// Time.
    pub t: f64,
    /// Distinct vertices.
    pub vertices: usize,
    /// Area, positive.
    pub area: f64,
    /// Centroid of the area: not the centre of the modes.
    pub centroid: [f64; 2],
    /// Length of the polygon.
    pub perimeter: f64,
    /// Aspect ratio, solidity and circularity; `None` where nothing is enclosed.
    pub form: Option<Form>,
    /// Centre and modes of the radius; `None` where it is not single valued, and where there is no fit.
    pub radius: Option<RadiusFit>,
    /// Modes of the tangent angle; `None` where the outline does not turn once.
    pub tangent: Option<TangentModes>,
    /// Its faults.
    pub flags: Vec<Flag>,
}

impl FrameModes {
    /// Returns `true` if the frame is no observation of the shape; its flags say why.
    pub fn is_left_out(&self) -> bool {
        self.flags.iter().any(Flag::leaves_out)
    }

    /// Returns `true` if it has modes of the radius that count.
    pub fn counts(&self) -> bool {
        self.radius.is_some() && !self.is_left_out()
    }

    /// Returns `true` if its place is an observation, and the form of the polygon where there is one, whatever its radius: it encloses an
    /// area, and only modes would ask for more vertices, or the record is one of positions.
    pub fn is_seen(&self) -> bool {
        self.is_seen_but(|_| false)
    }

    /// The same without regard to these flags.
    pub fn is_seen_but(&self, without: impl Fn(&Flag) -> bool) -> bool {
        let of_modes = |flag: &Flag| matches!(flag, Flag::TooFewVertices { .. } | Flag::PositionAlone);
        let hides = |flag: &Flag| flag.leaves_out() && !of_modes(flag) && !without(flag);
        let is_placed = self.form.is_some() || self.flags.contains(&Flag::PositionAlone);
        is_placed && !self.flags.iter().any(hides)
    }
}

/// The shape of one outline, with the flags that can be seen in it alone. `points` are finite.
pub fn outline_modes(points: &[[f64; 2]], options: &ModeOptions) -> FrameModes {
    let points = distinct(points);
    let (least, highest) = (options.least(), options.highest.max(3));
    let mut modes = FrameModes {
        frame: 0,
        t: 0.0,
        vertices: points.len(),
        area: area(&points).abs(),
        centroid: centroid(&points),
        perimeter: perimeter(&points),
        form: form(&points),
        radius: None,
        tangent: None,
        flags: Vec::new(),
    };
    let few = points.len() < least;
    if few {
        modes.flags.push(Flag::TooFewVertices { vertices: points.len(), least });
    }
    // a polygon along a line encloses only round-off
    if modes.area.is_nan() || modes.area <= 1e-9 * modes.perimeter * modes.perimeter {
        modes.flags.extend((!few).then_some(Flag::NoArea));
        return modes;
    }
    match crossing(&points) {
        Crossing::None => {}
        Crossing::At(edges) => modes.flags.push(Flag::SelfCrossing { edges }),
        Crossing::Unknown => modes.flags.push(Flag::CrossingUnknown { vertices: points.len() }),
    }
    if few {
        return modes;
    }
    modes.tangent = tangent_modes(&points, highest);
    match fit_radius(&points, highest) {
        None => modes.flags.push(Flag::NoFit),
        Some(fit) => match not_star_shaped(&points, &fit) {
            Some(flag) => modes.flags.push(flag),
            None => modes.radius = Some(fit),
        },
    }
    modes
}

/// The flag, where the outline runs back about the centre by more than noise: the median edge or 4 sigma, at most R0/10.
fn not_star_shaped(points: &[[f64; 2]], fit: &RadiusFit) -> Option<Flag> {
    let median = median(edges(points).map(|(a, b)| libm::hypot(b[0] - a[0], b[1] - a[1])))?;
    let tolerance = median.max(4.0 * fit.sigma).min(0.1 * fit.r0);
    let (turns, back) = fold(points, fit.centre).map_or((0, 0.0), |fold| (fold.turns, fold.back));
    (turns.abs() != 1 || back > tolerance).then_some(Flag::NotStarShaped { turns, back, tolerance })
}
