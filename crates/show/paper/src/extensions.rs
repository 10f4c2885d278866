//! Extensions of the literature, given as equations in text: what is known of them exactly, checked.

mod directed;
mod noisy;

use super::claims::check;
use super::context::Context;
use motiform_analysis::Verdict;
use motiform_diagrams::draw::{Ordinate, branch_diagram};
use motiform_diagrams::{follow, summary};
use motiform_figures::report::{Claim, ReportFigure, Section};
use motiform_study::branches::{Along, BranchPlan, BranchSettings};
use motiform_study::{Error, Study};

const ABOUT: &str = "Not in the paper: models that the literature asks for, each a file of `presets/` with \
    its equations as text. Checked is what can be computed by hand: the onset of circular motion of an \
    elliptic body (Ohta and Ohkuma, 2009), the mirror images of a handed body, the speed of a body under a \
    constant force and in a field that stretches it, and the diffusion of the heading under noise.";

pub(super) fn section(context: &Context<'_>) -> Result<Section, Error> {
    let (onset, figure) = onset(context)?;
    let mut claims = onset;
    claims.extend(handed(context)?);
    claims.extend(directed::claims(context)?);
    claims.extend(noisy::claims(context)?);
    let parameters = [
        (
            "equations",
            "`motiform models amplitudes --preset NAME`: ohta-ohkuma, chiral, force, elongating-field, noisy-heading",
        ),
        ("method", "dop853, relative tolerance 10^{-9}; with noise: splitting, docs/equations.md"),
    ];
    Ok(Section {
        title: "Extensions: equations given as text".to_owned(),
        about: ABOUT.to_owned(),
        parameters: parameters.map(|(name, value)| (name.to_owned(), value.to_owned())).to_vec(),
        figures: vec![figure],
        claims,
        ..Section::default()
    })
}

/// The verdict on a preset with these values.
fn verdict(context: &Context<'_>, preset: &str, values: &[(&str, f64)]) -> Result<Verdict, Error> {
    context.classify(&with(context, preset, values)?)
}

fn with(context: &Context<'_>, preset: &str, values: &[(&str, f64)]) -> Result<Study, Error> {
    context.preset(preset, |study| values.iter().try_for_each(|&(name, value)| study.set(name, value)))
}

/// Straight motion along gamma: a pair of circular motions leaves it at gamma_c.
fn onset(context: &Context<'_>) -> Result<(Vec<Claim>, ReportFigure), Error> {
    let mut study = with(context, "ohta-ohkuma", &[("gamma", 0.5)])?;
    "Straight and circular motion of an elliptic body".clone_into(&mut study.title);
    let along = Along { name: "gamma".to_owned(), from: 0.05, to: 1.5 };
    let plan =
        BranchPlan::new(&study, &BranchSettings { points: 500, branches: 3, ..BranchSettings::over(along) })?;
    let found = follow(&plan, None, &context.quiet())?;
    if !found.complete {
        return Err(Error::Interrupted);
    }
    let (kappa, a, b) = (0.5, 1.0, 0.5);
    let exact = kappa * kappa / (a * b) + 0.5 * kappa;
    let entries = summary(&plan, &found);
    let special = entries["branches"][0]["special"].as_array().cloned().unwrap_or_default();
    let broken = special.iter().find(|entry| entry["kind"] == "pitchfork");
    let gamma = context.number(broken.and_then(|entry| entry["gamma"].as_f64()).unwrap_or(f64::NAN));
    let says = "Straight motion becomes circular at *γ*_c = *κ*^2/(*a* *b*) + *κ*/2 (Ohta and Ohkuma 2009).";
    let finds =
        format!("the pitchfork of straight motion lies at *γ* = {gamma:.10}; the formula gives {exact}");
    let how =
        "*κ* = 0.5, *a* = 1, *b* = 0.5: the branch of straight motion continued along *γ*; within 10^{-9}";
    let pitchfork = check(says, finds, how, (gamma - exact).abs() < 1e-9);
    let beside = [-0.01, 0.01].map(|step| verdict(context, "ohta-ohkuma", &[("gamma", exact + step)]));
    let [below, above] = beside;
    let regimes = [below?.regime.name(), above?.regime.name()];
    let says = "Below *γ*_c the body moves straight, above it in a circle.";
    let finds = format!("{} at *γ*_c − 0.01, {} at *γ*_c + 0.01", regimes[0], regimes[1]);
    let regimes =
        check(says, finds, "the classifier, from a small random start", regimes == ["straight", "circular"]);
    let drawn = context.sheet(branch_diagram(&plan, &found, Ordinate::Speed)?)?;
    let words = "Mean speed along *γ*: straight motion, and the circular motion that leaves it at *γ*_c = 0.75. Dashed: unstable.";
    Ok((vec![pitchfork, regimes], ReportFigure::new(drawn, words)))
}

/// omega and -omega are mirror images.
fn handed(context: &Context<'_>) -> Result<Vec<Claim>, Error> {
    let mut worst = 0.0_f64;
    let mut same = Vec::new();
    for (kappa2, kappa3, omega) in [(1.5, 0.5, 0.1), (1.5, 0.5, 0.2), (1.4, 0.8, 0.3)] {
        let one = |omega: f64| {
            let values = [("kappa2", kappa2), ("kappa3", kappa3), ("omega", omega)];
            let mut study = with(context, "chiral", &values)?;
            study.set_initial("v1", 0.5)?;
            context.classify(&study)
        };
        let (left, right) = (one(-omega)?, one(omega)?);
        let rates = [&left, &right].map(|verdict| verdict.turning_rate.unwrap_or(f64::NAN));
        worst = worst.max((rates[0] + rates[1]).abs());
        same.push(left.regime == right.regime && left.course != right.course && left.course.is_some());
    }
    let says = "*ω* → −*ω* mirrors the motion of a handed body.";
    let finds = format!(
        "the same motions, the other hand each time; turning rates differ from opposite ones by {worst:.1e}"
    );
    let how = "three places in (*κ*_2, *κ*_3, *ω*) where the body circles; turning rates within 10^{-9}";
    Ok(vec![check(says, finds, how, worst < 1e-9 && same.iter().all(|same| *same))])
}
