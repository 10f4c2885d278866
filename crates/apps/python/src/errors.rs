//! Conversion of errors to Python exceptions, with the texts of the library and the keywords that mend them.

use motiform_models::Error as ModelError;
use motiform_store::{Error as StoreError, Kind};
use motiform_study::Error;
use pyo3::PyErr;
use pyo3::exceptions::{
    PyFileExistsError, PyFileNotFoundError, PyKeyboardInterrupt, PyOSError, PyTypeError, PyValueError,
};

/// `ValueError` for input that cannot be used, `OSError` (or `FileExistsError`) for files, `KeyboardInterrupt` for a stop.
pub(crate) fn python(error: Error) -> PyErr {
    let text = format!("{error}{}", remedy(&error).unwrap_or_default());
    match error {
        Error::Interrupted => PyKeyboardInterrupt::new_err(text),
        Error::Store(
            StoreError::Unreadable { .. }
            | StoreError::Unwritable { .. }
            | StoreError::Busy { .. }
            | StoreError::WriteFailed { .. }
            | StoreError::Inventory { .. },
        ) => PyOSError::new_err(text),
        Error::Store(StoreError::NotVerified { .. } | StoreError::NoFolder { .. }) => {
            PyValueError::new_err(text)
        }
        Error::Store(_) => PyFileExistsError::new_err(text),
        failure if failure.is_machine_failure() => PyOSError::new_err(text),
        _ => PyValueError::new_err(text),
    }
}

/// The keywords that mend an error, where there are some: the end of its sentence.
fn remedy(error: &Error) -> Option<&'static str> {
    Some(match error {
        Error::NoAxis { .. } => "; give axes={\"NAME\": values}",
        Error::Store(error) => return in_place(error),
        Error::Unfinished { .. } => ": the call of atlas that began it goes on with resume=True",
        Error::NoResult { kind: Kind::Dataset, .. } => "; give the folder of a simulation",
        Error::OtherPlan { .. } => "; choose another one, or overwrite=True to replace it",
        Error::PartFailed { .. } | Error::InTheWay { .. } => "; resume=True continues it",
        _ => return None,
    })
}

/// The keywords that mend an error of the place of a result.
fn in_place(error: &StoreError) -> Option<&'static str> {
    Some(match error {
        StoreError::Resumable { .. } => {
            "; resume=True continues it, overwrite=True replaces it; or choose another folder"
        }
        StoreError::Exists { .. } => "; choose another one, or overwrite=True to replace it",
        StoreError::Busy { .. } => ", or choose another folder",
        StoreError::NotOurs { .. } | StoreError::NotContinued { .. } | StoreError::OtherKind { .. } => {
            "; choose another one"
        }
        StoreError::Unwritable { .. } => "; choose a place in a folder that is writable",
        _ => return None,
    })
}

/// As [`python()`], for errors of tracked cells.
pub(crate) fn of_cells(error: motiform_cells::Error) -> PyErr {
    use motiform_cells::Error as CellError;
    match error {
        CellError::Study(error) => python(error),
        CellError::Tracks(error) => of_tracks(error),
        CellError::NoFits { .. } => {
            PyValueError::new_err(format!("{error}; give a folder of fits, or begin without resume=True"))
        }
        CellError::OtherFits { .. } => {
            PyValueError::new_err(format!("{error}; choose another one, or overwrite=True to replace it"))
        }
        CellError::Inference(error) => PyValueError::new_err(error.to_string()),
    }
}

/// As [`python()`], for errors of files with outlines.
pub(crate) fn of_tracks(error: motiform_tracks::Error) -> PyErr {
    use motiform_tracks::{Apart, Error as TrackError, Setting};
    let text = match &error {
        TrackError::Column { wanted, .. } => format!("{error}: columns={{'{wanted}': HEADER}}"),
        TrackError::MixedCells { remedy: Apart::Column, .. } => {
            format!("{error}: columns={{'cell': HEADER}}")
        }
        TrackError::UnknownFormat { setting: Some(Setting::Columns), .. } => {
            format!("{error}; columns are named by columns={{'frame': HEADER}}")
        }
        TrackError::UnknownFormat { setting: Some(Setting::Masks), .. } => {
            format!("{error}; label masks are read with format='masks'")
        }
        _ => error.to_string(),
    };
    match error {
        TrackError::Io { reason, .. } if reason.kind() == std::io::ErrorKind::NotFound => {
            PyFileNotFoundError::new_err(text)
        }
        TrackError::Io { .. } => PyOSError::new_err(text),
        _ => PyValueError::new_err(text),
    }
}

/// As [`python()`], for names that were given as keywords: an unknown one is a `TypeError`, as Python has it.
pub(crate) fn of_keywords(error: Error) -> PyErr {
    match error {
        Error::Models(ModelError::UnknownParameter { .. }) => PyTypeError::new_err(error.to_string()),
        other => python(other),
    }
}

/// JSON that cannot be written is a bug, and is reported as such.
pub(crate) fn of_json(error: serde_json::Error) -> PyErr {
    PyValueError::new_err(format!("not the JSON of motiform: {error}"))
}
