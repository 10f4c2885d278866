//! The points of codimension two: where two neighbouring modes of the circle become unstable simultaneously.

use super::super::claims::differs;
use super::super::context::Context;
use super::onset::{Onsets, WINDOWS};
use motiform_dynamics::VectorField as _;
use motiform_figures::report::{Claim, ReportFigure};
use motiform_figures::{Chart, ErrorBarSeries, ExpectedLine, LineStyle, Measured};
use motiform_models::cell::{CellField, CellParameters};
use motiform_study::Error;

/// The distance, as a part of the length, within which such a point is near its window.
const NEAR: f64 = 0.06;

/// A point of the plane (L, g1) at which modes `n` and `n + 1` are neutral.
struct Point {
    n: usize,
    length: f64,
    g1: f64,
}

/// The growth rate of a small mode `n`, from the field.
fn rate(length: f64, g1: f64, n: usize) -> f64 {
    const SMALL: f64 = 1e-9;
    let modes = 2 * n + 2;
    let field = CellField::new(&CellParameters { length, g1, ..CellParameters::default() }, modes);
    let (mut shape, mut rates) = (vec![0.0; 2 * modes], vec![0.0; 2 * modes]);
    shape[2 * n - 2] = SMALL;
    field.eval(0.0, &shape, &mut rates);
    rates[2 * n - 2] / SMALL
}

/// The `g1` at which mode `n` is neutral: its rate falls along a straight line with `g1`.
fn neutral(length: f64, n: usize) -> f64 {
    let (without, with) = (rate(length, 0.0, n), rate(length, 1.0, n));
    without / (without - with)
}

/// The crossing of the neutral curves of two neighbouring modes, beyond the onset of the second, by
/// bisection.
fn crossing(n: usize) -> Point {
    let apart = |length: f64| neutral(length, n) - neutral(length, n + 1);
    let first = std::f64::consts::TAU * (n as f64 + 1.0);
    let (mut low, mut high) = (first, 1.5 * first);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if apart(middle) * apart(low) > 0.0 { low = middle } else { high = middle }
    }
    let length = 0.5 * (low + high);
    Point { n, length, g1: neutral(length, n) }
}

/// Distance of a length from a window; 0 inside.
fn outside(length: f64, (from, to): (f64, f64)) -> f64 {
    (from - length).max(length - to).max(0.0)
}

/// Sentence 145.
pub(super) fn claim(context: &Context<'_>, onsets: &Onsets) -> Claim {
    let points = [1, 2, 3].map(crossing).map(|p| Point { length: context.number(p.length), ..p });
    let words = |(point, window): (&Point, &(f64, f64))| {
        let off = outside(point.length, *window);
        let place =
            if off == 0.0 { "inside".to_owned() } else { format!("{:.1} % off", 100.0 * off / point.length) };
        format!(
            "modes {} and {} at *L* = {:.3}, *g*_1 = {:.4} ({place} *W*_{})",
            point.n,
            point.n + 1,
            point.length,
            point.g1,
            point.n
        )
    };
    let found: Vec<String> = points.iter().zip(&WINDOWS).map(words).collect();
    let near = points.iter().zip(&WINDOWS).all(|(p, w)| outside(p.length, *w) < NEAR * p.length);
    let nearer =
        points.iter().zip(&WINDOWS).skip(1).all(|(p, w)| outside(p.length, *w) < outside(onsets.0[p.n], *w));
    differs(
        &[145],
        "Since the codimension two bifurcation points exist near these critical points, the various types of motion would appear.",
        format!("two neighbouring modes of the circle are neutral at once: {}", found.join("; ")),
        "growth rates of small modes in the field with *g*_1; a point is near a window if it lies inside, or off by less than 6 % of \
         its length",
        "they exist in the plane (*L*, *g*_1), not in the paper's equation: there *g*_1 = 0, and with *L* alone two modes never become \
         unstable at once. The points lie in or near the windows, not at the critical lengths 2π*n* of single modes; near them modes \
         *n* and *n* + 1 interact, as the chapter on both models shows for 1 and 2",
        near && nearer && points.iter().all(|point| point.g1 > 0.0 && point.g1 < 0.25),
    )
}

/// The neutral curves, their crossings and the windows.
pub(super) fn figure(context: &Context<'_>) -> Result<ReportFigure, Error> {
    let curve = |n: usize| {
        let first = std::f64::consts::TAU * n as f64;
        let point = |i: u32| {
            let x = first + (34.0 - first) * f64::from(i) / 100.0;
            Measured { x, y: neutral(x, n), error: 0.0 }
        };
        ExpectedLine {
            label: format!("mode {n} is neutral"),
            style: [LineStyle::Solid, LineStyle::Dashed, LineStyle::Dotted, LineStyle::DashDotted]
                [(n - 1) % 4],
            points: (0..=100).map(point).map(|m| [m.x, m.y]).collect(),
        }
    };
    let points = [1, 2, 3].map(crossing).map(|p| Measured { x: p.length, y: p.g1, error: 0.0 }).to_vec();
    let edge = |(from, to): &(f64, f64)| [*from, *to].map(|x| Measured { x, y: 0.0, error: 0.0 });
    let figure = Chart {
        title: "Where two modes of the circle become unstable at once".to_owned(),
        caption: vec![
            "Below its curve a mode grows. The paper's equation is the axis *g*_1 = 0; the marks on it are the ends of the paper's windows."
                .to_owned(),
        ],
        x_label: "length *L*".to_owned(),
        y_label: "*g*_1".to_owned(),
        zero_line: true,
        ..Chart::default()
    }.with((1..=4).map(curve)).with([
            ErrorBarSeries { label: "two modes at once".to_owned(), points, joined: false },
            ErrorBarSeries {
                label: "ends of *W*_1, *W*_2, *W*_3".to_owned(),
                points: WINDOWS.iter().flat_map(edge).collect(),
                joined: false,
            },
        ]);
    let caption = "Neutral curves of the modes of the circle, with the damping *g*_1 of long waves as a second parameter.";
    Ok(ReportFigure::new(context.sheet(figure)?, caption))
}
