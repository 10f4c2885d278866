//! Reproduction of the paper: every figure recomputed, every claim checked, one report.
//!
//! One file or folder per figure, one for the equations and one for the discussion; each gives a [`Section`]
//! with its pictures and its claims. A chapter runs studies and scans through its `context`, and says what it
//! finds as `claims`. Continued bifurcations belong to two figures: `lines` (Fig. 1), which are known from
//! formulas, and `branches` and `curves` (Fig. 4).

mod branches;
mod claims;
mod context;
mod curves;
mod equations;
mod extensions;
mod fault;
mod fig1;
mod fig2;
mod fig3;
mod fig4;
mod fig5;
mod fig6;
mod journal;
mod kept;
mod lines;
mod models;
mod plane;
mod sentences;
mod strip;

use context::{Context, Progress, Share};
pub use fault::Fault;
pub use kept::Kept;
use motiform_dynamics::Watch;
use motiform_figures::Style;
use motiform_figures::report::{Claim, Counts, Report, Section};
use motiform_lab::pool;
use motiform_store::Journal;
use motiform_study::Error;
pub use sentences::{checked_in, entry_of};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// The figures to rebuild, and the settings.
#[derive(Clone, Debug)]
pub struct Options {
    /// The figures, by name (see [`names`]); all of the paper if empty.
    pub figures: Vec<String>,
    /// Coarser scans and shorter runs: the same claims with less evidence.
    pub quick: bool,
    /// Threads of the scans; changes no number.
    pub threads: usize,
    /// Title, caption and width of the figures. Finished chapters with figures in another style are rebuilt, from the scans that are there.
    pub style: Style,
}

impl Options {
    /// Checks that every figure asked for is one of the paper's.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with all names.
    pub fn check(&self) -> Result<(), Error> {
        match self.figures.iter().find(|name| !names().contains(&name.as_str())) {
            Some(name) => Err(unknown(name)),
            None => Ok(()),
        }
    }
}

fn unknown(name: &str) -> Error {
    let choice = format!("choose one of {}", names().join(", "));
    Error::UnknownName { kind: "figure", name: name.to_owned(), nearest: None, choice }
}

/// A part of the paper: its name, the share of the work it is, and what rebuilds it.
struct Chapter {
    name: &'static str,
    work: f64,
    rebuild: fn(&Context<'_>) -> Result<Section, Error>,
}

/// The figures, numbered as in the paper; then what is not about one figure.
const CHAPTERS: &[Chapter] = &[
    Chapter { name: "fig1", work: 3.0, rebuild: fig1::section },
    Chapter { name: "fig2", work: 1.0, rebuild: fig2::section },
    Chapter { name: "fig3", work: 0.5, rebuild: fig3::section },
    Chapter { name: "fig4", work: 3.0, rebuild: fig4::section },
    Chapter { name: "fig5", work: 1.0, rebuild: fig5::section },
    Chapter { name: "fig6", work: 8.0, rebuild: fig6::section },
    Chapter { name: "equations", work: 1.0, rebuild: equations::section },
    Chapter { name: "models", work: 0.5, rebuild: models::section },
];

/// Chapters that are not about the paper: rebuilt where they are asked for by name.
const FURTHER: &[Chapter] = &[Chapter { name: "extensions", work: 0.5, rebuild: extensions::section }];

/// The names of what can be rebuilt.
pub fn names() -> Vec<&'static str> {
    CHAPTERS.iter().chain(FURTHER).map(|chapter| chapter.name).collect()
}

/// The number of a chapter, which does not depend on what else is rebuilt.
fn number_of(name: &str) -> Option<usize> {
    names().iter().position(|known| *known == name).map(|place| place + 1)
}

/// `fig1: 12 hold, 3 differ, 0 fail, 1 not judged`, over the claims of the paper and the checks of ours.
fn finished(name: &str, section: &Section) -> String {
    let Counts { hold, differ, fail, unjudged } = Counts::of(section.claims.iter());
    format!("{name}: {hold} hold, {differ} differ, {fail} fail, {unjudged} not judged")
}

/// The treatment of chapters while others are computed.
#[derive(Clone, Copy)]
pub struct Keeping<'k> {
    /// Keeps finished chapters: they are not computed again.
    pub journal: &'k dyn Journal,
    /// Gets the report after each chapter; those that are missing say so.
    pub page: &'k (dyn Fn(&Report) -> Result<(), Error> + Sync),
    /// The results that are computed once for all chapters.
    pub kept: &'k Kept,
}

