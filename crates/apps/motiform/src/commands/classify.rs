//! `motiform classify`.

use crate::args::ClassifyOptions;
use crate::commands::subject;
use crate::output::{End, say, warn};
use crate::progress::Progress;
use motiform_analysis::{Regime, Verdict};
use motiform_lab::analyse;
use motiform_lab::answers::{Classified, Motions};
use motiform_lab::samples::{self, Basins, Escapes, Samples};
use motiform_study::Plan;

pub(crate) fn run(options: &ClassifyOptions) -> anyhow::Result<End> {
    let mut study = subject::motion(&options.motion)?;
    study.perturb = options.perturb.unwrap_or(study.perturb);
    let (study, perturbation) = study.perturbed()?;
    if let Some(perturbation) = perturbation {
        warn(&format!("{perturbation}; --perturb 0 keeps the exact start"));
    }
    let (plan, samples) = subject::plan(study, &options.many)?;
    let budget = options.budget.unwrap_or(0.0);
    if let Some(samples) = samples {
        return many(options, &plan, samples, budget);
    }
    let watch = Progress::of_stage("the motion", "of the budget of model time spent");
    let verdict = watch.over(|watch| analyse::classify(&plan, budget, watch));
    let Some(verdict) = verdict? else { return Ok(End::Interrupted) };
    say(&Classified::new(&plan, &verdict), options.motion.json)?;
    advise(&plan, budget, std::slice::from_ref(&verdict))?;
    Ok(if verdict.regime == Regime::Undetermined { End::NotAsAsked } else { End::Done })
}

/// `--samples`: the motions that many initial states lead to.
fn many(options: &ClassifyOptions, plan: &Plan, samples: Samples, budget: f64) -> anyhow::Result<End> {
    let watch = Progress::new(samples.count as f64, "initial states");
    let verdicts = watch.over(|watch| samples::classify(plan, samples, budget, watch));
    let Some(verdicts) = verdicts? else { return Ok(End::Interrupted) };
    let watch = Progress::new(samples.count as f64, "chaotic starts");
    let escapes = watch.over(|watch| Escapes::of_verdicts(plan, samples, &verdicts, budget, watch))?;
    let basins = Basins::new(&samples, &verdicts);
    say(&Motions::new(plan, &verdicts, &basins, escapes.as_ref()), options.motion.json)?;
    advise(plan, budget, &verdicts)?;
    let undecided = verdicts.iter().any(|verdict| verdict.regime == Regime::Undetermined);
    Ok(if undecided { End::NotAsAsked } else { End::Done })
}

/// Advises a longer budget where one was spent without a name.
fn advise(plan: &Plan, budget: f64, verdicts: &[Verdict]) -> anyhow::Result<()> {
    let budget = analyse::settings(plan, budget)?.budget;
    let is_spent = |verdict: &Verdict| verdict.regime == Regime::Undetermined && verdict.time >= budget;
    if verdicts.iter().any(is_spent) {
        warn(&format!(
            "the budget of {budget} was spent without a name: a longer one may decide, such as --budget {}",
            5.0 * budget
        ));
    }
    Ok(())
}
