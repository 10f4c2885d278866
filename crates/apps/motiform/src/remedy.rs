//! The remedy after an error, as it is typed: the library speaks of values, the command line of its options.

use motiform_cells::Error as CellError;
use motiform_store::{Error as StoreError, Kind};
use motiform_study::Error;
use motiform_tracks::{Apart, Error as TrackError, Setting};

/// The options that mend an error of any kind, where there are some: the end of its sentence.
pub(crate) fn end(error: &anyhow::Error) -> String {
    let known = error.downcast_ref().and_then(remedy);
    let known = known.or_else(|| error.downcast_ref().and_then(in_place)).map(str::to_owned);
    let of_tracks = || error.downcast_ref().and_then(of_tracks);
    known.or_else(of_tracks).or_else(|| error.downcast_ref().and_then(of_cells)).unwrap_or_default()
}

fn of_cells(error: &CellError) -> Option<String> {
    match error {
        CellError::Tracks(error) => of_tracks(error),
        CellError::Study(error) => remedy(error).map(str::to_owned),
        CellError::NoFits { .. } => {
            Some("; give a folder written by `motiform fit`, or begin without --resume".to_owned())
        }
        CellError::OtherFits { .. } => Some("; choose another --out, or --force to replace it".to_owned()),
        CellError::Inference(_) => None,
    }
}

fn of_tracks(error: &TrackError) -> Option<String> {
    match error {
        TrackError::Column { wanted, .. } => Some(format!(": --column {wanted}=HEADER")),
        TrackError::MixedCells { remedy: Apart::Column, .. } => Some(": --column cell=HEADER".to_owned()),
        TrackError::UnknownFormat { setting: Some(Setting::Columns), .. } => {
            Some("; columns are named by --column frame=HEADER".to_owned())
        }
        TrackError::UnknownFormat { setting: Some(Setting::Masks), .. } => {
            Some("; label masks are read with --format masks".to_owned())
        }
        _ => None,
    }
}

/// The options that mend an error of a study or a plan.
fn remedy(error: &Error) -> Option<&'static str> {
    Some(match error {
        Error::Start { .. } => {
            "; steady motions, also those that are not stable there, are listed by `motiform equilibria ... --json > FILE.json`, \
             and --start FILE.json:NUMBER begins with one of them"
        }
        Error::NoAxis { .. } => "; give --axis NAME=LOW:HIGH:COUNT, or axes in [scan]",
        Error::NoAlong => ": --along NAME=LOW:HIGH, or along in [continue]",
        Error::Setting { key: "curve", .. } => ": --in NAME,NAME=LOW:HIGH",
        Error::Setting { key: "in", .. } => ": --curve KIND",
        Error::Store(error) => return in_place(error),
        Error::OtherPlan { .. } => "; choose another --out, or --force to replace it",
        Error::Unfinished { .. } => ": the `motiform atlas` that began it goes on with --resume",
        Error::NoResult { kind: Kind::Dataset, .. } => "; give a folder written by `motiform simulate`",
        Error::NoResult { kind: Kind::Scan, .. } => "; give a folder written by `motiform scan`",
        Error::NoResult { kind: Kind::Branches | Kind::Curves, .. } => {
            "; give a folder written by `motiform continue`"
        }
        Error::NoResult { kind: Kind::Atlas, .. } => "; give a folder written by `motiform atlas`",
        Error::PartFailed { .. } | Error::InTheWay { .. } => "; --resume continues it",
        _ => return None,
    })
}

/// The options that mend an error of the place of a result.
fn in_place(error: &StoreError) -> Option<&'static str> {
    Some(match error {
        StoreError::Resumable { .. } => {
            "; --resume continues it, --force replaces it; or choose another --out"
        }
        StoreError::Exists { .. } => "; choose another --out, or --force to replace it",
        StoreError::Busy { .. } | StoreError::Changed { .. } | StoreError::Taken { .. } => {
            ", or choose another --out"
        }
        StoreError::NotOurs { .. } | StoreError::NotContinued { .. } | StoreError::OtherKind { .. } => {
            "; choose another --out, or move it to another place"
        }
        StoreError::NoFolder { .. } => ": give one that motiform wrote",
        StoreError::Unwritable { .. } => "; choose an --out in a folder that is writable",
        StoreError::Inventory { .. } => "; choose another --out",
        StoreError::Unreadable { reason, .. } if reason.ends_with("(os error 24)") => {
            "; allow more open files (ulimit -n)"
        }
        StoreError::Unreadable { reason, .. } if reason.ends_with("(os error 2)") => {
            "; give the name of a file that exists"
        }
        _ => return None,
    })
}
