//! Kinds of results.

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

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 13] = [
        Self::Dataset,
        Self::Scan,
        Self::Branches,
        Self::Curves,
        Self::Atlas,
        Self::Lifetimes,
        Self::Statistics,
        Self::Observations,
        Self::Fits,
        Self::Report,
        Self::Table,
        Self::Outlines,
        Self::Figures,
    ];

    /// Its name in inventories.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Dataset => "dataset",
            Self::Scan => "scan",
            Self::Branches => "branches",
            Self::Curves => "curves",
            Self::Atlas => "atlas",
            Self::Lifetimes => "lifetimes",
            Self::Statistics => "statistics",
            Self::Observations => "observations",
            Self::Fits => "fits",
            Self::Report => "report",
            Self::Table => "table",
            Self::Outlines => "outlines",
            Self::Figures => "figures",
        }
    }

    /// The kind of a name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// The kind in words: `a scan`.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Dataset => "a dataset",
            Self::Scan => "a scan",
            Self::Branches => "branches",
            Self::Curves => "curves",
            Self::Atlas => "an atlas",
            Self::Lifetimes => "lifetimes",
            Self::Statistics => "statistics",
            Self::Observations => "observations of cells",
            Self::Fits => "fits of cells",
            Self::Report => "a reproduction of the paper",
            Self::Table => "a table",
            Self::Outlines => "outlines",
            Self::Figures => "figures",
        }
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
