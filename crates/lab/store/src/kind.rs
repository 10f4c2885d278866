//! Kinds of results.

use crate::{Inventory, mend};
use std::path::Path;

/// The kind of a result: only a result of the same kind may replace it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A body's path and shape.
    Dataset,
    /// Rows over one or two axes.
    Scan,
    /// Branches of a motion.
    Branches,
    /// Curves of special points.
    Curves,
    /// The motions of a plane and what bounds them.
    Atlas,
    /// Mean lives of transient chaos.
    Lifetimes,
    /// Statistics of many bodies.
    Statistics,
    /// The motions of tracked cells.
    Observations,
    /// Equations of tracked cells.
    Fits,
    /// The reproduction of the paper.
    Report,
    /// A single table.
    Table,
    /// Outlines in a file for other programs.
    Outlines,
    /// Figures alone, drawn from another folder.
    Figures,
}

/// Every kind, in the order of their declaration: its name in inventories, and its words.
const KINDS: [(Kind, &str, &str); 13] = [
    (Kind::Dataset, "dataset", "a dataset"),
    (Kind::Scan, "scan", "a scan"),
    (Kind::Branches, "branches", "branches"),
    (Kind::Curves, "curves", "curves"),
    (Kind::Atlas, "atlas", "an atlas"),
    (Kind::Lifetimes, "lifetimes", "lifetimes"),
    (Kind::Statistics, "statistics", "statistics"),
    (Kind::Observations, "observations", "observations of cells"),
    (Kind::Fits, "fits", "fits of cells"),
    (Kind::Report, "report", "a reproduction of the paper"),
    (Kind::Table, "table", "a table"),
    (Kind::Outlines, "outlines", "outlines"),
    (Kind::Figures, "figures", "figures"),
];

impl Kind {
    /// Its name in inventories.
    #[must_use]
    pub fn name(self) -> &'static str {
        KINDS[self as usize].1
    }

    /// The kind of a name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        KINDS.into_iter().find(|kind| kind.1 == name).map(|kind| kind.0)
    }

    /// The kind in words: `a scan`.
    #[must_use]
    pub fn words(self) -> &'static str {
        KINDS[self as usize].2
    }

    /// Returns `true` if its command continues it with `--resume`.
    #[must_use]
    pub fn resumes(self) -> bool {
        matches!(
            self,
            Self::Scan
                | Self::Branches
                | Self::Curves
                | Self::Atlas
                | Self::Lifetimes
                | Self::Statistics
                | Self::Fits
        )
    }
}

/// The kind of a folder, by its inventory. An interrupted replacement is finished before.
#[must_use]
pub fn kind_of(folder: &Path) -> Option<Kind> {
    let _ = mend(folder); // reading says what is wrong
    Kind::of_name(&Inventory::read(folder).ok()??.kind)
}

#[test]
fn kinds_are_in_their_order() {
    assert!(KINDS.iter().enumerate().all(|(place, kind)| kind.0 as usize == place));
}
