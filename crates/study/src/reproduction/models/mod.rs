//! models.

use super::context::Context;
use crate::Error;
use crate::report::Section;

pub(super) fn section(_context: &Context<'_>) -> Result<Section, Error> {
    Ok(Section { title: "models".to_owned(), ..Section::default() })
}
