//! The region of the crosses: a singularity of the equations, not of the numerics.
//!
//! With b3 = d3 = 0 and `z1 ~ C/s`, s = t* - t, the leading terms balance as
//!
//! ```text
//!     (Z1) |z1|^2 = e11 |z2|           (Z2) z2' = e22 z1* z3           (Z3) z3' = e31 z1^3 + e32 z1 z2
//!     z2 = z1^2/e11                    z3 = 2 C/(e11 e22 s^2)          C^2 = 4 / (e11 e22 (e31 + e32/e11))
//! ```

use super::super::claims::{claim, differs};
use super::super::context::Context;
use super::approach::{Approach, follow};
use super::{at, figure, power};
use motiform_dynamics::Outcome;
use motiform_figures::report::{ReportFigure, Section};
use motiform_figures::{Chart, ErrorBarSeries, ExpectedLine, LineStyle, Measured};
use motiform_study::{Error, Study};

/// The point that is examined.
const PLACE: (f64, f64) = (0.3, 0.1);

/// The start lies this long before the escape: the orbit is still on the chaotic saddle.
const BEFORE: f64 = 20.0;

/// Steppers with their tolerance or step: adaptive ones of two orders, and the paper's.
const ADAPTIVE: [(&str, f64); 6] = [
    ("dop853", 1e-8),
    ("dop853", 1e-10),
    ("dop853", 1e-13),
    ("dopri5", 1e-8),
    ("dopri5", 1e-10),
    ("dopri5", 1e-13),
];
const FIXED: [(&str, f64); 3] = [("heun", 1e-3), ("heun", 1e-4), ("rk4", 1e-3)];

pub(super) fn add(context: &Context<'_>, section: &mut Section) -> Result<(), Error> {
    let Some(start) = start(context)? else {
        let how = "up to 200 random starts, 2000 time units each";
        section.claims.push(claim(&[156], "The region × exists.", "No run escaped.", how, false));
        return Ok(());
    };
    let approach = context.kept.once("approach of the singularity", || follow(context, &start))?;
    let law = law(&start)?;
    section.figures.push(picture(context, &approach, law)?);
    let (adaptive, fixed) = (times(context, &start, &ADAPTIVE)?, times(context, &start, &FIXED)?);
    let (spread, list) = compare(&adaptive, &approach);
    let (coefficient, ratio) = (context.number(approach.coefficient()), context.number(approach.ratio()));
    let off = (coefficient / law - 1.0).abs();
    section.claims.push(differs(
        &[156],
        "In the region × a numerical instability occurs, so that there is no definite conclusion.",
        format!(
            "From one start, {BEFORE} time units before the end, every method blows up at the same time t\\* = {:.9}: {list}. \
             The largest spread is {}. |z_1| (t\\* − t) → {coefficient:.5}; theory {law:.5}; measured before: 5.6. \
             |z_2|/|z_1|^2 → {ratio:.6}; theory 0.5.",
            approach.t_star,
            power(spread)
        ),
        "the spread of t\\* over two methods and three tolerances, below 10^{-5}; |z_1|(t\\* − t) and |z_2|/|z_1|^2 at \
         t\\* − t < 10^{-4} within 0.1 % of the leading balance of the equations",
        "it is a true singularity in finite time: without the cubic terms b_3 and d_3 the leading terms z_2 = z_1^2/e_{11}, \
         z_3 ∝ (t\\* − t)^{-2} balance with |z_1| = C/(t\\* − t), C^2 = 4/(e_{11} e_{22} (e_{31} + e_{32}/e_{11})). No step, \
         however small, integrates past it",
        spread < 1e-5 && off < 1e-3 && (ratio - 0.5).abs() < 5e-4,
    ));
    section.claims.push(paper_steps(&fixed, context.number(approach.t_star), law));
    section.claims.push(bounded(context, &start)?);
    Ok(())
}

/// A state before the escape, from the first random start that escapes.
fn start(context: &Context<'_>) -> Result<Option<Study>, Error> {
    for seed in 1..=200 {
        let mut study = at(context, PLACE.0, PLACE.1)?;
        study.run.seed = seed;
        (study.run.transient, study.run.t_end, study.run.dt_out) = (0.0, 2000.0, 1.0);
        let dataset = context.simulate(&study)?;
        let Outcome::Escaped { t, .. } = dataset.manifest.outcome.outcome else { continue };
        let table = &dataset.trajectory;
        let row = table.get("t").unwrap_or(&[]).partition_point(|time| *time < t - BEFORE);
        if t < 100.0 || row >= table.rows() {
            continue;
        }
        for name in ["v1", "v2", "s11", "s12", "u111", "u222"] {
            study.set_initial(name, table.get(name).map_or(0.0, |column| column[row]))?;
        }
        study.run.t_end = 200.0;
        return Ok(Some(study));
    }
    Ok(None)
}

/// C of the leading balance, from the study's parameters.
fn law(study: &Study) -> Result<f64, Error> {
    let values = study.values()?;
    let named = |name: &str| {
        let specs = study.info().map(motiform_models::ModelInfo::parameters).unwrap_or_default();
        specs.iter().position(|spec| spec.name == name).map_or(0.0, |place| values[place])
    };
    let (e11, e22, e31, e32) = (-2.0 * named("a1"), named("b2"), named("d1") / 8.0, named("d2") / 2.0);
    Ok((4.0 / (e11 * e22 * (e31 + e32 / e11))).sqrt())
}

/// The time of a run's end, if it is a singularity.
type Ended = (String, Option<f64>);

