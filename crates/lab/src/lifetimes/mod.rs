//! Transient chaos along a parameter: how long it lives at each value, and by which law.

mod follow;
#[cfg(test)]
mod tests;

use crate::pool::spread;
use follow::{End, Followed, Follower};
use motiform_analysis::{LifeCount, LifeLaws, MeanLife, Stay, compare_life_laws, mean_life};
use motiform_dynamics::Watch;
use motiform_study::plan::check;
use motiform_study::{Error, ScanPlan};
use serde::Serialize;

/// The longest time of an orbit if the plan has no budget, in looks of the model.
const LOOKS: f64 = 100.0;

/// Mean lives of chaos along a parameter, and their law.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Lifetimes {
    /// The parameter.
    pub parameter: String,
    /// Longest time for which an orbit was followed (model time).
    pub until: f64,
    /// The results for each of its values, in the order of the axis.
    pub values: Vec<LifeAt>,
    /// The law of the mean lives.
    pub laws: LifeLaws,
}

/// What became of the starts at one value of the parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LifeAt {
    /// Value of the parameter.
    pub value: f64,
    /// Starts.
    pub starts: usize,
    /// Those that blew up.
    pub blew_up: usize,
    /// Those that came to rest at a stable steady motion: motionless, straight or circular.
    pub captured: usize,
    /// Those that were still chaotic at the end, or on their way to a steady motion.
    pub lasting: usize,
    /// Those that moved regularly at the end, not steadily (such as a zigzag): when they began to is not known, and they do not count.
    pub regular: usize,
    /// Those that could not be followed to the end (no further step, or the budget of steps was used up); they count until then.
    pub lost: usize,
    /// The time after which a life counts (model time).
    pub delay: f64,
    /// Mean life after the delay.
    pub life: MeanLife,
}

/// How long chaos lives along the only axis of a plan, from its random starts, each followed to `plan`'s budget (0 for 100 looks of the
/// model), in whole looks. A life ends by a blow-up, or when the orbit has come close to a stable steady motion; both count alike.
///
/// Lives count from `delay` on, which has to cover the way onto the chaotic set. If it is not given: one look, and if
/// orbits are captured, twice the time that the slowest eigenvalue takes to bring an orbit as near as that is noticed, which a start that
/// was never chaotic needs too.
///
/// The tensor model runs in the lanes of vector registers. The results do not depend on `threads` or on the machine. `None` if the watch
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
    let [axis] = &plan.computation.axes[..] else {
        let text = plan.computation.axes.last().map_or_else(String::new, |axis| axis.name.clone());
        return Err(Error::Axis {
            text,
            problem: "mean lives are computed along one parameter: give one axis".to_owned(),
        });
    };
    check(
        "transient",
        delay.unwrap_or(0.0),
        delay.is_none_or(|delay| delay >= 0.0),
        "give a time of at least 0",
    )?;
    let (look, budget) = (plan.info()?.look, plan.computation.budget);
    let looks = (if budget > 0.0 { budget / look } else { LOOKS }).ceil();
    let follower = Follower::new(plan, looks as usize, watch)?;
    let Some(all) = spread(plan.rows(), threads, watch, |jobs| follower.run(jobs))? else { return Ok(None) };
    let values: Vec<LifeAt> = axis
        .values
        .iter()
        .zip(all.chunks(plan.computation.samples))
        .map(|(&value, all)| summarise(value, all, delay, look))
        .collect::<Result<_, _>>()?;
    let count =
        |at: &LifeAt| LifeCount { parameter: at.value, events: at.life.events, watched: at.life.watched };
    let laws = compare_life_laws(&values.iter().map(count).collect::<Vec<_>>())?;
    Ok(Some(Lifetimes { parameter: axis.name.clone(), until: looks * look, values, laws }))
}

fn summarise(value: f64, all: &[Followed], delay: Option<f64>, look: f64) -> Result<LifeAt, Error> {
    let count = |is: fn(&End) -> bool| all.iter().filter(|followed| is(&followed.end)).count();
    let rate =
        |followed: &Followed| if let End::Captured { rate } = followed.end { rate } else { f64::INFINITY };
    let slowest = all.iter().map(rate).fold(f64::INFINITY, f64::min);
    let delay = delay.unwrap_or_else(|| look.max(2.0 * follow::way(slowest)));
    let ended = |end: &End| matches!(end, End::BlewUp | End::Captured { .. });
    let counted = all.iter().filter(|followed| followed.end != End::Regular);
    let stays: Vec<Stay> =
        counted.map(|followed| Stay { time: followed.time, escaped: ended(&followed.end) }).collect();
    Ok(LifeAt {
        value,
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

impl Lifetimes {
    /// What the numbers do not tell by themselves: one line each.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let sum = |of: fn(&LifeAt) -> usize| self.values.iter().map(of).sum::<usize>();
        let late = self.values.iter().filter(|at| at.life.watched == 0.0).count();
        let notes = [
            (
                sum(|at| at.regular),
                "starts moved regularly at the end, but not steadily, since an unknown time: they do not count",
            ),
            (sum(|at| at.lost), "starts could not be followed to the end: they count until then"),
            (
                late,
                "values have nothing to watch after the delay: follow for longer, or give a shorter delay",
            ),
        ];
        notes.iter().filter(|note| note.0 > 0).map(|(count, text)| format!("{count} {text}")).collect()
    }
}
