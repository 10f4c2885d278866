//! The map: the motions in a window of two parameters, first coarse, then increasingly fine.

mod lattice;
mod map_state;
mod pool;
mod shipped;
mod store;
mod telling;
mod view;
#[cfg(feature = "threads")]
mod work;

use crate::answers::{Answers, Gone};
use crate::export::{Made, Maker};
use crate::protocol::{Evidence, MapWindow, Values};
use crate::task::{Crew, Errand, lock};
#[cfg(feature = "threads")]
use crate::task::{Task as _, thread};
pub(crate) use map_state::FARTHEST;
use map_state::MapState;
use motiform_lab::draw::{exponents, phase_diagram, sheet};
use motiform_lab::scan::{CellSummary, Row, motion_mark, rows_to_csv};
use motiform_study::{Shown, Study};
pub(crate) use pool::Cells;
use pool::Pool;
use serde_json::json;
use std::sync::{Arc, Mutex};
use view::View;

/// The map of a session.
pub(crate) struct Map {
    drive: Drive,
    map_state: Arc<Mutex<MapState>>,
    answers: Answers,
}

#[allow(clippy::large_enum_variant, reason = "who computes the map: one per session")]
enum Drive {
    #[cfg(feature = "threads")]
    Thread(thread::Thread<Job>),
    Pool(Pool),
}

/// A window, over the parameters and with the start of a study.
pub(crate) struct Job {
    pub(crate) window: MapWindow,
    pub(crate) study: Study,
}

impl Map {
    pub(crate) fn new(answers: Answers, crew: &Crew) -> std::io::Result<Self> {
        let map_state = Arc::new(Mutex::new(MapState::default()));
        let drive = match crew {
            #[cfg(feature = "threads")]
            Crew::Threads => {
                let (shared, told) = (Arc::clone(&map_state), answers.clone());
                let work = move |job: Job, current: &thread::Current<'_>| {
                    // A page that has gone takes its session along.
                    let _ = work::compute(&job, &shared, current, &told);
                };
                Drive::Thread(thread::Thread::new(Cells::NAME, Cells::NICE, work)?)
            }
            Crew::Away { post, mappers } => Drive::Pool(Pool::new(post.clone(), *mappers)),
        };
        Ok(Self { drive, map_state, answers })
    }

    /// Computes a window, replacing the one in progress.
    #[cfg_attr(not(feature = "threads"), allow(clippy::needless_pass_by_value, reason = "a thread takes it"))]
    pub(crate) fn show(&self, job: Job) -> Done {
        match &self.drive {
            #[cfg(feature = "threads")]
            Drive::Thread(thread) => {
                thread.put(job);
                Ok(())
            }
            Drive::Pool(pool) => pool.show(&job, &self.map_state, &self.answers),
        }
    }

    /// Stops computing, because the result is no longer needed.
    pub(crate) fn stop(&self) {
        match &self.drive {
            #[cfg(feature = "threads")]
            Drive::Thread(thread) => thread.clear(),
            Drive::Pool(pool) => pool.stop(),
        }
    }

    /// Takes what a helper found.
    pub(crate) fn report(&self, errand: &Errand<'_>) -> Done {
        match &self.drive {
            #[cfg(feature = "threads")]
            Drive::Thread(_) => Ok(()),
            Drive::Pool(pool) => pool.report(errand, &self.map_state, &self.answers),
        }
    }

    /// Returns `true` if the visible map has this parameter as an axis.
    pub(crate) fn has_axis(&self, name: &str) -> bool {
        let map_state = lock(&self.map_state);
        map_state.present().is_some_and(|map| map.plan.computation.axes.iter().any(|axis| axis.name == name))
    }

    /// Number of axes of the visible map.
    pub(crate) fn axes(&self) -> usize {
        lock(&self.map_state).present().map_or(0, |map| map.sides.len())
    }

    /// The verdict on a cell, in the form of the protocol.
    pub(crate) fn evidence(&self, epoch: u32, [i, j]: [u16; 2]) -> Option<Evidence> {
        let mut map_state = lock(&self.map_state);
        let map = map_state.present().filter(|map| map.epoch == epoch)?;
        let at = map.at(usize::from(i), usize::from(j))?;
        let names: Vec<String> = map.plan.computation.axes.iter().map(|axis| axis.name.clone()).collect();
        let parameters: Values =
            names.into_iter().zip(&at).map(|(name, value)| (name, json!(value))).collect();
        let row = map_state.store.get(&at);
        Some(Evidence {
            epoch,
            cell: [i, j],
            parameters,
            regime: row.map(|row| motion_mark(row.regime, row.course).name),
            why: row.map_or_else(String::new, |row| row.why.clone()),
            numbers: row.map(numbers),
        })
    }

    /// Makes a file of the visible cells that are computed.
    pub(crate) fn maker(&self, file: MapFile) -> Maker {
        let known = lock(&self.map_state).rows();
        Box::new(move || {
            let Some((plan, rows)) = known.filter(|(_, rows)| !rows.is_empty()) else { return Ok(None) };
            let cells = || {
                rows.iter()
                    .map(|row| CellSummary::of(row.cell, std::slice::from_ref(row)))
                    .collect::<Vec<_>>()
            };
            Ok(match file {
                MapFile::Csv => Some(Made::Bytes(rows_to_csv(&plan, &rows))),
                MapFile::Diagram => Some(Made::Svg(sheet(&phase_diagram(&plan, &cells())?)?.svg)),
                MapFile::Exponents => match exponents(&plan, &cells(), &Shown::default())? {
                    Some(figure) => Some(Made::Svg(sheet(&figure)?.svg)),
                    None => None,
                },
            })
        })
    }
}

/// The files that can be made of a map.
#[derive(Clone, Copy, Debug)]
pub(crate) enum MapFile {
    Csv,
    Diagram,
    /// The largest Lyapunov exponent along the only axis; none of a map with two.
    Exponents,
}

/// The numbers of a row that are defined.
pub(crate) fn numbers(row: &Row) -> Values {
    let defined = motiform_lab::scan::NUMBERS.iter().zip(row.numbers).filter(|entry| entry.1.is_finite());
    defined.map(|(quantity, value)| (quantity.name.to_owned(), json!(value))).collect()
}

type Done = Result<(), Gone>;

/// Switches to the window of a job, and announces it with what is known of it; `None` for one that cannot be shown.
fn turn(job: &Job, map_state: &Mutex<MapState>, answers: &Answers) -> Result<Option<View>, Gone> {
    let mut seen = lock(map_state);
    if let Err(error) = seen.turn(job, &shipped::TABLES) {
        drop(seen);
        return answers.refused(None, &error.to_string()).map(|()| None);
    }
    let view = View::of(&mut seen, job);
    drop(seen);
    if let Some(view) = &view {
        view.announce(answers)?;
    }
    Ok(view)
}
