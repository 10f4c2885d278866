//! Figures of runs: what is error or rest is not drawn as motion.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{column, preset, run};
use motiform_figures::{Drawn, Style};
use motiform_lab::draw;
use motiform_study::{Dataset, Study};

fn of(name: &str, set: &[(&str, f64)]) -> Dataset {
    run(&preset(name, |study| set.iter().for_each(|(name, value)| study.set(name, *value).unwrap())))
}

fn figure(dataset: &Dataset, name: &str) -> Drawn {
    let all = draw::drawn(dataset, &Style::default()).unwrap();
    all.into_iter().find(|(known, _)| *known == name).unwrap().1
}

/// The texts of a figure, without its fonts.
fn texts(drawn: &Drawn) -> Vec<String> {
    let drawing = drawn.svg.rsplit("</style>").next().unwrap_or_default();
    let pieces = drawing.split('<').filter_map(|piece| piece.split_once('>'));
    pieces.map(|(_, text)| text.trim().to_owned()).filter(|text| !text.is_empty()).collect()
}

/// The tensor body on a circle and on a straight line: speeds with errors of 1e-9 and 6e-8 had axes of these.
#[test]
fn a_fixed_shape_is_drawn_as_constants() {
    for set in [[("kappa2", 0.45), ("kappa3", 0.5)], [("kappa2", 0.9), ("kappa3", 0.9)]] {
        let dataset = of("fig4", &set);
        let speeds = column(&dataset, "speed");
        assert!(speeds.iter().any(|speed| *speed != speeds[0]));
        let long = texts(&figure(&dataset, "series"))
            .into_iter()
            .find(|text| text.len() > 8 && text.parse::<f64>().is_ok());
        assert_eq!(long, None);
    }
}

/// A decayed body had an axis of 1e-25, and 13 outlines along a path of 1e-24.
#[test]
fn a_body_at_rest_is_one_outline_at_true_size() {
    let dataset = of("fig1", &[("gamma", -0.1), ("kappa2", 0.2)]);
    let path = figure(&dataset, "path");
    let starts = |part: &str| path.data.lines().filter(|line| line.starts_with(part)).count();
    assert_eq!((starts("path"), starts("outline")), (1, 96));
    let words = texts(&path).join(" ");
    assert!(
        words.contains("The centre rests: its speed is at most") && words.contains("drawn at true size"),
        "{words}"
    );
    let words = texts(&figure(&dataset, "series")).join(" ");
    assert!(words.contains("undefined: the centre rests") && !words.contains("25"), "{words}");
}

/// Noise turns a swimmer whose equations do not: its heading has no derivative, and a panel of zeros would deny the turns of its path.
#[test]
fn noise_on_the_velocity_leaves_no_turning_rate() {
    let text = "preset = \"noisy-heading\"\n[run]\nt_end = 50\n";
    let dataset = run(&Study::parse(text, "text", "test").unwrap());
    assert!(column(&dataset, "turning_rate").iter().all(|rate| rate.is_nan()));
    let words = texts(&figure(&dataset, "series")).join(" ");
    assert!(words.contains("noise leaves the velocity no derivative") && !words.contains("rad"), "{words}");
}
