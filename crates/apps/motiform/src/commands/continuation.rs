//! `motiform continue`.

use crate::args::ContinueOptions;
use crate::commands::remarks::{of_branches, ties};
use crate::commands::{curves, subject};
use crate::output::{End, plain, say, warn};
use crate::progress::Progress;
use motiform_diagrams::draw::branch_figures;
use motiform_diagrams::starts::StartPoint;
use motiform_diagrams::{
    BranchEnd, BranchFolder, Coefficient, Followed, NamedPart, SpecialEntry, follow_kept, neutral_stretches,
    nine, stated, stretches, summary,
};
use motiform_dynamics::in_words;
use motiform_lab::draw::{self, Figures, Picture};
use motiform_store::{Folder, Journal, Opening};
use motiform_study::branches::BranchSettings;
use motiform_study::quantity::motion::PERIOD;
use motiform_study::{BranchPlan, CurvePlan, Error, Given, Shown, Study, counted};
use serde::{Serialize, Serializer};
use std::fmt::{Display, Formatter};
use std::path::{Path, PathBuf};

pub(crate) fn run(options: &ContinueOptions) -> anyhow::Result<End> {
    let drawn = output(options, String::new()).is_some() && !options.no_figures;
    let remedy = "nothing is drawn with --no-figures, or with --json and no --out: leave one out";
    options.style.refuse_unless(drawn, remedy)?;
    let (mut study, given) = study(options)?;
    let units = options.units.of(&mut study)?;
    let plan = BranchPlan::new(&study, &BranchSettings { given, ..study.follow.branches()? })?;
    match study.follow.curves()? {
        Some(_) if options.units.given.is_some() => Err(no_units("--curve").into()),
        Some(settings) => curves::run(options, &CurvePlan::new(&study, plan, &settings)?),
        None => branches(options, plan, &units),
    }
}

/// Refuses units where both axes are parameters.
pub(super) fn no_units(of: &str) -> Error {
    let remedy = "both axes of this figure are parameters, which stay those of the model: leave it out";
    Error::Setting { key: "--units", value: format!("given with {of}"), remedy }
}

fn branches(options: &ContinueOptions, plan: BranchPlan, units: &Shown) -> anyhow::Result<End> {
    let out = output(options, plan.default_folder());
    let (files, before) = prepare(options, out, |path, opening| BranchFolder::open(path, &plan, opening))?;
    let watch = Progress::of_stage("branches", "of those known so far");
    let mut keep = |found: &_| files.as_ref().map_or(Ok(()), |folder| BranchFolder::keep(found, folder));
    let journal: &dyn Journal = files.as_ref().map_or(&(), |folder| folder);
    let found = watch.over(|watch| follow_kept(&plan, before, &mut keep, journal, watch));
    let (files, found) = or_abandon(files, found)?;
    let folder = BranchFolder { plan, found };
    let ordinate = options.observable.ordinate();
    let drawn = || branch_figures(&folder.plan, &folder.found, ordinate, units);
    let (written, undrawn) = write(options, files, drawn, |pictures, to| folder.write(pictures, to))?;
    say(&Branched { folder: &folder, written: written.as_deref(), units }, options.json)?;
    end(undrawn, folder.found.complete)
}

/// The plan of the options, and its start, if it was taken from an earlier result.
fn study(options: &ContinueOptions) -> Result<(Study, Option<Given>), Error> {
    let (mut study, given) = subject(options)?;
    subject::note_noise(&mut study);
    subject::apply(&options.method, &mut study)?;
    study.perturb = options.perturb.unwrap_or(study.perturb);
    let (mut study, perturbation) = study.perturbed()?;
    if let Some(perturbation) = perturbation {
        warn(&format!("{perturbation}; --perturb 0 keeps the exact start"));
    }
    options.follow.apply(&mut study.follow)?;
    ties(&study, &of_branches(&study))?;
    Ok((study, given))
}

/// The model with the parameters and the start of an earlier result, if one is given; --set and --tie have the last word.
fn subject(options: &ContinueOptions) -> Result<(Study, Option<Given>), Error> {
    let Some(text) = &options.start else { return Ok((subject::study(&options.subject)?, None)) };
    let start = StartPoint::read(text)?;
    let named = options.subject.subject.is_some() || options.subject.preset.is_some();
    let mut study = if named { subject::study(&options.subject)? } else { start.study()? };
    start.put(&mut study)?;
    subject::put(&options.subject.parameters, &mut study)?;
    study.follow.from = None; // the motion of another start
    Ok((study, Some(start.given)))
}

