//! Evidence that repeats itself from look to look: more time would not change it.

use super::steady_turns::SteadyTurns;

/// Looks in a row, each twice as long as the one before, whose turns are the same: they remain so.
const STEADY: u32 = 2;

/// Runs in a row whose exponent is what errors of steps leave of larger numbers: the next one would say the same.
const CANCELLED: u32 = 3;

/// The common results of the latest looks and runs of a search.
#[derive(Debug, Default)]
pub(super) struct Repeats {
    /// Turns between rests in the last look that were all the same.
    turns: Option<SteadyTurns>,
    /// Number of looks in a row in which they were the same.
    steady: u32,
    /// Runs in a row without an exponent of the motion.
    cancelled: u32,
}

impl Repeats {
    /// Takes in the turns of a look.
    pub(super) fn turned(&mut self, turns: Option<SteadyTurns>) {
        let goes_on = turns.zip(self.turns).is_some_and(|(turns, before)| turns.agrees(&before));
        self.steady = u32::from(turns.is_some()) + if goes_on { self.steady } else { 0 };
        self.turns = turns;
    }

    /// Takes in whether errors of steps decided the exponent of a run.
    pub(super) fn measured(&mut self, cancels: bool) {
        self.cancelled = if cancels { self.cancelled + 1 } else { 0 };
    }

    /// The turns of the last look, if all were the same.
    pub(super) fn turns(&self) -> Option<&SteadyTurns> {
        self.turns.as_ref()
    }

    /// The number of repetitions, in words, after which more time would give the same result; `None` if it
    /// might not.
    pub(super) fn since(&self) -> Option<String> {
        if self.steady >= STEADY {
            return Some(format!("in {} looks in a row", self.steady));
        }
        (self.cancelled >= CANCELLED).then(|| format!("in {} runs in a row", self.cancelled))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two looks in a row with the same turns are enough; other turns, or none, begin again.
    #[test]
    fn the_same_turns_twice_are_enough() {
        let mut repeats = Repeats::default();
        for (angle, alternates, enough) in
            [(1.5, false, false), (1.2, false, false), (1.2, true, false), (1.2, true, true)]
        {
            repeats.turned(Some(SteadyTurns::of_angle(angle, alternates)));
            assert_eq!(repeats.since().is_some(), enough, "{angle} {alternates}");
        }
        repeats.turned(None);
        assert!(repeats.since().is_none() && repeats.turns().is_none());
        repeats.turned(Some(SteadyTurns::of_angle(1.2, true)));
        assert!(repeats.since().is_none());
    }

    /// Three runs in a row that errors decide; one that they do not decide begins again.
    #[test]
    fn three_runs_without_a_measure_are_enough() {
        let mut repeats = Repeats::default();
        for (cancels, enough) in
            [(true, false), (true, false), (false, false), (true, false), (true, false), (true, true)]
        {
            repeats.measured(cancels);
            assert_eq!(repeats.since().is_some(), enough);
        }
        assert_eq!(repeats.since().as_deref(), Some("in 3 runs in a row"));
    }
}
