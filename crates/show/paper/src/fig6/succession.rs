//! The succession of motions with increasing length.

use super::super::claims::claim;
use super::lengths::Lengths;
use super::tracks::Track;
use motiform_analysis::Regime;
use motiform_dynamics::sample::sort_by_number;
use motiform_figures::report::Claim;

/// The motions that the paper names for the cell.
const NAMED: [Regime; 6] = [
    Regime::Straight,
    Regime::Circular,
    Regime::Rectangular,
    Regime::QuasiPeriodic,
    Regime::Chaotic,
    Regime::Zigzag,
];

/// The first of each with growing length, and what must lie between.
const ORDER: [Regime; 9] = [
    Regime::Motionless,
    Regime::Straight,
    Regime::Circular,
    Regime::Rectangular,
    Regime::Motionless,
    Regime::Chaotic,
    Regime::QuasiPeriodic,
    Regime::Circular,
    Regime::Motionless,
];

pub(super) fn claims(lengths: &Lengths, tracks: &[Track]) -> [Claim; 2] {
    [kinds(lengths, tracks), order(lengths, tracks)]
}

fn kinds(lengths: &Lengths, tracks: &[Track]) -> Claim {
    let count = |regime: Regime| {
        let scanned =
            lengths.0.iter().filter(|point| point.1.motions.iter().any(|m| m.regime == regime)).count();
        let runs = tracks.iter().filter(|track| track.verdict.regime == regime).count();
        (scanned, runs)
    };
    let found = NAMED.map(|regime| (regime, count(regime)));
    let words: Vec<String> = found
        .iter()
        .map(|(regime, (scanned, runs))| {
            format!("{regime} at {scanned} of {} lengths and in {runs} of the four runs", lengths.0.len())
        })
        .collect();
    claim(
        &[136],
        "The active cell model produces these similar dynamics changing only the value of *L*.",
        words.join("; "),
        "random starts at the lengths of the scan, and the runs of Fig. 6(a) to (d): each motion at least once",
        found.iter().all(|(_, (scanned, runs))| scanned + runs > 0),
    )
}

/// The most frequent motions with growing length, without repetitions.
fn order(lengths: &Lengths, tracks: &[Track]) -> Claim {
    let mut seen: Vec<(f64, Regime)> =
        lengths.0.iter().filter_map(|point| Some((point.0, point.1.motions.first()?.regime))).collect();
    seen.extend(tracks.iter().map(|track| (track.parameter("length"), track.verdict.regime)));
    sort_by_number(&mut seen, |a| a.0);
    let mut names: Vec<Regime> =
        seen.iter().map(|entry| entry.1).filter(|regime| *regime != Regime::Undetermined).collect();
    names.dedup();
    let mut rest = names.iter();
    let all = ORDER.iter().all(|wanted| rest.any(|found| found == wanted));
    let words: Vec<&str> = names.iter().map(|regime| regime.name()).collect();
    claim(
        &[139, 189],
        "These motions occur successively by changing the value of *L*.",
        words.join(", "),
        "the most frequent motion at each length, with growing length; motionless, straight, circular, rectangular, motionless, chaotic, \
         quasi-periodic, circular, motionless must occur in this order",
        all,
    )
}
