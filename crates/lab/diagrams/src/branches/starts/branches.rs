//! A point of a branch.

use super::{Asked, StartPoint};
use crate::{BranchFolder, Followed, Sample};
use motiform_continuation::Motion;
use motiform_dynamics::digits::six_decimals;
use motiform_study::plan::Named;
use motiform_study::{Error, Given};
use std::path::Path;

/// The point `BRANCH:POINT` of the branches in a folder.
pub(super) fn point(asked: &Asked<'_>, folder: &Path) -> Result<StartPoint, Error> {
    let BranchFolder { plan, found } = BranchFolder::read(folder)?;
    let branches = &found.branches;
    let list = || listed(asked, branches);
    let (branch, point) = match asked.point {
        None => return Err(asked.wrong(format!("say which point: {}", list()))),
        Some(point) => point.split_once(':').unwrap_or((point, "")),
    };
    let chosen = branch.parse().ok().and_then(|number: usize| branches.get(number));
    let followed = chosen.ok_or_else(|| asked.wrong(format!("there is no branch {branch:?}: {}", list())))?;
    let sample = point.parse().ok().and_then(|number| followed.samples().nth(number)).ok_or_else(|| {
        let problem = if point.is_empty() {
            "say which point".to_owned()
        } else {
            format!("there is no point {point:?}")
        };
        asked.wrong(format!(
            "{problem}: branch {branch} has points 0 to {}{}",
            last(followed),
            specials(followed)
        ))
    })?;
    let value = sample.point.parameter;
    let names = plan.computation.start.parameters.0.iter().map(|entry| entry.0.clone());
    Ok(StartPoint {
        text: asked.text.to_owned(),
        model: Some(plan.computation.start.model.clone()),
        name: Some(plan.name.clone()),
        parameters: Named(names.zip(plan.parameters_at(value)).collect()),
        state: state(&plan, sample)?,
        given: given(&sample.point.motion),
    })
}

fn given(motion: &Motion) -> Given {
    match motion {
        Motion::Equilibrium(_) => Given::Equilibrium,
        Motion::Orbit { orbit, .. } => {
            Given::Orbit { time: orbit.time, angle: orbit.angle, mirrored: orbit.mirrored }
        }
    }
}

/// The shape by the names of its coordinates.
fn state(plan: &motiform_study::BranchPlan, sample: &Sample) -> Result<Named, Error> {
    let values = plan.parameters_at(sample.point.parameter);
    let names = plan.info()?.coordinates(&values).iter().map(|coordinate| coordinate.name.to_owned());
    Ok(Named(names.zip(sample.reading.state.iter().copied()).collect()))
}

fn last(followed: &Followed) -> usize {
    followed.samples().count().saturating_sub(1)
}

/// The branches in words, so that a point can be chosen.
fn listed(asked: &Asked<'_>, branches: &[Followed]) -> String {
    let line = |(number, followed): (usize, &Followed)| {
        let values = followed.samples().map(|sample| sample.point.parameter);
        let (low, high) =
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let motion = followed.named().map_or("", |part| part.motion.name());
        let last = last(followed);
        format!(
            "\n  {}:{number}:0 to {number}:{last}  {motion}, {} to {}{}",
            asked.shown(),
            six_decimals(low),
            six_decimals(high),
            specials(followed)
        )
    };
    let lines: String = branches.iter().enumerate().map(line).collect();
    format!("give FOLDER:BRANCH:POINT, as in the columns branch and point of points.parquet{lines}")
}

/// Most special points that are listed.
const LISTED: usize = 6;

/// The special points of a branch with their numbers.
fn specials(followed: &Followed) -> String {
    let all = followed.samples().enumerate().filter_map(|(number, sample)| {
        let special = sample.point.special?;
        Some(format!("{number} {} at {}", special.name(), six_decimals(sample.point.parameter)))
    });
    let some: Vec<String> = all.take(LISTED).collect();
    if some.is_empty() { String::new() } else { format!("; special: {}", some.join(", ")) }
}
