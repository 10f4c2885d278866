//! `motiform figure`, and the drawing that `simulate` shares with it.

use super::continuation::no_units;
use super::film;
use crate::args::{DrawingOptions, FigureOptions, Observable};
use crate::output::{End, print, warn};
use motiform_diagrams::BranchFolder;
use motiform_diagrams::atlas::{AtlasFolder, atlas_map};
use motiform_diagrams::curves::CurveFolder;
use motiform_diagrams::draw::{branch_figures, curve_figures};
use motiform_figures::{Figure, Panels};
use motiform_lab::dataset::read_dataset_by;
use motiform_lab::draw::{Figures, Picture, dataset_figures, draw, files, scan_figures};
use motiform_lab::long::read_shown;
use motiform_lab::scan::ScanFolder;
use motiform_store::{Folder, Kind, Opening, kind_of};
use motiform_study::study::FigureSettings;
use motiform_study::{Dataset, Error, plan};
use std::path::Path;

pub(crate) fn run(options: &FigureOptions) -> anyhow::Result<End> {
    film::check(&options.drawing.film)?;
    if let (Some(grid), Some(out)) = (options.panels, &options.out) {
        return apart(&panels(grid, options)?, out, options.force).map(|()| End::Done);
    }
    let mut end = End::Done;
    if let (Some(out), true) = (&options.out, options.datasets.len() > 1) {
        let remedy = "its figures would have the same names: draw one folder at a time, or all as --panels of one figure";
        return Err(Error::Setting { key: "--out", value: out.display().to_string(), remedy }.into());
    }
    for path in &options.datasets {
        one(path, options)?;
        check(kind_of(path), options)?;
        let pictures = Content::read(path, options)?.pictures(options)?;
        if pictures.is_empty() && shows_a_part(options)? {
            return Err(nothing(path));
        }
        if let Some(out) = &options.out {
            apart(&pictures, out, options.force)?;
            continue;
        }
        let folder = Folder::redraw(path)?;
        let written = write(&folder, &pictures, options.force)?;
        folder.settle()?;
        let kept = folder.notes();
        let remedy = if options.force { "" } else { "; --force draws those of motiform again" };
        kept.iter().for_each(|note| warn(&format!("{note}{remedy}")));
        if !(kept.is_empty() || options.force) {
            end = End::NotAsAsked;
        }
        say(path, &written)?;
    }
    Ok(end)
}

/// Writes pictures into a folder of their own.
fn apart(pictures: &[Picture], out: &Path, force: bool) -> anyhow::Result<()> {
    let folder = Folder::open(out, Kind::Figures, Opening::of(false, force), &[])?;
    let written = write(&folder, pictures, false)?;
    folder.complete()?;
    folder.notes().iter().for_each(|note| warn(note));
    say(out, &written)
}

/// Writes pictures; the names of those that are written.
fn write<'p>(folder: &Folder, pictures: &'p [Picture], force: bool) -> Result<Vec<&'p str>, Error> {
    let mut written = Vec::new();
    for picture in pictures {
        if folder.draw(&picture.name, &picture.bytes, force)? {
            written.push(picture.name.as_str());
        }
    }
    Ok(written)
}

/// Returns `true` if a part of the trajectory is asked for.
fn shows_a_part(options: &FigureOptions) -> Result<bool, Error> {
    let mut asked = FigureSettings::default();
    options.drawing.figure.apply(&mut asked)?;
    Ok(asked.from > 0.0 || asked.to > 0.0)
}

/// Says why a folder has no figure.
fn nothing(path: &Path) -> anyhow::Error {
    anyhow::anyhow!(
        "{}: no figure, as fewer than two rows of the trajectory lie within the times that are shown: look at the times of its table, and \
         change --from or --to, or leave them out",
        path.display()
    )
}

fn say(folder: &Path, written: &[&str]) -> anyhow::Result<()> {
    let names = if written.is_empty() { "no figure is written".to_owned() } else { written.join(" ") };
    print(&format!("{}: {names}", folder.display()))
}

