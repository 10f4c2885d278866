//! Many bodies of one study: other seeds, so other random starts and other noise.

use crate::accuracy::Accuracy;
use crate::ensemble::{Member, Track as Tracked, tracks};
use crate::noisy::{has_noisy_lanes, noisy_tracks};
use crate::pool;
use crate::simulate::simulate;
use crate::statistics::Result;
use crate::statistics::kept::Kept;
use crate::statistics::record::{Measurement, Recorder, at_rest, measured, title};
use motiform_dynamics::{Model, Outcome, Part, StopOnly, Watch};
use motiform_statistics::{Settings, Track};
use motiform_store::Journal;
use motiform_study::{Error, RunPlan, Study};
use serde_json::json;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Most bodies.
pub const MOST: usize = 100_000;

/// The progress that is told when all bodies are computed; their statistics are the rest.
pub const SIMULATED: f64 = 0.5;

/// Bodies that are computed together in lanes: what an interruption loses at most.
const TOGETHER: usize = 64;

/// Statistics of `count` bodies: body k is the run of the study with the seed `seed + k`, its transient left
/// out. They are computed on `threads` threads; those that do not complete (a blow-up, too many steps) are
/// left out and counted. If the watch stops the work, the bodies that are finished are measured.
///
/// Tensor models and amplitude equations of at most four modes run in the lanes of vector registers (see
/// [`tracks`] and [`noisy_tracks`]). The result does not depend on `threads`.
///
/// # Errors
/// Input that a run rejects; bodies that would all be the same (a given start and no noise); [`Error::Interrupted`] if no body was
/// finished.
///
/// # Checked by  tests/all/bodies.rs: bodies against single runs, threads, interruption
pub fn simulated(
    study: &Study,
    count: usize,
    settings: &Settings,
    threads: usize,
    watch: &dyn Watch,
) -> Result<Measurement> {
    simulated_kept(study, count, settings, threads, &(), watch)
}

/// As [`simulated`]; finished bodies go to a journal, and those that it has are not computed again.
///
/// # Errors
/// As [`simulated`], and those of the journal.
pub fn simulated_kept(
    study: &Study,
    count: usize,
    settings: &Settings,
    threads: usize,
    journal: &dyn Journal,
    watch: &dyn Watch,
) -> Result<Measurement> {
    let (plans, kept) = (plans(study, count)?, Kept(journal));
    let noisy = plans[0].computation.noise.is_some();
    let alone = noisy && !has_noisy_lanes(&plans[0])?;
    let part = Part { watch, from: 0.0, to: SIMULATED };
    let found = if alone {
        one_by_one(&plans, &kept, threads, &part)?
    } else {
        in_lanes(&plans, &kept, threads, &part)?
    };
    let mut kept = Vec::new();
    let mut seeds = Vec::new();
    let (mut early, mut missing) = (Vec::new(), 0);
    for (plan, body) in plans.iter().zip(found) {
        match body {
            Some((Outcome::Completed { .. }, track)) => {
                kept.push(track);
                seeds.push(plan.computation.seed);
            }
            Some((outcome, _)) => early.push((plan.computation.seed, outcome)),
            None => missing += 1,
        }
    }
    if kept.is_empty() {
        return Err(match early.first() {
            Some((seed, outcome)) if missing == 0 => {
                Error::NoBody { count, seed: *seed, outcome: outcome.to_string() }
            }
            _ => Error::Interrupted,
        }
        .into());
    }
    let mut notes = notes(&early, missing, count);
    let statistics = measured(&plans[0], kept, settings, &Part { watch, from: SIMULATED, to: 1.0 })?;
    notes.extend(at_rest(&statistics));
    let source = json!({ "plan": plans[0], "plan_hash": plans[0].hash(), "bodies": count });
    let title = title(&plans[0]);
    let plan = plans[0].clone();
    Ok(Measurement { title, plan, source, seeds, notes, complete: missing == 0, statistics })
}

/// The plan of each body.
fn plans(study: &Study, count: usize) -> Result<Vec<RunPlan>> {
    if !(1..=MOST).contains(&count) {
        let remedy = "give a number from 1 to 100000";
        return Err(Error::Setting { key: "bodies", value: count.to_string(), remedy }.into());
    }
    let mut study = study.clone();
    study.return_map = None; // its second pass would be for nothing
    let first = study.run.seed;
    let given = study.initial.iter().any(|(name, _)| !["x", "y"].contains(&name.as_str()));
    if count > 1 && given && RunPlan::new(&study)?.computation.noise.is_none() {
        let remedy = "without noise all bodies with this start are the same: leave out the initial values, or give noise";
        return Err(Error::Setting { key: "bodies", value: count.to_string(), remedy }.into());
    }
    let plan = |body: usize| {
        study.run.seed = first.wrapping_add(body as u64);
        RunPlan::new(&study)
    };
    Ok((0..count).map(plan).collect::<std::result::Result<_, _>>()?)
}

