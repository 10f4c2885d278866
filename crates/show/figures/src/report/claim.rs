//! A claim, whose it is, and what became of it.

use serde::{Deserialize, Serialize};

/// A statement and what became of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Claim {
    /// The author of the statement.
    pub source: Source,
    /// The statement of the paper, or of our check.
    pub says: String,
    /// The finding.
    pub finds: String,
    /// The way of the decision: quantity, tolerance.
    pub how: String,
    /// The decision.
    pub verdict: Verdict,
}

/// The author of a claim.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub enum Source {
    /// The paper's, in the sentences of these numbers (see [`super::Sentence`]).
    Paper(Vec<u16>),
    /// Ours: the tools are checked, or something that follows, or was measured before.
    Ours,
}

impl Claim {
    /// Returns `true` if it is a check of ours, not a claim of the paper.
    pub fn is_ours(&self) -> bool {
        self.source == Source::Ours
    }

    /// The sentences of the paper that it is about; none for a check of ours.
    pub fn sentences(&self) -> &[u16] {
        match &self.source {
            Source::Paper(sentences) => sentences,
            Source::Ours => &[],
        }
    }

    /// Its noun.
    pub(super) fn noun(&self) -> &'static str {
        if self.is_ours() { "Check" } else { "Claim" }
    }
}

/// The decision on a claim.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub enum Verdict {
    /// It does.
    Holds,
    /// It does not as stated, for a reason that is understood.
    Differs {
        /// The reason.
        explanation: String,
    },
    /// It does not.
    Fails {
        /// The fault.
        explanation: String,
    },
    /// Too little was computed to say.
    Unjudged {
        /// The missing part.
        explanation: String,
    },
}

impl Verdict {
    /// Symbol and word; neither needs a colour.
    pub fn words(&self) -> &'static str {
        match self {
            Self::Holds => "✓ holds",
            Self::Differs { .. } => "≠ differs",
            Self::Fails { .. } => "✗ fails",
            Self::Unjudged { .. } => "○ not judged",
        }
    }

    /// The reason why it does not hold; `None` if it does.
    pub fn explanation(&self) -> Option<&str> {
        match self {
            Self::Holds => None,
            Self::Differs { explanation } | Self::Fails { explanation } | Self::Unjudged { explanation } => {
                Some(explanation)
            }
        }
    }

    /// Name for the style sheet.
    pub(super) fn class(&self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Differs { .. } => "differs",
            Self::Fails { .. } => "fails",
            Self::Unjudged { .. } => "unjudged",
        }
    }
}

/// The numbers of claims that hold, differ, fail, and are not judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Claims that hold.
    pub hold: usize,
    /// Claims that differ for a reason.
    pub differ: usize,
    /// Claims that fail.
    pub fail: usize,
    /// Claims for which too little was computed.
    pub unjudged: usize,
}

impl Counts {
    /// Counts the verdicts of claims.
    pub fn of<'a>(claims: impl IntoIterator<Item = &'a Claim>) -> Self {
        let mut counts = Self::default();
        for claim in claims {
            match claim.verdict {
                Verdict::Holds => counts.hold += 1,
                Verdict::Differs { .. } => counts.differ += 1,
                Verdict::Fails { .. } => counts.fail += 1,
                Verdict::Unjudged { .. } => counts.unjudged += 1,
            }
        }
        counts
    }
}
