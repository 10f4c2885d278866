//! What holds for every figure at every width: the sheet is as wide as asked, text keeps its size, and nothing is written beside the sheet.

use super::tests::{field, path, series, spectrum, wave};
use super::tests_of_measurements::{measured, survival};
use super::tests_of_phase_diagrams::{diagram, strip};
use super::*;

/// Units of a drawing per millimetre: 1.5 per point.
const UNITS: f64 = 1.5 * 72.0 / 25.4;

/// 7 pt in units of a drawing.
const SMALLEST: f64 = 7.0 * 1.5;

fn figures() -> Vec<(&'static str, Box<dyn Figure>)> {
    let tracks = TrackPanels {
        unit: "µm".into(),
        columns: 4,
        panels: ["one", "two", "three"]
            .map(|name| TrackPanel {
                name: name.into(),
                path: vec![vec![[0.0, 0.0], [3.0, 2.0]]],
                outlines: Vec::new(),
            })
            .into(),
        ..TrackPanels::default()
    };
    vec![
        ("path", Box::new(path(wave(100)))),
        ("series", Box::new(series((0..50).map(|i| Some(f64::from(i).sin())).collect()))),
        ("field", Box::new(field(40, 20, |t, s| (t + s).sin()))),
        ("spectrum", Box::new(spectrum(&[1.0, 3.0, 2.0, 0.5]))),
        ("measured", Box::new(measured(&[(1.0, 2.0, 0.5), (2.0, 3.0, 0.5)]))),
        ("survival", Box::new(survival(&[1.0, 0.5, 0.2]))),
        ("diagram", Box::new(diagram(12, 8))),
        ("mosaic", Box::new(diagram(60, 50))),
        ("strip", Box::new(strip(12))),
        ("tracks", Box::new(tracks)),
    ]
}

/// The numbers of an attribute of all elements of a kind.
fn numbers(svg: &str, element: &str, attribute: &str) -> Vec<f64> {
    let (begin, key) = (format!("<{element} "), format!("{attribute}=\""));
    let tags = svg.split(&begin).skip(1).filter_map(|rest| rest.split('>').next());
    let value = |tag: &str| tag.split(&key).nth(1)?.split('"').next()?.parse().ok();
    tags.filter_map(value).collect()
}

#[test]
fn sheets_are_as_wide_as_asked_and_text_keeps_its_size() {
    for (name, mut figure) in figures() {
        for millimetres in [86.0, 120.0, 178.0] {
            let width = Some(Width::Millimetres(millimetres));
            let svg = Style { width, ..Style::default() }.draw(figure.as_mut()).expect("a figure").svg;
            let view = svg.split("viewBox=\"0 0 ").nth(1).expect("a view");
            let units: f64 = view.split(' ').next().expect("a width").parse().expect("a number");
            let asked = millimetres * UNITS;
            // a strip has columns of at most 130 units, tracks panels of at most 300
            let fits = (units - asked).abs() <= 3.0 || name == "tracks" && units < asked;
            assert!(fits, "{name} at {millimetres} mm: {units} units for {asked}");
            let sizes = numbers(&svg, "text", "font-size");
            assert!(!sizes.is_empty() && sizes.iter().all(|size| *size >= SMALLEST), "{name}: {sizes:?}");
            let places = numbers(&svg, "text", " x");
            assert!(places.iter().all(|x| (0.0..units).contains(x)), "{name}: {places:?}");
        }
    }
}

#[test]
fn a_slide_has_1920_pixels_and_its_own_text() {
    let style = Style { width: Some(Width::Slide), ..Style::default() };
    let svg = style.draw(&mut path(wave(100))).expect("a figure").svg;
    assert!(svg.contains(" width=\"1920\""), "{}", &svg[..200]);
    let image = png(&svg, style.png_scale(), &[]).expect("a picture");
    let reader = ::png::Decoder::new(std::io::Cursor::new(image)).read_info().expect("a header");
    assert_eq!(reader.info().width, 1920);
}
