//! A part of a scan: the rows of consecutive cells in one Parquet file that contains the hash of its plan and its own digest.
//!
//! The digest is SHA-256 over every byte of the file (its own 64 digits counted as zeros), kept in the file's
//! metadata: any change of any byte is detected, even one that Parquet would decode to other numbers without an error.

use super::ScanPlan;
use super::rows::{Row, from_columns, to_columns};
use motiform_store::columns;
use motiform_study::Error;
use motiform_study::dataset::VERSION;
use motiform_study::plan::sha256_hex;
use std::fs;
use std::path::{Path, PathBuf};

const PLAN: &str = "motiform.plan_hash";
const NUMBER: &str = "motiform.part";
const VERSION_KEY: &str = "motiform.version";
const DIGEST: &str = "motiform.digest";

/// Length of a digest, in digits.
const DIGITS: usize = 64;

/// The files of a folder's parts.
#[derive(Clone, Debug)]
pub struct Parts {
    folder: PathBuf,
    plan_hash: String,
    digits: usize,
}

/// A defect of the file of a part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PartError {
    /// It does not exist.
    Missing,
    /// Something other than a file has its name.
    InTheWay(PathBuf),
    /// It is damaged, or not this part of this scan; the text gives the evidence.
    Damaged(String),
}

impl Parts {
    pub(super) fn new(folder: &Path, plan: &ScanPlan) -> Self {
        let digits = plan.parts().saturating_sub(1).to_string().len().max(5);
        Self { folder: folder.to_owned(), plan_hash: plan.hash(), digits }
    }

    /// The file of a part.
    pub fn path(&self, part: usize) -> PathBuf {
        self.folder.join(self.name(part))
    }

    /// Checks the file of a part; returns its digest.
    ///
    /// # Errors
    /// [`PartError`].
    pub fn check(&self, part: usize) -> Result<String, PartError> {
        let path = self.path(part);
        let damaged = |reason: String| PartError::Damaged(format!("{}: {reason}", path.display()));
        if path.metadata().is_ok_and(|there| !there.is_file()) {
            return Err(PartError::InTheWay(path)); // reading a pipe would wait without end
        }
        let mut bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Err(PartError::Missing),
            Err(error) => return Err(damaged(error.to_string())),
        };
        let place =
            digest_place(&bytes).ok_or_else(|| damaged("it is cut off or no part of a scan".to_owned()))?;
        let said = String::from_utf8_lossy(&bytes[place.clone()]).into_owned();
        bytes[place].fill(b'0');
        if said != sha256_hex(&bytes) {
            return Err(damaged("its bytes do not give its digest".to_owned()));
        }
        let metadata = columns::metadata(&path).map_err(|error| damaged(error.to_string()))?;
        let entry = |key| metadata.iter().find(|entry| entry.0 == key).map(|entry| entry.1.as_str());
        if entry(PLAN) != Some(self.plan_hash.as_str()) || entry(NUMBER) != Some(part.to_string().as_str()) {
            let by = entry(VERSION_KEY).map_or_else(String::new, |by| format!(" (written by motiform {by})"));
            return Err(damaged(format!("it belongs to another scan or another place of it{by}")));
        }
        Ok(said)
    }

    /// The name of the file of a part.
    pub(super) fn name(&self, part: usize) -> String {
        format!("part-{part:0width$}.parquet", width = self.digits)
    }

    /// The bytes of a part.
    pub(super) fn encode(&self, plan: &ScanPlan, part: usize, rows: &[Row]) -> Result<Vec<u8>, Error> {
        let failed = |reason| Error::PartFailed { path: self.path(part), reason };
        self.try_encode(plan, part, rows).map_err(failed)
    }

    fn try_encode(&self, plan: &ScanPlan, part: usize, rows: &[Row]) -> Result<Vec<u8>, String> {
        let metadata = vec![
            (PLAN, self.plan_hash.clone()),
            (NUMBER, part.to_string()),
            (VERSION_KEY, VERSION.to_owned()),
            (DIGEST, "0".repeat(DIGITS)),
        ];
        let mut bytes =
            columns::encode(&to_columns(plan, rows), metadata).map_err(|error| error.to_string())?;
        let digest = sha256_hex(&bytes);
        let place = digest_place(&bytes).ok_or("the file has no place for its digest")?;
        bytes[place].copy_from_slice(digest.as_bytes());
        Ok(bytes)
    }
}

/// The position of the digest in a file: the key is followed by two bytes of framing (field type, length 64).
fn digest_place(bytes: &[u8]) -> Option<std::ops::Range<usize>> {
    let key = bytes.windows(DIGEST.len()).rposition(|window| window == DIGEST.as_bytes())?;
    let start = key + DIGEST.len() + 2;
    (start + DIGITS <= bytes.len()).then_some(start..start + DIGITS)
}

/// The rows of a part that [`Parts::check`] found undamaged.
///
/// # Errors
/// [`Error::Store`].
pub fn read_part(plan: &ScanPlan, parts: &Parts, part: usize) -> Result<Vec<Row>, Error> {
    let path = parts.path(part);
    let columns = columns::decode(&path).map_err(|error| Error::unreadable(&path, error))?;
    from_columns(plan, columns).ok_or_else(|| Error::unreadable(&path, "it has not the columns of this scan"))
}
