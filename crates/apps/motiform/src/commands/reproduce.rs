//! `motiform reproduce`.

use crate::args::ReproduceOptions;
use crate::output::{End, plain, say, warn};
use crate::progress::Progress;
use motiform_figures::Label;
use motiform_figures::report::{Claim, Counts, Picture, Report, ReportFigure};
use motiform_lab::draw::{FigureFormat, formats};
use motiform_paper::{Keeping, Kept, Options, reproduce_kept};
use motiform_store::{Folder, Kind, Opening, end_of_work};
use motiform_study::Error;
use serde::{Serialize, Serializer};
use serde_json::json;
use std::fmt::{Display, Formatter};
use std::path::Path;

/// The page.
const PAGE: &str = "report.html";

pub(crate) fn run(options: &ReproduceOptions) -> anyhow::Result<End> {
    let out = &options.out;
    let format = options.style.format();
    let wanted = Options {
        style: format.style.clone(),
        figures: options.figures.clone(),
        quick: options.quick,
        threads: options.threads.count(),
    };
    wanted.check()?;
    let files = Folder::open(out, Kind::Report, Opening::Resume, &[])?;
    files.check()?;
    files.notes().iter().for_each(|note| warn(note));
    let watch = Progress::new(1000.0, "permille");
    let page = |report: &Report| Ok(files.put(PAGE, report.html().as_bytes())?);
    let keeping = Keeping { journal: &files, page: &page, kept: &Kept::default() };
    let report = watch.over(|watch| reproduce_kept(&wanted, out, keeping, watch));
    let report = match report {
        Err(Error::Interrupted) => {
            files.settle()?;
            warn(&format!("interrupted: the same command continues with the results in {}", out.display()));
            return Ok(End::Interrupted);
        }
        report => report?,
    };
    write_figures(&report, &format, &files)?;
    files.put(PAGE, report.html().as_bytes())?;
    end_of_work(&files);
    files.complete()?;
    files.notes().iter().for_each(|note| warn(note));
    let page = out.join(PAGE);
    say(&Reproduced { report: &report, page: &page }, options.json)?;
    Ok(if report.all_hold() { End::Done } else { End::NotAsAsked })
}

/// The figures of the report as files: `figure-3b.svg` and `.png` are Fig. 3(b) of the paper, `figure-3.1.svg` the page's further
/// Figure 3.1, `.csv` the numbers that it shows, `.txt` the words that a medium leaves to the text around it.
fn write_figures(report: &Report, format: &FigureFormat, files: &Folder) -> Result<(), Error> {
    for (number, section) in report.numbered() {
        for (figure, name) in section.figures.iter().zip(section.figure_names(number)) {
            let stem = format!("figure-{}", name.replace(['(', ')'], ""));
            write_figure(&stem, figure, format, files)?;
        }
    }
    Ok(())
}

fn write_figure(
    stem: &str,
    figure: &ReportFigure,
    format: &FigureFormat,
    files: &Folder,
) -> Result<(), Error> {
    match &figure.picture {
        Picture::Svg(svg) => {
            for file in formats(&stem, svg.clone(), format)? {
                files.put(&file.name, &file.bytes)?;
            }
        }
        Picture::Png(bytes) => files.put(&format!("{stem}.png"), bytes)?,
    }
    if let Some(data) = &figure.data {
        files.put(&format!("{stem}.csv"), data.as_bytes())?;
    }
    if let Some(left) = &figure.left {
        let words = format!("{left}{}\n", Label::parse(&figure.caption).terminal());
        files.put(&format!("{stem}.txt"), words.as_bytes())?;
    }
    Ok(())
}

/// A report: the claims of the paper, and the checks of ours.
struct Reproduced<'a> {
    report: &'a Report,
    page: &'a Path,
}

/// `hold`, `differ`, `fail`, `not_judged` count the claims of the paper; `checks` has the same for the checks of ours.
impl Serialize for Reproduced<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { report, page } = self;
        let claim = |claim: &Claim| {
            json!({ "source": if claim.is_ours() { "check" } else { "paper" }, "sentences": claim.sentences(),
                "says": claim.says, "finds": claim.finds, "how": claim.how, "verdict": claim.verdict.words(),
                "explanation": claim.verdict.explanation() })
        };
        let sections: Vec<_> = report
            .numbered()
            .map(|(number, section)| {
                let claims: Vec<_> = section.claims.iter().map(claim).collect();
                json!({ "number": number, "title": section.title, "claims": claims })
            })
            .collect();
        let (counts, checks) = (report.counts(), report.checks());
        json!({
        "report": page, "hold": counts.hold, "differ": counts.differ, "fail": counts.fail, "not_judged": counts.unjudged,
        "checks": { "hold": checks.hold, "differ": checks.differ, "fail": checks.fail, "not_judged": checks.unjudged },
        "sections": sections,
    })
    .serialize(serializer)
    }
}

impl Display for Reproduced<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { report, page } = self;
        for section in &report.sections {
            writeln!(f, "{}", plain(&section.title))?;
            for claim in &section.claims {
                let ours = if claim.is_ours() { "check: " } else { "" };
                writeln!(f, "  {:12} {ours}{}", claim.verdict.words(), plain(&claim.says))?;
                if let Some(explanation) = claim.verdict.explanation() {
                    writeln!(f, "               found: {}", plain(&claim.finds))?;
                    writeln!(f, "               {}", plain(explanation))?;
                }
            }
        }
        let counted = |Counts { hold, differ, fail, unjudged }: Counts| {
            let open = if unjudged == 0 { String::new() } else { format!(", {unjudged} not judged") };
            format!("{hold} hold, {differ} differ for a known reason, {fail} fail{open}")
        };
        writeln!(f, "claims of the paper: {}", counted(report.counts()))?;
        writeln!(f, "additional checks:   {}", counted(report.checks()))?;
        write!(f, "{}", page.display())
    }
}
