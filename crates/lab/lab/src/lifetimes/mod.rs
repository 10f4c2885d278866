//! Transient chaos along a parameter: how long it lives at each value, and by which law.

mod folder;
mod follow;
#[cfg(test)]
mod tests;

use crate::captured::way;
use crate::pool::{Keeping, complete};
pub use folder::{follow_into, open, write};
use follow::{End, Followed, Follower};
use motiform_analysis::{LifeCount, LifeLaws, MeanLife, Stay, compare_life_laws, mean_life, memory};
use motiform_dynamics::Watch;
use motiform_store::Kind;
use motiform_study::plan::{check, other_version};
use motiform_study::scan::Axis;
use motiform_study::{Error, ScanPlan, Study, input};
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::time::Duration;

/// The longest time of an orbit if the plan has no budget, in looks of the model.
const LOOKS: f64 = 100.0;

/// The time between savings: a killed run loses at most this, beside the orbits under way.
const KEPT_EVERY: Duration = Duration::from_secs(5);

/// Mean lives of chaos along a parameter, and their law.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Lifetimes {
    /// The parameter.
    pub parameter: String,
    /// The results for each of its values, in the order of the axis.
    pub values: Vec<LifeAt>,
    /// The law of the mean lives.
    pub laws: LifeLaws,
}

/// The fates of the starts at one value of the parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LifeAt {
    /// Value of the parameter.
    pub value: f64,
    /// Longest time for which an orbit was followed (model time).
    pub until: f64,
    /// Starts.
    pub starts: usize,
    /// Those that blew up.
    pub blew_up: usize,
    /// Those that came to rest at a stable steady motion: motionless, straight or circular.
    pub captured: usize,
    /// Those that were still chaotic at the end, or on their way to a steady motion.
    pub lasting: usize,
    /// Those that moved regularly at the end, not steadily (such as a zigzag): when they began to is not
    /// known, and they do not count.
    pub regular: usize,
    /// Those that could not be followed to the end (no further step, or the budget of steps was used up);
    /// they count until then.
    pub lost: usize,
    /// The time after which a life counts (model time).
    pub delay: f64,
    /// Mean life after the delay.
    pub life: MeanLife,
}

/// Asks a study for lives along an axis, from so many random starts at each value, with the longest time of an orbit and the delay (model
/// time; `None` for their defaults).
///
/// # Errors
/// Times that are not positive; a range over which the model has no size.
pub fn ask(study: &mut Study, axis: Axis, samples: u64, times: [Option<f64>; 2]) -> Result<(), Error> {
    for (key, value) in ["until", "transient"].into_iter().zip(times) {
        let is_one = value.is_none_or(|value| value > 0.0 || key == "transient" && value == 0.0);
        check(key, value.unwrap_or(0.0), is_one, "give a model time above 0 (the transient may be 0)")?;
    }
    (study.scan.axes, study.scan.samples, study.scan.budget) = (vec![axis], samples, times[0].unwrap_or(0.0));
    study.initial.clear();
    study.random = Some(study.starts_over(2, &study.scan.axes)?); // those that sample basins, also of one start
    Ok(())
}

/// The lifetimes of chaos along the only axis of a plan, from its random starts, each followed to `plan`'s
/// budget (0 for 100 looks of the model), in whole looks of the model at each value. A life ends by a blow-up, or when the orbit has
/// come close to a stable steady motion; both count alike.
///
/// Lives count from `delay` on, which has to cover the way onto the chaotic set. If it is not given: one look, and if
/// orbits are captured, twice the time that the slowest eigenvalue takes to bring an orbit as near as that is
/// noticed, which a start that
/// was never chaotic needs too.
///
/// The tensor model runs in the lanes of vector registers. The results do not depend on `threads` or on the
/// machine. `None` if the watch
/// stopped it.
///
/// # Errors
/// A plan with two axes, a negative delay; input that only the numerics can reject.
///
/// # Checked by  tests/all/lifetimes.rs: lanes and threads against single orbits, blow-up, capture
pub fn lifetimes(
    plan: &ScanPlan,
    delay: Option<f64>,
    threads: usize,
    watch: &dyn Watch,
) -> Result<Option<Lifetimes>, Error> {
    check_axis(plan, delay)?;
    let lives = follow_lives_kept(plan, None, threads, &|_| Ok(()), watch)?;
    lives.is_complete().then(|| lives.summarised(plan, delay)).transpose()
}

