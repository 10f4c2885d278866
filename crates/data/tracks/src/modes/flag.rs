//! The faults of a frame, by name and with evidence.

use serde::Serialize;
use std::fmt;

/// A side of the images.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// Least x.
    Left,
    /// Greatest x.
    Right,
    /// Least y: the upper side on a screen.
    LeastY,
    /// Greatest y: the lower side on a screen.
    GreatestY,
}

/// A frame counts as long as so many times the vertices that are missing are not more than all of them.
const MOST_MISSING: usize = 10;

/// Something that is wrong with a frame. Lengths are in the unit of the tracks.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
#[serde(tag = "flag", rename_all = "kebab-case")]
#[allow(missing_docs, reason = "each variant says what it is; the fields are its evidence")]
pub enum Flag {
    /// Fewer distinct vertices than are needed.
    TooFewVertices { vertices: usize, least: usize },
    /// Vertices of the file, `of` in all, were not finite: the outline has holes. Up to a tenth of them the others still give the modes.
    MissingVertices { count: usize, of: usize },
    /// The record is one of positions: there is no outline.
    PositionAlone,
    /// The polygon encloses nothing.
    NoArea,
    /// Two edges cross.
    SelfCrossing { edges: [usize; 2] },
    /// Too many pairs of edges to look at: whether any cross is not known.
    CrossingUnknown { vertices: usize },
    /// Rays from the centre meet the outline more than once: there are no radius modes, tangent-angle modes stand in.
    NotStarShaped { turns: i64, back: f64, tolerance: f64 },
    /// No centre with a radius of this form was found: there are no radius modes, tangent-angle modes stand in.
    NoFit,
    /// The outline is that of an earlier frame, vertex by vertex.
    Repeated { of: i64 },
    /// The area differs from the median of the frames around it by this factor.
    AreaJump { factor: f64 },
    /// The area changes by this factor and stays: another unit, or another cell.
    AreaStep { factor: f64 },
    /// The outline is at another place than those before and after it, this far away.
    PositionJump { distance: f64 },
    /// The outline is at another place than all before it, this far away, and stays there: another cell.
    PositionStep { distance: f64 },
    /// The outline is at another place than all before it, this far away, with the shape that it had: the stage has moved.
    StageJump { distance: f64 },
    /// A straight run of vertices at the border of the images: part of the cell is not seen.
    Clipped { side: Side, at: f64, run: f64 },
    /// Frames are missing before this one.
    Gap { missing: i64 },
}

impl Flag {
    /// All names, in the order of the flags.
    pub const NAMES: [&'static str; 16] = [
        "too few vertices",
        "missing vertices",
        "position alone",
        "no area",
        "self-crossing",
        "crossing unknown",
        "not star-shaped",
        "no fit",
        "repeated frame",
        "area jump",
        "area step",
        "position jump",
        "position step",
        "stage jump",
        "clipped",
        "gap",
    ];

    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::TooFewVertices { .. } => "too few vertices",
            Self::MissingVertices { .. } => "missing vertices",
            Self::PositionAlone => "position alone",
            Self::NoArea => "no area",
            Self::SelfCrossing { .. } => "self-crossing",
            Self::CrossingUnknown { .. } => "crossing unknown",
            Self::NotStarShaped { .. } => "not star-shaped",
            Self::NoFit => "no fit",
            Self::Repeated { .. } => "repeated frame",
            Self::AreaJump { .. } => "area jump",
            Self::AreaStep { .. } => "area step",
            Self::PositionJump { .. } => "position jump",
            Self::PositionStep { .. } => "position step",
            Self::StageJump { .. } => "stage jump",
            Self::Clipped { .. } => "clipped",
            Self::Gap { .. } => "gap",
        }
    }

    /// Returns `true` if no displacement can be taken to this frame from those before: stage, unit or cell is
    /// another one.
    pub fn parts(&self) -> bool {
        matches!(self, Self::AreaStep { .. } | Self::PositionStep { .. } | Self::StageJump { .. })
    }

    /// Returns `true` if the frame is no observation of the shape: its modes, if there are any, must not be
    /// used.
    pub fn leaves_out(&self) -> bool {
        if let Self::MissingVertices { count, of } = self {
            return MOST_MISSING * count > *of;
        }
        !matches!(
            self,
            Self::NotStarShaped { .. }
                | Self::NoFit
                | Self::CrossingUnknown { .. }
                | Self::Gap { .. }
                | Self::AreaStep { .. }
                | Self::PositionStep { .. }
                | Self::StageJump { .. }
        )
    }
}

impl fmt::Display for Flag {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.name();
        match self {
            Self::TooFewVertices { vertices, least } => {
                write!(f, "{name}: {vertices}, at least {least} are needed")
            }
            Self::MissingVertices { count, of } => write!(f, "{name}: {count} of {of} are not finite"),
            Self::PositionAlone | Self::NoArea | Self::NoFit => f.write_str(name),
            Self::SelfCrossing { edges: [a, b] } => write!(f, "{name}: edges {a} and {b}"),
            Self::CrossingUnknown { vertices } => write!(f, "{name}: {vertices} vertices are too many"),
            Self::NotStarShaped { turns, back, tolerance } => {
                write!(
                    f,
                    "{name}: {turns} turns about the centre, {back:.3} back where {tolerance:.3} is noise"
                )
            }
            Self::Repeated { of } => write!(f, "{name}: the outline of frame {of}"),
            Self::AreaJump { factor } => write!(f, "{name}: {factor:.2} times the frames around it"),
            Self::AreaStep { factor } => {
                write!(f, "{name}: {factor:.2} times the frames before, from here on")
            }
            Self::PositionJump { distance } => write!(f, "{name}: {distance:.3} from the frames around it"),
            Self::PositionStep { distance } => write!(f, "{name}: {distance:.3} from the frame before"),
            Self::StageJump { distance } => {
                write!(f, "{name}: {distance:.3} from the frame before, the shape goes on")
            }
            Self::Clipped { side, at, run } => write!(f, "{name}: {run:.3} along {side:?} = {at:.3}"),
            Self::Gap { missing } => {
                write!(f, "{name}: {missing} frame{} missing before it", if *missing == 1 { "" } else { "s" })
            }
        }
    }
}