/// Where the result goes; nowhere, if it is only printed.
pub(super) fn output(options: &ContinueOptions, default: String) -> Option<PathBuf> {
    match &options.folder.out {
        Some(path) => Some(path.clone()),
        None if options.json && !options.folder.resume => None,
        None => Some(PathBuf::from(default)),
    }
}

/// Opens the output before any computing, so that a wrong --out costs nothing, and reads what is there of the result.
pub(super) fn prepare<T>(
    options: &ContinueOptions,
    out: Option<PathBuf>,
    open: impl FnOnce(&Path, Opening) -> Result<(Folder, Option<T>), Error>,
) -> Result<(Option<Folder>, Option<T>), Error> {
    let Some(out) = out else { return Ok((None, None)) };
    let (folder, before) = open(&out, options.folder.opening())?;
    folder.notes().iter().for_each(|note| warn(note));
    Ok((Some(folder), before))
}

/// The result; nothing is left of the output if nothing could be computed.
pub(super) fn or_abandon<T>(
    files: Option<Folder>,
    found: Result<T, Error>,
) -> Result<(Option<Folder>, T), Error> {
    match found {
        Ok(found) => Ok((files, found)),
        Err(error) => {
            files.into_iter().for_each(Folder::abandon);
            Err(error)
        }
    }
}

/// Writes the folder; what was written, and why there are no figures, if there are none.
pub(super) fn write(
    options: &ContinueOptions,
    files: Option<Folder>,
    draw: impl FnOnce() -> Result<Figures, Error>,
    write: impl FnOnce(&[Picture], &Folder) -> Result<(), Error>,
) -> Result<(Option<String>, Option<Error>), Error> {
    let Some(files) = files else { return Ok((None, None)) };
    let format = options.style.format();
    let drawn = if options.no_figures {
        Ok(Vec::new())
    } else {
        draw().and_then(|all| draw::files(all, true, &format))
    };
    let (pictures, undrawn) = match drawn {
        Ok(pictures) => (pictures, None),
        Err(error @ Error::Figure(_)) => (Vec::new(), Some(error)),
        Err(error) => return Err(error),
    };
    write(&pictures, &files)?;
    files.notes().iter().for_each(|note| warn(note));
    Ok((Some(files.shown().display().to_string()), undrawn))
}

/// The end of the command.
pub(super) fn end(undrawn: Option<Error>, complete: bool) -> anyhow::Result<End> {
    if let Some(error) = undrawn {
        return Err(anyhow::Error::new(error).context("the points are written, the figures are not"));
    }
    if !complete {
        warn("interrupted: what is whole is kept; the same `motiform continue` with --resume goes on");
        return Ok(End::Interrupted);
    }
    Ok(End::Done)
}

/// The branches of a plan.
struct Branched<'a> {
    folder: &'a BranchFolder,
    written: Option<&'a str>,
    units: &'a Shown,
}

impl Serialize for Branched<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        summary(&self.folder.plan, &self.folder.found).serialize(serializer)
    }
}

impl Display for Branched<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let BranchFolder { plan, found } = self.folder;
        let along = &plan.computation.along;
        write!(f, "{}, {}", plain(&plan.title()), along.words())?;
        for (number, followed) in found.branches.iter().enumerate() {
            branch(f, self.folder, number, followed, self.units)?;
        }
        if found.left > 0 {
            write!(f, "\nmore       begins at {} of these points; --branches N follows more", found.left)?;
        }
        if found.doublings_left > 0 {
            let left = found.doublings_left;
            write!(
                f,
                "\ndoublings  of the period that were not followed: {left}; --doublings N follows N in a row"
            )?;
        }
        self.written.map_or(Ok(()), |written| write!(f, "\nwritten    {written}"))
    }
}

