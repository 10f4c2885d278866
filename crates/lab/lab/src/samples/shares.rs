//! The motions of many initial states: shares with intervals, and a description of what was sampled.

use super::{Named, Samples, motions};
use motiform_analysis::{Share, Verdict};
use motiform_study::Random;
use serde::Serialize;

/// The motions of many initial states.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Basins {
    /// The starts that were drawn.
    pub starts: Starts,
    /// The motions that they lead to, the most frequent first; none if no start was drawn.
    pub shares: Vec<MotionShare>,
}

/// Random starts: how many, and of which distribution.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Starts {
    /// Number of starts drawn.
    pub count: usize,
    /// `true` if there is an additional given one, which is not part of any share.
    pub given: bool,
    /// Their distribution.
    pub random: Random,
    /// The same in words.
    pub words: String,
}

/// The share of one motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MotionShare {
    /// The motion.
    #[serde(flatten)]
    pub motion: Named,
    /// Its share of the starts that were drawn, with Wilson's 95 % interval.
    #[serde(flatten)]
    pub share: Share,
}

impl Basins {
    /// The shares of these verdicts on these samples. A start that was given is not random and is not part of any share.
    pub fn new(samples: &Samples, verdicts: &[Verdict]) -> Self {
        let drawn = &verdicts[usize::from(samples.given).min(verdicts.len())..];
        let share = |(motion, count)| Some(MotionShare { motion, share: Share::new(count, drawn.len())? });
        Self { starts: Starts::of(samples), shares: motions(drawn).into_iter().filter_map(share).collect() }
    }

    /// `of 200 starts of size 0.01 to 1, log-uniform: circular 86 % (80 to 90 %), ...`.
    pub fn words(&self) -> String {
        let shares: Vec<String> = self.shares.iter().map(MotionShare::words).collect();
        format!("of {}: {}", self.starts.sentence(), shares.join(", "))
    }
}

impl Starts {
    /// The random ones of these samples.
    pub fn of(samples: &Samples) -> Self {
        let Samples { count, random, given, .. } = *samples;
        Self { count: count.saturating_sub(usize::from(given)), given, random, words: random.words() }
    }

    /// `200 starts of size 0.01 to 1, log-uniform`.
    pub fn sentence(&self) -> String {
        let Self { count, given, words, .. } = self;
        let beside = if *given { ", beside the given one" } else { "" };
        format!("{count} starts {words}{beside}")
    }
}

impl MotionShare {
    fn words(&self) -> String {
        let Share { value, lower, upper, .. } = self.share;
        format!("{} {:.0} % ({:.0} to {:.0} %)", self.motion, 100.0 * value, 100.0 * lower, 100.0 * upper)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_analysis::{Attractor, Regime};

    fn verdicts(counts: [(Regime, usize); 2]) -> Vec<Verdict> {
        let one = |regime| Verdict::new(regime, Attractor::Unknown, String::new(), 1.0);
        counts.iter().flat_map(|&(regime, count)| vec![one(regime); count]).collect()
    }

    #[test]
    fn shares_are_of_the_starts_that_were_drawn() {
        let found = verdicts([(Regime::QuasiPeriodic, 28), (Regime::Circular, 172)]);
        let random = Random::Sizes { min: 0.01, max: 1.0 };
        let samples = Samples { count: 200, random, given: false, threads: 1 };
        let basins = Basins::new(&samples, &found);
        assert_eq!(
            basins.words(),
            "of 200 starts of size 0.01 to 1, log-uniform: circular 86 % (81 to 90 %), quasi-periodic 14 % (10 to 19 %)"
        );
        let given = Basins::new(&Samples { given: true, ..samples }, &found);
        assert_eq!((given.starts.count, given.shares[1].share.count), (199, 27));
        let json = serde_json::to_value(&basins).unwrap();
        assert_eq!(
            (&json["shares"][0]["regime"], &json["shares"][0]["count"]),
            (&"circular".into(), &172.into())
        );
        assert_eq!(json["starts"]["random"]["max"], 1.0);
    }

    #[test]
    fn one_given_start_has_no_share() {
        let found = verdicts([(Regime::Circular, 1), (Regime::Zigzag, 0)]);
        let samples = Samples { count: 1, random: Random::SMALL, given: true, threads: 1 };
        assert!(Basins::new(&samples, &found).shares.is_empty());
    }
}
