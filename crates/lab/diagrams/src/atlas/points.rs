//! The points of codimension two of a plane, each once.

use crate::atlas::folder::AtlasFolder;
use crate::atlas::line::StabilityCurve;
use crate::branches::draw::point_words;
use crate::curves::{CurveSample, same_point};
use motiform_continuation::Degenerate;
use motiform_dynamics::in_words;

/// A point of codimension two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpecialPoint<'f> {
    /// The curve on which it was found first.
    pub(crate) on: &'f StabilityCurve,
    /// Its kind.
    pub(crate) kind: Degenerate,
    /// The point of the curve.
    pub(crate) sample: &'f CurveSample,
    /// Lengths of the curve beside it, across and upwards.
    beside: [f64; 2],
}

impl SpecialPoint<'_> {
    /// Its words: `Bautin on the Hopf curve`.
    pub(crate) fn words(&self) -> String {
        let name = point_words(self.kind).unwrap_or_else(|| "not located".to_owned());
        format!("{name} on the {} curve", in_words(self.on.curve.kind.name()))
    }
}

/// The points of codimension two on all curves. One that was found from several curves of one kind, or twice on one, is one point.
pub(crate) fn special_points(folder: &AtlasFolder) -> Vec<SpecialPoint<'_>> {
    let widths = folder.plan.plane().map(|side| side.to - side.from);
    let curves = folder.lines.iter().flat_map(|line| &line.curves);
    let mut all: Vec<SpecialPoint<'_>> = Vec::new();
    for point in curves.flat_map(on_curve) {
        let is_known = all.iter().any(|known| {
            known.on.curve.kind == point.on.curve.kind
                && same_point([known, &point].map(|one| (one.sample, one.beside)), widths)
        });
        if !is_known {
            all.push(point);
        }
    }
    all
}

fn on_curve(on: &StabilityCurve) -> Vec<SpecialPoint<'_>> {
    let samples: Vec<&CurveSample> = on.curve.samples().collect();
    let point = |(place, sample): (usize, &&'_ CurveSample)| {
        let near = [place.saturating_sub(1), (place + 1).min(samples.len() - 1)].map(|place| samples[place]);
        let beside = [0, 1].map(|side| {
            let off = near.map(|other| (other.parameters[side] - sample.parameters[side]).abs());
            off[0].max(off[1])
        });
        Some((place, sample.degenerate?, beside))
    };
    let found: Vec<(usize, Degenerate, [f64; 2])> = samples.iter().enumerate().filter_map(point).collect();
    found
        .into_iter()
        .map(|(place, kind, beside)| SpecialPoint { on, kind, sample: samples[place], beside })
        .collect()
}
