//! The folder of a scan: `_manifest.json`, locked while it is computed, and parts.
//!
//! The manifest's name begins with `_`: readers of Parquet folders (pandas, pyarrow, polars) skip such names, so that they open the
//! folder as one table.

use super::{Parts, ScanPlan};
use motiform_store::mend;
use motiform_study::Error;
use motiform_study::dataset::VERSION;
use motiform_study::input;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The name of the manifest.
pub(super) const MANIFEST: &str = "_manifest.json";

/// Provenance of a scan. Contains no host, user, time of day, threads or shards.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScanManifest {
    /// Version of motiform that started it.
    pub motiform: String,
    /// SHA-256 of the plan's computation.
    pub plan_hash: String,
    /// The plan.
    pub plan: ScanPlan,
}

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
    /// [`Error::NoScan`] if it is missing or damaged.
    pub fn read(path: &Path) -> Result<Self, Error> {
        mend(path)?;
        let no_scan = |reason: String| Error::NoScan { path: path.to_owned(), reason };
        let text =
            input::manifest(&path.join(MANIFEST)).map_err(|error| no_scan(format!("{MANIFEST}: {error}")))?;
        let manifest: ScanManifest =
            serde_json::from_str(&text).map_err(|error| no_scan(format!("{MANIFEST}: {error}")))?;
        if manifest.plan.hash() != manifest.plan_hash {
            return Err(no_scan(format!("{MANIFEST} was changed: its plan does not give its hash")));
        }
        Ok(Self { path: path.to_owned(), manifest })
    }

    /// The path of the folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Its provenance.
    #[must_use]
    pub fn manifest(&self) -> &ScanManifest {
        &self.manifest
    }

    /// Its plan.
    #[must_use]
    pub fn plan(&self) -> &ScanPlan {
        &self.manifest.plan
    }

    /// The files of its parts.
    #[must_use]
    pub fn parts(&self) -> Parts {
        Parts::new(&self.path, self.plan())
    }
}

/// The default folder of a scan.
#[must_use]
pub fn default_folder(plan: &ScanPlan) -> String {
    let model = &plan.computation.model;
    if plan.name == model.as_str() { format!("{model}-scan") } else { format!("{model}-{}-scan", plan.name) }
}

/// The manifest of a scan.
pub(super) fn manifest(plan: &ScanPlan, target: &Path) -> Result<Vec<u8>, Error> {
    let manifest = ScanManifest { motiform: VERSION.to_owned(), plan_hash: plan.hash(), plan: plan.clone() };
    let mut json = serde_json::to_vec_pretty(&manifest)
        .map_err(|error| Error::write_failed(&target.join(MANIFEST), error))?;
    json.push(b'\n');
    Ok(json)
}

/// The differences between two plans: the values in the folder and the requested ones.
pub(super) fn differences(there: &ScanPlan, asked: &ScanPlan) -> String {
    let (there, asked) = (&there.computation, &asked.computation);
    let json = |computation| serde_json::to_value(computation).unwrap_or_default();
    let (mut left, mut right) = (json(there), json(asked));
    let mut found = Vec::new();
    if there.format != asked.format {
        found.push(format!(
            "it was computed by another version of motiform with other numbers: format {} there, {} here",
            there.format, asked.format
        ));
    }
    if there.axes != asked.axes {
        let say = |axes: &[super::Axis]| {
            axes.iter().map(|axis| format!("[{axis}]")).collect::<Vec<_>>().join(" x ")
        };
        found.push(format!("axes: {} there, {} requested", say(&there.axes), say(&asked.axes)));
    }
    for side in [&mut left, &mut right] {
        if let Some(object) = side.as_object_mut() {
            object.remove("axes");
            object.remove("format");
        }
    }
    compare("", &left, &right, &mut found);
    found.join("; ")
}

/// Appends what differs, key by key.
fn compare(key: &str, there: &Value, asked: &Value, found: &mut Vec<String>) {
    let (Some(left), Some(right)) = (there.as_object(), asked.as_object()) else {
        if there != asked {
            found.push(format!("{key}: {} there, {} requested", shown(there), shown(asked)));
        }
        return;
    };
    let new = right.keys().filter(|name| !left.contains_key(*name));
    for name in left.keys().chain(new) {
        let path = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
        compare(&path, &there[name], &asked[name], found);
    }
}

fn shown(value: &Value) -> String {
    if value.is_null() { "none".to_owned() } else { value.to_string() }
}