/// Version of the orbits of one plan: raised where their numbers change. 2: looks are those of each value of the parameter.
const LIVES_FORMAT: u32 = 2;

fn first_format() -> u32 {
    1
}

/// The orbits of a plan, as far as they are followed, in its order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lives {
    /// [`LIVES_FORMAT`]; absent where it was 1.
    #[serde(default = "first_format")]
    format: u32,
    plan_hash: String,
    /// Absent in what version 0.2.0 left unfinished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    plan: Option<ScanPlan>,
    orbits: Vec<Option<Followed>>,
}

/// Follows the orbits of a plan that `before` does not hold. Where the watch stopped it, some are still missing; each of those that are
/// there was followed to its end. `keep` gets the orbits that are finished, every five seconds.
///
/// # Errors
/// As [`lifetimes`], and those of `keep`.
pub fn follow_lives_kept(
    plan: &ScanPlan,
    before: Option<Lives>,
    threads: usize,
    keep: &(dyn Fn(&Lives) -> Result<(), Error> + Sync),
    watch: &dyn Watch,
) -> Result<Lives, Error> {
    let keep = |orbits: &[Option<Followed>]| keep(&Lives::of(plan, orbits.to_vec()));
    let keeping = Keeping { every: KEPT_EVERY, keep: &keep };
    let follower = Follower::new(plan, watch)?;
    let mut orbits = before.map_or_else(Vec::new, |lives| lives.orbits);
    orbits.resize(plan.rows(), None);
    let orbits = complete(orbits, threads, keeping, watch, |jobs| follower.run(jobs))?;
    Ok(Lives::of(plan, orbits))
}

/// The looks of an orbit at a value of the axis, which are those of the body there ([`ScanPlan::look_of`]).
#[derive(Clone, Copy, Debug)]
struct Looks {
    /// The most of them.
    count: usize,
    /// Model time of each.
    time: f64,
}

impl Looks {
    fn of(plan: &ScanPlan, cell: usize) -> Result<Self, Error> {
        let (time, budget) = (plan.look_of(cell)?, plan.computation.budget);
        Ok(Self { count: (if budget > 0.0 { budget / time } else { LOOKS }).ceil() as usize, time })
    }
}

impl Lives {
    fn of(plan: &ScanPlan, orbits: Vec<Option<Followed>>) -> Self {
        Self { format: LIVES_FORMAT, plan_hash: plan.hash(), plan: Some(plan.clone()), orbits }
    }

    /// Reads the lives of `plan` from a file, to go on with.
    ///
    /// # Errors
    /// [`Error::Store`]; [`Error::OtherPlan`] for another plan.
    pub fn read(path: &Path, plan: &ScanPlan) -> Result<Self, Error> {
        let lives: Self = input::json(path).map_err(|error| Error::unreadable(path, error))?;
        let same = lives.plan_hash == plan.hash() && lives.orbits.len() == plan.rows();
        if same && lives.format == LIVES_FORMAT {
            Ok(lives)
        } else {
            let differences = match lives.plan {
                _ if same => other_version(lives.format, LIVES_FORMAT),
                None => "other settings".to_owned(),
                Some(there) => there.differences(plan),
            };
            let path = path.parent().unwrap_or(path).to_owned();
            Err(Error::OtherPlan { path, kind: Kind::Lifetimes, differences })
        }
    }

    /// Returns `true` if every orbit was followed to its end.
    pub fn is_complete(&self) -> bool {
        self.orbits.iter().all(Option::is_some)
    }

    /// Mean lives along the only axis of the plan, and their law, from the orbits that are there.
    ///
    /// # Errors
    /// As [`lifetimes`].
    pub fn summarised(&self, plan: &ScanPlan, delay: Option<f64>) -> Result<Lifetimes, Error> {
        let axis = check_axis(plan, delay)?;
        let values: Vec<LifeAt> = axis
            .values
            .iter()
            .zip(self.orbits.chunks(plan.computation.samples))
            .enumerate()
            .map(|(cell, (&value, all))| {
                let all: Vec<Followed> = all.iter().flatten().copied().collect();
                summarise(value, &all, delay, Looks::of(plan, cell)?)
            })
            .collect::<Result<_, _>>()?;
        let count =
            |at: &LifeAt| LifeCount { parameter: at.value, events: at.life.events, watched: at.life.watched };
        let laws = compare_life_laws(&values.iter().map(count).collect::<Vec<_>>())?;
        let sets = self.orbits.chunks(plan.computation.samples).zip(&values);
        let sets: Vec<_> = sets.map(|(all, at)| (stays(all.iter().flatten()), at.delay)).collect();
        let laws = laws.held_against(memory(&sets)?);
        Ok(Lifetimes { parameter: axis.name.clone(), values, laws })
    }
}

