//! `motiform simulate`.

use crate::args::{SimulateOptions, TableFormat};
use crate::commands::remarks::remark;
use crate::commands::{figure, film, subject};
use crate::output::{End, plain, say, warn};
use crate::progress::Progress;
use motiform_analysis::Verdict;
use motiform_dynamics::digits::six_decimals;
use motiform_lab::draw::Picture;
use motiform_lab::fields::write_rest;
use motiform_lab::long::read_shown;
use motiform_lab::naming;
use motiform_lab::recorder::{Rows, Unwanted};
use motiform_lab::simulate::{Run, columns, simulate_into};
use motiform_store::table::Table;
use motiform_store::{Format, Kind, Staged, StagedFile, TableWriter};
use motiform_study::{Dataset, Error, Manifest, RunPlan, Study};
use serde::{Serialize, Serializer};
use serde_json::json;
use std::fmt::{Display, Formatter};
use std::path::PathBuf;

pub(crate) fn run(options: &SimulateOptions) -> anyhow::Result<End> {
    film::check(&options.drawing.film)?;
    style(options)?;
    let plan = RunPlan::new(&study(options)?)?;
    shown_times(options, &plan)?;
    let target = Target::prepare(options, &plan)?;
    target.notes().iter().for_each(|note| warn(note));
    let c = &plan.computation;
    let watch = Progress::new(c.transient + c.t_end, "model time");
    let mut rows = target.rows(options, &plan)?;
    let (verdict, mut run) = watch.over(|watch| {
        let run = simulate_into(&plan, rows.as_mut(), watch).map_err(|error| target.shown(error))?;
        Ok::<_, Error>((naming::name(&run.manifest, watch)?, run))
    })?;
    run.manifest.regime = verdict.as_ref().map(|verdict| verdict.regime.name().to_owned());
    let whole = rows.finish(&run.manifest).map_err(|error| target.shown(error))?;
    let (written, undrawn) = target.write(options, &run, whole)?;
    let units = options.drawing.units.given.as_deref().unwrap_or(&plan.figure.units);
    let done = Simulated { run: &run, verdict: verdict.as_ref(), written: written.as_deref(), units };
    say(&done, options.json)?;
    if let Some((motion, growth)) = naming::unstable(&run.manifest)? {
        warn(&format!(
            "the run ends on {motion} motion that is unstable (growth rate {growth:.2e}): it passes by, or its \
             start has an exact symmetry, which a typical start has not; follow it for longer, or change a coordinate that is 0 in the \
             start a little"
        ));
    }
    if let Some(error) = run.manifest.step_error.filter(|&error| error > COARSE) {
        warn(&format!(
            "the step loses accuracy: halving it changes one step by {error:.1e} of the state; give a smaller --step"
        ));
    }
    if let Some(error) = undrawn {
        return Err(error);
    }
    Ok(End::from(&run.manifest.outcome.outcome))
}

/// A fixed step whose error is a larger fraction of the state than this gives a warning.
const COARSE: f64 = 1e-4;

/// The reason why a run without an error has no figures.
const NOT_DRAWN: &str = "no figure is drawn: fewer than two rows lie within the times that are shown; give a smaller --dt-out, or a longer \
                         --t-end, or other times to draw (--from, --to)";

/// Refuses times to draw that begin where the run ends: nothing would be drawn.
fn shown_times(options: &SimulateOptions, plan: &RunPlan) -> Result<(), Error> {
    let table = options.out.as_ref().is_some_and(|out| Format::of_path(out).is_some());
    let drawn = !(options.no_figures || table || (options.json && options.out.is_none()));
    let (from, end) = (plan.figure.from, plan.computation.t_end);
    if drawn && from > 0.0 && from >= end {
        let remedy = "the figures would begin at the end of the run or after it (t_end, counted from the end of the transient): give a \
                      smaller --from, or a longer --t-end";
        return Err(Error::Setting { key: "from", value: from.to_string(), remedy });
    }
    Ok(())
}

/// The study that the options describe: a file or a model, a preset, then the options.
fn study(options: &SimulateOptions) -> Result<Study, Error> {
    let mut study = subject::study(&options.subject)?;
    subject::apply(&options.method, &mut study)?;
    options.run.record(&mut study.run)?;
    figure::apply(&options.drawing, &mut study.figure)?;
    remark(&study, &[])?;
    Ok(study)
}

