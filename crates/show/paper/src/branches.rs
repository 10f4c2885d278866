//! Branches along kappa3 = 0.1: where the zigzag comes from, how it changes and ends.

use super::claims::check;
use super::context::Context;
use motiform_analysis::regime::Regime;
use motiform_continuation::Special;
use motiform_diagrams::draw::{Ordinate, branch_diagram};
use motiform_diagrams::{Branches, Followed, Sample, SpecialEntry, stretches};
use motiform_figures::report::{Claim, ReportFigure, Section};
use motiform_study::branches::{Along, BranchPlan, BranchSettings};
use motiform_study::{Error, Study};
use std::sync::Arc;

/// Measured before, by another program (multiple shooting, checked by AUTO and by simulation): kind, kappa2, digits given.
const KNOWN: [(&str, f64, f64); 5] = [
    ("symmetry-breaking", 0.783_547, 1e-6),
    ("symmetry-breaking", 1.148_047, 1e-6),
    ("hopf", 1.121_937, 1e-6),
    ("period-doubling", 0.7343, 1e-4),
    ("homoclinic", 1.344_179, 1e-6),
];

/// The disturbance of a motion, relative to its state.
const DISTURBED: f64 = 1e-2;

/// The preset of the figure at a place of the plane.
///
/// # Errors
/// None but for a changed preset.
pub(crate) fn at(context: &Context<'_>, kappa2: f64, kappa3: f64) -> Result<Study, Error> {
    context.preset("fig4", |study| {
        study.set("kappa2", kappa2)?;
        study.set("kappa3", kappa3)
    })
}

/// Follows branches along kappa2 through a place, from the motion that a start settles on there.
///
/// # Errors
/// [`Error::Start`] if that is not the motion asked for; [`Error::Interrupted`].
pub(crate) fn follow(
    context: &Context<'_>,
    kappa2: f64,
    kappa3: f64,
    origin: Regime,
    branches: usize,
) -> Result<(BranchPlan, Arc<Branches>), Error> {
    let mut study = at(context, kappa2, kappa3)?;
    "Branches along *κ*_2".clone_into(&mut study.title);
    let along = Along { name: "kappa2".to_owned(), from: 0.3, to: 1.6 };
    let settings = BranchSettings { origin: Some(origin), branches, ..BranchSettings::over(along) };
    let plan = BranchPlan::new(&study, &settings)?;
    let found = context.follow(&plan)?;
    Ok((plan, found))
}

/// The branches at kappa3 = 0.1, from the zigzag.
///
/// # Errors
/// As [`follow`].
pub(crate) fn slow(context: &Context<'_>) -> Result<(BranchPlan, Arc<Branches>), Error> {
    follow(context, 0.9, 0.1, Regime::Zigzag, context.choose(8, 5))
}

