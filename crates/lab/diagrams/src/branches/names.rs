//! The names of the motions along a branch.

use super::result::{Followed, Sample};
use motiform_analysis::regime::{Course, Form, Regime};
use serde::Serialize;

/// A part of a branch whose motions have one name.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct NamedPart {
    /// The kind of motion.
    pub motion: Regime,
    /// The symmetry that most of its orbits have.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub form: Option<Form>,
    /// The course, if all that have one have the same.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub course: Option<Course>,
    /// The parameter at its first point, in the order of the branch.
    pub from: f64,
    /// The parameter at its last point. The name changes between this one and the first point of the next part.
    pub to: f64,
}

impl Followed {
    /// The parts of the branch in its order. A single point with a name of its own is none: the motion of more symmetry at the point
    /// where a branch begins or ends.
    pub fn parts(&self) -> Vec<NamedPart> {
        let samples: Vec<&Sample> = self.samples().collect();
        let runs = samples.chunk_by(|a, b| a.reading.motion == b.reading.motion);
        let several: Vec<&[&Sample]> = runs.filter(|run| run.len() > 1).collect();
        let mut joined: Vec<Vec<&Sample>> = Vec::new();
        for run in several {
            match joined.last_mut().filter(|last| last[0].reading.motion == run[0].reading.motion) {
                Some(last) => last.extend(run),
                None => joined.push(run.to_vec()),
            }
        }
        joined.iter().map(|run| part(run)).collect()
    }

    /// All points of the motion that most of its points have, as one part.
    pub fn named(&self) -> Option<NamedPart> {
        let samples: Vec<&Sample> = self.samples().collect();
        let regime = most(&samples, |sample| Some(sample.reading.motion), &Regime::ALL)?;
        let own: Vec<&Sample> =
            samples.into_iter().filter(|sample| sample.reading.motion == regime).collect();
        Some(part(&own))
    }
}

/// The part of these points, of which there is one at least.
fn part(samples: &[&Sample]) -> NamedPart {
    let mut courses = samples.iter().filter_map(|sample| sample.reading.direction.course);
    let first = courses.next();
    NamedPart {
        motion: samples[0].reading.motion,
        form: most(samples, |sample| sample.reading.form, &Form::ALL),
        course: first.filter(|&first| courses.all(|course| course == first)),
        from: samples[0].point.parameter,
        to: samples[samples.len() - 1].point.parameter,
    }
}

/// The most frequent name, if there is any; of several the last one in the order of `all`.
fn most<T: Copy + PartialEq>(
    samples: &[&Sample],
    name: impl Fn(&Sample) -> Option<T>,
    all: &[T],
) -> Option<T> {
    let count = |one: T| samples.iter().filter(|sample| name(sample) == Some(one)).count();
    let counted = all.iter().map(|&one| (count(one), one));
    counted.filter(|entry| entry.0 > 0).max_by_key(|entry| entry.0).map(|entry| entry.1)
}