fn branch(
    f: &mut Formatter<'_>,
    folder: &BranchFolder,
    number: usize,
    followed: &Followed,
    units: &Shown,
) -> std::fmt::Result {
    let parts = followed.parts();
    let names = match &parts[..] {
        [_, _, ..] => parts.iter().map(name).collect::<Vec<_>>().join(", then "),
        _ => followed.named().as_ref().map_or_else(String::new, name),
    };
    write!(f, "\nbranch {number:<3} {names}, {}", counted(followed.samples().count(), "point"))?;
    for pair in parts.windows(2) {
        let [last, first] = [pair[0].to, pair[1].from].map(nine);
        write!(f, "\n           becomes {} between {last} and {first}", pair[1].motion.words())?;
    }
    if followed.family() > 0 {
        let dimensions = counted(followed.family(), "dimension");
        write!(
            f,
            "\n           each motion is one of a family of {dimensions} with the same parameters (has the model a symmetry that it"
        )?;
        write!(f, " does not state?): stability is that of the family")?;
    }
    let stable = stretches(&folder.found, followed);
    let neutral = neutral_stretches(followed);
    for [from, to] in &neutral {
        let [from, to] = [nine(*from), nine(*to)];
        write!(f, "\n           neutral from {from} to {to}: a growth rate is 0 within its error")?;
    }
    if stable.is_empty() && neutral.is_empty() {
        write!(f, "\n           stable nowhere")?;
    }
    for [from, to] in stable {
        let [from, to] = [from, to].map(|end| bound(followed, end));
        write!(f, "\n           stable from {from} to {to}")?;
    }
    for special in folder.found.special(number) {
        write!(f, "\n           {}", line(&special, units))?;
    }
    for leg in &followed.legs {
        write!(f, "\n           ends: {}", leg.ending())?;
    }
    Ok(())
}

/// The name of a part of a branch, with its course and its form.
fn name(part: &NamedPart) -> String {
    let course = part.course.map_or(String::new(), |course| format!(" {}", course.words()));
    let form = part.form.map_or(String::new(), |form| format!(" ({})", in_words(form.name())));
    format!("{}{course}{form}", part.motion.words())
}

/// The end of a stable range, with its error where that is an extrapolated end of the branch.
fn bound(followed: &Followed, value: f64) -> String {
    let connections = followed.legs.iter().filter_map(|leg| match &leg.end {
        BranchEnd::Homoclinic(connection) => Some(connection),
        _ => None,
    });
    let here = connections
        .filter(|connection| connection.parameter == value)
        .min_by(|a, b| a.error.total_cmp(&b.error));
    here.map_or_else(|| nine(value), |connection| stated(value, connection.error))
}

/// A coefficient with its error, where that shows in six digits.
fn six(found: Coefficient) -> String {
    if found.value == 0.0 && found.error == 0.0 {
        return "0".to_owned();
    }
    let least = 1e-6 * found.value.abs();
    let text = stated(found.value, found.error.max(least));
    let value = text.split_once(" +- ").filter(|_| found.error < least).map(|parts| parts.0.to_owned());
    value.unwrap_or(text)
}

/// An error below this one is not shown: all nine decimals are right.
const SHOWN: f64 = 5e-10;

/// The same of periods, with six decimals.
const SHOWN_OF_PERIODS: f64 = 5e-7;

fn line(special: &SpecialEntry, units: &Shown) -> String {
    let value = match special.error {
        Some(error) if error > SHOWN => stated(special.parameter, error),
        _ => nine(special.parameter),
    };
    let mut line = format!("{:<17} {value}", in_words(special.kind));
    let unit = if units.is_physical() {
        format!(" {}", plain(&units.name(PERIOD.dimension, "")))
    } else {
        String::new()
    };
    let factor = units.factor(PERIOD.dimension);
    let period = special.period.map(|period| match special.period_error.map(|error| error * factor) {
        Some(error) if error > SHOWN_OF_PERIODS => format!("period {}{unit}", stated(period * factor, error)),
        _ => format!("period {:.6}{unit}", period * factor),
    });
    let words = special.criticality.map(|word| match &special.undecided {
        Some(why) => format!("{word} ({why})"),
        None => word.to_owned(),
    });
    let coefficient = special.coefficient.map(|(name, found)| format!("{name} {}", six(found)));
    let crosses =
        special.coefficient.is_some_and(|(name, _)| special.kind == "branch-point" && name == "cubic");
    let pitchfork = crosses.then(|| "a pitchfork".to_owned());
    let breaks = special.breaks.map(|what| format!("breaks the {what}"));
    let others: String = special.others.iter().map(|other| format!(" and {other}")).collect();
    let next = special.branch.map(|branch| {
        let word = if special.others.is_empty() { "branch" } else { "branches" };
        format!("to {word} {branch}{others}")
    });
    let without = special.without.as_ref().map(|why| format!("without a branch: {why}"));
    for part in [period, pitchfork, words, coefficient, breaks, next, without].into_iter().flatten() {
        line += "  ";
        line += &part;
    }
    line
}
