//! The zigzags of both models: their turns, and the modes that carry them.

use super::super::claims::{claim, differs};
use super::super::context::Context;
use super::super::fig6::Track;
use motiform_analysis::{Regime, Verdict};
use motiform_dynamics::sample::ascending;
use motiform_figures::report::{Claim, ReportFigure};
use motiform_figures::{Chart, ErrorBarSeries, Measured};
use motiform_study::Error;

/// Modes that are looked at.
const MODES: usize = 6;

pub(super) struct Zigzags {
    tensor: Verdict,
    cells: Vec<Track>,
}

impl Zigzags {
    pub(super) fn find(context: &Context<'_>) -> Result<Self, Error> {
        let tensor = context.classify(&context.preset("fig5a", |_| Ok(()))?)?;
        let cells = context.each(&["fig6c", "fig6d"], |name| Track::of(context, name))?;
        Ok(Self { tensor, cells })
    }

    pub(super) fn claims(&self, context: &Context<'_>) -> Vec<Claim> {
        let [c, d] = &self.cells[..] else { return Vec::new() };
        vec![self.sixty(), self.not_in_the_cell(), fourth(context, d), fourth_at_the_edge(context, c)]
    }

    fn sixty(&self) -> Claim {
        let turns = turns(&self.tensor);
        claim(
            &[193],
            "The zigzag of the tensor model turns by about 60 degrees, by its modes ±2 and ±3.",
            format!(
                "{}; turns of {} degrees from leg to leg; the heading swings by {:.1} degrees",
                self.tensor.regime,
                listed(&turns),
                self.tensor.swing.unwrap_or(f64::NAN).to_degrees()
            ),
            "Fig. 5(a): change of direction from leg to leg, within 6 degrees; modes 1 to 3 are all there are.",
            self.tensor.regime == Regime::Zigzag
                && !turns.is_empty()
                && turns.iter().all(|turn| (turn - 60.0).abs() < 6.0),
        )
    }

    fn not_in_the_cell(&self) -> Claim {
        let found: Vec<String> = self.cells.iter().map(|track| listed(&turns(&track.verdict))).collect();
        let all = self.cells.iter().flat_map(|track| turns(&track.verdict));
        let near = all.filter(|turn| (turn - 60.0).abs() < 15.0).count();
        let has = |place: usize, angle: f64| {
            self.cells
                .get(place)
                .is_some_and(|track| turns(&track.verdict).iter().any(|turn| (turn - angle).abs() < 6.0))
        };
        claim(
            &[195],
            "In the active cell model more complicated zigzags with angles of about 135 and 45 degrees appear in Fig. 6(c) and (d).",
            format!(
                "turns of {} degrees at *L* = 29.2, (c), and of {} degrees at 29.6, (d): besides reversals, \
                about 45 in (c) and about 135 in (d)",
                found[0], found[1]
            ),
            "Change of heading at top speed from leg to leg; 45 in (c) and 135 in (d) within 6 degrees, \
            none within 15 of 60. These two lengths are those of the paper; others are in the chapter on \
            Fig. 6.",
            near == 0
                && has(0, 45.0)
                && has(1, 135.0)
                && self.cells.iter().all(|track| track.verdict.regime == Regime::Zigzag),
        )
    }

    /// Mean amplitudes over the mode number.
    pub(super) fn figure(&self, context: &Context<'_>) -> Result<ReportFigure, Error> {
        let series = |track: &Track| ErrorBarSeries {
            label: format!("*L* = {}", track.parameter("length")),
            points: (1..)
                .zip(amplitudes(track))
                .map(|(n, y)| Measured { x: f64::from(n), y, error: 0.0 })
                .collect(),
            joined: true,
        };
        let figure =
            Chart { x_label: "mode *n*".to_owned(), y_label: "mean |*φ_n*|".to_owned(), ..Chart::default() }
                .with(self.cells.iter().map(series));
        let caption = "Which modes of the boundary carry the zigzags of the active cell: time average of \
            |*φ_n*|. Mode 1 is no deformation of its own: it follows from the others where the boundary is \
            nearly closed.";
        Ok(ReportFigure::new(context.sheet(figure)?, caption))
    }
}

fn turns(verdict: &Verdict) -> Vec<f64> {
    let mut turns: Vec<f64> = verdict.legs.iter().map(|turn| turn.to_degrees().abs()).collect();
    ascending(&mut turns);
    turns.dedup_by(|a, b| (*a - *b).abs() < 1.0);
    turns
}

fn listed(turns: &[f64]) -> String {
    turns.iter().map(|turn| format!("{turn:.1}")).collect::<Vec<_>>().join(" and ")
}

/// Time averages of |phi_n|.
fn amplitudes(track: &Track) -> Vec<f64> {
    let column =
        |letter: char, n: usize| track.dataset.trajectory.get(&format!("{letter}{n}")).unwrap_or(&[]);
    let mean = |n: usize| {
        let (c, s) = (column('c', n), column('s', n));
        0.5 * c.iter().zip(s).map(|(c, s)| libm::hypot(*c, *s)).sum::<f64>() / c.len() as f64
    };
    (1..=MODES).map(mean).collect()
}

fn in_words(track: &Track) -> String {
    let numbers: Vec<String> = amplitudes(track).iter().map(|x| format!("{x:.2}")).collect();
    format!("mean |*φ_n*|, *n* = 1 to {MODES}: {}", numbers.join(", "))
}

const HOW: &str = "Time average of the amplitudes over the run; the deformation modes are n = 2 and higher.";

fn fourth(context: &Context<'_>, track: &Track) -> Claim {
    let mean: Vec<f64> = amplitudes(track).into_iter().map(|x| context.number(x)).collect();
    claim(
        &[123, 196],
        "Higher modes such as the fourth are dominant for the zigzag of the active cell (Fig. 6(d)).",
        in_words(track),
        HOW,
        (0..MODES).all(|i| i == 3 || mean[i] < mean[3]),
    )
}

fn fourth_at_the_edge(context: &Context<'_>, track: &Track) -> Claim {
    let mean: Vec<f64> = amplitudes(track).into_iter().map(|x| context.number(x)).collect();
    let says = "The same for Fig. 6(c): the effective modes are *n* = ±4.";
    if (1..MODES).all(|i| i == 3 || mean[i] < mean[3]) {
        return claim(&[151], says, in_words(track), HOW, true);
    }
    differs(
        &[151],
        says,
        in_words(track),
        HOW,
        &format!(
            "near the shortest length with a zigzag, modes 3 and 4 share it: mode 4 is {:.2} times mode 3, and both are over twice mode 2.",
            mean[3] / mean[2]
        ),
        (mean[3] / mean[2] - 1.0).abs() < 0.25 && mean[2] > 2.0 * mean[1] && mean[3] > 2.0 * mean[1],
    )
}
