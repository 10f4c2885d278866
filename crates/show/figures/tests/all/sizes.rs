//! Text is never too small to read, nothing is written over other words or beside the sheet.

use crate::drawing::{Words, sides, words};
use crate::kinds::kinds;
use motiform_figures::{Medium, Panels, Style, Width, png};

/// Units of a drawing per point, where it is as wide as asked.
const ON_PAPER: f64 = 1.4;
/// The same of a slide, 960 pt wide.
const ON_SLIDE: f64 = 640.0 / 960.0;

/// Least size of all text, indices and exponents included, in points.
const TEXT: f64 = 7.0;

/// Least size of text on a slide in points, and of indices.
const SLIDE: [f64; 2] = [18.0, 14.0];

/// Kinds whose sheets may be narrower: both axes of a path have one unit, and its frame a largest height, panels of tracks a largest width.
const NARROWER: [&str; 3] = ["path-section", "tracks", "film-strip"];

/// Kinds whose frames have a shape of their own, and rows of panels: on a slide they may be higher than it.
const HIGHER: [&str; 3] = ["tracks", "film-strip", "panels"];

/// Words that lie over others or reach beyond the sheet.
fn faults(svg: &str) -> Vec<String> {
    let [width, height] = sides(svg);
    let all = words(svg);
    let beside = |words: &&Words| {
        let [left, top, right, bottom] = words.sides;
        left < -0.5 || top < -0.5 || right > width + 0.5 || bottom > height + 0.5
    };
    let mut faults: Vec<String> =
        all.iter().filter(beside).map(|words| format!("{:?} beside the sheet", words.text)).collect();
    for (i, one) in all.iter().enumerate() {
        let over = all[..i].iter().filter(|other| one.overlaps(other));
        faults.extend(over.map(|other| format!("{:?} over {:?}", one.text, other.text)));
    }
    faults
}

/// The least size of text and of its smallest letters, in units.
fn least(svg: &str) -> [f64; 2] {
    let all = words(svg);
    let of = |size: fn(&Words) -> f64| all.iter().map(size).fold(f64::INFINITY, f64::min);
    [of(|words| words.size), of(|words| words.least)]
}

#[test]
fn sheets_are_as_wide_as_asked_and_their_text_can_be_read() {
    let mut wrong = Vec::new();
    for (name, mut figure) in kinds() {
        for millimetres in [86.0, 120.0, 178.0] {
            let style = Style { width: Some(Width::Millimetres(millimetres)), ..Style::default() };
            let svg = style.draw(figure.as_mut()).expect("a figure").svg;
            let [width, _] = sides(&svg);
            let asked = millimetres / 25.4 * 72.0 * ON_PAPER;
            let fits = (width - asked).abs() <= 3.0 || NARROWER.contains(&name) && width < asked;
            assert!(fits, "{name} at {millimetres} mm: {width} units for {asked}");
            let [_, letters] = least(&svg).map(|size| size * asked / width / ON_PAPER);
            assert!(letters >= TEXT, "{name} at {millimetres} mm: letters of {letters:.2} pt");
            let found = faults(&svg);
            wrong.extend(found.into_iter().map(|fault| format!("{name} at {millimetres} mm: {fault}")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn slides_can_be_read_from_afar() {
    let mut wrong = Vec::new();
    for (name, mut figure) in kinds() {
        let style = Style { medium: Some(Medium::Slide), ..Style::default() };
        let svg = style.draw(figure.as_mut()).expect("a figure").svg;
        let [width, height] = sides(&svg);
        if height > 1081.0 / 1920.0 * width && !HIGHER.contains(&name) {
            wrong.push(format!("{name}: higher than a slide, {:.2} of its width", height / width));
        }
        let found = least(&svg).map(|size| size * 640.0 / width / ON_SLIDE);
        assert!(found[0] >= SLIDE[0] && found[1] >= SLIDE[1], "{name}: text of {found:.2?} pt");
        wrong.extend(faults(&svg).into_iter().map(|fault| format!("{name} on a slide: {fault}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The test sees what it looks for: words over others, and words beyond the edge.
#[test]
fn moved_words_are_seen() {
    let mut figure = kinds().swap_remove(0).1;
    let style = Style { width: Some(Width::Millimetres(86.0)), ..Style::default() };
    let svg = style.draw(figure.as_mut()).expect("a figure").svg;
    assert_eq!(faults(&svg), [""; 0]);
    let first = svg.find("<text x=\"").expect("text") + "<text x=\"".len();
    let end = first + svg[first..].find('"').expect("an end");
    let beyond = format!("{}{}{}", &svg[..first], 340.0, &svg[end..]);
    assert!(faults(&beyond).iter().any(|fault| fault.contains("beside the sheet")));
    let text = svg.rfind("<text ").expect("text");
    let twice = svg.replacen(
        "</svg>",
        &format!("{}</svg>", svg[text..].split("</text>").next().expect("text").to_owned() + "</text>"),
        1,
    );
    assert!(faults(&twice).iter().any(|fault| fault.contains(" over ")));
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
