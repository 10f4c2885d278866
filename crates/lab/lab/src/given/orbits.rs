//! Orbits of a given function: one with rows, or many at given times.

use super::{Flow, Given, Settings, check_start};
use crate::ensemble::{Track, check_times, track_of};
use crate::pool::spread;
use motiform_dynamics::drive::drive;
use motiform_dynamics::{Part, Request, Section, StopOnly, Trajectory, Watch};
use motiform_study::plan::{MOST_IN_MEMORY, check};
use motiform_study::{Ending, Error, Scales};

/// The times of a run. The function is asked for times from `-transient` to `t_end`.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    /// Time before the recording.
    pub transient: f64,
    /// Time recorded.
    pub t_end: f64,
    /// Time between rows; 0 is `t_end / 2000`, infinite is none.
    pub dt_out: f64,
}

impl Span {
    /// Checks the times; the time between rows, if there are rows.
    fn checked(&self, scales: Scales) -> Result<Option<f64>, Error> {
        let Self { transient, t_end, dt_out } = *self;
        scales.check_time("t_end", t_end, true)?;
        scales.check_time("transient", transient, false)?;
        if dt_out == f64::INFINITY {
            return Ok(None);
        }
        let every = if dt_out == 0.0 { t_end / 2000.0 } else { dt_out };
        check("dt_out", every, every > 0.0, "give a time above 0")?;
        let remedy = "this gives more than 20 million rows: give a longer time";
        check("dt_out", every, t_end / every <= MOST_IN_MEMORY, remedy)?;
        Ok(Some(every))
    }
}

/// The recorded orbit of a vector field, with its end.
pub struct Recording {
    /// Rows and crossings; empty if it ended during the transient.
    pub trajectory: Trajectory,
    /// The end of the run.
    pub ending: Ending,
    /// The last state.
    pub last: Vec<f64>,
}

/// The orbit of `flow` from `start`, with rows from dense output and the crossings of `sections`. What happens on the way, a blow-up too,
/// is part of the result.
///
/// # Errors
/// A start or times that cannot be.
///
/// # Checked by  tests/all/given.rs: exact solutions, a built-in model's bits, a blow-up at a known time
pub fn record(
    flow: &Flow<'_>,
    start: &[f64],
    span: &Span,
    settings: &Settings,
    sections: &[Section<'_>],
    watch: &dyn Watch,
) -> Result<Recording, Error> {
    let every = span.checked(settings.scales)?;
    check_start(flow, start)?;
    let mut orbit = settings.method.shape_orbit(flow, settings.control, 0.0 - span.transient, start)?;
    let mut trajectory = Trajectory::new(start.len());
    let share = span.transient / (span.transient + span.t_end);
    let early = Part { watch, from: 0.0, to: share };
    let settled =
        drive(orbit.as_mut(), &Request { watch: &early, ..settings.until(0.0, start.len()) }, &mut ())?;
    let ending = if settled.is_complete() {
        let late = Part { watch, from: share, to: 1.0 };
        let request = Request {
            sample_every: every,
            sections,
            watch: &late,
            ..settings.until(span.t_end, start.len())
        };
        Ending::from(drive(orbit.as_mut(), &request, &mut trajectory)?)
    } else {
        Ending::of_transient(settled, span.transient)
    };
    Ok(Recording { trajectory, ending, last: orbit.state().to_vec() })
}

/// The tracks of many orbits at `times` (increasing, the first one at least 0), each with its parameters and its start, on `threads`
/// threads; `None` if the watch stopped it. A track does not depend on the others or on `threads`, if the function's values do not.
///
/// # Errors
/// A start or times that cannot be.
///
/// # Checked by  tests/all/given.rs: against single orbits, on one thread and on three
pub fn tracks(
    given: &dyn Given,
    members: &[(Vec<f64>, Vec<f64>)],
    times: &[f64],
    settings: &Settings,
    threads: usize,
    watch: &dyn Watch,
) -> Result<Option<Vec<Track>>, Error> {
    check_times(times)?;
    spread(members.len(), threads, watch, |jobs| {
        jobs.each(|job| {
            let (parameters, start) = &members[job];
            track(&Flow::new(given, parameters.clone()), start, times, settings, watch)
        });
    })
}

fn track(
    flow: &Flow<'_>,
    start: &[f64],
    times: &[f64],
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<Option<Track>, Error> {
    check_start(flow, start)?;
    let mut orbit = settings.method.shape_orbit(flow, settings.control, 0.0, start)?;
    let request = Request { watch: &StopOnly(watch), ..settings.until(0.0, start.len()) };
    track_of(orbit.as_mut(), times, &request, &<[f64]>::to_vec)
}

impl Settings {
    /// A request to `t_end` for states with `dim` entries, with these bounds.
    fn until<'g>(&self, t_end: f64, dim: usize) -> Request<'g> {
        let Self { max_steps, escape_norm, .. } = *self;
        Request { max_steps, escape_norm, ..Request::until(t_end, dim) }
    }
}