/// Refuses an option that a kind of figure does not have.
fn refuse(given: Option<&'static str>, remedy: &'static str) -> Result<(), Error> {
    given.map_or(Ok(()), |key| Err(Error::Setting { key, value: "given".to_owned(), remedy }))
}

/// Refuses the options that the figures of a kind of folder do not have.
fn check(kind: Option<Kind>, options: &FigureOptions) -> Result<(), Error> {
    if kind != Some(Kind::Branches) {
        let given = options.observable.map(|_| "--observable");
        refuse(given, "only diagrams of branches have it: leave it out")?;
    }
    if matches!(kind, Some(Kind::Curves | Kind::Atlas)) && options.drawing.units.given.is_some() {
        return Err(no_units("a map of curves"));
    }
    if has_no_body(kind) {
        refuse(options.drawing.of_bodies(), "only figures of a body have it: leave it out")?;
    }
    Ok(())
}

fn has_no_body(kind: Option<Kind>) -> bool {
    matches!(kind, Some(Kind::Scan | Kind::Branches | Kind::Curves | Kind::Atlas))
}

/// Figures of several folders as panels of one.
fn panels([columns, rows]: [usize; 2], options: &FigureOptions) -> anyhow::Result<Vec<Picture>> {
    if options.datasets.len() > columns * rows {
        let value = format!("{columns}x{rows}");
        let remedy = "there are more folders than panels: write COLUMNSxROWS with room for all";
        return Err(Error::Setting { key: "--panels", value, remedy }.into());
    }
    refuse(
        (!options.drawing.film.is_empty()).then_some("--film"),
        "a figure of panels does not move: leave it out",
    )?;
    let sources: Vec<(&Path, Option<&str>)> = options.datasets.iter().map(|path| source(path)).collect();
    // an option that one of the panels has is no mistake
    let kinds = || sources.iter().map(|(path, _)| kind_of(path));
    let one = kinds().find(|kind| check(*kind, options).is_ok()).or_else(|| kinds().next());
    check(one.flatten(), options)?;
    let figures = sources.iter().map(|(path, name)| chosen(path, *name, options));
    let panels = Panels::new(columns, figures.collect::<anyhow::Result<_>>()?);
    files(vec![("panels", Box::new(panels))], true, &options.drawing.style.format()).map_err(|error| {
        match error {
            Error::Figure(why) => anyhow::anyhow!(why), // nothing is drawn: the layout that was asked for is no input
            other => other.into(),
        }
    })
}

/// A folder, and after a colon the name of one of its figures.
fn source(path: &Path) -> (&Path, Option<&str>) {
    let split = path.to_str().filter(|_| !path.exists()).and_then(|text| text.rsplit_once(':'));
    split.map_or((path, None), |(folder, name)| (Path::new(folder), Some(name)))
}

/// Refuses what is no folder; a figure of one is a panel.
fn one(path: &Path, options: &FigureOptions) -> anyhow::Result<()> {
    if path.exists() {
        return Ok(());
    }
    let value = path.display().to_string();
    let (folder, name) = source(path);
    if name.is_some() && folder.exists() {
        chosen(folder, name, options)?;
        let remedy = "one figure of a folder is drawn as a panel: add --panels 1x1 --out DIR, or give the folder alone";
        return Err(Error::Setting { key: "DIR", value, remedy }.into());
    }
    let remedy =
        "there is no such folder: give one written by `motiform simulate`, `scan`, `continue` or `atlas`";
    Err(Error::Setting { key: "DIR", value, remedy }.into())
}

