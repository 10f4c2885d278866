//! A state of a recorded motion.

use super::{Asked, StartPoint};
use crate::branches::folder::read;
use motiform_lab::dataset::table_path;
use motiform_store::table::Table;
use motiform_store::{columns, read_groups};
use motiform_study::plan::Named;
use motiform_study::{Error, Given, Manifest};
use std::path::Path;

/// Which row is asked for.
enum Row {
    Last,
    Number(usize),
    Time(f64),
}

/// A state of the dataset in a folder.
pub(super) fn folder(asked: &Asked<'_>, folder: &Path) -> Result<StartPoint, Error> {
    let path = table_path(folder, "trajectory").ok_or_else(|| {
        asked.wrong("it has no trajectory.parquet or trajectory.csv: give a run that has one".to_owned())
    })?;
    state(asked, &path, read(folder, "manifest.json")?)
}

/// A state of a table; its manifest is in it, or in its folder, or there is none.
pub(super) fn table(asked: &Asked<'_>) -> Result<StartPoint, Error> {
    let path = &asked.path;
    let parquet = path.extension().is_some_and(|extension| extension == "parquet");
    let inside = if parquet { written_in(asked)? } else { None };
    let beside = || {
        path.parent()
            .filter(|_| path.file_stem().is_some_and(|stem| stem == "trajectory"))
            .and_then(|folder| read(folder, "manifest.json").ok())
    };
    match inside.or_else(beside) {
        Some(manifest) => state(asked, path, manifest),
        None => {
            let (state, given) = (row(asked, path)?, Given::State);
            let text = asked.text.to_owned();
            Ok(StartPoint { text, model: None, name: None, parameters: Named::default(), state, given })
        }
    }
}

/// The manifest in a Parquet file, if it has one.
fn written_in(asked: &Asked<'_>) -> Result<Option<Manifest>, Error> {
    let entries = columns::metadata(&asked.path).map_err(|error| Error::unreadable(&asked.path, error))?;
    let text = entries.into_iter().find(|entry| entry.0 == "motiform").map(|entry| entry.1);
    text.map(|text| serde_json::from_slice(text.as_bytes())).transpose().map_err(|_| {
        asked.wrong(
            "this is a table of another result than a dataset: of branches, give their folder".to_owned(),
        )
    })
}

fn state(asked: &Asked<'_>, table: &Path, manifest: Manifest) -> Result<StartPoint, Error> {
    let state = row(asked, table)?;
    let (name, computation) = (manifest.plan.name, manifest.plan.computation);
    Ok(StartPoint {
        text: asked.text.to_owned(),
        model: Some(computation.model),
        name: Some(name),
        parameters: computation.parameters,
        state,
        given: Given::State,
    })
}

/// The numbers of the row that is asked for.
fn row(asked: &Asked<'_>, path: &Path) -> Result<Named, Error> {
    let wanted = wanted(asked)?;
    let (mut best, mut rows): (Option<(f64, Named)>, usize) = (None, 0);
    let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
    read_groups(path, &mut |group: Table| -> Result<(), Error> {
        let times = group.get("t").unwrap_or_default();
        if let (Some(first), Some(last)) = (times.first(), times.last()) {
            (from, to) = (from.min(*first), to.max(*last));
        }
        let found = wanted.place(&group, rows);
        // the last row of a later group is later, and the first of the nearest ones is as good
        if let Some((distance, place)) = found
            && best.as_ref().is_none_or(|(least, _)| distance < *least || distance == 0.0)
        {
            let values = group.columns.iter().map(|column| (column.name.clone(), column.values[place]));
            best = Some((distance, Named(values.collect())));
        }
        rows += group.rows();
        Ok(())
    })?;
    let outside = matches!(wanted, Row::Time(time) if !(from..=to).contains(&time));
    best.filter(|_| !outside).map(|found| found.1).ok_or_else(|| {
        let last = rows.saturating_sub(1);
        asked.wrong(format!(
            "there is no such row: give t=TIME, from {from} to {to}, or the number of a row, from 0 to {last}"
        ))
    })
}

impl Row {
    /// The row of a group that comes closest, with its distance; the group has `before` rows before it.
    fn place(&self, group: &Table, before: usize) -> Option<(f64, usize)> {
        match *self {
            Self::Last => Some((0.0, group.rows().checked_sub(1)?)),
            Self::Number(number) => {
                let place = number.checked_sub(before)?;
                (place < group.rows()).then_some((0.0, place))
            }
            Self::Time(time) => {
                let times = group.get("t").unwrap_or_default().iter().enumerate();
                let distances = times.map(|(place, t)| ((t - time).abs(), place));
                distances.min_by(|a, b| a.0.total_cmp(&b.0))
            }
        }
    }
}

fn wanted(asked: &Asked<'_>) -> Result<Row, Error> {
    let Some(point) = asked.point else { return Ok(Row::Last) };
    let time = point.strip_prefix("t=").and_then(|time| time.parse().ok()).map(Row::Time);
    time.or_else(|| point.parse().ok().map(Row::Number)).ok_or_else(|| {
        asked.wrong(format!("{point:?} is no row: give t=TIME or the number of a row, from 0; without it, the last state is taken"))
    })
}
