//! Measured numbers with their errors.

use super::{axis, noise, words};
use motiform_figures::{
    BandCurve, BandPoint, Chart, ErrorBarSeries, ExpectedLine, Interval, LineStyle, Measured, SurvivalCurve,
    SurvivalStep,
};

pub(super) fn bands(logarithmic: bool) -> Chart {
    let f = |x: f64| if logarithmic { x * x / (1.0 + 0.2 * x) } else { (-0.3 * x).exp() * x.cos() };
    let point = |x: f64| BandPoint { x, y: f(x), low: 0.8 * f(x) - 0.02, high: 1.2 * f(x) + 0.02 };
    Chart {
        title: "Mean-square displacement".into(),
        caption: words(),
        x_label: "lag".into(),
        y_label: "MSD".into(),
        zero_line: !logarithmic,
        logarithmic_x: logarithmic,
        logarithmic_y: logarithmic,
        ..Chart::default()
    }
    .with([BandCurve {
        label: "60 bodies".into(),
        points: axis(0.1, 12.0, 60).into_iter().map(point).collect(),
    }])
    .with([ExpectedLine {
        label: "persistent walk".into(),
        style: LineStyle::Dashed,
        points: vec![[0.1, f(0.1)], [12.0, f(12.0)]],
    }])
}

pub(super) fn exponents() -> Chart {
    let point = |i: usize| {
        let x = 0.35 + 0.01 * i as f64;
        Measured { x, y: 0.05 * (x - 0.48).max(0.0).sqrt(), error: 0.0015 + 0.002 * noise(i) }
    };
    let below = |i: usize| Measured { x: 0.35 + 0.01 * i as f64, y: -0.01 - 3e-4 * i as f64, error: 5e-4 };
    let series = |label: &str, points, joined| ErrorBarSeries { label: label.into(), points, joined };
    Chart {
        title: "Lyapunov exponents".into(),
        caption: words(),
        x_label: "*κ*_2".into(),
        y_label: "*λ*".into(),
        zero_line: true,
        ..Chart::default()
    }
    .with([
        series("*λ*_1", (0..30).map(point).collect(), true),
        series("*λ*_2", (0..30).map(below).collect(), false),
    ])
}

pub(super) fn rest_times() -> Chart {
    let point = |i: usize| {
        let sigma = 10f64.powf(-8.0 + 0.5 * i as f64);
        Measured { x: sigma, y: 40.0 - 3.1 * sigma.ln() + 4.0 * noise(i), error: 3.0 }
    };
    Chart {
        title: "Mean rest time".into(),
        caption: words(),
        x_label: "noise amplitude *σ*".into(),
        y_label: "mean rest time".into(),
        logarithmic_x: true,
        ..Chart::default()
    }
    .with([ExpectedLine {
        label: "slope -1/*λ*_u".into(),
        style: LineStyle::Dashed,
        points: vec![[1e-9, 104.2], [1.0, 40.0]],
    }])
    .with([vec![Interval { x: 1e-5, low: 60.0, high: 90.0 }]])
    .with([ErrorBarSeries { label: "runs".into(), points: (0..12).map(point).collect(), joined: false }])
}

pub(super) fn survival() -> Chart {
    let curve = |label: &str, count: usize, mean: f64| {
        let step = |i: usize| {
            let share = (count - i) as f64 / count as f64;
            let error = 1.96 * (share * (1.0 - share) / count as f64).sqrt();
            SurvivalStep { t: -mean * share.ln(), share, low: share - error, high: (share + error).min(1.0) }
        };
        SurvivalCurve {
            label: label.into(),
            steps: (0..count).map(step).collect(),
            end: mean * (count as f64).ln(),
        }
    };
    Chart {
        title: "How long chaos lasts".into(),
        caption: words(),
        x_label: "*t* (1000)".into(),
        ..Chart::survival([curve("*κ*_2 = 0.9", 90, 1.3), curve("*κ*_2 = 0.95", 30, 2.9)])
    }
    .with([ExpectedLine {
        label: "exponential law".into(),
        style: LineStyle::Dashed,
        points: vec![[0.0, 1.0], [6.5, (-5f64).exp()]],
    }])
}
