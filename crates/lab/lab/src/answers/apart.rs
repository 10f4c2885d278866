//! Motions of one name that are not one motion.

use motiform_analysis::Verdict;
use motiform_analysis::regime::Attractor;
use motiform_analysis::symmetry::wrap;
use serde::Serialize;

/// Steady and periodic motions whose numbers differ by more than this part, and headings by more than this angle (rad), are different.
const PART: f64 = 1e-3;
const ANGLE: f64 = 0.01;

/// More different motions than this are members of a family, of which a list says nothing.
const MOST: usize = 8;

/// A motion among those of one name.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct One {
    /// The name that it has with others.
    regime: &'static str,
    /// Starts that lead to it.
    count: usize,
    /// The first of them.
    first: usize,
    /// Mean speed (model length per model time).
    speed: f64,
    /// Period (model time).
    #[serde(skip_serializing_if = "Option::is_none")]
    period: Option<f64>,
    /// Heading (rad), where the model has no rotations.
    #[serde(skip_serializing_if = "Option::is_none")]
    heading: Option<f64>,
}

impl One {
    fn of(first: usize, verdict: &Verdict) -> Option<Self> {
        let exact = matches!(verdict.attractor, Attractor::Equilibrium | Attractor::Periodic);
        let speed = verdict.speed.filter(|_| exact)?.mean;
        let heading = verdict.heading.filter(|_| speed > 0.0);
        Some(Self { regime: verdict.regime.name(), count: 1, first, speed, period: verdict.period, heading })
    }

    fn is_like(&self, other: &Self) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= PART * a.abs().max(b.abs()).max(f64::MIN_POSITIVE);
        let both = |a: Option<f64>, b: Option<f64>, alike: &dyn Fn(f64, f64) -> bool| match (a, b) {
            (Some(a), Some(b)) => alike(a, b),
            _ => true,
        };
        near(self.speed, other.speed)
            && both(self.period, other.period, &near)
            && both(self.heading, other.heading, &|a, b| wrap(a - b).abs() <= ANGLE)
    }

    /// `38 with speed 1.1072, heading 0.0 degrees`.
    pub(super) fn words(&self) -> String {
        let mut text = format!("{} with speed {:.4e}", self.count, self.speed);
        if let Some(period) = self.period {
            text += &format!(", period {period:.6}");
        }
        if let Some(heading) = self.heading {
            text += &format!(", heading {:.1} degrees", heading.to_degrees() + 0.0);
        }
        text
    }
}

/// The different motions among these verdicts of one name, the most frequent first; none where all are the same, or a family.
pub(super) fn apart<'v>(verdicts: impl Iterator<Item = (usize, &'v Verdict)>) -> Vec<One> {
    let mut all: Vec<One> = Vec::new();
    for one in verdicts.filter_map(|(place, verdict)| One::of(place, verdict)) {
        match all.iter_mut().find(|known| known.is_like(&one)) {
            Some(known) => known.count += 1,
            None => all.push(one),
        }
    }
    all.sort_by(|a, b| b.count.cmp(&a.count).then(a.first.cmp(&b.first)));
    if (2..=MOST).contains(&all.len()) { all } else { Vec::new() }
}
