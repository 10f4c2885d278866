//! Unfinished sweeps as items of a journal: the points of a direction that are there, and the shape that the next one starts from.

use crate::branches::sweep::SweepPoint;
use motiform_lab::clock::Moment;
use motiform_store::Journal;
use motiform_study::Error;
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::time::Duration;

/// A kill costs this much at most, and writing costs next to nothing.
const EVERY: Duration = Duration::from_secs(1);

/// A direction of a sweep, as far as it is sampled.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Begun {
    pub(crate) points: Vec<SweepPoint>,
    /// The shape at the end of the last run; `None` before the first one, and where that run ended early.
    pub(crate) state: Option<Vec<f64>>,
}

/// The item of one direction.
pub(crate) struct Kept<'j> {
    journal: &'j dyn Journal,
    item: &'static str,
    last: Moment,
}

impl<'j> Kept<'j> {
    pub(crate) fn new(journal: &'j dyn Journal, item: &'static str) -> Self {
        Self { journal, item, last: Moment::now() }
    }

    /// The samples of an earlier run at these values; nothing where there is no such item.
    pub(crate) fn read(&self, values: &[f64]) -> Begun {
        let begun = || serde_json::from_slice::<Begun>(&self.journal.finished(self.item)?).ok();
        let is_part = |begun: &Begun| {
            let parameters = begun.points.iter().map(|point| point.parameter);
            begun.points.len() <= values.len() && parameters.eq(values[..begun.points.len()].iter().copied())
        };
        begun().filter(is_part).unwrap_or_default()
    }

    /// Keeps what is there, now and then.
    pub(crate) fn now_and_then(&mut self, begun: &Begun) -> Result<(), Error> {
        if self.last.elapsed() < EVERY {
            return Ok(());
        }
        self.last = Moment::now();
        self.write(begun)
    }

    /// Keeps what is there.
    pub(crate) fn write(&self, begun: &Begun) -> Result<(), Error> {
        let content =
            serde_json::to_vec(begun).map_err(|error| Error::write_failed(Path::new(self.item), error))?;
        Ok(self.journal.finish(self.item, &content)?)
    }
}
