//! A plane of two parameters of any subject: which motions happen where, and by which bifurcation each begins or ends.
//!
//! An [`AtlasPlan`](motiform_study::AtlasPlan) is carried out in two steps. [`survey()`] classifies the cells of a grid, coarse first, then
//! finer where neighbours differ; each cell has the verdicts of a scan of the same plan. [`trace()`] asks what bounds the regions: it
//! follows a motion from one side of a boundary along a line through it ([`crate::branches::follow()`]), and each point where a motion
//! loses its stability over the plane ([`crate::curves`]), until all boundaries lie on a curve or nothing more can be followed.
//! [`boundaries()`] compares the two.
//!
//! Finished cells and lines are kept in a journal: neither an interruption nor the number of threads changes a number.

mod boundary;
mod courses;
mod draw;
mod folder;
mod grid;
mod inset;
mod line;
mod page;
mod points;
mod region;
mod summary;
mod survey;
mod tables;
mod trace;
mod verify;

pub use boundary::{Boundary, Edge, boundaries};
pub use courses::mixed_courses;
pub use draw::{atlas_map, draw_atlas};
pub use folder::AtlasFolder;
pub use grid::{Found, Grid, Place};
pub use line::{CrossingKind, EndKind, Line, LineEnd, StabilityCurve};
pub use page::{html, why_no_line};
pub use region::{Region, regions};
pub use summary::{atlas_summary, words};
pub use survey::{Begins, Stage, survey};
pub use tables::{cell_columns, curve_columns};
pub use trace::trace;
pub(crate) use verify::verify_atlas;
