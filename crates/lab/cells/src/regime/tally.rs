//! The motions of models that are drawn, and whether more of them can change the name.

use super::{LEAST_SHARE, MOST_LOST};
use motiform_analysis::regime::Regime;

/// Numbers of models, the best one among them, after which their motions may have decided: multiples of the number of lanes.
const LOOKS: [usize; 5] = [24, 40, 56, 80, 112];
/// Shares between which the test decides, on both sides of [`LEAST_SHARE`], at which the evidence stays the same on average.
const SHARES: [f64; 2] = [0.78, 0.97];
/// Probability of either error at these shares.
const ERROR: f64 = 0.01;

/// Numbers of models to classify before each decision, of `count`.
pub(super) fn looks(count: usize) -> impl Iterator<Item = usize> {
    LOOKS.into_iter().filter(move |look| *look < count).chain([count])
}

/// The motions of models that the data allow.
#[derive(Default)]
pub(super) struct Tally {
    /// The motion of the best model.
    best: Option<Regime>,
    /// Numbers of drawn models.
    counts: Vec<(Regime, usize)>,
}

impl Tally {
    /// Adds the motion in which a model ends: that of the best one, then of drawn ones as the record would show them.
    pub(super) fn add(&mut self, end: Regime, shown: impl FnOnce(Regime) -> Regime) {
        if self.best.is_none() {
            self.best = Some(end);
            return;
        }
        let regime = shown(end);
        match self.counts.iter_mut().find(|entry| entry.0 == regime) {
            Some(entry) => entry.1 += 1,
            None => self.counts.push((regime, 1)),
        }
    }

    /// The motion of the best model.
    pub(super) fn best(&self) -> Regime {
        self.best.unwrap_or(Regime::Undetermined)
    }

    /// Number of models, the best one among them.
    pub(super) fn seen(&self) -> usize {
        self.models() + usize::from(self.best.is_some())
    }

    /// Number of drawn models.
    pub(super) fn models(&self) -> usize {
        self.counts.iter().map(|entry| entry.1).sum()
    }

    /// Number of drawn models with each motion, the most frequent one first.
    pub(super) fn counts(mut self) -> Vec<(Regime, usize)> {
        self.counts.sort_by_key(|entry| std::cmp::Reverse(entry.1));
        self.counts
    }

    fn count(&self, regime: Regime) -> usize {
        self.counts.iter().find(|entry| entry.0 == regime).map_or(0, |entry| entry.1)
    }

    /// The share of the most frequent motion among the models that do not blow up; `true` if they agree on the motion of the best model,
    /// and at most [`MOST_LOST`] of all blow up.
    pub(super) fn agreement(&self) -> (f64, bool) {
        let (all, lost) = (self.models(), self.count(Regime::BlowUp));
        let others = self.counts.iter().filter(|entry| entry.0 != Regime::BlowUp);
        let most = others.map(|entry| entry.1).max().unwrap_or(0);
        if most == 0 {
            return (0.0, false);
        }
        let share = most as f64 / (all - lost) as f64;
        let agree = share >= LEAST_SHARE && lost as f64 <= MOST_LOST * all as f64;
        (share, agree && self.can_be_named() && self.count(self.best()) == most)
    }

    /// `true` if at least [`LEAST_SHARE`] of the models that do not blow up rest or are undetermined, the best one among them, and at most
    /// [`MOST_LOST`] of all blow up.
    pub(super) fn is_quiet(&self) -> bool {
        let quiet = |regime: &Regime| matches!(regime, Regime::Motionless | Regime::Undetermined);
        let (all, lost) = (self.models(), self.count(Regime::BlowUp));
        let count: usize = self.counts.iter().filter(|one| quiet(&one.0)).map(|one| one.1).sum();
        let most = count as f64 >= LEAST_SHARE * (all - lost) as f64 && count > 0;
        most && lost as f64 <= MOST_LOST * all as f64 && quiet(&self.best())
    }

    fn can_be_named(&self) -> bool {
        !matches!(self.best(), Regime::Undetermined | Regime::BlowUp)
    }

    /// Returns `true` if more models can hardly change the name: the sequential test of a share of .97 against one of .78, with 1 % of
    /// errors, has decided. 23 models with the motion of the best one decide, or 31 of 32; with shares near .9 many are needed.
    ///
    /// Source: Wald (1945), Ann. Math. Stat. 16, 117.
    pub(super) fn is_clear(&self) -> bool {
        if !self.can_be_named() {
            return true;
        }
        let agree = self.count(self.best()) as f64;
        let differ = self.models() as f64 - agree;
        let [low, high] = SHARES;
        let evidence = agree * libm::log(high / low) + differ * libm::log((1.0 - high) / (1.0 - low));
        evidence.abs() >= libm::log((1.0 - ERROR) / ERROR)
    }
}

