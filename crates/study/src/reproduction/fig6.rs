//! fig6.

use super::context::Context;
use crate::Error;
use crate::report::Section;

pub(super) fn section(_context: &Context<'_>) -> Result<Section, Error> {
    Ok(Section { title: "fig6".to_owned(), ..Section::default() })
}
