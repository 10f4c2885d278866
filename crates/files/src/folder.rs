//! The folder of a dataset: `manifest.json`, `trajectory.*`, `crossings.*`, and figures.

use super::Fields;
use super::{csv_table, parquet_table};
use motiform_dynamics::Model;
use motiform_store::{Staged, mend};
use motiform_study::Error;
use motiform_study::dataset::{Dataset, Manifest};
use motiform_study::input;
use motiform_study::table::Table;
use std::path::{Path, PathBuf};

/// The name of the manifest in every dataset folder.
const MANIFEST: &str = "manifest.json";

/// The file format of tables.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Parquet: compact, typed, with the manifest inside.
    #[default]
    Parquet,
    /// Comma-separated text.
    Csv,
}

impl Format {
    /// The format given by the extension of a file name.
    #[must_use]
    pub fn of_path(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()? {
            "parquet" => Some(Self::Parquet),
            "csv" => Some(Self::Csv),
            _ => None,
        }
    }

    fn extension(self) -> &'static str {
        match self {
            Self::Parquet => "parquet",
            Self::Csv => "csv",
        }
    }
}

/// Writes one table to `path` in the given format, with the manifest inside if the format supports it.
///
/// # Errors
/// Files that cannot be written.
pub fn write_table(table: &Table, manifest: &Manifest, format: Format, path: &Path) -> Result<(), Error> {
    match format {
        Format::Csv => csv_table::write(table, path),
        Format::Parquet => {
            let metadata =
                serde_json::to_string(manifest).map_err(|error| Error::write_failed(path, error))?;
            parquet_table::write(table, &metadata, path)
        }
    }
}

/// Writes the tables, the fields (if any) and the manifest of a dataset into a staged folder.
///
/// # Errors
/// Files that cannot be written.
pub fn write_dataset(
    dataset: &Dataset,
    fields: Option<&Fields>,
    format: Format,
    staged: &Staged,
) -> Result<(), Error> {
    let manifest = &dataset.manifest;
    let tables = [("trajectory", Some(&dataset.trajectory)), ("crossings", dataset.crossings.as_ref())];
    for (name, table) in tables.into_iter().filter_map(|(name, table)| Some((name, table?))) {
        let file = format!("{name}.{}", format.extension());
        write_table(table, manifest, format, &staged.path().join(file))
            .map_err(|error| shown(staged, error))?;
    }
    if let Some(fields) = fields {
        super::write_fields(&staged.path().join("fields.h5"), fields)
            .map_err(|error| shown(staged, error))?;
    }
    let mut json =
        serde_json::to_vec_pretty(manifest).map_err(|error| Error::write_failed(staged.target(), error))?;
    json.push(b'\n');
    Ok(staged.write(MANIFEST, &json)?)
}

/// The same failure with the final name of the file.
fn shown(staged: &Staged, error: Error) -> Error {
    match error {
        Error::Store(error) => staged.shown(error).into(),
        other => other,
    }
}

/// Reads a dataset folder back.
///
/// # Errors
/// [`Error::Unreadable`] for a folder without a manifest, or files that are missing or damaged.
pub fn read_dataset(folder: &Path) -> Result<Dataset, Error> {
    mend(folder)?;
    let path = folder.join(MANIFEST);
    let text = input::manifest(&path).map_err(|error| {
        Error::unreadable(&path, format!("{error}; give a folder written by `motiform simulate`"))
    })?;
    let manifest: Manifest = serde_json::from_str(&text).map_err(|error| Error::unreadable(&path, error))?;
    let model = model_of(&manifest).map_err(|error| Error::unreadable(&path, error))?;
    let (path, trajectory) = read_table(folder, "trajectory")?
        .ok_or_else(|| Error::unreadable(folder, "it has no trajectory.parquet or trajectory.csv"))?;
    let observables = model.observables().iter().map(|observable| observable.name);
    let coordinates = model.coordinates().iter().map(|coordinate| coordinate.name);
    let derived = ["t", "x", "y", "speed", "turning_rate"].into_iter();
    require(&trajectory, &path, derived.chain(coordinates).chain(observables))?;
    let Some((path, crossings)) = read_table(folder, "crossings")? else {
        return Ok(Dataset { manifest, trajectory, crossings: None });
    };
    require(&crossings, &path, ["t", "x", "y", "rising"])?;
    Ok(Dataset { manifest, trajectory, crossings: Some(crossings) })
}

/// Reads one table, Parquet or CSV by its extension, and the manifest if the file contains one.
///
/// # Errors
/// [`Error::Unreadable`].
pub fn read_table_file(path: &Path) -> Result<(Table, Option<Manifest>), Error> {
    match Format::of_path(path) {
        Some(Format::Csv) => Ok((csv_table::read(path)?, None)),
        Some(Format::Parquet) => {
            let text = parquet_table::read_metadata(path)?;
            let manifest = text.map(|text| serde_json::from_str(&text)).transpose();
            Ok((parquet_table::read(path)?, manifest.map_err(|error| Error::unreadable(path, error))?))
        }
        None => Err(Error::unreadable(path, "it is not a table: give a .parquet or .csv file")),
    }
}

fn model_of(manifest: &Manifest) -> Result<Box<dyn Model>, Error> {
    let plan = &manifest.plan;
    Ok(plan.info()?.build(&plan.computation.parameters.values())?)
}

/// Rejects a table without one of the columns `names`.
fn require(table: &Table, path: &Path, names: impl IntoIterator<Item = &'static str>) -> Result<(), Error> {
    match names.into_iter().find(|name| table.get(name).is_none()) {
        Some(missing) => Err(Error::unreadable(path, format!("it has no column {missing}"))),
        None => Ok(()),
    }
}

fn read_table(folder: &Path, name: &str) -> Result<Option<(PathBuf, Table)>, Error> {
    for format in [Format::Parquet, Format::Csv] {
        let path = folder.join(format!("{name}.{}", format.extension()));
        if path.is_file() {
            let table = match format {
                Format::Parquet => parquet_table::read(&path),
                Format::Csv => csv_table::read(&path),
            }?;
            return Ok(Some((path, table)));
        }
    }
    Ok(None)
}
