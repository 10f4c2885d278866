//! Figures of branches and curves: their contents and texts. The drawing itself is in [`motiform_figures`].

mod branches;
mod curves;

pub use branches::{Ordinate, branch_figures, diagram as branch_diagram};
pub use curves::{
    check_scan, curve_figures, curve_map, curve_mark, curve_stretches, marks_together, point_words, unlocated,
};
