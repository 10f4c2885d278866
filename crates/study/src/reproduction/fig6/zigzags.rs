//! The third window: the zigzag, followed from Fig. 6(c) to other lengths.

use super::super::claims::claim;
use super::super::context::Context;
use super::edges::Edges;
use super::lengths::study;
use super::tracks::Track;
use super::windows::words;
use crate::Error;
use crate::report::Claim;
use crate::scan::Axis;
use motiform_analysis::Regime;

/// Lengths at which the zigzag is started, in hundredths.
const FULL: [u32; 14] = [2890, 2900, 2905, 2910, 2915, 2920, 2940, 2960, 2980, 2990, 3000, 3010, 3020, 3030];
const QUICK: [u32; 4] = [2910, 2920, 3000, 3020];

/// Modes; enough for the longest.
const MODES: usize = 20;

/// At which lengths a zigzag stays one.
pub(super) struct Zigzags {
    /// Lengths, and whether it does.
    kept: Vec<(f64, bool)>,
}

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
        let zigzag = |motions: &[crate::scan::Motion]| motions[0].regime == Regime::Zigzag;
        let kept = cells.iter().map(|cell| (plan.axis_values(cell.cell)[0], zigzag(&cell.motions))).collect();
        Ok(Self { kept })
    }

    /// Shortest and longest length with a zigzag, and their neighbours without.
    fn ends(&self) -> Option<[(f64, f64); 2]> {
        let first = self.kept.iter().position(|entry| entry.1)?;
        let last = self.kept.iter().rposition(|entry| entry.1)?;
        let before = self.kept[..first].last()?.0;
        let after = self.kept.get(last + 1)?.0;
        Some([(before, self.kept[first].0), (self.kept[last].0, after)])
    }

    pub(super) fn claim(&self, edges: &Edges) -> Claim {
        let ends = self.ends().unwrap_or([(f64::NAN, f64::NAN); 2]);
        let [(before, first), (last, after)] = ends;
        claim(
            "Zigzag motions emerge in *W*_3 = [29.0, 29.9].",
            format!(
                "a zigzag persists from *L* = {first} (not at {before}) to {last} (not at {after}). The three-fold shape is stable there as well (up to {}), the four-fold one from {}: which one is reached depends on the start",
                words(edges.three_fold.1),
                words(edges.four_fold)
            ),
            "The motion of Fig. 6(c), started at other lengths and named again; the paper's edges to within the spacing, 0.1 to 0.2.",
            (first - 29.0).abs() < 0.21 && (last - 29.9).abs() < 0.21,
        )
    }
}
