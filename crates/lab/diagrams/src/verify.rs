//! A result on disk compared with what its inventory, its plan and the program say of it.

use crate::BranchFolder;
use crate::atlas::verify_atlas;
use crate::curves::CurveFolder;
use motiform_dynamics::Watch;
use motiform_lab::verify::{Repeated, verify_dataset, verify_scan};
use motiform_store::Audit;
use motiform_store::Kind;
use motiform_study::atlas::AtlasComputation;
use motiform_study::{Error, Provenance};
use serde_json::{Value, json};
use std::path::Path;

/// The findings of a verification.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verification {
    /// Its files, compared with the inventory.
    pub audit: Audit,
    /// The other checks, in a sentence.
    pub checked: &'static str,
    /// Numbers that were computed again, and those that are not the same.
    pub found: Repeated,
}

impl Verification {
    /// Checks digests and plan hashes, and computes numbers again where this costs no more than computing them did: all of them with `all`,
    /// otherwise a sample. `None` if the watch stopped it.
    ///
    /// # Errors
    /// [`Error::Store`] for a folder without an inventory, or one that cannot be read.
    pub fn of(folder: &Path, all: bool, watch: &dyn Watch) -> Result<Option<Self>, Error> {
        let audit = Audit::of(folder)?;
        let (checked, found) = match Kind::of_name(&audit.inventory.kind) {
            Some(Kind::Dataset) => {
                ("plan hash; rows of the trajectory computed again", verify_dataset(folder, all, watch))
            }
            Some(Kind::Scan) => {
                ("plan hash, digests inside the parts; rows computed again", verify_scan(folder, all, watch))
            }
            Some(Kind::Branches) => {
                ("plan hash; points are not computed again", readable(BranchFolder::read(folder)))
            }
            Some(Kind::Curves) => {
                ("plan hash; points are not computed again", readable(CurveFolder::read(folder)))
            }
            Some(Kind::Atlas) if !audit.inventory.complete => (
                "plan hash; cells are computed again once the atlas is finished",
                readable(Provenance::<AtlasComputation>::read(folder)),
            ),
            Some(Kind::Atlas) => (
                "plan hash; cells computed again, points of curves are not",
                verify_atlas(folder, all, watch),
            ),
            _ => ("digests only: numbers of this kind are not computed again", readable(Ok(()))),
        };
        let found = match found {
            Err(Error::Interrupted) => None,
            Err(error) => Some(Repeated { rows: 0, different: vec![error.to_string()] }),
            Ok(found) => found,
        };
        Ok(found.map(|found| Self { audit, checked, found }))
    }

    /// Returns `true` if everything is as it was written, and the same when computed again.
    pub fn is_intact(&self) -> bool {
        self.audit.changed.is_empty() && self.audit.missing.is_empty() && self.found.different.is_empty()
    }

    /// The findings, with stable keys.
    pub fn json(&self) -> Value {
        let Self { audit, checked, found } = self;
        json!({
            "intact": self.is_intact(),
            "kind": audit.inventory.kind,
            "motiform": audit.inventory.version,
            "complete": audit.inventory.complete,
            "unchanged": audit.unchanged.len(),
            "changed": audit.changed,
            "missing": audit.missing,
            "foreign": audit.foreign,
            "checked": checked,
            "rows": found.rows,
            "different": found.different,
        })
    }
}

/// A folder whose reader checks its plan; no rows.
fn readable<T>(read: Result<T, Error>) -> Result<Option<Repeated>, Error> {
    read.map(|_| Some(Repeated::default()))
}
