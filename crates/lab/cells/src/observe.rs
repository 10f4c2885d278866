//! The motion of a cell, from its samples alone: a name only where the record leaves no other, else what is missing.
//!
//! Definitions and limits: docs/cells.md, section 'Observed motion'.

mod course;
mod measures;
mod relatives;
mod repeats;
mod statistics;

pub(crate) use measures::step as step_of;
pub use relatives::{
    Finding, ObservedChaos, ObservedLegs, ObservedRests, ObservedSpectrum, Relatives, Rotation, SpectralPeak,
};
pub use statistics::{AtLag, Memory, MotionStatistics};

use crate::numbers::{WalkNumbers, bare, leaving, walk_of_cells, widened};
use crate::{CellTrack, Numbers, Units, numbers};
use measures::Measures;
use motiform_analysis::regime::Regime;
use motiform_analysis::symmetry::wrap;
use motiform_dynamics::sample::ascending;
use motiform_statistics::{four_digits, with_error};
use repeats::Repeats;
use serde::Serialize;
use std::f64::consts::TAU;

/// Fewest frames that count.
const LEAST_FRAMES: usize = 40;
/// Fewest periods, and fewest full turns of a circle.
const LEAST_REPEATS: f64 = 4.0;
const LEAST_TURNS: f64 = 2.0;
/// Fewest turns within which the heading of a circle forgets its direction: three times the one with which two records of a cell may have
/// two names. The measured time is within a factor of 3 of the true one (in 96 of 100 records of 200 frames).
const LEAST_MEMORY: f64 = 3.0;
/// Standard errors by which a mean must differ from 0.
const CLEAR: f64 = 4.0;
/// A shape that deviates from its mean by more than this part of the radius, and by more than the mean itself, is not that of a
/// straight motion with noise.
const MOST_WOBBLE: f64 = 0.05;
/// Largest scatter of heading (rad), and of speed and turning rate relative to their means, of a steady motion.
const STEADY: f64 = 0.25;
/// Largest change of the speed of a circle over the record, and amplitude with the direction, relative to its mean.
const MOST_COURSE: f64 = 0.1;
/// Largest share of the time without a turn on a circle: where noise scatters the turns by their mean, it is 0.23.
const MOST_STRAIGHT: f64 = 0.3;
/// Smallest scatter of the heading (rad) of a body that goes to and fro, and in units of the error of one heading.
const SWING: (f64, f64) = (0.05, 2.0);
/// Net rotations per period below this (rad) are none.
const NO_TURN: f64 = 0.1;
/// Largest turn over the record (rad) of a straight path, its error included twice.
const MOST_TURN: f64 = 1.0;
/// Share of resamples that must give the same name.
const LEAST_CONFIDENCE: f64 = 0.95;

/// The verdict on an observed motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Motion {
    /// The name; `None`: undecided.
    pub regime: Option<Regime>,
    /// The evidence, or what is missing.
    pub why: String,
    /// Share of resamples (blocks of the record) that give the same name; `None` without a name.
    pub confidence: Option<f64>,
}

/// The observed motion of one cell.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Observation {
    /// Name of the cell.
    pub cell: String,
    /// Frames that count.
    pub frames: usize,
    /// The verdict.
    #[serde(flatten)]
    pub motion: Motion,
    /// Numbers without a model of the shape: speed, path, displacement, persistence, form. They are there for every record.
    pub numbers: Numbers,
    /// The numbers behind the verdict; `None` for records that are too short for them.
    pub measures: Option<Measures>,
    /// The repetition of shape and motion; `None` where there is none.
    pub repeats: Option<Repeats>,
    /// Mean-square displacement and autocorrelations; `None` for records that are too short for them.
    pub statistics: Option<MotionStatistics>,
    /// Spectra, rests, legs, rotation, 0-1 test; `None` for records that are too short for them.
    pub relatives: Option<Relatives>,
}