/// The only axis of the plan, and the delay checked.
fn check_axis(plan: &ScanPlan, delay: Option<f64>) -> Result<&Axis, Error> {
    let [axis] = &plan.computation.axes[..] else {
        let text = plan.computation.axes.last().map_or_else(String::new, |axis| axis.name.clone());
        return Err(Error::Axis {
            text,
            problem: "mean lives are computed along one parameter: give one axis".to_owned(),
        });
    };
    if plan.varies_start()? {
        return Err(Error::Axis {
            text: axis.name.clone(),
            problem: "mean lives follow a law of a parameter, and this is a coordinate of the start; a scan maps what \
                      different starts end in"
                .to_owned(),
        });
    }
    check(
        "transient",
        delay.unwrap_or(0.0),
        delay.is_none_or(|delay| delay >= 0.0),
        "give a time of at least 0",
    )?;
    Ok(axis)
}

fn summarise(value: f64, all: &[Followed], delay: Option<f64>, looks: Looks) -> Result<LifeAt, Error> {
    let count = |is: fn(&End) -> bool| all.iter().filter(|followed| is(&followed.end)).count();
    let rate =
        |followed: &Followed| if let End::Captured { rate } = followed.end { rate } else { f64::INFINITY };
    let slowest = all.iter().map(rate).fold(f64::INFINITY, f64::min);
    let delay = delay.unwrap_or_else(|| looks.time.max(2.0 * way(slowest)));
    let stays = stays(all.iter());
    Ok(LifeAt {
        value,
        until: looks.count as f64 * looks.time,
        starts: all.len(),
        blew_up: count(|end| *end == End::BlewUp),
        captured: count(|end| matches!(end, End::Captured { .. })),
        lasting: count(|end| *end == End::Lasting),
        regular: count(|end| *end == End::Regular),
        lost: count(|end| *end == End::Lost),
        delay,
        life: mean_life(&stays, delay)?,
    })
}

/// The lives of the orbits that count.
fn stays<'f>(all: impl Iterator<Item = &'f Followed>) -> Vec<Stay> {
    let ended = |end: &End| matches!(end, End::BlewUp | End::Captured { .. });
    let counted = all.filter(|followed| followed.end != End::Regular);
    counted.map(|followed| Stay { time: followed.time, escaped: ended(&followed.end) }).collect()
}

impl Lifetimes {
    /// The shortest and the longest of the times for which orbits were followed: looks may differ from value to value.
    pub fn until(&self) -> [f64; 2] {
        let all = self.values.iter().map(|at| at.until);
        all.fold([f64::INFINITY, 0.0], |[least, most], until| [least.min(until), most.max(until)])
    }

    /// [`Self::until`], each time in these words: one of them where both are alike.
    pub fn until_in(&self, words: impl Fn(f64) -> String) -> String {
        let [least, most] = self.until().map(words);
        if least == most { least } else { format!("{least} to {most}") }
    }

    /// Remarks that the numbers do not tell by themselves: one line each.
    pub fn notes(&self) -> Vec<String> {
        let sum = |of: fn(&LifeAt) -> usize| self.values.iter().map(of).sum::<usize>();
        // where all starts ended, a longer watch shows nothing else
        let over = |at: &LifeAt| at.lasting == 0 && at.regular == 0 && at.lost == 0;
        let unwatched =
            |ended: bool| self.values.iter().filter(|at| at.life.watched == 0.0 && over(at) == ended).count();
        let notes = [
            (
                sum(|at| at.regular),
                "starts moved regularly at the end, but not steadily, since an unknown time: they do not count",
            ),
            (sum(|at| at.lost), "starts could not be followed to the end: they count until then"),
            (
                unwatched(true),
                "values have nothing to watch after the delay, as all of their starts ended before: there is no chaos that lasts for \
                 it; give a shorter delay (transient)",
            ),
            (
                unwatched(false),
                "values have nothing to watch after the delay: follow for longer, or give a shorter delay",
            ),
        ];
        notes.iter().filter(|note| note.0 > 0).map(|(count, text)| format!("{count} {text}")).collect()
    }
}