/// Their figures, and the claims that follow.
///
/// # Errors
/// Numbers that no axis can hold; [`Error::Interrupted`].
pub(crate) fn add(
    context: &Context<'_>,
    section: &mut Section,
    plan: &BranchPlan,
    found: &Branches,
) -> Result<(), Error> {
    let words = [
        (
            Ordinate::Period,
            "**The bifurcations along *κ*_3 = 0.1.** Periods of the motions that repeat, stable or not.",
        ),
        (Ordinate::Speed, "The same branches with those that are steady: mean speed."),
    ];
    for (ordinate, caption) in words {
        let drawn = context.sheet(branch_diagram(plan, found, ordinate)?)?;
        section.figures.push(ReportFigure::new(drawn, caption));
    }
    let own = |of: fn(&Context<'_>, &Branches) -> Claim| of(context, found);
    section.claims.extend([own(ends), own(kinds), own(known), bistable(context, found)?]);
    Ok(())
}

const HOW: &str = "a simulated zigzag at *κ*_2 = 0.9 is polished by Newton's method and followed by pseudo-arclength in both \
directions, stable or not; special points are solved for, and what begins there is followed too";

/// The special points of a kind on all branches.
fn special<'f>(found: &'f Branches, kind: &'f str) -> impl Iterator<Item = SpecialEntry> + 'f {
    let all = (0..found.branches.len()).flat_map(|number| found.special(number));
    all.filter(move |entry| entry.kind == kind)
}

/// The branches whose motion is of this kind.
fn of(found: &Branches, regime: Regime) -> impl Iterator<Item = &Followed> {
    found.branches.iter().filter(move |followed| followed.named().is_some_and(|part| part.motion == regime))
}

fn ends(context: &Context<'_>, found: &Branches) -> Claim {
    let own = found.special(0);
    let end = own.iter().find(|entry| entry.kind == "homoclinic").map_or(f64::NAN, |entry| entry.parameter);
    let straight = of(found, Regime::Straight).flat_map(Followed::samples);
    let hopf = straight.filter(|sample| matches!(sample.point.special, Some(Special::Hopf(_)))).count();
    let hopf = context.number(hopf as f64);
    let straight = of(found, Regime::Straight).count();
    check(
        "The zigzag is not born from straight motion: its branch ends where its period becomes infinite, on a homoclinic orbit.",
        format!(
            "the branch of the zigzag ends at *κ*_2 = {end:.6} on an orbit that leaves the unstable \
            straight motion and returns to it, once to the left and once to the right; the branch of \
            straight motion has {hopf} Hopf points between 0.3 and 1.6"
        ),
        &format!(
            "{HOW}. The end is one where the time grows as the logarithm of the distance, at the rate of the saddle"
        ),
        end.is_finite() && straight == 1 && hopf == 0.0,
    )
}

/// The claim on the transitions that are continuous.
fn kinds(context: &Context<'_>, found: &Branches) -> Claim {
    let words = |kind: &str| {
        let one = |entry: SpecialEntry| {
            format!("{:.6} ({})", entry.parameter, entry.criticality.unwrap_or("undecided"))
        };
        special(found, kind).map(one).collect::<Vec<_>>().join(", ")
    };
    let decided = |entry: &SpecialEntry| entry.criticality.is_some_and(|word| word != "undecided");
    let known = |kind: &str| special(found, kind).filter(decided).collect::<Vec<_>>();
    let (breaks, doubles) = (known("symmetry-breaking"), known("period-doubling"));
    let mut begins = breaks.iter().chain(&doubles);
    let mut hopf = special(found, "hopf");
    check(
        "The zigzag turns into chaos step by step: left and right legs become unequal, then periods double. \
        Circular motion ends in a jump.",
        format!(
            "symmetry breakings of the zigzag at *κ*_2 = {}; period doublings of the rotating zigzags that begin there at {}; Hopf \
             bifurcation of circular motion at {}",
            words("symmetry-breaking"),
            words("period-doubling"),
            words("hopf")
        ),
        &format!(
            "{HOW}. Supercritical: what begins is stable where the motion itself is not, by the sign of the normal form's coefficient"
        ),
        context.number(special(found, "symmetry-breaking").count() as f64) == 2.0
            && !breaks.is_empty()
            && begins.all(|entry| entry.criticality == Some("supercritical"))
            && special(found, "period-doubling").count() >= 1
            && hopf.all(|entry| entry.criticality == Some("subcritical")),
    )
}

fn known(context: &Context<'_>, found: &Branches) -> Claim {
    let off = |(kind, value, digits): (&'static str, f64, f64)| {
        let off =
            special(found, kind).map(|entry| (entry.parameter - value).abs()).fold(f64::INFINITY, f64::min);
        let off = context.number(off);
        (format!("{kind} {value}: {off:.0e}"), off < digits)
    };
    let all = KNOWN.map(off);
    check(
        "Measured before this project, by an independent program: where the motions along *κ*_3 = 0.1 change.",
        all.iter().map(|entry| entry.0.as_str()).collect::<Vec<_>>().join(", "),
        "the distance from the nearest special point of that kind is less than the last digit given",
        all.iter().all(|entry| entry.1),
    )
}

/// The range where zigzag and circular motion are both stable, and what becomes of each there after a push.
fn bistable(context: &Context<'_>, found: &Branches) -> Result<Claim, Error> {
    let range = |regime| {
        of(found, regime).flat_map(|followed| stretches(found, followed)).next().unwrap_or([f64::NAN; 2])
    };
    let (zigzag, circular) = (range(Regime::Zigzag), range(Regime::Circular));
    let (low, high) = (circular[0].max(zigzag[0]), circular[1].min(zigzag[1]));
    let mut kept = Vec::new();
    for regime in [Regime::Zigzag, Regime::Circular] {
        let middle = |a: &&Sample, b: &&Sample| {
            let off = |sample: &Sample| (sample.point.parameter - 0.5 * (low + high)).abs();
            off(a).total_cmp(&off(b))
        };
        let Some(sample) = of(found, regime).flat_map(Followed::samples).min_by(middle) else { continue };
        kept.push((regime, sample.point.parameter, disturbed(context, sample)?));
    }
    let words = kept.iter().map(|(from, at, to)| format!("{from} at *κ*_2 = {at:.4} stays {to}"));
    Ok(check(
        "Between zigzag and circular motion lies a range where both are stable.",
        format!(
            "both are stable from *κ*_2 = {low:.6} to {high:.6}; disturbed there, {}",
            words.collect::<Vec<_>>().join(", ")
        ),
        &format!(
            "{HOW}; a state of each, every component changed by up to 1 %, is simulated and named by the classifier"
        ),
        low < high
            && kept.len() == 2
            && kept.iter().all(|(from, at, to)| from == to && (low..high).contains(at)),
    ))
}

/// The motion that a disturbed one settles on.
fn disturbed(context: &Context<'_>, sample: &Sample) -> Result<Regime, Error> {
    let mut study = at(context, sample.point.parameter, 0.1)?;
    for (place, name) in ["v1", "v2", "s11", "s12", "u111", "u222"].iter().enumerate() {
        let push = 1.0 + if place % 2 == 0 { DISTURBED } else { -DISTURBED };
        study.set_initial(name, push * sample.reading.state.get(place).copied().unwrap_or(0.0))?;
    }
    Ok(context.classify(&study)?.regime)
}