/// Observes a cell. Noise and chaos cannot be told apart by such a record: motion that neither is steady nor repeats is undecided.
pub fn observe(cell: &CellTrack) -> Observation {
    let frames = cell.frames();
    let bare = |why: String| Observation {
        cell: cell.name.clone(),
        frames,
        motion: Motion { regime: None, why, confidence: None },
        numbers: numbers(cell),
        measures: None,
        repeats: None,
        statistics: None,
        relatives: None,
    };
    if let Some(reason) = cell.modes.inconsistent() {
        return bare(reason);
    }
    if cell.has_no_outlines() {
        return bare("there are positions and no outlines: motions are named by path and shape".to_owned());
    }
    if frames < LEAST_FRAMES {
        let are = |count: usize, one: &str, more: &str| {
            if count == 1 { format!("1 frame {one}") } else { format!("{count} frames {more}") }
        };
        let count = are(frames, "counts", "count");
        let seen = numbers(cell).seen;
        let others = match seen > frames {
            true => format!(
                " ({}: numbers without a model are from all of them, names from those with modes of the radius)",
                are(seen, "is seen", "are seen")
            ),
            false => String::new(),
        };
        return bare(format!("{count}; at least {LEAST_FRAMES} are needed to name a motion{others}"));
    }
    let Some(measures) = Measures::of(&cell.path(), cell.units.times()) else {
        return bare(measures::without(&cell.path(), cell.modes.frames.len(), &cell.units.time));
    };
    let repeats = Repeats::of(&measures);
    let (regime, why) = decide(&measures, cell, repeats.as_ref());
    let motion = match regime {
        None => Motion { regime, why, confidence: None },
        Some(_) => resampled(&measures, regime, why, cell, repeats.as_ref()),
    };
    let motion = beside_drift(cell, motion);
    let relatives = Some(Relatives::of(&measures));
    let numbers = numbers(cell);
    let walk = match motion.regime {
        Some(Regime::Circular) => {
            WalkNumbers::unknown("the heading turns steadily: this is no persistent random walk")
        }
        _ => WalkNumbers::from(&numbers.stated_walk),
    };
    let statistics = statistics::of_records(std::iter::once(&measures.series), walk).map(|mut found| {
        let persistence = numbers.walk.as_ref().map(|walk| walk.persistence.value);
        found.displacement = widened(found.displacement, measures.duration, persistence);
        found
    });
    let cell = cell.name.clone();
    Observation { cell, frames, motion, numbers, measures: Some(measures), repeats, statistics, relatives }
}

/// The verdict, if enough resamples of the record agree with it: that is how sure it is of this record, not of another one.
fn resampled(
    measures: &Measures,
    regime: Option<Regime>,
    why: String,
    cell: &CellTrack,
    repeats: Option<&Repeats>,
) -> Motion {
    let same = measures.resampled().filter(|other| decide(other, cell, repeats).0 == regime).count();
    let confidence = same as f64 / measures::RESAMPLES as f64;
    if confidence >= LEAST_CONFIDENCE {
        return Motion { regime, why, confidence: Some(confidence) };
    }
    let why = format!("{why}; but only {:.0} % of the resamples of this record say so", 100.0 * confidence);
    Motion { regime: None, why, confidence: None }
}

/// The verdict, if the path without the velocity that all cells have in common leads to the same one, and velocities do not differ from
/// place to place.
fn beside_drift(cell: &CellTrack, motion: Motion) -> Motion {
    if cell.flows && motion.regime.is_some() {
        let why = format!(
            "{}; but velocities of the cells differ from place to place: this may be the motion of its surroundings",
            motion.why
        );
        return Motion { regime: None, why, confidence: None };
    }
    let Some(velocity) = cell.drift.filter(|_| motion.regime.is_some()) else { return motion };
    let still = Measures::of(&cell.path_without(velocity), cell.units.times());
    let other = still.and_then(|m| decide(&m, cell, Repeats::of(&m).as_ref()).0);
    if other == motion.regime {
        return motion;
    }
    let why = format!(
        "{}; but all cells drift together, and without that velocity it is {}: the correction 'drift' subtracts it, if it is that of the \
         stage",
        motion.why,
        other.map_or("undecided", Regime::name)
    );
    Motion { regime: None, why, confidence: None }
}

/// Statistics over cells, each with the weight of its length: intervals are those over cells where there are 8 and more. Cells of
/// another sampling interval than most are left out; `None` without a cell that is long enough.
pub fn population_statistics(found: &[Observation]) -> Option<(usize, MotionStatistics)> {
    let all: Vec<_> = found.iter().filter_map(|one| Some(&one.measures.as_ref()?.series)).collect();
    let mut intervals: Vec<f64> = all.iter().map(|series| series.dt).collect();
    ascending(&mut intervals);
    let usual = *intervals.get(intervals.len() / 2)?;
    let alike = || all.iter().copied().filter(|series| (series.dt / usual - 1.0).abs() < 1e-3);
    let statistics = statistics::of_records(alike(), walk_of_cells(found))?;
    let displacement = bare(statistics.displacement, leaving(found).is_some());
    Some((alike().count(), MotionStatistics { displacement, ..statistics }))
}

