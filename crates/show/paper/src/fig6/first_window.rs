//! The first window: circular, quasi-periodic and rectangular motion.

use super::super::claims::{claim, differs};
use super::super::context::Context;
use super::edges::Edges;
use super::lengths::Lengths;
use super::quasi::Search;
use super::windows::{number, places};
use motiform_analysis::Regime;
use motiform_figures::report::Claim;
use std::f64::consts::TAU;

/// Share of the lengths that must be rectangular: with finite accuracy a run may repeat exactly beside the cycle.
const MOST: f64 = 0.8;

pub(super) fn claims(context: &Context<'_>, edges: &Edges, lengths: &Lengths, quasi: &Search) -> [Claim; 4] {
    [
        circular(context, edges, lengths),
        quasi_periodic(context, edges, quasi),
        rectangular(context, edges, lengths),
        end(edges),
    ]
}

fn circular(context: &Context<'_>, edges: &Edges, lengths: &Lengths) -> Claim {
    let (from, to) = (number(edges.straight), number(edges.circular));
    let (all, count) = lengths.only(Regime::Circular, from, number(edges.cycle));
    let found = claim(
        &[137, 138],
        "Circular motion emerges in *W*_1 = [12.0, 14.4].",
        format!(
            "circular at {} between *L* = {from:.3} and {to:.3}, where it loses its stability to an oscillation",
            places(count)
        ),
        "Leading eigenvalue of the turning shape, followed in length; runs from random starts.",
        all && count > 0 && from < to && from > 12.0 && to < 14.4,
    );
    context.resting_on(count, "lengths", found)
}

fn quasi_periodic(context: &Context<'_>, edges: &Edges, quasi: &Search) -> Claim {
    let (cycle, circular) = (number(edges.cycle), number(edges.circular));
    let says = "Quasi-periodic motion emerges in *W*_1, between circular and rectangular motion.";
    let how = "Random starts at lengths through the edge between circular and rectangular motion, each \
        named by the classifier; eigenvalues of the circular motion and of the saddles of the cycle.";
    if quasi.found > 0 {
        return claim(&[138], says, quasi.words(), how, true);
    }
    let found = differs(
        &[138],
        says,
        quasi.words(),
        how,
        &format!(
            "the cycle of the rectangular motion attracts from *L* = {cycle:.4} on, before the circular \
            motion loses its stability at {circular:.4}: the two coexist in between, and no length is left \
            that needs a third motion. At *L* = 12.95 an oscillation about the circular motion (period \
            {:.0}) decays at {:.1e} only: for {:.0} time units and more the transient looks quasi-periodic.",
            TAU / edges.circular_slow.1.abs(),
            -edges.circular_slow.0,
            1.0 / edges.circular_slow.0.abs()
        ),
        cycle < circular
            && circular - cycle < 0.1
            && quasi.runs > 0
            && edges.circular_slow.0 < 0.0
            && edges.circular_slow.0 > -5e-3,
    );
    context.resting_on(quasi.runs, "runs", found)
}

fn rectangular(context: &Context<'_>, edges: &Edges, lengths: &Lengths) -> Claim {
    let (from, to) = (number(edges.cycle), number(edges.two_fold));
    let inside: Vec<_> = lengths.inside(number(edges.circular), 14.45).collect();
    let share: f64 = inside
        .iter()
        .flat_map(|point| point.1.motions.iter().filter(|motion| motion.regime == Regime::Rectangular))
        .map(|motion| motion.share)
        .sum::<f64>()
        / inside.len() as f64;
    let found = claim(
        &[138],
        "Rectangular motion emerges in *W*_1.",
        format!(
            "a heteroclinic cycle between two-fold shapes exists and attracts from *L* = {from:.3} to \
            {to:.3}; {:.0} % of the starts at {} lengths between (up to 14.4) follow it",
            100.0 * share,
            inside.len()
        ),
        "*λ*_+ + *λ*_− < 0 < *λ*_+ at the two-fold shape, followed in length; rests near it in runs from random starts.",
        share >= MOST && from > 12.0 && from < 14.4,
    );
    context.resting_on(inside.len(), "lengths", found)
}

fn end(edges: &Edges) -> Claim {
    let to = number(edges.two_fold);
    differs(
        &[137],
        "*W*_1 ends at *L* = 14.4.",
        format!("the two-fold shape becomes stable at *L* = {to:.3}"),
        "*λ*_+ of the two-fold shape, followed in length, changes sign.",
        &format!(
            "at *L* = 14.4 the shape is still left at *λ*_+ = {:.4}, and slower for longer *L*: approached \
            to 10^{{-7}}, a rest lasts {:.0} time units there, and a run looks motionless.",
            edges.leaving,
            7.0 * std::f64::consts::LN_10 / edges.leaving
        ),
        edges.leaving > 0.0 && edges.leaving < 0.05 && to > 14.4 && to < 15.0,
    )
}