/// Rebuilds the paper, or parts of it. Scans are kept in folders inside `out`, so that an interrupted run goes on where it
/// was; `out` must exist.
///
/// # Errors
/// An unknown name; [`Error::Interrupted`] if the watch stopped it; files that cannot be written.
pub fn reproduce(options: &Options, out: &Path, watch: &dyn Watch) -> Result<Report, Error> {
    reproduce_kept(options, out, Keeping { journal: &(), page: &|_| Ok(()), kept: &Kept::default() }, watch)
}

/// As [`reproduce`]; finished chapters survive the end of the program, however it ends.
///
/// # Errors
/// As [`reproduce`], and those of `keeping`.
pub fn reproduce_kept(
    options: &Options,
    out: &Path,
    keeping: Keeping<'_>,
    watch: &dyn Watch,
) -> Result<Report, Error> {
    options.check()?;
    let named = |chapter: &&Chapter| options.figures.iter().any(|name| name == chapter.name);
    let paper = CHAPTERS.iter().filter(|chapter| options.figures.is_empty() || named(chapter));
    let chapters: Vec<&Chapter> = paper.chain(FURTHER.iter().filter(named)).collect();
    let progress = Progress::new(watch, &chapters.iter().map(|chapter| chapter.work).collect::<Vec<_>>());
    let pages = Pages::new(&chapters, keeping, options.style.no_caption);
    // Much of a chapter is one long run after the other: chapters side by side keep all cores busy.
    let rebuild = |&(index, chapter): &(usize, &Chapter)| {
        let share = Share { progress: &progress, index };
        let context = Context {
            out,
            quick: options.quick,
            threads: options.threads,
            style: &options.style,
            watch: &share,
            kept: keeping.kept,
            fault: None,
        };
        let section = match journal::read(keeping.journal, chapter.name, options) {
            Some(section) => section,
            None => {
                let mut section = (chapter.rebuild)(&context)?;
                section.number = number_of(chapter.name);
                // the paper's own figures first
                section.figures.sort_by_key(|figure| figure.of_paper.is_none());
                journal::write(keeping.journal, chapter.name, options, &section)?;
                section
            }
        };
        share.progress(1.0);
        share.note(&finished(chapter.name, &section));
        pages.turn(index, section)
    };
    let numbered: Vec<(usize, &Chapter)> = chapters.iter().copied().enumerate().collect();
    pool::each(&numbered, options.threads, watch, rebuild)?;
    Ok(report(pages.sections(), options.style.no_caption))
}

/// The claims of a chapter, with a fault in what they are judged by: what is computed is kept, so that many faults cost little. There
/// are no figures, and claims with little evidence are judged as well.
///
/// # Errors
/// As [`reproduce`].
pub fn claims_under(
    fault: &Fault,
    chapter: &str,
    kept: &Kept,
    out: &Path,
    threads: usize,
) -> Result<Vec<Claim>, Error> {
    let found = CHAPTERS.iter().chain(FURTHER).find(|known| known.name == chapter);
    let found = found.ok_or_else(|| unknown(chapter))?;
    let style = &Style::default();
    let context = Context { out, quick: true, threads, style, watch: &(), kept, fault: Some(fault) };
    Ok((found.rebuild)(&context)?.claims)
}

/// The report of these sections.
fn report(sections: Vec<Section>, without_captions: bool) -> Report {
    Report {
        title: "Dynamics of a deformable self-propelled domain, rebuilt".to_owned(),
        about: claims::ABOUT.to_owned(),
        sections,
        without_captions,
        sentences: sentences::sentences(),
        ..Report::default()
    }
}

/// The sections so far.
struct Pages<'k> {
    sections: Mutex<Vec<Section>>,
    without_captions: bool,
    keeping: Keeping<'k>,
}

impl<'k> Pages<'k> {
    /// Sections that say that they are missing.
    fn new(chapters: &[&Chapter], keeping: Keeping<'k>, without_captions: bool) -> Self {
        let missing = |chapter: &&Chapter| {
            Section {
            number: number_of(chapter.name),
            title: chapter.name.to_owned(),
            about: "This chapter is not rebuilt yet. The page is written again after each chapter; if the computation was \
                    ended, the same command goes on with what is finished."
                .to_owned(),
            ..Section::default()
        }
        };
        Self { sections: Mutex::new(chapters.iter().map(missing).collect()), without_captions, keeping }
    }

    /// Takes the section of a chapter, and gives the report to the page.
    fn turn(&self, index: usize, section: Section) -> Result<(), Error> {
        let mut sections = self.sections.lock().unwrap_or_else(PoisonError::into_inner);
        sections[index] = section;
        (self.keeping.page)(&report(sections.clone(), self.without_captions)) // one page after the other
    }

    fn sections(self) -> Vec<Section> {
        self.sections.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}
