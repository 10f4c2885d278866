//! The folder of a dataset: `manifest.json`, `trajectory.*`, `crossings.*`, and figures.

use crate::readings::{CROSSING, columns};
use motiform_store::{Fields, Format, Staged, Table, read_table, table_metadata, write_fields, write_table};
use motiform_study::Error;
use motiform_study::dataset::{Dataset, Manifest};
use motiform_study::plan::{Computation, Question, manifest, pretty};
use std::path::{Path, PathBuf};

/// Writes what belongs to a trajectory, which is in the staged folder: crossings and fields (if any) and the manifest.
///
/// # Errors
/// [`Error::Store`].
pub fn write_rest(
    manifest: &Manifest,
    crossings: Option<&Table>,
    fields: Option<&Fields>,
    format: Format,
    staged: &Staged,
) -> Result<(), Error> {
    if let Some(crossings) = crossings {
        let path = staged.path().join(format.file("crossings"));
        write_table(crossings, manifest, format, &path).map_err(|error| staged.shown(error))?;
    }
    if let Some(fields) = fields {
        write_fields(&staged.path().join("fields.h5"), fields).map_err(|error| staged.shown(error))?;
    }
    Ok(staged.write(Computation::MANIFEST, &pretty(manifest, staged.target())?)?)
}

/// Reads a dataset folder back.
///
/// # Errors
/// [`Error::NoResult`] for a folder without a manifest, [`Error::Store`] for files that are missing or damaged.
pub fn read_dataset(folder: &Path) -> Result<Dataset, Error> {
    read_dataset_by(folder, &|_, path| Ok(read_table(path)?))
}

/// Reads a dataset folder back, whose trajectory `read` reads.
///
/// # Errors
/// As [`read_dataset`].
pub fn read_dataset_by(
    folder: &Path,
    read: &dyn Fn(&mut Manifest, &Path) -> Result<Table, Error>,
) -> Result<Dataset, Error> {
    let mut manifest: Manifest = manifest::<Computation, _>(folder)?;
    let model = manifest.plan.body().map_err(|error| Error::unreadable(folder, error))?;
    let path = trajectory_path(folder)?;
    let trajectory = read(&mut manifest, &path)?;
    let columns = columns(model.as_ref()).columns;
    let required = &columns[..columns.len() - model.measures().len()]; // measures are last, and may be missing
    require(&trajectory, &path, required.iter().map(|column| &*column.name))?;
    let Some(path) = table_path(folder, "crossings") else {
        return Ok(Dataset { manifest, trajectory, crossings: None });
    };
    let crossings = read_table(&path)?;
    require(&crossings, &path, CROSSING.map(|quantity| quantity.name))?;
    Ok(Dataset { manifest, trajectory, crossings: Some(crossings) })
}

/// Reads one table, Parquet or CSV by its extension, and the manifest if the file contains one.
///
/// # Errors
/// [`Error::Store`].
pub fn read_table_file(path: &Path) -> Result<(Table, Option<Manifest>), Error> {
    let manifest = table_metadata(path)?.map(|text| serde_json::from_slice(text.as_bytes())).transpose();
    Ok((read_table(path)?, manifest.map_err(|error| Error::unreadable(path, error))?))
}

/// Rejects a table without one of the columns `names`.
fn require<'n>(table: &Table, path: &Path, names: impl IntoIterator<Item = &'n str>) -> Result<(), Error> {
    match names.into_iter().find(|name| table.get(name).is_none()) {
        Some(missing) => Err(Error::unreadable(path, format!("it has no column {missing}"))),
        None => Ok(()),
    }
}

/// The file of a table in a folder, if it has one.
pub fn table_path(folder: &Path, name: &str) -> Option<PathBuf> {
    let files = [Format::Parquet, Format::Csv].map(|format| folder.join(format.file(name)));
    files.into_iter().find(|path| path.is_file())
}

/// The file of the trajectory in a folder.
///
/// # Errors
/// [`Error::Store`] where there is none.
pub fn trajectory_path(folder: &Path) -> Result<PathBuf, Error> {
    table_path(folder, "trajectory")
        .ok_or_else(|| Error::unreadable(folder, "it has no trajectory.parquet or trajectory.csv"))
}