#[cfg(test)]
mod tests {
    use super::{LOOKS, Tally, looks};
    use motiform_analysis::regime::Regime::{self, BlowUp, Chaotic, Motionless, Undetermined, Zigzag};

    fn tally(counts: &[(Regime, usize)], best: Regime) -> Tally {
        Tally { best: Some(best), counts: counts.to_vec() }
    }

    #[test]
    fn blow_ups_neither_agree_nor_object_up_to_a_tenth() {
        let agreement = |counts: &[(Regime, usize)], best| tally(counts, best).agreement();
        assert_eq!(agreement(&[(Chaotic, 36), (Zigzag, 4)], Chaotic), (0.9, true));
        assert_eq!(agreement(&[(Chaotic, 35), (BlowUp, 3), (Zigzag, 2)], Chaotic), (35.0 / 37.0, true));
        assert_eq!(agreement(&[(Chaotic, 33), (BlowUp, 3), (Zigzag, 4)], Chaotic), (33.0 / 37.0, false));
        assert_eq!(agreement(&[(Chaotic, 35), (BlowUp, 5)], Chaotic), (1.0, false));
        assert_eq!(agreement(&[(BlowUp, 40)], BlowUp), (0.0, false));
        assert_eq!(agreement(&[(Chaotic, 40)], Zigzag), (1.0, false));
        assert_eq!(agreement(&[(Undetermined, 40)], Undetermined), (1.0, false));
        assert_eq!(agreement(&[], Chaotic), (0.0, false));
    }

    /// Models that rest, or have no name, are quiet; one of ten may have another motion, and the best model none.
    #[test]
    fn quiet_models_rest_or_have_no_name() {
        let quiet = |counts: &[(Regime, usize)], best| tally(counts, best).is_quiet();
        assert!(quiet(&[(Motionless, 10), (Undetermined, 13)], Undetermined));
        assert!(quiet(&[(Motionless, 9), (Undetermined, 9), (Zigzag, 2)], Motionless));
        assert!(!quiet(&[(Motionless, 9), (Undetermined, 8), (Zigzag, 2)], Motionless));
        assert!(!quiet(&[(Motionless, 20)], Zigzag));
        assert!(!quiet(&[(Motionless, 17), (BlowUp, 3)], Motionless) && !quiet(&[], Motionless));
    }

    #[test]
    fn more_models_are_drawn_where_the_share_is_near_the_limit() {
        assert_eq!(looks(160).collect::<Vec<_>>(), [24, 40, 56, 80, 112, 160]);
        assert_eq!(looks(40).collect::<Vec<_>>(), [24, 40]);
        assert_eq!(looks(10).collect::<Vec<_>>(), [10]);
        for (agree, differ, clear) in [
            (23, 0, true),
            (23, 1, false),
            (31, 1, true),
            (36, 4, false),
            (30, 10, true),
            (14, 10, true),
            (72, 8, false),
        ] {
            assert_eq!(
                tally(&[(Zigzag, agree), (Chaotic, differ)], Zigzag).is_clear(),
                clear,
                "{agree} {differ}"
            );
        }
    }

    /// The chance of being named, by the exact distribution of the number of models that agree: of shares far from .9 nearly 0 and 1, and
    /// nearer to them than with 40 models always; where a decision is early it is that of the share.
    #[test]
    fn names_depend_less_on_the_draws_than_with_forty_models() {
        let named = |share: f64, looks: &[usize]| {
            // probability of each number of models that agree, undecided so far
            let (mut open, mut named, mut models) = (vec![1.0], 0.0, 0);
            for &look in looks {
                for _ in models..look {
                    let mut next = vec![0.0; open.len() + 1];
                    for (agree, p) in open.iter().enumerate() {
                        next[agree + 1] += p * share;
                        next[agree] += p * (1.0 - share);
                    }
                    open = next;
                }
                models = look;
                for (agree, p) in open.iter_mut().enumerate() {
                    let counts = [(Zigzag, agree), (Undetermined, look - agree)];
                    let here = tally(&counts, Zigzag);
                    if here.is_clear() || Some(&look) == looks.last() {
                        named += if here.agreement().1 { *p } else { 0.0 };
                        *p = 0.0;
                    }
                }
            }
            named
        };
        let sequential: Vec<usize> = LOOKS.into_iter().map(|look| look - 1).chain([160]).collect();
        for (share, at_most) in [(0.7, 0.001), (0.8, 0.012), (0.85, 0.09)] {
            let [new, old] = [named(share, &sequential), named(share, &[40])];
            println!("{share}: {new:.4} {old:.4}");
            assert!(new < at_most && new < old, "{share}: {new} {old}");
        }
        for (share, at_least) in [(0.94, 0.9), (0.97, 0.99), (0.99, 0.999)] {
            let [new, old] = [named(share, &sequential), named(share, &[40])];
            println!("{share}: {new:.4} {old:.4}");
            assert!(new > at_least && new > old, "{share}: {new} {old}");
        }
    }
}
