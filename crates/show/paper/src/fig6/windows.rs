//! The statements of the paper about the windows of length, against edges computed from eigenvalues and scans
//! from random starts.

use super::super::claims::{check, claim, differs};
use super::super::context::Context;
use super::edges::Edges;
use super::lengths::Lengths;
use super::onset::Onsets;
use super::zigzags::Zigzags;
use motiform_analysis::Regime;
use motiform_figures::report::Claim;

/// The largest distance of an edge from the paper's, which has three digits and was found by looking: the
/// spacing of the scan.
const NEAR: f64 = 0.1;

pub(super) fn claims(
    context: &Context<'_>,
    edges: &Edges,
    lengths: &Lengths,
    zigzags: &Zigzags,
    quasi: &super::quasi::Search,
    onsets: &Onsets,
) -> Vec<Claim> {
    let mut claims = onsets.claims(edges).to_vec();
    claims.extend([super::codimension::claim(context, onsets), fastest(edges)]);
    claims.extend([nothing(context, onsets, lengths), straight(context, edges, onsets, lengths)]);
    claims.extend(super::first_window::claims(context, edges, lengths, quasi));
    claims.extend([
        two_fold(context, edges, lengths),
        second_start(edges),
        second_end(edges),
        three_fold(context, edges, lengths),
    ]);
    claims.extend([zigzags.claim(edges), four_fold(context, edges, lengths)]);
    claims
}

/// An edge in words.
pub(super) fn words(edge: Option<f64>) -> String {
    edge.map_or_else(|| "not met".to_owned(), |edge| format!("{edge:.3}"))
}

/// An edge as a number.
pub(super) fn number(edge: Option<f64>) -> f64 {
    edge.unwrap_or(f64::NAN)
}

/// The number of lengths, all of them, in words.
pub(super) fn places(count: usize) -> String {
    match count {
        1 => "the one length scanned".to_owned(),
        2 => "both lengths scanned".to_owned(),
        _ => format!("all {count} lengths scanned"),
    }
}

fn fastest(edges: &Edges) -> Claim {
    let (rate, square) = edges.fastest;
    check(
        "Of *σ* = *k*^4 − *k*^6 the largest value is 4/27, at *k*^2 = 2/3 (follows from the paper's equation).",
        format!("{rate:.9} at *k*^2 = {square:.6}; 4/27 = {:.9}", 4.0 / 27.0),
        "Golden-section search over the length with the field's own rate of mode 1.",
        (rate - 4.0 / 27.0).abs() < 1e-12 && (square - 2.0 / 3.0).abs() < 1e-6,
    )
}

fn nothing(context: &Context<'_>, onsets: &Onsets, lengths: &Lengths) -> Claim {
    let (still, count) = lengths.only(Regime::Motionless, 0.0, onsets.0[0]);
    let found = claim(
        &[141],
        "No shape instability and no motion for *L* < 6.2.",
        format!(
            "the circle is stable up to *L* = {:.4} = 2π; motionless at {} below",
            onsets.0[0],
            places(count)
        ),
        "Runs: growth of a small mode 1, and motions from random starts; the paper gives two digits.",
        still && count > 0 && (onsets.0[0] - 6.2).abs() < NEAR,
    );
    context.resting_on(count, "lengths", found)
}

fn straight(context: &Context<'_>, edges: &Edges, onsets: &Onsets, lengths: &Lengths) -> Claim {
    let end = number(edges.straight);
    let (all, count) = lengths.only(Regime::Straight, onsets.0[0], end);
    let same = (end - number(edges.straight_refined)).abs();
    let found = differs(
        &[140],
        "The straight motion is found for 6.2 < *L* < 12.0.",
        format!("straight at {} between 2π and *L* = {end:.3}, where it loses its stability", places(count)),
        "Edge: the leading eigenvalue of the straight shape, followed in length, changes sign. Runs from random starts between.",
        &format!(
            "at *L* = 12.0 the leading eigenvalue of the straight motion is still {:.3} (stable); computed \
            with twice as many modes the edge moves by less than {:.0e}. The paper's limit is that of its \
            scan.",
            edges.straight_growth,
            same.max(1e-5)
        ),
        all && count > 0 && edges.straight_growth < 0.0 && same < 1e-4 && end > 12.0 && end < 12.5,
    );
    context.resting_on(count, "lengths", found)
}

