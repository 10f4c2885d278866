//! Fig. 6: the active cell, whose only parameter is its length.

mod branches;
mod edges;
mod lengths;

pub(super) use branches::{Branch, folds};
pub(super) use lengths::{modes_for, study};

use super::context::Context;
use crate::Error;
use crate::report::Section;
use edges::Edges;
use lengths::Lengths;

pub(super) fn section(context: &Context<'_>) -> Result<Section, Error> {
    let edges = Edges::find(context)?;
    eprintln!("{edges:#?}");
    let _ = Lengths::scan(context)?;
    Ok(Section::default())
}