/// Refuses options of figures where none is drawn.
fn style(options: &SimulateOptions) -> Result<(), Error> {
    let folder = options.out.as_ref().map_or(!options.json, |out| Format::of_path(out).is_none());
    let remedy =
        "nothing is drawn with --no-figures, into a single table, or with --json and no --out: leave one out";
    options.drawing.style.refuse_unless(folder && !options.no_figures, remedy)
}

/// The destination of the result.
enum Target {
    Nowhere,
    Folder(Staged),
    Table(StagedFile, Format),
}

impl Target {
    /// Prepared before any computing, so that a wrong --out costs nothing.
    fn prepare(options: &SimulateOptions, plan: &RunPlan) -> Result<Self, Error> {
        let out = match &options.out {
            Some(path) => path.clone(),
            None if options.json => return Ok(Self::Nowhere),
            None => PathBuf::from(plan.default_folder()),
        };
        Ok(match Format::of_path(&out) {
            Some(format) => Self::Table(StagedFile::new(&out, Kind::Table, options.force)?, format),
            None => Self::Folder(Staged::new(&out, Kind::Dataset, options.force)?),
        })
    }

    /// The findings in its place, in sentences.
    fn notes(&self) -> &[String] {
        match self {
            Self::Nowhere => &[],
            Self::Folder(staged) => staged.notes(),
            Self::Table(staged, _) => staged.notes(),
        }
    }

    /// Where the rows of the trajectory go.
    fn rows(&self, options: &SimulateOptions, plan: &RunPlan) -> Result<Box<dyn Destination>, Error> {
        let (path, format) = match self {
            Self::Nowhere => return Ok(Box::new(Unwanted::default())),
            Self::Table(staged, format) => (staged.path(), *format),
            Self::Folder(staged) => {
                let format = format(options);
                (staged.path().join(format.file("trajectory")), format)
            }
        };
        Ok(Box::new(TableWriter::new(columns(plan)?, format, &path)))
    }

    /// A failure with the final name of the file.
    fn shown(&self, error: Error) -> Error {
        match (self, error) {
            (Self::Folder(staged), Error::Store(error)) => staged.shown(error).into(),
            (Self::Table(staged, _), Error::Store(error)) => staged.shown(error).into(),
            (_, other) => other,
        }
    }

    /// Writes everything beside the trajectory and renames it; returns what was written, and why there are no figures: numbers that
    /// do not fit on an axis must not prevent the tables from being written.
    fn write(
        self,
        options: &SimulateOptions,
        run: &Run,
        whole: Option<Table>,
    ) -> anyhow::Result<(Option<String>, Option<anyhow::Error>)> {
        match self {
            Self::Nowhere => Ok((None, None)),
            Self::Table(staged, _) => Ok((Some(staged.commit()?.display().to_string()), None)),
            Self::Folder(staged) => {
                write_rest(run, whole.as_ref(), format(options), &staged)?;
                let drawn =
                    if options.no_figures { Ok(Vec::new()) } else { pictures(options, run, whole, &staged) };
                if drawn.as_ref().is_ok_and(|pictures| pictures.is_empty() && !options.no_figures) {
                    warn(NOT_DRAWN);
                }
                let (pictures, undrawn) = match drawn {
                    Ok(pictures) => (pictures, None),
                    Err(error @ Error::Figure(_)) => (
                        Vec::new(),
                        Some(
                            anyhow::Error::new(error).context("the tables are written, the figures are not"),
                        ),
                    ),
                    Err(error) => return Err(error.into()),
                };
                let (films, unfilmed) = match film::convert(&pictures, &options.drawing.film) {
                    Ok(films) => (films, None),
                    Err(error) => (Vec::new(), Some(error.context("everything except the film is written"))),
                };
                let undrawn = undrawn.or(unfilmed);
                for picture in pictures.into_iter().chain(films) {
                    staged.write(&picture.name, &picture.bytes)?;
                }
                let mut names: Vec<String> = std::fs::read_dir(staged.path())?
                    .map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()))
                    .collect::<std::io::Result<_>>()?;
                names.sort_unstable();
                let (path, kept) = staged.commit()?;
                kept.iter().for_each(|note| warn(note));
                let written = format!("{}: {}", path.display(), names.join(" "));
                Ok((Some(written), undrawn))
            }
        }
    }
}

