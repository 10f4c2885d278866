//! The work: branches followed one after the other, each from where the ones before lead to.

use super::arrives::arrives;
use super::family::Bodies;
use super::given::first;
use super::known::known;
use super::origin::{Origin, sides};
use super::reading::Reading;
use super::result::{Branches, Followed, Leg, Link, Sample};
use super::sweep::sweeps;
use crate::settles::settles;
use motiform_continuation::{Allowance, Branch, End, Special};
use motiform_dynamics::{StopOnly, Watch};
use motiform_store::Journal;
use motiform_study::{BranchPlan, DOUBLINGS, Error, Stride};

/// A new branch is compared with the others over so many points, and over fewer and fewer of the later ones: near a special point Newton's
/// method may confuse the branches that meet there.
const COMPARED: usize = 8;

/// The part of a plane that a branch within an allowance goes through.
const PART_OF_PLANE: f64 = 0.3;

/// Takes the branches that there are.
pub type Keep<'k> = dyn FnMut(&Branches) -> Result<(), Error> + 'k;

/// Follows the branches of a plan, after those that `before` holds of an interrupted run.
///
/// Interrupted by the watch, the last branch ends with [`End::Stopped`], and the result is not complete.
///
/// # Errors
/// [`Error::Start`]; what the models and the numerics refuse.
pub fn follow(plan: &BranchPlan, before: Option<Branches>, watch: &dyn Watch) -> Result<Branches, Error> {
    follow_kept(plan, before, &mut |_| Ok(()), &(), watch)
}

/// As [`follow()`]; `keep` gets what there is after each branch, all of it whole, and the journal what is sampled ([`sweeps`]), so that
/// nothing of it is lost however the program ends.
///
/// # Errors
/// As [`follow()`], and those of `keep` and of the journal.
pub fn follow_kept(
    plan: &BranchPlan,
    before: Option<Branches>,
    keep: &mut Keep<'_>,
    journal: &dyn Journal,
    watch: &dyn Watch,
) -> Result<Branches, Error> {
    follow_bodies(&Bodies::new(plan)?, before, keep, journal, watch)
}

/// As [`follow()`]; no more is spent on orbits than the allowance. A branch on which it is spent ends with [`End::Spent`], and what would
/// begin after it is not followed; one that winds about a connection ends with [`End::Settles`].
///
/// # Errors
/// As [`follow()`].
pub fn follow_within(plan: &BranchPlan, allowance: &Allowance, watch: &dyn Watch) -> Result<Branches, Error> {
    follow_bodies(&Bodies::new(plan)?.within(Some(allowance)), None, &mut |_| Ok(()), &(), watch)
}

fn follow_bodies(
    bodies: &Bodies<'_>,
    before: Option<Branches>,
    keep: &mut Keep<'_>,
    journal: &dyn Journal,
    watch: &dyn Watch,
) -> Result<Branches, Error> {
    let plan = bodies.plan;
    let mut work = Branching {
        bodies,
        watch,
        stop: &StopOnly(watch),
        done: before.map(Branches::whole).unwrap_or_default(),
        expected: plan.computation.branches,
    };
    if work.done.branches.is_empty() {
        if !work.begin()? {
            return Ok(work.done);
        }
        keep(&work.done)?;
    }
    while let Some(origin) = work.next() {
        if work.done.branches.len() >= plan.computation.branches || bodies.is_spent() {
            work.done.left = work.open().count();
            break;
        }
        let there = work.done.branches.len();
        work.expected = plan.computation.branches.min(there + work.open().count());
        if !work.grow(origin)? {
            return Ok(work.done);
        }
        if work.done.branches.len() > there {
            keep(&work.done)?;
        }
    }
    work.done.doublings_left = work.unasked().filter(|&origin| work.is_too_deep(origin)).count();
    let mut done = work.done;
    if plan.computation.samples > 0 && done.sweeps.is_none() {
        done.sweeps = sweeps(plan, journal, watch)?;
    }
    done.complete = done.sweeps.is_some() || plan.computation.samples == 0;
    Ok(done)
}

