//! What to type after an error: the library speaks of values, the command line of its options.

use motiform_study::Error;

/// The options that mend an error, where there are some: the end of its sentence.
pub(crate) fn remedy(error: &Error) -> Option<&'static str> {
    Some(match error {
        Error::NoAxis { .. } => "; give --axis NAME=LOW:HIGH:COUNT, or axes in [scan]",
        Error::NoAlong => ": --along NAME=LOW:HIGH, or along in [continue]",
        Error::Setting { key: "curve", .. } => ": --in NAME,NAME=LOW:HIGH",
        Error::Setting { key: "in", .. } => ": --curve KIND",
        Error::ScanExists { .. } => "; --resume continues it, --force replaces it; or choose another --out",
        Error::OtherScan { .. } | Error::OtherBranches { .. } | Error::Exists { .. } => {
            "; choose another --out, or --force to replace it"
        }
        Error::Busy { .. } => ", or choose another --out",
        Error::NotOurs { .. } => "; choose another --out",
        Error::Unwritable { .. } => "; choose an --out in a folder that exists and is writable",
        Error::PartFailed { .. } | Error::InTheWay { .. } => "; --resume continues it",
        _ => return None,
    })
}
