//! Reading of texts of bounded length, so that reading a device ends.

use serde::de::DeserializeOwned;
use std::fs::File;
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;

/// Maximum size of a study file in bytes.
pub const STUDY: u64 = 1 << 20;

/// Maximum size of a manifest in bytes; those of the largest plans have several hundred thousand.
pub const MANIFEST: u64 = 1 << 26;

/// The text of a file, pipe or device, of at most `most` bytes.
pub fn text(path: &Path, most: u64) -> Result<String> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(Error::new(ErrorKind::FileTooLarge, format!("it has more than {most} bytes")));
    }
    String::from_utf8(bytes).map_err(|_| Error::new(ErrorKind::InvalidData, "it is not UTF-8 text"))
}

/// The content of a JSON file: only of a file, because reading from a pipe might never end.
pub fn json<T: DeserializeOwned>(path: &Path) -> Result<T> {
    if !path.metadata()?.is_file() {
        return Err(Error::new(ErrorKind::InvalidInput, "it is not a file"));
    }
    Ok(serde_json::from_slice(text(path, MANIFEST)?.as_bytes())?)
}
