//! Finished chapters as items of a journal.

use super::Options;
use motiform_figures::Style;
use motiform_figures::report::Section;
use motiform_store::Journal;
use motiform_study::Error;
use motiform_study::dataset::VERSION;
use std::path::Path;

fn item(chapter: &str, quick: bool) -> String {
    format!("{chapter}{}.json", if quick { "-quick" } else { "" })
}

/// The style of the figures as a text that is equal for equal styles; empty for the default.
fn style_name(style: &Style) -> String {
    if *style == Style::default() { String::new() } else { format!("{style:?}") }
}

/// A chapter that an earlier run finished; `None` where there is none, another version computed it, or its figures have another style.
pub(crate) fn read(journal: &dyn Journal, chapter: &str, options: &Options) -> Option<Section> {
    let (version, style, section): (String, String, Section) =
        serde_json::from_slice(&journal.finished(&item(chapter, options.quick))?).ok()?;
    (version == VERSION && style == style_name(&options.style)).then_some(section)
}

/// Keeps a chapter.
pub(crate) fn write(
    journal: &dyn Journal,
    chapter: &str,
    options: &Options,
    section: &Section,
) -> Result<(), Error> {
    let item = item(chapter, options.quick);
    let content = serde_json::to_vec(&(VERSION, style_name(&options.style), section))
        .map_err(|error| Error::write_failed(Path::new(&item), error))?;
    Ok(journal.finish(&item, &content)?)
}