/// The motion of these numbers, or what is missing.
fn decide(m: &Measures, cell: &CellTrack, repeats: Option<&Repeats>) -> (Option<Regime>, String) {
    let (radius, units) = (cell.radius, &cell.units);
    if m.displacement < CLEAR * m.displacement_error {
        return rest(m, units);
    }
    let steady_speed = m.speed_scatter < STEADY;
    if steady_speed && m.heading_scatter < STEADY && m.directness > 0.97 {
        if let Some(why) = arc(m, units) {
            return (None, why);
        }
        if m.shape_wobble > (MOST_WOBBLE * radius).max(m.mean_shape) {
            let why = format!(
                "the path is straight, but the shape changes by {:.1} % of the radius: more than its mean deformation, \
                 and a body that moves straight keeps its shape",
                100.0 * m.shape_wobble / radius
            );
            return (None, why);
        }
        let why = format!(
            "straight over a path of {} {}: net displacement is {:.1} % of the path, and the turning rate, {}, is within {CLEAR} of its \
             errors of 0: less than {MOST_TURN} rad over the record",
            four_digits(m.length),
            units.length,
            100.0 * m.directness,
            rate(m, units)
        );
        return (Some(Regime::Straight), why);
    }
    let turns = m.turning.abs() * m.duration / TAU;
    let clear_turn = m.turning.abs() > CLEAR * m.turning_error;
    if steady_speed && clear_turn && m.turning_scatter < STEADY && m.shape_scatter < STEADY {
        if turns < LEAST_TURNS {
            let why = format!("it turns steadily, but {turns:.1} turns were seen; {LEAST_TURNS} are needed");
            return (None, why);
        }
        if m.straight_share > MOST_STRAIGHT {
            let why = format!(
                "{turns:.1} turns, but not at a steady rate: the heading keeps its direction in {:.0} % of the time, as on legs \
                 between corners",
                100.0 * m.straight_share
            );
            return (None, why);
        }
        let memory = m.heading_memory();
        if memory * m.turning.abs() < LEAST_MEMORY * TAU {
            let why = format!(
                "{turns:.1} turns, but not at a steady rate: noise turns the heading, too, which forgets its direction within {} {}, {:.1} \
                 turns, where {LEAST_MEMORY} turns are needed; another record of such a cell may go otherwise",
                four_digits(memory),
                units.time,
                memory * m.turning.abs() / TAU
            );
            return (None, why);
        }
        if let Some(why) = unsteady(m) {
            return (None, format!("{turns:.1} turns at a steady rate, but {why}"));
        }
        let steady = format!("{turns:.1} turns at a steady rate, {}", rate(m, units));
        let why = match m.drift.filter(|[speed, error]| *speed > CLEAR * error) {
            Some([speed, error]) => format!(
                "{steady}, each of them displaced: a circle that drifts by {} {}/{}",
                with_error(speed, error),
                units.length,
                units.time
            ),
            None => format!("{steady}, and a steady speed"),
        };
        return (Some(Regime::Circular), why);
    }
    match repeats {
        Some(repeats) => repeating(repeats, m, units),
        None => {
            let why = "neither steady nor repeating in speed and shape (by correlations of the speed, and of z2 beside the heading, one \
             period later; paths that repeat alone are not looked for): noise and chaos cannot be told apart by samples alone; equations \
             fitted to them can decide";
            (None, why.to_owned())
        }
    }
}

/// The reason why a path that is nearly straight is not named so: it turns, or may turn.
fn arc(m: &Measures, units: &Units) -> Option<String> {
    let (turn, error) = (m.turning * m.duration, m.turning_error * m.duration);
    if m.turning.abs() > CLEAR * m.turning_error {
        return Some(format!(
            "the path is nearly straight, but turns by {} rad over the record, {}: {} turns of a circle, and {LEAST_TURNS} are needed to \
             name one",
            with_error(turn, error),
            rate(m, units),
            four_digits(turn.abs() / TAU)
        ));
    }
    (turn.abs() + 2.0 * error > MOST_TURN).then(|| {
        format!(
            "the path is nearly straight, but the record does not exclude a turn by {MOST_TURN} rad: {} rad",
            with_error(turn, error)
        )
    })
}

