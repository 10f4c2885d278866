//! Phase diagrams and error bars.

use std::path::Path;

use motiform_figures::{
    Cell, Chart, ErrorBarSeries, ExpectedLine, LineStyle, Measured, PhaseDiagram, REGIMES,
};

use super::{Outcome, noise, save};

pub(super) fn draw(folder: &Path) -> Outcome {
    for (columns, rows) in [(12, 6), (16, 6), (40, 40), (64, 64), (200, 200), (3, 2)] {
        save(folder, &format!("phase_{columns}x{rows}"), &phase_diagram(columns, rows).svg()?)?;
    }
    save(folder, "strip_130", &strip(130).svg()?)?;
    save(folder, "strip_12", &strip(12).svg()?)?;
    save(folder, "exponent", &exponent().svg()?)?;
    save(folder, "exponent_many", &exponent_many().svg()?)
}

fn axis(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| from + (to - from) * i as f64 / (count.max(2) - 1) as f64).collect()
}

pub(super) fn phase_diagram(columns: usize, rows: usize) -> PhaseDiagram {
    let (x, y) = (axis(-1.5, 1.5, columns), axis(0.0, 1.0, rows));
    let places = y.iter().flat_map(|y| x.iter().map(move |x| (*x, *y)));
    let line = |label: &str, style, f: fn(f64) -> f64| ExpectedLine {
        label: label.into(),
        style,
        points: axis(-3.0, 3.0, 200).into_iter().map(|x| [x, f(x)]).collect(),
    };
    PhaseDiagram {
        title: "Full tensor model: regimes over *κ*_2 and *κ*_3".into(),
        caption: vec![format!(
            "{columns} x {rows} cells, 8 initial states each; *γ* = 1, *a*_1 = -1, *b*_1 = -0.5."
        )],
        x_label: "*κ*_2".into(),
        y_label: "*κ*_3".into(),
        cells: places.map(|(x, y)| Cell { x, y, shares: shares(x, y) }).collect(),
        x,
        y,
        lines: vec![
            line("drift bifurcation, *κ*_2 = *κ*_3", LineStyle::Solid, |x| x),
            line("Hopf", LineStyle::Dashed, |x| 0.8 - 0.4 * x * x),
            line("steep", LineStyle::DashDotted, |x| 1e6 * (x + 0.75)),
        ],
    }
}

/// Regimes in wavy regions, two motions where they overlap.
fn shares(x: f64, y: f64) -> Vec<(String, f64)> {
    let name = |i: usize| REGIMES[i].name.to_owned();
    let u = 2.4 * (x + 1.5) + 0.7 * (5.0 * y).sin();
    let first = (u as usize).min(8);
    let second = ((u + 0.3) as usize).min(8);
    let third = if (x - 0.4).hypot(y - 0.5) < 0.2 { 6 } else { first };
    let mut shares = vec![(name(first), 1.0_f64)];
    for (other, share) in [(second, 0.375), (third, 0.25)] {
        if other != first {
            shares[0].1 -= share;
            shares.push((name(other), share));
        }
    }
    shares.sort_by(|a, b| b.1.total_cmp(&a.1));
    shares
}

fn strip(columns: usize) -> PhaseDiagram {
    let x = axis(0.0, 1.3, columns);
    let cells = x.iter().map(|x| Cell { x: *x, y: 0.0, shares: shares(2.2 * x - 1.4, 0.4) }).collect();
    PhaseDiagram {
        title: "Active cell model: regimes over the feedback *K*".into(),
        caption: vec!["32 initial states each; *L* = 21.6.".into()],
        x_label: "*K* (per model time)".into(),
        x,
        cells,
        lines: vec![ExpectedLine {
            label: "loss of stability of the circle".into(),
            style: LineStyle::Dashed,
            points: vec![[0.61, 0.0], [0.61, 1.0]],
        }],
        ..PhaseDiagram::default()
    }
}

fn measured(points: impl IntoIterator<Item = (f64, f64, f64)>) -> Vec<Measured> {
    points.into_iter().map(|(x, y, error)| Measured { x, y, error }).collect()
}

fn exponent() -> Chart {
    let value = |i: usize| {
        let x = 0.35 + 0.01 * i as f64;
        let y = if x < 0.48 { 0.0 } else { 0.05 * (x - 0.48).sqrt() + 0.004 * (noise(i) - 0.5) };
        (x, y, 0.0015 + 0.002 * noise(i + 5))
    };
    let second = |i: usize| (0.35 + 0.01 * i as f64, -0.01 - 0.0003 * i as f64, 0.0005);
    let series = |label: &str, points, joined| ErrorBarSeries { label: label.into(), points, joined };
    Chart {
        title: "Lyapunov exponents against *κ*_2".into(),
        caption: vec!["Error bars: standard error over 20 segments.".into()],
        x_label: "*κ*_2".into(),
        y_label: "exponent (per model time)".into(),
        zero_line: true,
        ..Chart::default()
    }
    .with([
        series("*λ*_1", measured((0..35).map(value)), true),
        series("*λ*_2", measured((0..35).map(second)), false),
    ])
}

fn exponent_many() -> Chart {
    let line = |i: usize| {
        let points = (0..12).map(|k| (f64::from(k), (1.0 + i as f64) * 1e-5 * f64::from(k).sin(), 2e-6));
        ErrorBarSeries { label: format!("*K* = {i}"), points: measured(points), joined: true }
    };
    let empty = Chart { title: "All markers, small numbers".into(), layers: Vec::new(), ..exponent() };
    empty.with((0..6).map(line))
}
