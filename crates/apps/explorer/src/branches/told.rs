//! Branches in the form of the protocol.

use super::Known;
use crate::body::short;
use crate::protocol::{BranchTold, SpecialPoint, Specials};
use motiform_diagrams::draw::Ordinate;
use motiform_diagrams::{Followed, Origin, Sample, SpecialEntry, is_stable, motion_between};

/// Enough digits for a picture, and for a value of the parameter.
const DIGITS: (usize, usize) = (6, 10);

/// A branch with this number.
pub(super) fn branch(known: &Known, number: usize) -> Option<BranchTold> {
    let followed = known.found.branches.get(number)?;
    let samples: Vec<&Sample> = followed.samples().collect();
    let read = |value: &dyn Fn(&Sample) -> f64, digits| {
        samples.iter().map(|sample| short(value(sample), digits)).collect::<Vec<_>>()
    };
    Some(BranchTold {
        epoch: known.epoch,
        branch: number,
        origin: origin(known, followed.origin),
        parameter: read(&|sample| sample.point.parameter, DIGITS.1),
        speed: read(&|sample| sample.reading.speed[0], DIGITS.0),
        period: read(&|sample| sample.reading.period.unwrap_or(0.0), DIGITS.0),
        motion: samples.iter().map(|sample| sample.reading.motion.name()).collect(),
        unstable: samples.iter().map(|sample| sample.point.unstable).collect(),
        neutral: samples.iter().map(|sample| sample.point.neutral).collect(),
        between: samples.windows(2).map(|pair| motion_between(pair[0], pair[1]).name()).collect(),
        stable: samples.windows(2).map(|pair| is_stable(pair[0], pair[1])).collect(),
    })
}

/// The special point where a branch begins: its branch, and its place there.
fn origin(known: &Known, origin: Origin) -> Option<[usize; 2]> {
    let Origin::Special { branch, leg, point } = origin else { return None };
    let parent = known.found.branches.get(branch)?;
    let sample = parent.legs.get(leg)?.samples.get(point)?;
    let place = parent.samples().position(|other| std::ptr::eq(other, sample))?;
    Some([branch, place])
}

/// The special points of all branches: with every branch more is known of those before.
pub(super) fn specials(known: &Known) -> Specials {
    let branches = known.found.branches.iter().enumerate();
    let points = branches.flat_map(|(number, followed)| {
        let entries = known.found.special(number).into_iter();
        entries.filter_map(move |entry| special(number, followed, &entry))
    });
    Specials { epoch: known.epoch, points: points.collect() }
}

fn special(branch: usize, followed: &Followed, entry: &SpecialEntry) -> Option<SpecialPoint> {
    let same = |sample: &Sample| {
        sample.point.special.is_some_and(|special| special.name() == entry.kind)
            && sample.point.parameter.to_bits() == entry.parameter.to_bits()
    };
    let point = followed.samples().position(same).or_else(|| nearest_end(followed, entry.parameter))?;
    Some(SpecialPoint {
        branch,
        point,
        kind: entry.kind,
        parameter: short(entry.parameter, DIGITS.1),
        speed: entry.connection.as_ref().and_then(|connection| {
            let last = || followed.samples().nth(point).map(|sample| sample.reading.speed[0]);
            Ordinate::Speed.at(connection).or_else(last).map(|speed| short(speed, DIGITS.0))
        }),
        period: entry.period.map(|period| short(period, DIGITS.1)),
        criticality: entry.criticality.filter(|word| *word != "undecided"),
        breaks: entry.breaks,
        leads: entry.branch,
    })
}

/// A connection is no point of the branch: the end of the branch next to it.
fn nearest_end(followed: &Followed, parameter: f64) -> Option<usize> {
    let samples: Vec<&Sample> = followed.samples().collect();
    let far = |place: usize| samples.get(place).map(|sample| (sample.point.parameter - parameter).abs());
    let last = samples.len().checked_sub(1)?;
    Some(if far(0)? < far(last)? { 0 } else { last })
}
