//! The questions where the returns lie on a closed curve: is it a torus that lasts, or does it shrink onto a periodic orbit?

use super::super::case::Case;
use super::super::lasting::Change;
use super::super::look::Look;
use super::super::shrinking::shrinking_onto;
use super::super::verdict::Verdict;
use super::super::{chaos, words};
use super::Search;
use crate::{Lyapunov, Result};

impl Search {
    /// The verdict where the returns lie on a closed curve: a periodic orbit that they shrink onto, or a
    /// torus, seen twice, that keeps its size.
    pub(super) fn on_a_curve(
        &mut self,
        case: Case<'_>,
        look: &Look,
        run: &Lyapunov,
        witness: &chaos::Witness,
    ) -> Result<Option<Verdict>> {
        let torus = chaos::torus(run, witness, self.time);
        let again = self.curve.is_seen_again(look, torus.is_some());
        let inside =
            (torus.is_some() || witness.shrinks_orderly()).then(|| shrinking_onto(case, look)).flatten();
        if let Some((orbit, recurrence)) = inside {
            return words::periodic(case, &orbit, &recurrence, self.time).map(Some);
        }
        let Some(torus) = torus else { return Ok(None) };
        match self.lasts(torus, case, look, again) {
            Ok(torus) => self.described(torus, case, look.end - look.start).map(Some),
            Err(missing) => {
                self.missing = missing;
                Ok(None)
            }
        }
    }

    /// The verdict on a torus that was seen twice and keeps its size; otherwise what is missing.
    fn lasts(
        &mut self,
        torus: Verdict,
        case: Case<'_>,
        look: &Look,
        again: bool,
    ) -> std::result::Result<Verdict, String> {
        if !again {
            return Err(
                "the returns lie on a closed curve that was not seen twice with the same size".to_owned()
            );
        }
        self.time += look.end - look.start;
        let change = Change::along(case, &self.shape, look);
        let unseen = "the returns lie on a closed curve, and whether it keeps its size was not seen";
        change.ok_or(unseen.to_owned())?.judges(Verdict { time: self.time, ..torus })
    }
}
