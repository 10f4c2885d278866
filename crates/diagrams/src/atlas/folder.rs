//! The folder of an atlas.

use crate::atlas::draw::draw_atlas;
use crate::atlas::grid::Grid;
use crate::atlas::line::Line;
use crate::atlas::page::html;
use crate::atlas::plan::AtlasPlan;
use crate::atlas::summary::atlas_summary;
use crate::atlas::tables::{cell_columns, curve_columns};
use motiform_lab::draw::FigureFormat;
use motiform_store::mend;
use motiform_store::{Folder, Kind, Opening, columns, end_of_work};
use motiform_study::dataset::VERSION;
use motiform_study::{Error, input};
use serde::{Deserialize, Serialize};
use std::path::Path;

const MANIFEST: &str = "manifest.json";
const STATE: &str = "atlas.json";

/// Provenance of an atlas. Knows no host, no user, no time of day.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Manifest {
    motiform: String,
    plan_hash: String,
    complete: bool,
    atlas: AtlasPlan,
}

/// A finished atlas.
#[derive(Clone, Debug, PartialEq)]
pub struct AtlasFolder {
    /// What was asked for.
    pub plan: AtlasPlan,
    /// The motions of the cells.
    pub grid: Grid,
    /// The lines that were followed.
    pub lines: Vec<Line>,
}

#[derive(Serialize, Deserialize)]
struct State {
    grid: Grid,
    lines: Vec<Line>,
}

/// The folder of an atlas whose place is not given.
#[must_use]
pub fn default_atlas_folder(plan: &AtlasPlan) -> String {
    let model = &plan.computation.scan.model;
    if plan.name == model.as_str() {
        format!("{model}-atlas")
    } else {
        format!("{model}-{}-atlas", plan.name)
    }
}

impl AtlasFolder {
    /// Reads a finished atlas.
    ///
    /// # Errors
    /// [`Error::Store`] where a file is missing or damaged, or the atlas is not finished.
    pub fn read(path: &Path) -> Result<Self, Error> {
        mend(path)?;
        let manifest: Manifest = read(&path.join(MANIFEST))?;
        if manifest.atlas.hash() != manifest.plan_hash {
            return Err(Error::unreadable(
                &path.join(MANIFEST),
                "it was changed: its plan does not give its hash",
            ));
        }
        if !manifest.complete {
            let why = "this atlas is not finished: the same `motiform atlas` with --resume goes on";
            return Err(Error::unreadable(path, why));
        }
        let State { grid, lines } = read(&path.join(STATE))?;
        let count = manifest.atlas.scan().cells();
        if grid.places.len() != count || grid.size[0] * grid.size[1] != count {
            return Err(Error::unreadable(&path.join(STATE), "its cells are not those of its plan"));
        }
        Ok(Self { plan: manifest.atlas, grid, lines })
    }

    /// Opens the folder of the atlas of `plan` to write it, or to go on with it.
    ///
    /// # Errors
    /// [`Error::OtherBranches`] for another plan; [`Error::Store`] where it exists, is not ours, is used by others or cannot be written.
    pub fn open(path: &Path, plan: &AtlasPlan, opening: Opening) -> Result<Folder, Error> {
        if opening != Opening::Resume || !path.exists() {
            let manifest = manifest(plan, false, path)?;
            return Ok(Folder::open(path, Kind::Atlas, opening, &[(MANIFEST, &manifest)])?);
        }
        mend(path)?;
        let there: Manifest = read(&path.join(MANIFEST))?;
        if there.atlas.hash() != plan.hash() {
            return Err(Error::OtherBranches { path: path.to_owned() });
        }
        let folder = Folder::resume(path, Kind::Atlas)?;
        folder.check()?;
        Ok(folder)
    }

    /// Writes everything: tables, summary, page, figures and, last, the manifest, which says that it is finished.
    ///
    /// # Errors
    /// Files that cannot be written; numbers that no axis can hold.
    pub fn write(&self, folder: &Folder, figures: Option<&FigureFormat>) -> Result<(), Error> {
        let failed = |error: String| Error::write_failed(folder.shown(), error);
        let Self { plan, grid, lines } = self;
        let manifest = manifest(plan, true, folder.shown())?;
        let provenance = String::from_utf8_lossy(&manifest).into_owned();
        for (name, table) in
            [("cells.parquet", cell_columns(plan, grid)), ("curves.parquet", curve_columns(plan, lines))]
        {
            let bytes = columns::encode(&table, vec![("motiform", provenance.clone())]);
            folder.put(name, &bytes.map_err(|error| failed(error.to_string()))?)?;
        }
        folder.put("summary.json", &pretty(&atlas_summary(self), folder.shown())?)?;
        if let Some(format) = figures {
            for picture in draw_atlas(self, format)? {
                folder.put(&picture.name, &picture.bytes)?;
            }
            folder.put("report.html", html(self)?.as_bytes())?;
        }
        let state = State { grid: grid.clone(), lines: lines.clone() };
        folder.put(STATE, &serde_json::to_vec(&state).map_err(|error| failed(error.to_string()))?)?;
        end_of_work(folder);
        folder.put(MANIFEST, &manifest)?;
        Ok(folder.complete()?)
    }
}

fn manifest(plan: &AtlasPlan, complete: bool, target: &Path) -> Result<Vec<u8>, Error> {
    let (motiform, plan_hash) = (VERSION.to_owned(), plan.hash());
    pretty(&Manifest { motiform, plan_hash, complete, atlas: plan.clone() }, target)
}

fn pretty(value: &impl Serialize, target: &Path) -> Result<Vec<u8>, Error> {
    let mut json = serde_json::to_vec_pretty(value).map_err(|error| Error::write_failed(target, error))?;
    json.push(b'\n');
    Ok(json)
}

fn read<T: for<'d> Deserialize<'d>>(path: &Path) -> Result<T, Error> {
    let text = input::manifest(path).map_err(|error| {
        Error::unreadable(path, format!("{error}; give a folder written by `motiform atlas`"))
    })?;
    serde_json::from_str(&text).map_err(|error| Error::unreadable(path, error))
}

/// What was kept as JSON; `None` where it is something else.
pub(crate) fn parsed<T: for<'d> Deserialize<'d>>(bytes: &[u8]) -> Option<T> {
    serde_json::from_str(std::str::from_utf8(bytes).ok()?).ok()
}
