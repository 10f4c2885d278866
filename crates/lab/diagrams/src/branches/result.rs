//! The results of following branches: points, legs, branches and links.

use super::origin::Origin;
use super::reading::Reading;
use super::sweep::Sweeps;
use motiform_continuation::{End, Motion, Point};
use serde::{Deserialize, Serialize};

/// A point of a branch with what is read off it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// The point. The nodes of an orbit are kept where a branch may begin: at special points, first and last ones.
    pub point: Point,
    /// The reading.
    pub reading: Reading,
}

/// A branch from where it begins to one of its ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Leg {
    /// Its points, the first one where it begins.
    pub samples: Vec<Sample>,
    /// Why it ended.
    pub end: End,
}

impl Leg {
    /// Returns `true` if the leg ends at this of its points because its motion gains a symmetry there: the point then belongs to the motion
    /// of more symmetry.
    pub(super) fn meets_at(&self, point: usize) -> bool {
        point + 1 == self.samples.len() && self.meets()
    }

    /// Returns `true` if its motion gains a symmetry at its end.
    pub(super) const fn meets(&self) -> bool {
        matches!(self.end, End::Meets { .. })
    }
}

/// A branch that was followed from its origin, to both sides where it has two.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Followed {
    /// Its origin.
    pub origin: Origin,
    /// One leg, or two with the same first point: towards smaller and towards larger values of the parameter, or to both sides of
    /// where it crosses another branch.
    pub legs: Vec<Leg>,
}

/// The outcome of an origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Link {
    /// The origin.
    pub origin: Origin,
    /// The branch that begins there, or lies there: it may have been followed from elsewhere before. `None` if none was found.
    pub branch: Option<usize>,
    /// Why none was found, where that was refused.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

/// Branches, as far as they are followed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Branches {
    /// The branches in the order in which they were found.
    pub branches: Vec<Followed>,
    /// The outcome of each origin, in the order in which they were asked: one entry for each branch, or one without a branch.
    pub links: Vec<Link>,
    /// Number of origins that were left because there were enough branches.
    pub left: usize,
    /// Number of doublings of the period that were left because as many precede them as are followed in a row.
    #[serde(default)]
    pub doublings_left: usize,
    /// Motions sampled along the parameter, if that was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweeps: Option<Sweeps>,
    /// `true` if everything was done that was asked for: not interrupted.
    pub complete: bool,
}

impl Sample {
    /// Drops the nodes of its orbit.
    pub(super) fn forget_nodes(&mut self) {
        if let Motion::Orbit { nodes, .. } = &mut self.point.motion {
            nodes.clear();
        }
    }
}

impl Leg {
    pub(super) const fn none() -> Self {
        Self { samples: Vec::new(), end: End::Stopped }
    }
}

impl Followed {
    /// Returns `true` if it came to all its ends.
    pub fn is_whole(&self) -> bool {
        self.legs.iter().all(|leg| leg.end != End::Stopped)
    }

    /// Returns `true` if it came back to where it began: another leg would be the same one backwards.
    pub(super) fn is_closed(&self) -> bool {
        self.legs.last().is_some_and(|leg| leg.end == End::Closed)
    }

    /// The largest dimension of the families of motions, each with one value of the parameter, that the branch leads through; 0 where each
    /// of its motions is alone.
    pub fn family(&self) -> usize {
        self.samples().map(|sample| sample.point.family).max().unwrap_or(0)
    }

    /// Its points in order: the first leg backwards, then the second.
    pub fn samples(&self) -> impl Iterator<Item = &Sample> {
        let (first, rest) = self.legs.split_at(self.legs.len().min(1));
        let (back, ahead) = if rest.is_empty() { (&[][..], first) } else { (first, rest) };
        let first = |legs: &[Leg]| legs.first().and_then(|leg| Some(leg.samples.first()?.point.clone()));
        let shared = usize::from(!back.is_empty() && first(back) == first(ahead));
        let back = back.iter().flat_map(|leg| leg.samples.iter().rev());
        back.chain(ahead.iter().flat_map(move |leg| leg.samples.iter().skip(shared)))
    }
}

impl Branches {
    /// The point with these numbers: branch, leg and point.
    pub fn at(&self, [branch, leg, point]: [usize; 3]) -> Option<&Sample> {
        self.branches.get(branch)?.legs.get(leg)?.samples.get(point)
    }

    /// All points with their numbers.
    pub(crate) fn samples(&self) -> impl Iterator<Item = ([usize; 3], &Sample)> {
        let legs = self.branches.iter().enumerate().flat_map(|(branch, followed)| {
            followed.legs.iter().enumerate().map(move |(leg, done)| ([branch, leg], done))
        });
        legs.flat_map(|([branch, leg], done)| {
            done.samples.iter().enumerate().map(move |(point, sample)| ([branch, leg, point], sample))
        })
    }

    /// Without the branch that was interrupted.
    pub(super) fn whole(mut self) -> Self {
        self.branches.retain(Followed::is_whole);
        self.left = 0;
        self.doublings_left = 0;
        self.complete = false;
        self
    }
}
