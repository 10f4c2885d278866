//! The requests of a search to its caller, who computes orbits.

use super::verdict::Verdict;

/// The next observation that a search needs.
#[derive(Debug)]
pub(super) enum Ask {
    /// The orbit, for this long, from where it is.
    Look(f64),
    /// The largest exponent over this time, from where the orbit is, which goes on from where that run ends.
    Exponent(f64),
    /// Nothing: it has decided, or was interrupted.
    Nothing(Option<Box<Verdict>>),
}

impl From<Verdict> for Ask {
    fn from(verdict: Verdict) -> Self {
        Self::Nothing(Some(Box::new(verdict.or_undetermined())))
    }
}
