//! Fig. 1: the phase diagram of velocity and ellipse, compared with the lines from formulas.

mod correspondence;
mod grid;
mod hopf;
mod schemes;

use super::claims::{check, claim};
use super::context::Context;
use crate::lines::Continued;
use grid::{Grid, found_line};
use motiform_figures::report::{Claim, ReportFigure, Section};
use motiform_lab::draw::{boundary_lines, phase_diagram};
use motiform_lab::scan::Axis;
use motiform_models::tensor::reduced::{Line, Motion, Reduced};
use motiform_study::Error;

const ABOUT: &str = "Velocity *v* and ellipse *S* alone, *a*_1 = 1, *b*_1 = 0.5, *b*_3 = 1, over the plane (*κ*_2, *γ*). \
Every boundary of this diagram is known in closed form: in polar form the model has three unknowns, its straight and \
circular motions are roots of polynomials, and their stability follows from those. The lines drawn are these formulas; \
nothing about them is fitted. The markers are motions named by the classifier, which knows none of the formulas.";

pub(super) fn section(context: &Context<'_>) -> Result<Section, Error> {
    let study = context.preset("fig1", |study| {
        let (columns, rows) = context.choose((64, 48), (22, 16));
        study.title = "Motions of velocity and ellipse".to_owned();
        study.scan.axes = vec![
            Axis::parse(&format!("kappa2=-0.22:0.22:{columns}"))?,
            Axis::parse(&format!("gamma=-0.16:0.12:{rows}"))?,
        ];
        study.scan.samples = context.choose(2, 1);
        // near rest digits must stay relative, or shapes hover where they should decay
        (study.run.rtol, study.run.atol) = (1e-10, Some(1e-30));
        Ok(())
    })?;
    let (plan, cells) = context.scan("fig1", &study)?;
    let grid = Grid::new(&plan, &cells, Reduced::PAPER);
    let mut claims = regions(&grid);
    claims.push(order(&grid));
    claims.push(agreement(&grid));
    claims.extend(lines(&grid));
    claims.extend(hopf::claims(context, &grid)?);
    let continued = Continued::follow(context)?;
    claims.extend(continued.claims());
    claims.push(schemes::claim_of(context)?);
    claims.extend(correspondence::claims(context)?);
    let caption = "The motions found, one marker or colour per cell, and the analytic lines. Solid, broken and dotted lines \
                   are those of the paper's figure; the other two are lines that the paper does not draw.";
    Ok(Section {
        title: "Fig. 1: phase diagram of velocity and ellipse".to_owned(),
        about: ABOUT.to_owned(),
        parameters: parameters(&plan),
        figures: context.drawn(&|| {
            let diagram = context.sheet(phase_diagram(&plan, &cells)?)?;
            let diagram = ReportFigure::new(diagram, caption).of_paper("1");
            Ok(vec![diagram, continued.figure(context, &boundary_lines(&plan))?])
        })?,
        claims,
        ..Section::default()
    })
}

