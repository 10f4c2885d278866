//! The folder of a scan: `_manifest.json`, locked while it is computed, and parts.

use super::{Parts, ScanPlan};
use motiform_study::scan::ScanComputation;
use motiform_study::{Error, Provenance};
use std::path::{Path, PathBuf};

/// Provenance of a scan.
pub type ScanManifest = Provenance<ScanComputation>;

/// A folder that contains a scan, or the part of it that is computed.
#[derive(Clone, Debug)]
pub struct ScanFolder {
    path: PathBuf,
    manifest: ScanManifest,
}

impl ScanFolder {
    /// Reads the manifest of a folder.
    ///
    /// # Errors
    /// [`Error::NoResult`] if it is missing or damaged.
    pub fn read(path: &Path) -> Result<Self, Error> {
        Ok(Self { path: path.to_owned(), manifest: ScanManifest::read(path)? })
    }

    /// The path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Its provenance.
    pub fn manifest(&self) -> &ScanManifest {
        &self.manifest
    }

    /// Its plan.
    pub fn plan(&self) -> &ScanPlan {
        &self.manifest.plan
    }

    /// The files of its parts.
    pub fn parts(&self) -> Parts {
        Parts::new(&self.path, self.plan())
    }
}