/// A figure of a folder by its name, or the first one.
fn chosen(path: &Path, name: Option<&str>, options: &FigureOptions) -> anyhow::Result<Box<dyn Figure>> {
    let mut all = Content::read(path, options)?.figures()?;
    let names: Vec<&str> = all.iter().map(|one| one.0.trim_start_matches('_')).collect();
    let place = match name {
        Some(name) => names.iter().position(|known| *known == name.trim_start_matches('_')),
        None => (!names.is_empty()).then_some(0),
    };
    match place {
        Some(place) => Ok(all.swap_remove(place).1),
        None if names.is_empty() && shows_a_part(options)? => Err(nothing(path)),
        None if names.is_empty() => anyhow::bail!("{}: it has no figure: leave it out", path.display()),
        None => anyhow::bail!(
            "{}:{}: there is no such figure; it has {}",
            path.display(),
            name.unwrap_or_default(),
            names.join(", ")
        ),
    }
}

/// The figures of a folder.
enum Content {
    /// Figures, and whether their numbers are files, too.
    Figures(Figures, bool),
    /// A body, which moves.
    Body(Box<Dataset>),
}

impl Content {
    /// The content of a folder, whatever is in it.
    fn read(path: &Path, options: &FigureOptions) -> anyhow::Result<Self> {
        Ok(match kind_of(path) {
            Some(Kind::Scan) => {
                let folder = ScanFolder::read(path)?;
                let units = options.drawing.units.or(&folder.plan().figure.units)?;
                Self::Figures(scan_figures(&folder, &units)?, false)
            }
            Some(Kind::Branches) => {
                let BranchFolder { plan, found } = BranchFolder::read(path)?;
                let ordinate = options.observable.unwrap_or(Observable::Speed).ordinate();
                let units = options.drawing.units.or(&plan.figure.units)?;
                Self::Figures(branch_figures(&plan, &found, ordinate, &units)?, true)
            }
            Some(Kind::Curves) => {
                let CurveFolder { plan, found } = CurveFolder::read(path)?;
                Self::Figures(curve_figures(&plan, &found, None)?, true)
            }
            Some(Kind::Atlas) => {
                Self::Figures(vec![("atlas", Box::new(atlas_map(&AtlasFolder::read(path)?)?))], true)
            }
            None | Some(Kind::Dataset) => Self::Body(Box::new(read_dataset_by(path, &|manifest, path| {
                apply(&options.drawing, &mut manifest.plan.figure)?;
                plan::check_figure(&manifest.plan.figure)?;
                let (trajectory, stride) = read_shown(manifest, path)?;
                note_stride(stride);
                Ok(trajectory)
            })?)),
            Some(_) => {
                let remedy = "figures of such a folder are not drawn again: give the command that wrote it the options \
                 of figures, with --force";
                let value = path.display().to_string();
                return Err(Error::Setting { key: "DIR", value, remedy }.into());
            }
        })
    }

    fn pictures(self, options: &FigureOptions) -> anyhow::Result<Vec<Picture>> {
        match self {
            Self::Figures(all, numbers) => Ok(files(all, numbers, &options.drawing.style.format())?),
            Self::Body(dataset) => {
                let mut stills = pictures(&dataset, &options.drawing)?;
                stills.extend(film::convert(&stills, &options.drawing.film)?);
                Ok(stills)
            }
        }
    }

    fn figures(self) -> Result<Figures, Error> {
        match self {
            Self::Figures(all, _) => Ok(all),
            Self::Body(dataset) => dataset_figures(&dataset),
        }
    }
}

/// Overrides the study's settings with those given on the command line.
pub(crate) fn apply(options: &DrawingOptions, settings: &mut FigureSettings) -> Result<(), Error> {
    options.figure.apply(settings)?;
    settings.animation &= !options.no_animation;
    if let Some(units) = &options.units.given {
        settings.units.clone_from(units);
    }
    Ok(())
}

/// Says that a long run is not drawn from all of its rows.
pub(crate) fn note_stride(stride: u32) {
    if stride > 1 {
        warn(&format!("the run is long: its figures show one row of {stride}"));
    }
}

/// Every picture of a dataset.
pub(crate) fn pictures(dataset: &Dataset, options: &DrawingOptions) -> Result<Vec<Picture>, Error> {
    draw(dataset, &options.style.format())
}
