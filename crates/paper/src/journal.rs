//! Finished chapters as items of a journal.

use motiform_figures::report::Section;
use motiform_store::Journal;
use motiform_study::Error;
use motiform_study::dataset::VERSION;
use std::path::Path;

fn item(chapter: &str, quick: bool) -> String {
    format!("{chapter}{}.json", if quick { "-quick" } else { "" })
}

/// A chapter that an earlier run finished; `None` where there is none, or another version computed it.
pub(crate) fn read(journal: &dyn Journal, chapter: &str, quick: bool) -> Option<Section> {
    let (version, section): (String, Section) =
        serde_json::from_slice(&journal.finished(&item(chapter, quick))?).ok()?;
    (version == VERSION).then_some(section)
}

/// Keeps a chapter.
pub(crate) fn write(
    journal: &dyn Journal,
    chapter: &str,
    quick: bool,
    section: &Section,
) -> Result<(), Error> {
    let item = item(chapter, quick);
    let content = serde_json::to_vec(&(VERSION, section))
        .map_err(|error| Error::write_failed(Path::new(&item), error))?;
    Ok(journal.finish(&item, &content)?)
}
