//! The numbers of the persistent random walk that are stated, and why the others are not: one answer for text, pages, tables and JSON.

use motiform_inference::{Bounded, PersistentWalk, WalkTests};
use motiform_statistics::{Answer, Measured};
use serde::Serialize;

/// Why there is no walk.
pub(super) const TOO_FEW: &str = "fewer than 12 displacements, or none at all";

/// Why there is no error of the places.
const SMOOTH: &str = "displacements from frame to frame are smaller than those of a walk without errors, as those of places that are means \
                      over an exposure; they show no error";

/// A number of the walk, or why it is not stated.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OfWalk {
    /// The value; `None` where the reason is given.
    pub value: Option<f64>,
    /// Lower end of its 95 % interval, or the bound that the record sets without a value.
    pub low: Option<f64>,
    /// Upper end, in the same way.
    pub high: Option<f64>,
    /// The reason why there is no value, without the bound.
    pub reason: Option<String>,
}

impl OfWalk {
    fn none(reason: String) -> Self {
        Self { value: None, low: None, high: None, reason: Some(reason) }
    }

    /// There is no value where the record sets no bound to one side.
    fn of(Bounded { value, low, high }: Bounded, name: &str, rests: bool) -> Self {
        let reason = match (low, high) {
            (Some(low), Some(high)) => {
                let (low, high) = (Some(low.min(value)), Some(high.max(value)));
                return Self { value: Some(value), low, high, reason: None };
            }
            (None, _) if rests => "no motion is seen beside the errors of the places".to_owned(),
            (None, Some(_)) => format!("the frames do not resolve a shorter {name}"),
            (Some(_), None) => format!("the record sets no upper bound to the {name}"),
            (None, None) => format!("the record sets no bound to the {name}"),
        };
        Self { value: None, low, high, reason: Some(reason) }
    }

    /// The value with its interval, or why there is none.
    pub(super) fn answer(&self) -> Answer {
        match (self.value, &self.reason) {
            (Some(value), _) => {
                Answer::Known(Measured { value, interval: self.low.zip(self.high).map(<[f64; 2]>::from) })
            }
            (None, reason) => Answer::unknown(reason.clone().unwrap_or_default()),
        }
    }
}

/// The walk as it is stated.
///
/// # Units   of the data
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StatedWalk {
    /// Persistence time P.
    pub persistence: OfWalk,
    /// Root mean square speed S of the walk itself.
    pub speed: OfWalk,
    /// Diffusion coefficient D = S^2 P/2.
    pub diffusion: OfWalk,
    /// Standard deviation of the error of a coordinate.
    pub error: OfWalk,
    /// The reason why no walk describes the path; `None` where one does.
    pub reason: Option<String>,
    /// The tests of the walk of highest likelihood; `None` without one.
    pub tests: Option<WalkTests>,
}

impl StatedWalk {
    /// `without`: the reason why there is no walk at all.
    pub(super) fn of(walk: Option<&PersistentWalk>, without: &str, drift: Option<&str>) -> Self {
        let all = |reason: String| {
            let [persistence, speed, diffusion, error] = [(); 4].map(|()| OfWalk::none(reason.clone()));
            Self { persistence, speed, diffusion, error, reason: Some(reason), tests: None }
        };
        let Some(walk) = walk else { return all(without.to_owned()) };
        let tests = Some(walk.tests);
        if let Some(misfit) = walk.misfit() {
            return Self { tests, ..all(format!("no persistent random walk describes the path: {misfit}")) };
        }
        if let Some(drift) = drift {
            return Self { tests, ..all(drift.to_owned()) };
        }
        let number = |bounded, name| OfWalk::of(bounded, name, walk.rests);
        Self {
            persistence: number(walk.persistence, "persistence time"),
            speed: number(walk.speed, "speed"),
            diffusion: number(walk.diffusion, "diffusion coefficient"),
            error: match walk.error_variance.high {
                Some(high) if high < 0.0 => OfWalk::none(SMOOTH.to_owned()),
                _ => number(walk.error, "error"),
            },
            reason: None,
            tests,
        }
    }
}

/// The walk of one cell, or of many together, as [`crate::MotionStatistics`] have it.
///
/// # Units   of the data
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WalkNumbers {
    /// Persistence time P.
    pub persistence: Answer,
    /// Root mean square speed S of the walk itself.
    pub speed: Answer,
    /// Diffusion coefficient D.
    pub diffusion: Answer,
}

impl WalkNumbers {
    /// No numbers, for this reason.
    pub(crate) fn unknown(reason: &str) -> Self {
        let [persistence, speed, diffusion] = [(); 3].map(|()| Answer::unknown(reason));
        Self { persistence, speed, diffusion }
    }
}

impl From<&StatedWalk> for WalkNumbers {
    fn from(walk: &StatedWalk) -> Self {
        let [persistence, speed, diffusion] =
            [&walk.persistence, &walk.speed, &walk.diffusion].map(OfWalk::answer);
        Self { persistence, speed, diffusion }
    }
}
