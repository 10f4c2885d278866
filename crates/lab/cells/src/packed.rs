//! Values as compressed JSON: what is done of a computation that can be continued.

use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use motiform_store::Folder;
use motiform_study::Error;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::io::{Read, Write};

/// Writes a value, at once or not at all.
pub(crate) fn write_packed(folder: &Folder, name: &str, value: &impl Serialize) -> Result<(), Error> {
    let packed = || -> std::io::Result<Vec<u8>> {
        let mut packer = GzEncoder::new(Vec::new(), Compression::fast());
        packer.write_all(&serde_json::to_vec(value)?)?;
        packer.finish()
    };
    let bytes = packed().map_err(|error| Error::write_failed(&folder.shown().join(name), error))?;
    Ok(folder.put(name, &bytes)?)
}

/// A value that was written; `None` where there is none, or where it cannot be read or was changed: then it is computed again.
pub(crate) fn read_packed<T: DeserializeOwned>(folder: &Folder, name: &str) -> Option<T> {
    let mut text = Vec::new();
    GzDecoder::new(folder.read(name)?.as_slice()).read_to_end(&mut text).ok()?;
    serde_json::from_slice(&text).ok()
}