/// The course of the speed of a cell that turns steadily, if it has one: a circle of the models has one speed.
fn unsteady(m: &Measures) -> Option<String> {
    if m.speed_axis > MOST_COURSE {
        return Some(format!(
            "the speed changes by {:.0} % of its mean with the direction, twice per turn: an ellipse, or lengths that differ along x and y",
            200.0 * m.speed_axis
        ));
    }
    (m.speed_trend.abs() > MOST_COURSE).then(|| {
        let what = if m.speed_trend < 0.0 { "falls" } else { "grows" };
        format!("the speed {what} by {:.0} % of its mean over the record", 100.0 * m.speed_trend.abs())
    })
}

/// The turning rate with its error and unit.
fn rate(m: &Measures, units: &Units) -> String {
    format!("{} rad/{}", with_error(m.turning, m.turning_error), units.time)
}

fn rest(m: &Measures, units: &Units) -> (Option<Regime>, String) {
    if m.wandering >= CLEAR {
        let why = format!(
            "displacements from frame to frame are within {CLEAR} of their errors, but over the record the cell \
             wanders, {:.0} errors from its mean place: it moves, or the stage drifts",
            m.wandering
        );
        return (None, why);
    }
    if m.shape_change < CLEAR {
        let errors = format!("their errors, {} {}", four_digits(m.displacement_error), units.length);
        let why = match m.displacement {
            0.0 => format!(
                "displacements do not exceed {errors}, and changes of shape are within {CLEAR} of theirs"
            ),
            size => format!(
                "displacements of {} {} are within {CLEAR} of {errors}, and so are changes of shape",
                four_digits(size),
                units.length
            ),
        };
        return (Some(Regime::Motionless), why);
    }
    (None, "the centre rests within its errors while the shape changes".to_owned())
}

/// Full circles in words.
fn full(circles: i64) -> String {
    match circles.abs() {
        1 => "one full circle".to_owned(),
        more => format!("{more} full circles"),
    }
}

fn repeating(repeats: &Repeats, m: &Measures, units: &Units) -> (Option<Regime>, String) {
    let Repeats { period, periods, likeness, rotation, rotation_error, .. } = repeats;
    let (period, turn) =
        (format!("{} {}", four_digits(*period), units.time), with_error(*rotation, *rotation_error));
    if *periods < LEAST_REPEATS {
        let why = format!(
            "it repeats with a period of {period}, but {periods:.1} periods were seen; {LEAST_REPEATS} are needed"
        );
        return (None, why);
    }
    let seen = format!("repeats {periods:.1} times with a period of {period} (likeness {likeness:.2})");
    // full circles of the heading are no rotation of the motion
    let net = wrap(*rotation);
    let circles = ((rotation - net) / TAU).round() as i64;
    let left = with_error(net, *rotation_error);
    let clear = net.abs() > CLEAR * rotation_error;
    match (*rotation_error < 0.5 * NO_TURN && net.abs() < NO_TURN, circles) {
        _ if clear && net.abs() > NO_TURN && repeats.is_sustained() => {
            (Some(Regime::QuasiPeriodic), format!("{seen}, turned by {left} rad each time"))
        }
        _ if clear && net.abs() > NO_TURN => {
            let why = format!(
                "{seen}, turned by {left} rad each time: quasi-periodic motion, or oscillations that noise sustains about a steady \
                 one; equations fitted to them can decide"
            );
            (None, why)
        }
        (true, 0) if m.heading_scatter < SWING.0.max(SWING.1 * m.heading_error()) => {
            let why = format!(
                "{seen}, but the heading keeps its direction within {} rad: the shape repeats, or the pixels that its outline follows",
                four_digits(m.heading_scatter)
            );
            (None, why)
        }
        (true, 0) => (Some(Regime::Zigzag), format!("{seen} without net rotation: {turn} rad each time")),
        (true, _) if !clear => {
            let why = format!(
                "{seen}; the heading turns through {} each time and is {left} rad off then: a circle that drifts",
                full(circles)
            );
            (Some(Regime::Circular), why)
        }
        (true, _) => {
            let full = full(circles);
            (
                None,
                format!(
                    "{seen}; the heading turns through {full} each time, and {left} rad beyond: a circle that drifts, or a rosette"
                ),
            )
        }
        _ => (None, format!("{seen}; whether it turns a little each time is not clear: {turn} rad")),
    }
}