/// The outcome of a body, and its track; `None` if it was stopped.
pub(crate) type Body = Option<(Outcome, Track)>;

/// Runs of their own, with noise, of models without lanes.
fn one_by_one(plans: &[RunPlan], kept: &Kept<'_>, threads: usize, watch: &dyn Watch) -> Result<Vec<Body>> {
    let done = AtomicUsize::new(0);
    let run = |&(number, plan): &(usize, &RunPlan)| {
        if watch.stopped() {
            return Ok(None);
        }
        if let Some([body]) = kept.read(number).as_deref() {
            done.fetch_add(1, Ordering::Relaxed);
            return Ok(body.clone());
        }
        let dataset = simulate(plan, &StopOnly(watch))?;
        let outcome = dataset.manifest.outcome.outcome;
        let model = plan.body()?;
        let accuracy = Accuracy::of(&dataset.manifest);
        let track = crate::statistics::datasets::track(&dataset.trajectory, model.as_ref(), accuracy, 0.0);
        let part = (done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / plans.len() as f64;
        watch.progress(part);
        let body = (!matches!(outcome, Outcome::Interrupted { .. })).then_some((outcome, track));
        if body.is_some() {
            kept.write(number, std::slice::from_ref(&body))?;
        }
        Ok(body)
    };
    let plans: Vec<(usize, &RunPlan)> = plans.iter().enumerate().collect();
    Ok(pool::each(&plans, threads, &(), run)?) // the watch is asked above: what is finished is kept
}

/// Tracks of an ensemble, some bodies at a time.
fn in_lanes(plans: &[RunPlan], kept: &Kept<'_>, threads: usize, watch: &dyn Watch) -> Result<Vec<Body>> {
    plans[0].check_in_memory()?;
    let c = &plans[0].computation;
    let rows = (c.t_end / c.dt_out * (1.0 + 1e-12)).floor() as usize;
    let times: Vec<f64> = (0..=rows).map(|k| c.transient + k as f64 * c.dt_out).collect();
    let model = plans[0].body()?;
    let mut found = Vec::with_capacity(plans.len());
    for (number, chunk) in plans.chunks(TOGETHER).enumerate() {
        let at = |body: usize| body.min(plans.len()) as f64 / plans.len() as f64;
        let part = Part { watch, from: at(number * TOGETHER), to: at((number + 1) * TOGETHER) };
        if let Some(bodies) = kept.read(number * TOGETHER).filter(|bodies| bodies.len() == chunk.len()) {
            found.extend(bodies);
            part.progress(1.0);
            continue;
        }
        let tracks = if c.noise.is_some() {
            noisy_tracks(chunk, threads, &part)?
        } else {
            tracks(&plans[0], &chunk.iter().map(member).collect::<Vec<_>>(), &times, threads, &part)?
        };
        let Some(tracks) = tracks else { break };
        let accuracy = Accuracy::with(c.control, None);
        let body = |track: &Tracked| Some((track.outcome, recorded(model.as_ref(), accuracy, &track.states)));
        let bodies: Vec<Body> = tracks.iter().map(body).collect();
        kept.write(number * TOGETHER, &bodies)?;
        found.extend(bodies);
    }
    found.resize(plans.len(), None);
    Ok(found)
}

fn member(plan: &RunPlan) -> Member {
    let c = &plan.computation;
    Member { parameters: c.parameters.values(), start: c.initial.values() }
}

fn recorded(model: &dyn Model, accuracy: Accuracy, states: &[Vec<f64>]) -> Track {
    let mut recorder = Recorder::new(model, accuracy);
    for state in states {
        let (coordinates, position) = state.split_at(state.len() - 2);
        recorder.push(coordinates, [position[0], position[1]]);
    }
    recorder.finish()
}

fn notes(early: &[(u64, Outcome)], missing: usize, count: usize) -> Vec<String> {
    let mut notes = Vec::new();
    if let Some((seed, outcome)) = early.first() {
        notes.push(format!(
            "{} of {count} bodies are left out, since they did not complete their run (seed {seed}: {outcome})",
            early.len()
        ));
    }
    if missing > 0 {
        notes.push(format!("interrupted: {missing} of {count} bodies were not finished and are left out"));
    }
    notes
}