/// Rows that end with a manifest.
trait Destination: Rows {
    /// Ends the file. Gives the whole table where it is short.
    fn finish(self: Box<Self>, manifest: &Manifest) -> Result<Option<Table>, Error>;
}

impl Destination for TableWriter {
    fn finish(self: Box<Self>, manifest: &Manifest) -> Result<Option<Table>, Error> {
        Ok((*self).finish(manifest)?)
    }
}

impl Destination for Unwanted {
    fn finish(self: Box<Self>, _manifest: &Manifest) -> Result<Option<Table>, Error> {
        Ok(None)
    }
}

fn format(options: &SimulateOptions) -> Format {
    match options.format {
        TableFormat::Parquet => Format::Parquet,
        TableFormat::Csv => Format::Csv,
    }
}

/// The figures of a run whose trajectory is in the staged folder, and `whole` where it is short.
fn pictures(
    options: &SimulateOptions,
    run: &Run,
    whole: Option<Table>,
    staged: &Staged,
) -> Result<Vec<Picture>, Error> {
    let mut manifest = run.manifest.clone();
    let trajectory = match whole {
        Some(whole) => whole,
        None => {
            let path = staged.path().join(format(options).file("trajectory"));
            let (shown, stride) = read_shown(&mut manifest, &path)?;
            figure::note_stride(stride);
            shown
        }
    };
    figure::pictures(&Dataset { manifest, trajectory, crossings: run.crossings.clone() }, &options.drawing)
}

/// The end of a run.
struct Simulated<'a> {
    run: &'a Run,
    verdict: Option<&'a Verdict>,
    written: Option<&'a str>,
    /// Those of the figures; empty where they are those of the model.
    units: &'a str,
}

impl Serialize for Simulated<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let manifest = &self.run.manifest;
        let mut object = json!({
            "model": manifest.plan.computation.model,
            "parameters": manifest.plan.computation.parameters,
            "outcome": manifest.outcome,
            "control": manifest.plan.computation.control,
            "t": manifest.outcome.t_last(),
            "state": manifest.state,
            "position": manifest.position,
            "steps": manifest.steps,
            "manifest": manifest,
        });
        if let Some(regime) = &manifest.regime {
            object["regime"] = json!(regime);
        }
        if let Some(object) = object.as_object_mut().filter(|_| !manifest.measures.is_empty()) {
            object.insert("velocity".to_owned(), json!(manifest.velocity));
            for (name, value) in &manifest.measures.0 {
                object.insert(name.clone(), json!(value));
            }
        }
        object.serialize(serializer)
    }
}

impl Display for Simulated<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let manifest = &self.run.manifest;
        let plan = &manifest.plan;
        write!(f, "{} ({}, {})", plain(&manifest.title()), plan.computation.model, plan.name)?;
        write!(f, "\noutcome   {}", manifest.outcome)?;
        let (steps, rejected) = (manifest.steps, manifest.rejected_steps);
        let c = &plan.computation;
        write!(f, "\nsteps     {steps} accepted, {rejected} rejected ({}, {})", c.stepper, c.control)?;
        if let (Some(noise), Ok(body)) = (&c.noise, plan.body()) {
            write!(f, "\nnoise     {}, seed {}", noise.words(body.as_ref()), c.seed)?;
        }
        if let Some(verdict) = self.verdict {
            write!(f, "\nmotion    at the end {}: {}", verdict.regime.words(), verdict.why)?;
        }
        let state: Vec<String> = manifest
            .state
            .0
            .iter()
            .map(|(name, value)| format!("{name} = {}", six_decimals(*value)))
            .collect();
        write!(f, "\nstate     {}", state.join("  "))?;
        let [x, y] = manifest.position.map(six_decimals);
        write!(f, "\nposition  x = {x}  y = {y}")?;
        if let Some(crossings) = &self.run.crossings {
            write!(f, "\ncrossings {}", crossings.rows())?;
        }
        if !self.units.is_empty() {
            write!(f, "\nunits     of the model, here and in tables; figures have those of {}", self.units)?;
        }
        self.written.map_or(Ok(()), |written| write!(f, "\nwritten   {written}"))
    }
}
