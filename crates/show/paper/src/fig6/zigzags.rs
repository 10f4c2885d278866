//! The third window: the zigzag, followed from Fig. 6(c) to other lengths.

use super::super::claims::{claim, differs};
use super::super::context::Context;
use super::edges::Edges;
use super::lengths::{Lengths, study};
use super::tracks::Track;
use super::windows::{number, words};
use motiform_analysis::Regime;
use motiform_figures::report::Claim;
use motiform_lab::scan::{Axis, CellSummary};
use motiform_study::Error;

/// Lengths at which the zigzag is started, in hundredths.
const FULL: [u32; 19] = [
    2890, 2900, 2905, 2910, 2915, 2920, 2930, 2935, 2940, 2945, 2950, 2960, 2970, 2980, 2990, 3000, 3010,
    3020, 3030,
];
const QUICK: [u32; 6] = [2910, 2920, 2940, 2960, 3000, 3020];

/// Modes; enough for the longest.
const MODES: usize = 20;

/// The lengths about the third window.
const WINDOW: (f64, f64) = (28.8, 30.4);

/// The lengths inside which the zigzag may have lost its mirror symmetry (measured: 29.4 and 29.45).
const GAP: (f64, f64) = (29.25, 29.55);

/// The largest distance of an edge from that of the paper.
const EDGE: f64 = 0.21;

/// The continuation of the zigzag at a length.
struct Kept {
    length: f64,
    regime: Regime,
    /// Period, and net rotation per period (degrees), where it has them.
    period: Option<f64>,
    rotation: Option<f64>,
    /// The largest exponent.
    exponent: Option<f64>,
}

impl Kept {
    fn words(&self) -> String {
        let turned = match (self.rotation, self.period) {
            (Some(rotation), Some(period)) => format!(", turned by {rotation:+.1}° per {period:.1}"),
            _ => String::new(),
        };
        let parting = match (self.regime, self.exponent) {
            (Regime::Chaotic, Some(exponent)) => format!(", *λ*_1 = {exponent:.4}"),
            _ => String::new(),
        };
        format!("{} at {}{turned}{parting}", self.regime, self.length)
    }
}

/// The lengths at which a zigzag remains a zigzag.
pub(super) struct Zigzags(Vec<Kept>);

impl Zigzags {
    /// Starts at the state in which the run at *L* = 29.2 ended.
    pub(super) fn follow(context: &Context<'_>, track: &Track) -> Result<Self, Error> {
        let mut study = study(29.2, MODES)?;
        for (name, value) in &track.dataset.manifest.state.0 {
            study.set_initial(name, *value)?;
        }
        let values = context.choose(FULL.to_vec(), QUICK.to_vec());
        let values = values.into_iter().map(|hundredths| f64::from(hundredths) / 100.0).collect();
        study.scan.axes = vec![Axis { name: "length".to_owned(), values }];
        study.scan.budget = context.choose(5e4, 2e4);
        let (plan, cells) = context.scan("fig6-zigzag", &study)?;
        let kept = |cell: &CellSummary| {
            let motion = &cell.motions[0];
            Kept {
                length: plan.axis_values(cell.cell)[0],
                regime: motion.regime,
                period: motion.median("period"),
                rotation: motion.median("net_rotation").map(f64::to_degrees),
                exponent: motion.median("lambda_1"),
            }
        };
        Ok(Self(cells.iter().map(kept).collect()))
    }

    /// The length without a zigzag before the first one, the shortest and the longest length with one, and the next length, without.
    fn ends(&self) -> Option<(f64, f64, f64, Option<f64>)> {
        let zigzag = |kept: &Kept| kept.regime == Regime::Zigzag;
        let first = self.0.iter().position(zigzag)?;
        let last = self.0.iter().rposition(zigzag)?;
        let before = self.0[..first].last()?.length;
        let after = self.0.get(last + 1).map(|kept| kept.length);
        Some((before, self.0[first].length, self.0[last].length, after))
    }

