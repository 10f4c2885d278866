//! Figures of bodies: paths, series, spectra, panels.

use super::maps::branches;
use super::measurements::bands;
use super::{axis, ellipse, noise, words};
use motiform_figures::palette::{BLUE, CATEGORIES, VERMILION};
use motiform_figures::{
    Chart, Curve, OutlineStamp, Panel, Panels, PathFigure, PathPoint, SectionLine, SeriesFigure,
    SpaceTimeFigure, SpectrumCurve, TrackPanel, TrackPanels,
};
use std::f64::consts::TAU;

pub(super) fn path(count: usize, stamps: usize) -> PathFigure {
    let turns = if stamps > 0 { 30.0 } else { 3000.0 };
    let at = |t: f64| [t * 30.0 / turns, 4.0 * (t / 3.0).sin()];
    let point = |t: f64| PathPoint { t, x: at(t)[0], y: at(t)[1] };
    let stamp = |t: f64| OutlineStamp { t, points: ellipse(at(t), 1.0, (t / 3.0).cos()) };
    PathFigure {
        title: "Zigzag motion, *κ*_2 = 0.9, *κ*_3 = 0.1".into(),
        caption: words(),
        segments: vec![axis(0.0, turns, count).into_iter().map(point).collect()],
        outlines: axis(0.0, turns, stamps).into_iter().map(stamp).collect(),
        ..PathFigure::default()
    }
}

pub(super) fn section() -> PathFigure {
    let at = |t: f64| (4.0 + (1.7 * t).cos(), 0.9 * t);
    let point = |t: f64| PathPoint { t, x: at(t).0 * at(t).1.cos(), y: at(t).0 * at(t).1.sin() };
    let line = SectionLine {
        from: [-3.0, 3.0],
        to: [3.0, 3.0],
        label: "section *y* = 3".into(),
        crossings: (0..9).map(|i| [-2.4 + 0.6 * f64::from(i), 3.0]).collect(),
    };
    PathFigure {
        title: "Section of a quasi-periodic orbit".into(),
        segments: vec![axis(0.0, 40.0, 3000).into_iter().map(point).collect()],
        section: Some(line),
        ..path(2, 0)
    }
}

pub(super) fn series() -> SeriesFigure {
    let times = axis(0.0, 200.0, 1500);
    let curve = |label: &str, colour, f: fn(f64) -> Option<f64>| Curve {
        label: label.into(),
        colour,
        values: times.iter().map(|t| f(*t)).collect(),
    };
    let speed = curve("", BLUE, |t| Some(0.8 + 0.1 * (t / 3.0).sin()));
    let turning = curve("", BLUE, |t| ((t / 30.0).sin() < 0.95).then(|| 0.02 * (t / 6.0).sin()));
    let first = curve("|*U*| of the model", BLUE, |t| Some(12_000.0 * (t / 9.0).cos().powi(2)));
    let second = curve("|*V*|", VERMILION, |t| Some(9000.0 * (t / 17.0).sin().powi(2)));
    SeriesFigure {
        title: "Zigzag motion".into(),
        panels: vec![
            Panel { label: "speed |***v***|".into(), curves: vec![speed], least: 0.0 },
            Panel { label: "turning rate".into(), curves: vec![turning], least: 0.0 },
            Panel { label: "size".into(), curves: vec![first, second], least: 0.0 },
        ],
        notes: vec!["The turning rate is undefined where the body is at rest.".into()],
        caption: words(),
        times,
        ..SeriesFigure::default()
    }
}

pub(crate) fn return_map(count: usize) -> Chart {
    let mut x = 0.3;
    let mut step = || {
        let old = x;
        x = 3.9 * x * (1.0 - x);
        [6.0 * old - 3.0, 6.0 * x - 3.0]
    };
    let names = ["*x*_*n*", "*x*_{*n*+1}"].map(str::to_owned);
    Chart {
        title: "Return map of the section *y* = 3".into(),
        caption: words(),
        ..Chart::return_map(names, (0..count).map(|_| step()).collect())
    }
}

pub(super) fn space_time() -> SpaceTimeFigure {
    let (columns, rows) = (120, 64);
    let value = |i: usize| {
        let (t, s) = ((i % columns) as f64, (i / columns) as f64 / rows as f64);
        0.9 * (0.11 * t).sin() * (TAU * s).cos() + 0.6 * (2.0 * TAU * s + 0.1 * t).sin()
    };
    SpaceTimeFigure {
        title: "Active cell: *φ*(*s*, *t*)".into(),
        caption: words(),
        times: (1000.0, 1600.0),
        places: (0.0, 21.6),
        columns,
        rows,
        values: (0..columns * rows).map(value).collect(),
        ..SpaceTimeFigure::default()
    }
}

pub(super) fn spectrum(floor: f64) -> Chart {
    let frequencies = axis(0.0, 5.0, 900);
    let power = |i: usize, f: f64| noise(i) * (floor + 1.0 / (1.0 + (30.0 * f).powi(4))) / (1.0 + f);
    let peak = |f: f64| 1e-4 / ((f - 0.4).powi(2) + 1e-3);
    let curve = |n: usize| SpectrumCurve {
        label: format!("mode {}", n + 1),
        colour: CATEGORIES[n],
        power: frequencies
            .iter()
            .enumerate()
            .map(|(i, f)| power(i + n, *f) + n as f64 * floor * peak(*f))
            .collect(),
    };
    let curves = (0..2).map(curve).collect();
    Chart { title: "Power spectrum".into(), caption: words(), ..Chart::spectra(frequencies, curves) }
}

pub(super) fn tracks() -> TrackPanels {
    let panel = |k: u32| {
        let way = |t: f64| [t, (t / (2.0 + f64::from(k))).sin()];
        TrackPanel {
            name: format!("cell {k}, 0 to 120 min"),
            path: vec![axis(0.0, 12.0, 60).into_iter().map(way).collect()],
            outlines: axis(0.0, 12.0, 6).into_iter().map(|t| ellipse(way(t), 1.0, t)).collect(),
        }
    };
    TrackPanels {
        title: "Outlines".into(),
        caption: words(),
        unit: "µm".into(),
        columns: 2,
        panels: (1..=4).map(panel).collect(),
    }
}

pub(super) fn film_strip() -> TrackPanels {
    let way = |t: f64| [2.0 * t, (0.7 * t).sin()];
    let panel = |k: u32| {
        let t = 3.0 * f64::from(k);
        TrackPanel {
            name: format!("*t* = {} min", 17.25 * t),
            path: vec![axis((t - 0.7).max(0.0), t, 20).into_iter().map(way).collect()],
            outlines: vec![ellipse(way(t), 1.0, t)],
        }
    };
    TrackPanels { title: "Film strip".into(), columns: 8, panels: (0..8).map(panel).collect(), ..tracks() }
}

pub(super) fn panels() -> Panels {
    Panels::new(1, vec![Box::new(series()), Box::new(branches(false)), Box::new(bands(true))])
}
