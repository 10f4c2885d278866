//! Figures of branches and curves: their contents and texts. The drawing itself is in [`motiform_figures`].

mod branches;
mod curves;

pub use branches::{Ordinate, diagram as branch_diagram, draw_branches};
pub use curves::{check_scan, curve_map, curve_mark, curve_stretches, draw_curves, marks_together};