fn times(context: &Context<'_>, start: &Study, methods: &[(&str, f64)]) -> Result<Vec<Ended>, Error> {
    let one = |(name, accuracy): &(&str, f64)| -> Result<Ended, Error> {
        let mut study = start.clone();
        study.run.stepper = (*name).to_owned();
        if ADAPTIVE.contains(&(*name, *accuracy)) {
            (study.run.rtol, study.run.atol) = (*accuracy, Some(1e-3 * accuracy));
        } else {
            study.run.step = Some(*accuracy);
        }
        let dataset = context.simulate(&study)?;
        let t = match dataset.manifest.outcome.outcome {
            Outcome::Escaped { t, .. } => Some(t),
            _ => None,
        };
        Ok((format!("{name} {}", power(*accuracy)), t))
    };
    context.each(methods, one)
}

/// The largest distance from the best value, and all distances in words.
fn compare(times: &[Ended], approach: &Approach) -> (f64, String) {
    let off = |t: &Option<f64>| t.map_or(f64::INFINITY, |t| (t - approach.t_star).abs());
    let words = |(name, t): &Ended| match t {
        Some(t) => format!("{name}: {}", power(t - approach.t_star)),
        None => format!("{name}: no escape"),
    };
    let list: Vec<String> = times.iter().map(words).collect();
    (times.iter().map(|(_, t)| off(t)).fold(0.0, f64::max), list.join(", "))
}

/// An explicit scheme of fixed step breaks down where |z1|^2 dt is about 2, its limit of stability: at
/// t* - t = C sqrt(dt/2).
fn paper_steps(fixed: &[Ended], t_star: f64, c: f64) -> motiform_figures::report::Claim {
    let steps: Vec<(&str, f64, f64)> = FIXED
        .iter()
        .zip(fixed)
        .map(|((name, dt), (_, t))| (*name, *dt, t.map_or(f64::NAN, |t| t_star - t)))
        .collect();
    let list: Vec<String> = steps
        .iter()
        .map(|(name, dt, s)| format!("{name} with dt = {} at t\\* − t = {s:.4}", power(*dt)))
        .collect();
    let as_expected = |s: f64, dt: f64| (0.5..2.0).contains(&(s / (c * (0.5 * dt).sqrt())));
    let all = steps.iter().all(|(_, dt, s)| as_expected(*s, *dt));
    let closer = steps.windows(2).take(1).all(|pair| pair[1].2 < pair[0].2);
    claim(
        &[156],
        "With the modified Euler scheme a numerical instability occurs.",
        format!(
            "It does, shortly before the singularity: {}. There |z_1|^2 dt passes the scheme's limit of stability; a smaller step \
             only comes closer to t\\*.",
            list.join(", ")
        ),
        "from the same start with fixed steps: the end lies within a factor of 2 of t\\* − t = C (dt/2)^{1/2}, and the smaller step \
         ends later",
        all && closer,
    )
}

/// The cubic terms omitted in the paper bound the motion.
fn bounded(context: &Context<'_>, start: &Study) -> Result<motiform_figures::report::Claim, Error> {
    let mut study = start.clone();
    study.set("b3", 0.01)?;
    study.set("d3", 0.01)?;
    study.run.t_end = 1000.0;
    let dataset = context.simulate(&study)?;
    let complete = context.number(f64::from(u8::from(dataset.manifest.outcome.is_complete()))) > 0.5;
    let fastest = dataset.trajectory.get("speed").unwrap_or(&[]).iter().copied().fold(0.0, f64::max);
    Ok(claim(
        &[110],
        "Since κ_2 and κ_3 are positive the cubic terms are not considered: b_3 = d_3 = 0.",
        if complete {
            format!(
                "They are what bounds the motion: with b_3 = d_3 = 0.01 the run from the same start lasts for all of {} time \
                 units, at a speed of at most {fastest:.2}.",
                study.run.t_end
            )
        } else {
            format!("Even with b_3 = d_3 = 0.01 the run ended early: {}.", dataset.manifest.outcome)
        },
        "the run that blows up at t\\*, with the cubic terms put back",
        complete,
    ))
}

/// The sizes of the modes against the time that is left.
fn picture(context: &Context<'_>, approach: &Approach, c: f64) -> Result<ReportFigure, Error> {
    let series = ["|z_1|", "|z_2|", "|z_3|"].iter().enumerate().map(|(index, label)| ErrorBarSeries {
        label: (*label).to_owned(),
        points: approach.sizes(index).map(|(s, size)| Measured { x: s, y: size, error: 0.0 }).collect(),
        joined: false,
    });
    let ends = [1e-5, 1.0];
    let line = |label: String, style, power: f64, factor: f64| ExpectedLine {
        label,
        style,
        points: ends.iter().map(|s| [*s, factor / libm::pow(*s, power)]).collect(),
    };
    let ([_, z2, z3], s) = (approach.theory(c), "(*t*\\* − *t*)");
    let svg = Chart {
        title: "The singularity at κ_2 = 0.3, κ_3 = 0.1".to_owned(),
        caption: vec![format!(
            "Computed by dop853, relative tolerance 10^{{-13}}; *t*\\* = {:.6} is extrapolated from the growth. Lines: the leading \
             balance of the equations, nothing fitted.",
            approach.t_star
        )],
        x_label: "*t*\\* − *t*".to_owned(),
        y_label: "size of the modes".to_owned(),
        logarithmic_x: true,
        logarithmic_y: true,
        ..Chart::default()
    }.with([
            line(format!("{c:.3}/{s}"), LineStyle::Solid, 1.0, c),
            line(format!("{z2:.2}/{s}^2"), LineStyle::Dashed, 2.0, z2),
            line(format!("{z3:.2}/{s}^2"), LineStyle::Dotted, 2.0, z3),
        ]).with(series);
    let svg = context.sheet(svg)?;
    Ok(figure(
        svg,
        "**The region × of Fig. 4(a).** On the way to t\\* all three modes follow the power laws of a singularity.",
    ))
}
