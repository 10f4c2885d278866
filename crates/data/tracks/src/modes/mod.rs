//! Outlines -> modes of the shape, with their errors and with what is wrong with each frame.
//!
//! `R(theta) = R0 + sum_{n=2}^{N} 2 Re(z_n e^{i n theta})` about the centre (X, Y): the outline of the models. A rotation of the plane by
//! `angle` multiplies `z_n` by `exp(-i n angle)`; a mirror `y -> -y` makes it its conjugate; all are lengths.
//! The centre is the point about which the radius has no first harmonic; the centroid of the area is another
//! point.

mod border;
mod breaks;
mod crossing;
mod fit;
mod flag;
mod frame;
mod normal;
mod polar;
mod quality;
mod residual;
mod star;
mod start;
mod straight;
mod tangent;
mod track;

pub use crossing::{Crossing, crossing};
pub use fit::{RadiusFit, fit_radius};
pub use flag::{Flag, Side};
pub use frame::{FrameModes, ModeOptions, outline_modes};
pub use polar::{radius, radius_slope};
pub use star::{Fold, fold};
pub use tangent::{TangentModes, tangent_modes};
pub use track::{CellModes, modes};