    /// Sentence 153: zigzags at other lengths than about those of mode 4.
    pub(super) fn elsewhere(&self, context: &Context<'_>, lengths: &Lengths) -> Claim {
        let scanned = lengths.0.iter().map(|(length, cell)| {
            (*length, cell.motions.iter().any(|motion| motion.regime == Regime::Zigzag))
        });
        let followed = self.0.iter().map(|kept| (kept.length, kept.regime == Regime::Zigzag));
        let all: Vec<(f64, bool)> = scanned.chain(followed).collect();
        let outside = || all.iter().filter(|entry| !(WINDOW.0..WINDOW.1).contains(&entry.0));
        let there = all.iter().filter(|entry| entry.1 && (WINDOW.0..WINDOW.1).contains(&entry.0)).count();
        let found: Vec<String> = outside().filter(|entry| entry.1).map(|entry| entry.0.to_string()).collect();
        let count = outside().count();
        let words = if found.is_empty() { "none".to_owned() } else { found.join(", ") };
        let says =
            "The zigzag motion with *n* = ±3 as in Fig. 5(a) has not been found in the active cell model.";
        let finds = format!(
            "zigzags at {there} of the lengths in and about *W*_3, where *L*/2π is close to 4; at the \
            {count} lengths below and above it that were looked at, from 6 to 31: {words}"
        );
        let how = "the motions of random starts at the lengths of the scan, and the zigzag of (c) followed \
            in length; no zigzag outside 28.8 < *L* < 30.4. The turns of those inside, at the two lengths \
            of the paper, stand in the chapter on both models. A search with few starts does not exclude a \
            small basin";
        context.resting_on(count, "lengths", claim(&[153], says, finds, how, found.is_empty() && there > 0))
    }

    pub(super) fn claim(&self, edges: &Edges) -> Claim {
        let (before, first, last, after) = self.ends().unwrap_or((f64::NAN, f64::NAN, f64::NAN, None));
        // beyond the paper's edge the start decides
        let end = last.min(29.9 + EDGE);
        let inside = || self.0.iter().filter(|kept| (first..=end).contains(&kept.length));
        let others: Vec<&Kept> = inside().filter(|kept| kept.regime != Regime::Zigzag).collect();
        let says = "Zigzag motions emerge in *W*_3 = [29.0, 29.9].";
        let how = "the motion of Fig. 6(c), started at each of these lengths and named again; every length \
            between the first and the last zigzag, as far as the paper's window goes, counts; the paper's \
            lower edge to within the spacing, 0.1 to 0.2. Where two motions are stable the start decides, \
            so the upper edge is compared, within the same, with the length at which the four-fold shape at \
            rest becomes stable";
        let list: Vec<String> = others.iter().map(|kept| kept.words()).collect();
        let finds = format!(
            "a zigzag at {} of {} lengths from *L* = {first} (not at {before}) to {last} ({}); {}. The three-fold shape is stable \
             there as well (up to {}), the four-fold one from {}: which one is reached depends on the start",
            inside().count() - others.len(),
            inside().count(),
            after.map_or_else(|| "the longest one looked at".to_owned(), |after| format!("not at {after}")),
            if list.is_empty() { "at none of them another motion".to_owned() } else { list.join("; ") },
            words(edges.three_fold.1),
            words(edges.four_fold)
        );
        let edges_fit = (first - 29.0).abs() < EDGE
            && last > 29.9 - EDGE
            && (number(edges.four_fold) - 29.9).abs() < EDGE;
        let beyond = last > 29.9 + EDGE;
        if others.is_empty() && !beyond {
            return claim(&[137, 138], says, finds, how, edges_fit);
        }
        let broken = |kept: &&Kept| {
            let wild = matches!(kept.regime, Regime::QuasiPeriodic | Regime::Chaotic | Regime::Undetermined);
            wild && kept.length > GAP.0 && kept.length < GAP.1
        };
        differs(
            &[137, 138],
            says,
            finds,
            how,
            why(others.is_empty(), beyond),
            edges_fit
                && others.iter().all(broken)
                && (others.is_empty()
                    || others.iter().any(|kept| {
                        kept.regime == Regime::QuasiPeriodic && kept.rotation.is_some_and(|r| r.abs() > 1.0)
                    })),
        )
    }
}

/// The reason why the window differs from the paper's: a gap inside of it, unless there is `none`, and a
/// zigzag `beyond` its end.
fn why(none: bool, beyond: bool) -> &'static str {
    match (none, beyond) {
        (true, _) => {
            "the zigzag is stable beyond the paper's upper edge, beside a motionless four-fold shape that \
            becomes stable there: most starts lead to that"
        }
        (false, false) => {
            "inside the window lies a gap in which the zigzag has lost its mirror symmetry: it rotates slowly (quasi-periodic), and at one \
             end of the gap it is weakly chaotic; on a picture this looks like a zigzag"
        }
        (false, true) => {
            "inside the window lies a gap in which the zigzag has lost its mirror symmetry: it rotates \
            slowly (quasi-periodic), and at one end of the gap it is weakly chaotic; on a picture this \
            looks like a zigzag. It is also stable beyond the paper's upper edge, beside a motionless \
            four-fold shape that becomes stable there: most starts lead to that"
        }
    }
}