fn parameters(plan: &motiform_study::ScanPlan) -> Vec<(String, String)> {
    let c = &plan.computation;
    let axis = |i: usize| c.axes.get(i).map_or_else(String::new, ToString::to_string);
    [
        ("couplings", "*a*_1 = 1, *b*_1 = 0.5, *b*_3 = 1".to_owned()),
        ("across", axis(0).replace("kappa2", "*κ*_2")),
        ("upwards", axis(1).replace("gamma", "*γ*")),
        ("initial states per cell", format!("{}, random, {}", c.samples, c.random.words())),
        ("method", format!("{}, relative tolerance 10^{{-10}}", c.stepper)),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .to_vec()
}

/// The paper's regions, each at the position given by the formulas.
fn regions(grid: &Grid) -> Vec<Claim> {
    let says = [
        (Motion::Motionless, 91, "In the region indicated by the cross symbol the domain is motionless."),
        (Motion::Straight, 91, "It undergoes a straight motion in the region of the open squares."),
        (Motion::Circular, 91, "A circular motion in the region of the open circles."),
        (
            Motion::Rectangular,
            98,
            "For *κ*_2 < 0 rectangular motion occurs in the region of the solid squares (*γ* < 0).",
        ),
        (
            Motion::QuasiPeriodic,
            101,
            "Where *γ* > 0 and *κ*_2 < 0, next to the rectangular region, the motion is quasi-periodic.",
        ),
    ];
    says.into_iter()
        .map(|(motion, sentence, says)| {
            let (agree, all) = grid.region(motion);
            let finds = format!("{agree} of {all} cells that lie inside the analytic region are {}", motion.name());
            let how = "all cells more than one cell away from every analytic line where this is the only stable motion; \
                       at least 98 % agree, and there are at least 3";
            claim(&[sentence], says, finds, how, all >= 3 && agree as f64 >= 0.98 * all as f64)
        })
        .collect()
}

/// From below to above at kappa2 = -0.1 and 0.1.
fn order(grid: &Grid) -> Claim {
    let (left, right) = (grid.upwards(-0.1), grid.upwards(0.1));
    let expected = (
        vec!["straight", "rectangular", "quasi-periodic", "circular"],
        vec!["motionless", "straight", "circular"],
    );
    let finds = format!("*κ*_2 ≈ -0.1: {}; *κ*_2 ≈ 0.1: {}", left.join(", "), right.join(", "));
    let holds = (left, right) == expected;
    let says = "With growing *γ* the domain is motionless, then goes straight, then in circles (*κ*_2 > 0); for *κ*_2 < 0 the \
                rectangular and the quasi-periodic motion lie between straight and circular.";
    claim(
        &[96, 189],
        says,
        finds,
        "the most frequent motion of each cell in the two columns, from below",
        holds,
    )
}

/// Every cell compared with the formulas.
fn agreement(grid: &Grid) -> Claim {
    let count = grid.agreement();
    let finds = format!(
        "{} of {} cells more than one cell away from every line agree ({} more are undetermined); of the {} cells nearer to \
         a line {} agree ({} more are undetermined)",
        count.far.0, count.far.1, count.undetermined.0, count.near.1, count.near.0, count.undetermined.1
    );
    let how = "a cell agrees if every motion found in it is stable by the formulas (beside a stable straight motion the \
               rectangular one may exist as well); at least 99 % of the far cells must, and at most 1 % of them be undetermined";
    let far = count.far.1 as f64;
    let holds = count.far.0 as f64 >= 0.99 * far && count.undetermined.0 as f64 <= 0.01 * far;
    claim(&[84, 90], "The phase diagram, obtained numerically.", finds, how, holds)
}

/// Each line with a sharp change, found by the scan; without sentences of the paper it is an additional check.
fn lines(grid: &Grid) -> Vec<Claim> {
    use Line::{
        CircleToStraight, CircularToQuasiPeriodic, EllipseToStraight, QuasiPeriodicToRectangular,
        StraightToCircular,
    };
    type Sought = (&'static [Line], [Motion; 2], &'static [u16], &'static str);
    let all: [Sought; 4] = [
        (
            &[CircleToStraight, EllipseToStraight],
            [Motion::Motionless, Motion::Straight],
            &[93],
            "The solid line is the boundary between the motionless state and the straight motion.",
        ),
        (
            &[StraightToCircular],
            [Motion::Straight, Motion::Circular],
            &[93],
            "The broken line is the phase boundary between the straight motion and the circular motion.",
        ),
        (
            &[CircularToQuasiPeriodic],
            [Motion::Circular, Motion::QuasiPeriodic],
            &[],
            "Quasi-periodic motion lies beside circular motion, from *γ* = −(2/5) *κ*_2 on (no line in the paper).",
        ),
        (
            &[QuasiPeriodicToRectangular],
            [Motion::QuasiPeriodic, Motion::Rectangular],
            &[101],
            "Quasi-periodic motion has *γ* > 0 (no line in the paper; *γ* = 0 exactly, *κ*_2 < 0).",
        ),
    ];
    let line = |(lines, sides, sentences, says)| found_line(grid, lines, sides, sentences, says);
    all.into_iter().map(line).collect()
}
