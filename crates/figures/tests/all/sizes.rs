//! Text is never too small to read, and nothing is written beside the sheet.

use crate::kinds::kinds;
use motiform_figures::{Panels, Style, Width, png};

/// Points per unit of a drawing that is as wide as asked: text of 12 units has 8 pt.
const POINT: f64 = 1.5;

/// Least size of text, and of indices and exponents in it, in points.
const TEXT: f64 = 7.0;
const INDEX: f64 = 5.5;

/// Kinds whose sheets may be narrower: both axes of a path have one unit, and its frame a largest height, panels of tracks a largest width.
const NARROWER: [&str; 2] = ["path-section", "tracks"];

/// The numbers of an attribute of all elements of a kind.
fn numbers(svg: &str, element: &str, attribute: &str) -> Vec<f64> {
    let (begin, key) = (format!("<{element}"), format!(" {attribute}=\""));
    let tags = svg.split(&begin).skip(1).filter_map(|rest| rest.split('>').next());
    let value = |tag: &str| tag.split(&key).nth(1)?.split('"').next()?.parse().ok();
    tags.filter_map(value).collect()
}

/// Width and height of a sheet in units of its drawing.
fn sides(svg: &str) -> [f64; 2] {
    let view = svg.split("viewBox=\"0 0 ").nth(1).and_then(|rest| rest.split('"').next()).expect("a view");
    let (width, height) = view.split_once(' ').expect("sides");
    [width, height].map(|side| side.parse().expect("a number"))
}

#[test]
fn sheets_are_as_wide_as_asked_and_their_text_can_be_read() {
    for (name, mut figure) in kinds() {
        for millimetres in [86.0, 120.0, 178.0] {
            let style = Style { width: Some(Width::Millimetres(millimetres)), ..Style::default() };
            let svg = style.draw(figure.as_mut()).expect("a figure").svg;
            let [width, height] = sides(&svg);
            let asked = millimetres / 25.4 * 72.0 * POINT;
            let fits = (width - asked).abs() <= 3.0 || NARROWER.contains(&name) && width < asked;
            assert!(fits, "{name} at {millimetres} mm: {width} units for {asked}");
            let least = |all: Vec<f64>| all.into_iter().fold(f64::INFINITY, f64::min) * asked / width / POINT;
            let (text, index) =
                (least(numbers(&svg, "text", "font-size")), least(numbers(&svg, "tspan", "font-size")));
            assert!(text >= TEXT && index >= INDEX, "{name}: text of {text:.2} pt, indices of {index:.2} pt");
            let inside = |axis: &str, side: f64| {
                let all = numbers(&svg, "text", axis);
                !all.is_empty() && all.iter().all(|place| (0.0..=side).contains(place))
            };
            assert!(inside("x", width) && inside("y", height), "{name}: text beside the sheet");
        }
    }
}

#[test]
fn a_slide_has_1920_pixels_and_its_own_text() {
    let style = Style { width: Some(Width::Slide), ..Style::default() };
    let mut figure = kinds().swap_remove(0).1;
    let svg = style.draw(figure.as_mut()).expect("a figure").svg;
    assert!(svg.contains(" width=\"1920\""), "{}", &svg[..200]);
    let image = png(&svg, style.png_scale(), &[]).expect("a picture");
    let reader = ::png::Decoder::new(std::io::Cursor::new(image)).read_info().expect("a header");
    assert_eq!(reader.info().width, 1920);
}

/// The frames of a drawing: rectangles with an edge and no ground.
fn frames(svg: &str) -> Vec<[f64; 4]> {
    let tags = svg.split("<rect ").skip(1).filter_map(|rest| rest.split("/>").next());
    let frames = tags.filter(|tag| tag.contains("fill=\"none\""));
    let number = |tag: &str, name: &str| -> f64 {
        let value = tag.split(&format!("{name}=\"")).nth(1).and_then(|rest| rest.split('"').next());
        value.and_then(|value| value.parse().ok()).unwrap_or(f64::NAN)
    };
    frames.map(|tag| ["x", "y", " width", " height"].map(|name| number(tag, name))).collect()
}

#[test]
fn frames_of_panels_are_aligned() {
    let find = |of: &str| kinds().into_iter().find(|kind| kind.0 == of).expect("a kind").1;
    let mut panels = Panels::new(2, ["path", "phase-mosaic", "series", "bands"].map(find).into());
    let style = Style { width: Some(Width::Millimetres(178.0)), no_caption: true, ..Style::default() };
    let svg = style.draw(&mut panels).expect("a figure").svg;
    let frames: Vec<[f64; 4]> = frames(&svg).into_iter().filter(|frame| frame[2] > 100.0).collect();
    // the series has three panels of its own
    let [path, map, first, _, third, bands] = frames[..] else { panic!("{frames:?}") };
    let same = |a: f64, b: f64| (a - b).abs() < 0.02;
    assert!(same(path[1], map[1]) && same(path[3], map[3]), "{path:?} {map:?}");
    assert!(same(path[0], first[0]) && same(map[0], bands[0]), "{frames:?}");
    assert!(same(first[1], bands[1]) && same(third[1] + third[3], bands[1] + bands[3]), "{frames:?}");
    for letter in ["(a)", "(b)", "(c)", "(d)"] {
        assert_eq!(svg.matches(&format!(">{letter}<")).count(), 1, "{letter}");
    }
    let names: Vec<&str> =
        svg.split("clipPath id=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    assert!(names.iter().enumerate().all(|(i, name)| !names[..i].contains(name)), "{names:?}");
}

#[test]
fn panels_without_room_are_refused() {
    let find = |of: &str| kinds().into_iter().find(|kind| kind.0 == of).expect("a kind").1;
    let mut panels = Panels::new(3, ["path", "phase-mosaic", "series"].map(find).into());
    let style = Style { width: Some(Width::Millimetres(86.0)), ..Style::default() };
    let why = style.draw(&mut panels).expect_err("too narrow").to_string();
    assert!(why.contains("panel (") && why.contains("fewer columns"), "{why}");
}