struct Branching<'w> {
    bodies: &'w Bodies<'w>,
    watch: &'w dyn Watch,
    /// For the flow, whose progress is none of the work.
    stop: &'w dyn Watch,
    done: Branches,
    /// Number of branches as far as is known: those there are, and one for each origin that was not asked yet; at first as many as are
    /// followed at most.
    expected: usize,
}

impl Branching<'_> {
    /// The origins that were not asked yet, in the order of the branches, without doublings after too many others.
    fn open(&self) -> impl Iterator<Item = Origin> {
        self.unasked().filter(|&origin| !self.is_too_deep(origin))
    }

    /// Returns `true` at a doubling of the period after as many others as are followed in a row.
    fn is_too_deep(&self, origin: Origin) -> bool {
        let most = self.bodies.plan.computation.stride.doublings.unwrap_or(DOUBLINGS);
        origin.doublings(&self.done.branches) > most
    }

    /// All origins that were not asked yet.
    fn unasked(&self) -> impl Iterator<Item = Origin> {
        let all =
            self.done.branches.iter().enumerate().flat_map(|(number, branch)| Origin::on(number, branch));
        let Stride { steady, from_stable, .. } = self.bodies.plan.computation.stride;
        let found = &self.done.branches;
        let wanted = move |origin: &Origin| {
            let orbits = !steady && (!from_stable || origin.is_on_stable(found));
            orbits || origin.is_steady(self.bodies, found)
        };
        all.filter(|origin| self.done.links.iter().all(|link| link.origin != *origin)).filter(wanted)
    }

    /// The open origin with the shortest period: what begins there is found soonest, and cascades of doublings come last.
    fn next(&self) -> Option<Origin> {
        let cost = |origin: &Origin| origin.cost(&self.done.branches);
        self.open().min_by(|a, b| cost(a).total_cmp(&cost(b)))
    }

    /// Follows the motion of the start. Whether it came to its end.
    fn begin(&mut self) -> Result<bool, Error> {
        let plan = self.bodies.plan;
        let Some((start, settings)) = first(self.bodies, self.stop)? else { return Ok(false) };
        let towards = plan.computation.stride.direction;
        let legs = sides(self.bodies, plan.start_value(), &start, &settings, towards, self.stop)?;
        let mut followed = Followed { origin: Origin::Start, legs: Vec::new() };
        for leg in legs {
            followed.legs.push(self.leg(leg, &mut |_| false)?.unwrap_or_else(Leg::none));
            if followed.is_closed() {
                break;
            }
        }
        Ok(self.keep(followed))
    }

    /// Follows what begins at an origin. Whether it came to its end.
    fn grow(&mut self, origin: Origin) -> Result<bool, Error> {
        if let Some(number) = arrives(self.bodies, &self.done.branches, origin, self.stop) {
            return Ok(self.link(origin, &[number], None));
        }
        let new = match origin.branches(self.bodies, &self.done.branches, self.stop) {
            Ok(new) => new,
            Err(why) => return Ok(!self.watch.stopped() && self.link(origin, &[], Some(why.to_string()))),
        };
        let mut found = Vec::new();
        for legs in new {
            match self.lead(origin, legs)? {
                Led::Known(number) => found.push(number),
                Led::New(followed) if followed.legs.is_empty() => {}
                Led::New(followed) => {
                    found.push(self.done.branches.len());
                    let whole = followed.is_whole();
                    self.done.branches.push(followed);
                    if !whole {
                        return Ok(false);
                    }
                }
            }
        }
        Ok(self.link(origin, &found, None))
    }

    /// Follows one branch from an origin, as long as it is not one that is known.
    fn lead(&self, origin: Origin, legs: Vec<Branch<'_>>) -> Result<Led, Error> {
        let settings = self.bodies.settings();
        let mut followed = Followed { origin, legs: Vec::new() };
        for (number, leg) in legs.into_iter().enumerate() {
            let (mut seen, mut on) = (0, None);
            // where a branch meets a motion of more symmetry, that motion is on both
            let mut met = matches!(origin, Origin::Meets { .. });
            let mut is_known = |sample: &Sample| {
                if std::mem::take(&mut met) {
                    return false;
                }
                seen += 1;
                if number == 0 && (seen <= COMPARED || usize::is_power_of_two(seen)) && on.is_none() {
                    on = known(self.bodies, &self.done.branches, sample, &settings, self.stop);
                }
                on.is_some()
            };
            match (self.leg(leg, &mut is_known)?, on) {
                (None, Some(on)) => return Ok(Led::Known(on)),
                (leg, _) => followed.legs.extend(leg),
            }
            if followed.is_closed() {
                break;
            }
        }
        Ok(Led::New(followed))
    }

    /// The points of a leg; `None` as soon as `is_known` says that it is on a branch already followed.
    fn leg(
        &self,
        mut branch: Branch<'_>,
        is_known: &mut dyn FnMut(&Sample) -> bool,
    ) -> Result<Option<Leg>, Error> {
        let mut samples: Vec<Sample> = Vec::new();
        for point in branch.by_ref() {
            let sample = Sample { reading: Reading::of(self.bodies, &point, self.watch)?, point };
            if self.watch.stopped() {
                return Ok(Some(Leg { samples, end: End::Stopped })); // what was read may be half of it
            }
            if is_known(&sample) {
                return Ok(None);
            }
            if let [_, .., last] = &mut samples[..]
                && last.point.special.is_none()
            {
                last.forget_nodes();
            }
            samples.push(sample);
            self.progress(samples.len());
            if let Some(period) = self.winds(&samples) {
                return Ok(Some(Leg { samples, end: End::Settles { period } }));
            }
        }
        let end = branch.end().cloned().unwrap_or(End::Stopped);
        Ok(Some(Leg { samples, end }))
    }

    /// The period of the last point, if work is bounded and the branch winds about a connection: its folds have one place.
    fn winds(&self, samples: &[Sample]) -> Option<f64> {
        let along = &self.bodies.plan.computation.along;
        // a line of an atlas is a part of the plane
        let width = (along.to - along.from) / PART_OF_PLANE;
        let place = |sample: &Sample| Some((sample.reading.period?, [sample.point.parameter / width]));
        let from = self.bodies.is_bounded().then(|| settles(samples.iter().map(place)))??;
        let folds = samples[from..].iter().filter(|sample| sample.point.special == Some(Special::Fold));
        if folds.count() < 2 { None } else { samples.last()?.reading.period }
    }

    /// Progress of the work: branches, of those that are known to come, and the points of this one.
    fn progress(&self, points: usize) {
        let part = points as f64 / (points as f64 + TYPICAL);
        self.watch.progress((self.done.branches.len() as f64 + part) / self.expected as f64);
    }

    /// Keeps the branch of the start. Whether it came to its end.
    fn keep(&mut self, followed: Followed) -> bool {
        let whole = followed.is_whole();
        let (number, origin) = (self.done.branches.len(), followed.origin);
        self.done.branches.push(followed);
        whole && self.link(origin, &[number], None)
    }

    /// Notes what was found at an origin, or why nothing was.
    fn link(&mut self, origin: Origin, found: &[usize], why: Option<String>) -> bool {
        let all = found.iter().map(|&number| Link { origin, branch: Some(number), why: None });
        self.done.links.extend(all);
        if found.is_empty() {
            self.done.links.push(Link { origin, branch: None, why });
        }
        true
    }
}

/// One branch from an origin.
enum Led {
    /// The branch with this number, which was followed before.
    Known(usize),
    /// A new one.
    New(Followed),
}

/// Points of a branch, roughly: for the progress bar alone.
const TYPICAL: f64 = 200.0;
