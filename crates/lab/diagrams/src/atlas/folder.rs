//! The folder of an atlas.

use crate::atlas::draw::draw_atlas;
use crate::atlas::grid::Grid;
use crate::atlas::line::Line;
use crate::atlas::page::html;
use crate::atlas::summary::atlas_summary;
use crate::atlas::tables::{cell_columns, curve_columns};
use crate::branches::folder::{finish, keep, put_table, read};
use motiform_lab::draw::FigureFormat;
use motiform_store::{Folder, Kind, Opening};
use motiform_study::atlas::AtlasComputation;
use motiform_study::plan::pretty;
use motiform_study::{AtlasPlan, Error, Provenance};
use serde::{Deserialize, Serialize};
use std::path::Path;

const STATE: &str = "atlas.json";

/// A finished atlas, read from its folder: the motions of the plane, and the lines that bound them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AtlasFolder {
    /// The plan.
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

impl AtlasFolder {
    /// Reads a finished atlas.
    ///
    /// # Errors
    /// [`Error::NoResult`]; [`Error::Unfinished`]; [`Error::Store`] where a file is missing or damaged.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let manifest: Provenance<AtlasComputation> = Provenance::read(path)?;
        if manifest.complete != Some(true) {
            return Err(Error::Unfinished { path: path.to_owned(), kind: Kind::Atlas });
        }
        let State { grid, lines } = read(path, STATE)?;
        let count = manifest.plan.scan().cells();
        if grid.places.len() != count || grid.size[0] * grid.size[1] != count {
            return Err(Error::unreadable(&path.join(STATE), "its cells are not those of its plan"));
        }
        Ok(Self { plan: manifest.plan, grid, lines })
    }

    /// Opens the folder of the atlas of `plan` to write it, or to go on with it.
    ///
    /// # Errors
    /// [`Error::OtherPlan`] for another plan; [`Error::Store`] where it exists, is not ours, is used by
    /// others or cannot be written.
    pub fn open(path: &Path, plan: &AtlasPlan, opening: Opening) -> Result<Folder, Error> {
        let (folder, earlier) = plan.open(path, opening, Some(false))?;
        if earlier {
            folder.check()?;
        }
        Ok(folder)
    }

    /// Writes everything: tables, summary, page, figures and, last, the manifest, which says that it is finished.
    ///
    /// # Errors
    /// Files that cannot be written; numbers that no axis can hold.
    pub fn write(&self, folder: &Folder, figures: Option<&FigureFormat>) -> Result<(), Error> {
        let Self { plan, grid, lines } = self;
        let provenance = Provenance::new(plan, Some(true));
        put_table(folder, "cells.parquet", &cell_columns(plan, grid), &provenance)?;
        put_table(folder, "curves.parquet", &curve_columns(plan, lines), &provenance)?;
        folder.put("summary.json", &pretty(&atlas_summary(self), folder.shown())?)?;
        let pictures = figures.map(|format| draw_atlas(self, format)).transpose()?.unwrap_or_default();
        if let Some(format) = figures {
            folder.put("report.html", html(self, &format.style)?.as_bytes())?;
        }
        keep(STATE, &State { grid: grid.clone(), lines: lines.clone() }, folder)?;
        finish(folder, &pictures, &provenance)
    }
}

/// A kept item from its JSON; `None` where it is something else.
pub(crate) fn parsed<T: for<'d> Deserialize<'d>>(bytes: &[u8]) -> Option<T> {
    serde_json::from_slice(bytes).ok()
}
