//! Tables that are read some rows at a time.

use crate::errors::python;
use crate::run::{Columns, TableArrays};
use motiform_lab::dataset::trajectory_path;
use motiform_store::mend;
use motiform_store::read_columns;
use motiform_store::table::Table;
use motiform_study::Error;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, sync_channel};
use std::sync::{Mutex, PoisonError};

/// The rows of a table, a group at a time. The next group is read while Python works on the one before: two are in memory.
#[pyclass(frozen, module = "motiform._motiform")]
pub(crate) struct Chunks {
    groups: Mutex<Receiver<Result<Table, Error>>>,
}

#[pymethods]
impl Chunks {
    /// The columns of a table, or of the trajectory of a folder; `None`: all.
    #[new]
    #[pyo3(signature = (path, columns=None))]
    fn new(py: Python<'_>, path: PathBuf, columns: Option<Vec<String>>) -> PyResult<Self> {
        let file = || -> Result<PathBuf, Error> {
            if !path.is_dir() {
                return Ok(path);
            }
            mend(&path)?;
            trajectory_path(&path)
        };
        let file = py.detach(file).map_err(python)?;
        let (sender, receiver) = sync_channel(0);
        std::thread::spawn(move || {
            // It ends where nobody takes the next group.
            let mut take = |group| sender.send(Ok(group)).map_err(|_| Error::Interrupted);
            if let Err(error) = read_columns(&file, columns.as_deref(), &mut take) {
                let _ = sender.send(Err(error));
            }
        });
        Ok(Self { groups: Mutex::new(receiver) })
    }

    /// The next group; `None` at the end.
    fn next(&self, py: Python<'_>) -> PyResult<Option<TableArrays>> {
        let group = py.detach(|| self.groups.lock().unwrap_or_else(PoisonError::into_inner).recv());
        match group {
            Ok(group) => Ok(Some(Columns::new(py, group.map_err(python)?)?.parts(py))),
            Err(_) => Ok(None),
        }
    }
}
