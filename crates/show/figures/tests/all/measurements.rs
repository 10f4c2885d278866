//! Error bars and survival curves: axes, what is left out, what is refused.

use crate::drawing::drawing;
use motiform_figures::geometry::Point;
use motiform_figures::{
    Chart, ErrorBarSeries, ExpectedLine, FigureError, LineStyle, Measured, SurvivalCurve, SurvivalStep,
};

fn measured(points: &[(f64, f64, f64)]) -> Chart {
    let points = points.iter().map(|(x, y, error)| Measured { x: *x, y: *y, error: *error }).collect();
    let series = [ErrorBarSeries { label: "*λ*_1".into(), points, joined: true }];
    Chart::default().with(series)
}

fn survival(shares: &[f64]) -> Chart {
    let step = |(i, s): (usize, &f64)| SurvivalStep { t: i as f64, share: *s, low: s - 0.1, high: s + 0.1 };
    let steps = shares.iter().enumerate().map(step).collect();
    let curve = SurvivalCurve { label: "runs".into(), steps, end: shares.len() as f64 };
    Chart::survival([curve])
}

fn line(points: Vec<Point>) -> ExpectedLine {
    ExpectedLine { label: "expected".into(), style: LineStyle::Dashed, points }
}

#[test]
fn no_measurement_gives_a_number_that_is_none() {
    let far = vec![line(vec![[-1e99, 0.0], [1e99, 1e99]]), line(vec![[0.0, 0.0]])];
    let log = |figure| Chart { logarithmic_x: true, logarithmic_y: true, ..figure }.with(far.clone());
    let all = [
        measured(&[(0.0, 0.0, 0.0)]).svg(),
        Chart { zero_line: true, ..measured(&[(1.0, 2e-9, 1e-9)]) }.with(far.clone()).svg(),
        log(measured(&[(1.0, 1.0, 2.0), (1e90, 1e-90, 0.0), (0.0, 1.0, 0.0)])).svg(),
        log(measured(&[(3.0, 5.0, 5.0)])).svg(),
        survival(&[1.0]).svg(),
        survival(&[1.0, 0.5, 0.05, 0.0, 0.0]).with(far.clone()).svg(),
    ];
    for svg in all {
        let svg = svg.expect("a figure");
        for bad in ["NaN", "inf", "9223372"] {
            assert!(!drawing(&svg).contains(bad), "{bad} in {}", drawing(&svg));
        }
    }
    let twice = || survival(&[1.0, 0.5]).svg().expect("a figure");
    assert_eq!(twice(), twice());
}

#[test]
fn values_without_a_place_are_counted_in_the_caption() {
    let figure = measured(&[(1.0, 1.0, 0.1), (2.0, -1.0, 0.1), (0.0, 1.0, 0.0)]);
    let figure = |x, y| Chart { logarithmic_x: x, logarithmic_y: y, ..figure.clone() };
    for (x, y, count) in [(true, false, 1), (false, true, 1), (true, true, 2)] {
        let svg = figure(x, y).svg().expect("a figure");
        assert!(svg.contains(&format!("not above 0: {count} of the values")));
    }
    assert!(!figure(false, false).svg().expect("a figure").contains("Not drawn"));
}

#[test]
fn the_zero_line_widens_the_axis_and_the_legend_names_lines() {
    let figure = measured(&[(0.0, 5.0, 1.0), (1.0, 6.0, 1.0)]);
    let without = figure.svg().expect("a figure");
    let lines = vec![line(vec![[0.0, 0.0], [1.0, 1.0]])];
    let with = Chart { zero_line: true, ..figure }.with(lines).svg().expect("a figure");
    assert!(!without.contains(">2</tspan>"), "the axis begins at 4");
    assert!(with.contains(">expected</tspan>") && with.contains(">2</tspan>"));
}

#[test]
fn bad_measurements_are_refused() {
    assert!(matches!(Chart::default().svg(), Err(FigureError::Empty { .. })));
    assert!(matches!(measured(&[]).svg(), Err(FigureError::Empty { .. })));
    let negative = Chart { logarithmic_y: true, ..measured(&[(1.0, -1.0, 0.0)]) };
    assert!(matches!(negative.svg(), Err(FigureError::Empty { .. })));
    let nan = measured(&[(0.0, 1.0, 0.1), (1.0, f64::NAN, 0.1)]).svg();
    assert!(matches!(nan, Err(FigureError::NotFinite { index: 4, .. })));
    assert!(matches!(measured(&[(0.0, 1.0, -0.1)]).svg(), Err(FigureError::OutOfRange { .. })));
    assert!(matches!(survival(&[0.0]).svg(), Err(FigureError::Empty { .. })));
    assert!(matches!(survival(&[1.0, f64::NAN]).svg(), Err(FigureError::NotFinite { index: 5, .. })));
    let step = |t, share| SurvivalStep { t, share, low: share, high: share };
    let steps = vec![step(0.0, 1.0), step(1.0, 0.5)];
    let early = Chart::survival([SurvivalCurve { label: "runs".into(), steps, end: 0.5 }]);
    assert!(matches!(early.svg(), Err(FigureError::Unsorted { index: 2, .. })));
}
