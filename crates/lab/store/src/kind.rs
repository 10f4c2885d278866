//! Kinds of results.

use crate::{Inventory, mend};
use std::path::Path;

/// Kinds, each declared once: name of the variant, name in inventories, its words, `resumes` if its command continues it, its meaning.
macro_rules! kinds {
    ($($kind:ident $name:literal $words:literal $($resumes:ident)? $meaning:literal;)*) => {
        /// The kind of a result: only a result of the same kind may replace it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Kind {
            $(#[doc = $meaning] $kind,)*
        }

        impl Kind {
            /// Every kind, in the order of their declaration.
            const ALL: &'static [Self] = &[$(Self::$kind),*];

            /// Its name in inventories.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => $name,)*
                }
            }

            /// The kind in words: `a scan`.
            pub fn words(self) -> &'static str {
                match self {
                    $(Self::$kind => $words,)*
                }
            }

            /// Returns `true` if its command continues it with `--resume`.
            pub fn resumes(self) -> bool {
                match self {
                    $(Self::$kind => !<[&str]>::is_empty(&[$(stringify!($resumes))?]),)*
                }
            }
        }
    };
}

kinds! {
    Dataset "dataset" "a dataset" "A body's path and shape.";
    Scan "scan" "a scan" resumes "Rows over one or two axes.";
    Branches "branches" "branches" resumes "Branches of a motion.";
    Curves "curves" "curves" resumes "Curves of special points.";
    Atlas "atlas" "an atlas" resumes "The motions of a plane and what bounds them.";
    Lifetimes "lifetimes" "lifetimes" resumes "Mean lives of transient chaos.";
    Statistics "statistics" "statistics" resumes "Statistics of many bodies.";
    Observations "observations" "observations of cells" "The motions of tracked cells.";
    Fits "fits" "fits of cells" resumes "Equations of tracked cells.";
    Report "report" "a reproduction of the paper" "The reproduction of the paper.";
    Table "table" "a table" "A single table.";
    Outlines "outlines" "outlines" "Outlines in a file for other programs.";
    Figures "figures" "figures" "Figures alone, drawn from another folder.";
}

impl Kind {
    /// The kind of a name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|kind| kind.name() == name)
    }
}

/// The kind of a folder, by its inventory. An interrupted replacement is finished before.
pub fn kind_of(folder: &Path) -> Option<Kind> {
    let _ = mend(folder); // reading says what is wrong
    Kind::of_name(&Inventory::read(folder).ok()??.kind)
}
