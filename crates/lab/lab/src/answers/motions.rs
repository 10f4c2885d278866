//! The motions that many initial states lead to.

use super::About;
use super::apart::{One, apart};
use crate::samples::{Basins, Escapes, MotionShare, Named, Starts, motions};
use motiform_analysis::Verdict;
use motiform_study::Plan;
use serde::Serialize;
use std::fmt::{Display, Formatter, Result};

/// The motions of many initial states of a plan, and their shares.
#[derive(Clone, Debug, Serialize)]
pub struct Motions<'a> {
    #[serde(flatten)]
    about: About<'a>,
    seed: u64,
    regimes: serde_json::Map<String, serde_json::Value>,
    starts: &'a Starts,
    shares: &'a [MotionShare],
    samples: &'a [Verdict],
    /// Different motions of one name.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    apart: Vec<One>,
    #[serde(skip_serializing_if = "Option::is_none")]
    escapes: Option<&'a Escapes>,
    #[serde(skip)]
    basins: &'a Basins,
}

impl<'a> Motions<'a> {
    /// The verdicts on the initial states of a plan, in their order.
    pub fn new(
        plan: &'a Plan,
        verdicts: &'a [Verdict],
        basins: &'a Basins,
        escapes: Option<&'a Escapes>,
    ) -> Self {
        let mut regimes = serde_json::Map::new();
        for (motion, count) in motions(verdicts) {
            let before = regimes.get(motion.regime).and_then(serde_json::Value::as_u64).unwrap_or(0);
            regimes.insert(motion.regime.to_owned(), (before + count as u64).into());
        }
        Self {
            about: About::of(plan),
            seed: plan.computation.seed,
            regimes,
            starts: &basins.starts,
            shares: &basins.shares,
            samples: verdicts,
            apart: motions(verdicts).iter().flat_map(|(motion, _)| of_name(verdicts, *motion)).collect(),
            escapes,
            basins,
        }
    }

    /// The shares, and how many escape, in sentences.
    pub fn sentences(&self) -> Vec<String> {
        let escapes = self.escapes.into_iter().flat_map(|escapes| escapes.words(self.samples.len()));
        std::iter::once(self.basins.words()).chain(escapes).collect()
    }
}

/// The different motions of a name.
fn of_name(verdicts: &[Verdict], motion: Named) -> Vec<One> {
    apart(verdicts.iter().enumerate().filter(|(_, verdict)| Named::of(verdict) == motion))
}

impl Display for Motions<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let verdicts = self.samples;
        for (motion, count) in motions(verdicts) {
            let first = verdicts.iter().position(|verdict| Named::of(verdict) == motion).unwrap_or(0);
            let name = motion.to_string();
            writeln!(f, "{name:14} {count} of {}, the first is initial state {first}", verdicts.len())?;
            writeln!(f, "               {}", verdicts[first].why)?;
            let different = of_name(verdicts, motion);
            if !different.is_empty() {
                let words: Vec<String> = different.iter().map(One::words).collect();
                writeln!(f, "               {} different ones: {}", different.len(), words.join("; "))?;
            }
        }
        let sentences = self.sentences();
        if !self.shares.is_empty() {
            writeln!(f, "shares         {}", sentences[0])?;
        }
        for line in &sentences[1..] {
            writeln!(f, "escape         {line}")?;
        }
        write!(f, "seed           {}", self.seed)
    }
}
