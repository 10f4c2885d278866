//! `motiform equilibria`.

use crate::args::EquilibriaOptions;
use crate::commands::subject;
use crate::output::{End, say};
use crate::progress::Progress;
use motiform_lab::answers::SteadyMotions;
use motiform_lab::equilibria::equilibria;
use motiform_study::RunPlan;

pub(crate) fn run(options: &EquilibriaOptions) -> anyhow::Result<End> {
    let plan = RunPlan::new(&subject::motion(&options.motion)?)?;
    let watch = Progress::new(f64::from(options.starts), "starts");
    let found = watch.over(|watch| equilibria(&plan, options.starts as usize, watch));
    let Some(found) = found? else { return Ok(End::Interrupted) };
    say(&SteadyMotions::new(&plan, &found), options.motion.json)?;
    Ok(End::Done)
}