fn two_fold(context: &Context<'_>, edges: &Edges, lengths: &Lengths) -> Claim {
    let (from, to) = (number(edges.two_fold), number(edges.two_fold_end));
    let (all, count) = lengths.only(Regime::Motionless, from + NEAR, to);
    let found = claim(
        &[137],
        "Between *W*_1 and *W*_2 there is no intricate motion.",
        format!(
            "a motionless two-fold shape, stable from *L* = {from:.3} to {to:.3}; motionless at {} between",
            places(count)
        ),
        "Leading eigenvalue of the shape followed in length; number of folds from its rotations; runs from random starts.",
        all && count > 0 && edges.folds[0] == 2,
    );
    context.resting_on(count, "lengths", found)
}

fn second_start(edges: &Edges) -> Claim {
    let from = number(edges.two_fold_end);
    differs(
        &[137],
        "*W*_2 begins at *L* = 21.0.",
        format!("the two-fold shape loses its stability at *L* = {from:.3}"),
        "Leading eigenvalue of the two-fold shape, followed in length.",
        &format!(
            "up to *L* = 21.0 its growth rate is at most {:.4}: what starts near it rests for thousands of \
            time units and looks motionless.",
            edges.second_leaving
        ),
        from > 20.5 && from < 21.0 && edges.second_leaving > 0.0 && edges.second_leaving < 0.01,
    )
}

fn second_end(edges: &Edges) -> Claim {
    let (from, to) = edges.second_circular;
    let beyond = to.map_or("beyond 25".to_owned(), |to| format!("to {to:.2}"));
    claim(
        &[137, 138],
        "*W*_2, with its quasi-periodic and chaotic motions, ends at *L* = 21.9.",
        format!(
            "circular motion becomes stable at *L* = {} and stays so {beyond}; from {} on random starts end on the three-fold shape",
            words(from),
            words(edges.three_fold.0)
        ),
        "Leading eigenvalues of the circular motion and of the three-fold shape. The paper does not list the circular motion here.",
        from.is_some_and(|from| (from - 21.9).abs() < NEAR),
    )
}

fn three_fold(context: &Context<'_>, edges: &Edges, lengths: &Lengths) -> Claim {
    let (from, to) = edges.three_fold;
    let circular = number(edges.second_circular.0);
    let (all, count) = lengths.only(Regime::Motionless, number(from) + 3.0 * NEAR, 28.95);
    let (turning, turned) = lengths.only(Regime::Circular, circular + 0.5 * NEAR, number(from) - 0.5 * NEAR);
    let found = differs(
        &[137],
        "Between *W*_2 and *W*_3 there is no intricate motion.",
        format!(
            "a motionless three-fold shape, stable from *L* = {} to {}; motionless at {} up to *W*_3; but \
            circular motion at {} between *W*_2 and the three-fold shape",
            words(from),
            words(to),
            places(count),
            places(turned)
        ),
        "Leading eigenvalues of the shapes, followed in length; number of folds from their modes; runs from random starts.",
        &format!(
            "the three-fold shape is stable only from *L* = {} on; from {circular:.3} to there the stable \
            motion is circular, which the paper does not mention.",
            words(from)
        ),
        all && count > 0 && edges.folds[1] == 3 && turning && turned > 0,
    );
    context.resting_on(count.min(turned), "lengths", found)
}

fn four_fold(context: &Context<'_>, edges: &Edges, lengths: &Lengths) -> Claim {
    let from = number(edges.four_fold);
    let (all, count) = lengths.only(Regime::Motionless, from + 5.0 * NEAR, 32.0);
    let found = claim(
        &[137],
        "Beyond *W*_3 there is no intricate motion (up to *L* = 31).",
        format!(
            "a motionless four-fold shape, stable from *L* = {from:.3}; motionless at {} beyond {:.1}",
            places(count),
            from + 0.5
        ),
        "Leading eigenvalue of the four-fold shape, followed in length; runs from random starts.",
        all && count > 0 && edges.folds[2] == 4,
    );
    context.resting_on(count, "lengths", found)
}
