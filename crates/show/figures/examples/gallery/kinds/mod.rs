//! Every kind of figure once, from data of a small formula: what the gallery draws and what the reference pictures show.

mod bodies;
mod maps;
mod measurements;

pub(crate) use bodies::return_map;
use bodies::{film_strip, panels, path, section, series, space_time, spectrum, tracks};
use maps::{branches, curves, places};
pub(crate) use maps::{phase_diagram, strip};
use measurements::{bands, exponents, rest_times, survival};
use motiform_figures::Figure;
use std::f64::consts::TAU;

/// A figure and its name.
pub(crate) type Kind = (&'static str, Box<dyn Figure>);

/// One figure of each kind.
pub(crate) fn kinds() -> Vec<Kind> {
    vec![
        ("path", Box::new(path(400, 14))),
        ("path-section", Box::new(section())),
        ("path-crowded", Box::new(path(60_000, 0))),
        ("series", Box::new(series())),
        ("return-map", Box::new(return_map(400))),
        ("space-time", Box::new(space_time())),
        ("spectrum", Box::new(spectrum(1e-3))),
        ("spectrum-deep", Box::new(spectrum(1e-26))),
        ("phase-tiles", Box::new(phase_diagram(9, 6))),
        ("phase-mosaic", Box::new(phase_diagram(60, 50))),
        ("strip", Box::new(strip(24))),
        ("branches", Box::new(branches(false))),
        ("period", Box::new(branches(true))),
        ("curves", Box::new(curves(None, false))),
        ("curves-over", Box::new(curves(Some(phase_diagram(40, 30)), false))),
        ("atlas", Box::new(curves(Some(phase_diagram(64, 64)), true))),
        ("bands", Box::new(bands(false))),
        ("bands-logarithmic", Box::new(bands(true))),
        ("error-bars", Box::new(exponents())),
        ("error-bars-logarithmic", Box::new(rest_times())),
        ("survival", Box::new(survival())),
        ("places", Box::new(places())),
        ("tracks", Box::new(tracks())),
        ("film-strip", Box::new(film_strip())),
        ("panels", Box::new(panels())),
    ]
}

fn words() -> Vec<String> {
    vec![
        "Tensor model, in model units: *γ* = 1, *κ*_2 = 0.9, *κ*_3 = 0.1; all other parameters 0.".to_owned(),
        "The first 100 time units are not shown.".to_owned(),
    ]
}

fn axis(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| from + (to - from) * i as f64 / (count.max(2) - 1) as f64).collect()
}

/// Like white noise, a function of the index.
pub(crate) fn noise(i: usize) -> f64 {
    (1e4 * (12.9898 * i as f64).sin()).fract().abs() + 0.05
}

fn ellipse([x, y]: [f64; 2], radius: f64, turn: f64) -> Vec<[f64; 2]> {
    let vertex = |angle: f64| {
        let r = radius * (1.0 - 0.2 * (2.0 * angle).cos() + 0.12 * (3.0 * angle).cos());
        [x + r * (angle + turn).cos(), y + r * (angle + turn).sin()]
    };
    axis(0.0, TAU, 80).into_iter().map(vertex).collect()
}
