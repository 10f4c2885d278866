//! Where a branch is stable.

use super::origin::Origin;
use super::result::{Branches, Followed, Leg, Sample};
use motiform_analysis::regime::Regime;
use motiform_continuation::Point;
use motiform_figures::Stability;

/// Ranges of the parameter over which a branch is stable, in its order, each from the smaller to the larger value. They end at special
/// points, or where the branch does.
pub fn stretches(found: &Branches, followed: &Followed) -> Vec<[f64; 2]> {
    let samples: Vec<&Sample> = followed.samples().collect();
    let all =
        birth(found, followed).map_or_else(|| through(followed, &samples), |birth| from(birth, followed));
    if followed.is_closed() { joined(&samples, all) } else { all }
}

/// Those of a branch that goes through its start.
fn through(followed: &Followed, samples: &[&Sample]) -> Vec<[f64; 2]> {
    let mut all = along(samples);
    if let [back, .., ahead] | [back @ ahead] = &followed.legs[..] {
        let backwards: Vec<&Sample> = samples.iter().rev().copied().collect();
        if followed.legs.len() > 1 {
            to_end(&backwards, back, all.first_mut());
        }
        to_end(samples, ahead, all.last_mut());
    }
    all
}

/// Those of a branch that begins at the special point `birth`.
fn from(birth: f64, followed: &Followed) -> Vec<[f64; 2]> {
    let leg = |leg: &Leg| {
        let samples: Vec<&Sample> = leg.samples.iter().collect();
        let mut all = along(&samples);
        to_end(&samples, leg, all.last_mut());
        // no level changes its sign between the special point and the first point after it
        if let ([first, second, ..], Some(range)) = (&samples[..], all.first_mut())
            && is_stable(first, second)
        {
            *range = [range[0].min(birth), range[1].max(birth)];
        }
        all
    };
    match &followed.legs[..] {
        [back, ahead] => leg(back).into_iter().rev().chain(leg(ahead)).collect(),
        legs => legs.iter().flat_map(leg).collect(),
    }
}

/// Extends the last range over `samples` to the place where the leg ends: no level changes its sign on the way there.
fn to_end(samples: &[&Sample], leg: &Leg, last: Option<&mut [f64; 2]>) {
    if let ([.., before, end], Some(range), Some(parameter)) = (samples, last, leg.end.parameter())
        && is_stable(before, end)
    {
        *range = [range[0].min(parameter), range[1].max(parameter)];
    }
}

/// The ranges of a branch that comes back to its start: one that reaches over the start is one range.
fn joined(samples: &[&Sample], mut all: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    if let ([first, second, .., before, last], [_, _, ..]) = (samples, &all[..])
        && is_stable(first, second)
        && is_stable(before, last)
        && let Some([low, high]) = all.pop()
    {
        all[0] = [all[0][0].min(low), all[0][1].max(high)];
    }
    all
}

/// The same along some samples.
fn along(samples: &[&Sample]) -> Vec<[f64; 2]> {
    let mut all: Vec<[f64; 2]> = Vec::new();
    let mut open: Option<[f64; 2]> = None;
    for pair in samples.windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|sample| sample.point.parameter);
        let joint = pair[0].point.special.is_some();
        if !is_stable(pair[0], pair[1]) {
            all.extend(open.take());
        } else if let Some(range) = open.as_mut().filter(|_| !joint || goes_on(samples, pair[0])) {
            *range = [range[0].min(a).min(b), range[1].max(a).max(b)];
        } else {
            all.extend(open.replace([a.min(b), a.max(b)]));
        }
    }
    all.extend(open);
    all
}

/// The parameter of the special point where a branch begins.
fn birth(found: &Branches, followed: &Followed) -> Option<f64> {
    let Origin::Special { branch, leg, point } = followed.origin else { return None };
    Some(found.branches.get(branch)?.legs.get(leg)?.samples.get(point)?.point.parameter)
}

/// The name of the motion on a stretch between neighbours: a special point itself may have more symmetry.
pub fn motion_between(a: &Sample, b: &Sample) -> Regime {
    let named = if a.point.special.is_none() { a } else { b };
    named.reading.motion
}

/// Returns `true` if a stretch between neighbours is stable: a special point itself is neither.
pub fn is_stable(a: &Sample, b: &Sample) -> bool {
    nothing_grows(a, b) && !is_neutral(a, b)
}

/// The stability of a stretch between neighbours, as it is drawn.
pub(crate) fn stability(a: &Sample, b: &Sample) -> Stability {
    match (nothing_grows(a, b), is_neutral(a, b)) {
        (false, _) => Stability::Unstable,
        (true, true) => Stability::Neutral,
        (true, false) => Stability::Stable,
    }
}

fn nothing_grows(a: &Sample, b: &Sample) -> bool {
    holds(a, b, |point| point.unstable == 0)
}

/// Returns `true` if a growth rate is 0 within its error on a stretch between neighbours.
fn is_neutral(a: &Sample, b: &Sample) -> bool {
    holds(a, b, |point| point.neutral > 0)
}

/// Returns `true` if this holds at both neighbours, or at the one that is no special point.
fn holds(a: &Sample, b: &Sample, at: impl Fn(&Point) -> bool) -> bool {
    let known = |sample: &Sample| sample.point.special.is_none().then(|| at(&sample.point));
    let (a, b) = (known(a), known(b));
    a.or(b).unwrap_or(false) && b.or(a).unwrap_or(false)
}

/// Ranges of the parameter over which nothing grows and a growth rate is 0 within its error, in the order of the branch: stability is not
/// determined there.
pub fn neutral_stretches(followed: &Followed) -> Vec<[f64; 2]> {
    let samples: Vec<&Sample> = followed.samples().collect();
    let pairs: Vec<[&Sample; 2]> = samples.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let grows = |sample: &Sample| sample.point.unstable > sample.point.neutral;
    let runs = pairs.chunk_by(|a, b| neutral(a, &grows) == neutral(b, &grows));
    let range = |run: &[[&Sample; 2]]| {
        let values = run.iter().flatten().map(|sample| sample.point.parameter);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    };
    runs.filter(|run| neutral(&run[0], &grows)).map(range).collect()
}

/// Returns `true` if a pair is neutral and nothing else grows.
fn neutral([a, b]: &[&Sample; 2], grows: &dyn Fn(&Sample) -> bool) -> bool {
    is_neutral(a, b) && !grows(a) && !grows(b)
}

/// Returns `true` if the parameter goes on in one direction through a special point: it does not at a fold.
fn goes_on(samples: &[&Sample], at: &Sample) -> bool {
    let Some(place) = samples.iter().position(|sample| std::ptr::eq(*sample, at)) else { return false };
    let parameter = |place: usize| samples.get(place).map(|sample| sample.point.parameter);
    match (place.checked_sub(1).and_then(parameter), parameter(place), parameter(place + 1)) {
        (Some(before), Some(here), Some(after)) => (here - before) * (after - here) > 0.0,
        _ => false,
    }
}
