//! Pixels of single shapes, whose places follow from what was drawn.

use crate::picture::Picture;
use motiform_figures::geometry::Rect;
use motiform_figures::paint::Paint;
use motiform_figures::palette::BLACK;
use motiform_figures::svg::{Anchor, Svg};
use motiform_figures::{Label, png};

const SIDE: usize = 100;

/// The darkness of the pixels of a sheet, row after row: 0 is white.
fn ink(draw: impl FnOnce(&mut Svg)) -> Vec<u8> {
    let mut svg = Svg::new(SIDE as f64, SIDE as f64);
    draw(&mut svg);
    Picture::of(&svg.finish()).pixels.iter().map(|pixel| 255 - pixel.0).collect()
}

/// The first and the last column and row with ink.
fn bounds(ink: &[u8]) -> [[usize; 2]; 2] {
    let places: Vec<_> = (0..ink.len()).filter(|&k| ink[k] > 60).map(|k| [k % SIDE, k / SIDE]).collect();
    [0, 1].map(|axis| {
        let along = || places.iter().map(|place| place[axis]);
        [along().min().expect("ink"), along().max().expect("ink")]
    })
}

fn rect(x: f64, y: f64, w: f64, h: f64) -> Rect {
    Rect { x, y, w, h }
}

/// H has no ink to the left or right of its stems but the blank of its advance, and stands on the line.
#[test]
fn letters_stand_where_their_anchor_says() {
    let label = Label::parse("HHH");
    for (anchor, before) in [(Anchor::Start, 0.0), (Anchor::Middle, 0.5), (Anchor::End, 1.0)] {
        let left = 50.0 - before * label.width(20.0);
        let [x, y] = bounds(&ink(|svg| svg.text([50.0, 60.0], 20.0, anchor, &label)));
        assert!((x[0] as f64 - left - 2.0).abs() < 1.5, "{anchor:?}: {x:?}");
        assert!((x[1] as f64 - (left + label.width(20.0) - 2.0)).abs() < 1.5, "{anchor:?}: {x:?}");
        assert!(y[1] == 59 && (12..17).contains(&(y[1] - y[0])), "{anchor:?}: {y:?}");
        // A label that reads upward is the same one, turned about its place.
        let turned = bounds(&ink(|svg| svg.upward_text([60.0, 50.0], 20.0, anchor, &label)));
        assert_eq!(turned[0], y);
        assert!(turned[1][1].abs_diff(99 - x[0]) <= 1 && turned[1][0].abs_diff(99 - x[1]) <= 1, "{turned:?}");
    }
}

#[test]
fn scripts_are_lower_and_higher_than_their_line() {
    let lowest = |markup: &str| {
        bounds(&ink(|svg| svg.text([10.0, 50.0], 25.0, Anchor::Start, &Label::parse(markup))))[1][1]
    };
    // 0.22 of the size below the line, as `Script::drop` says; a superscript leaves the line as it is.
    assert_eq!((lowest("H"), lowest("H^H"), lowest("H_H")), (49, 49, 55));
    assert_eq!(lowest("H_HH"), 55);
}

#[test]
fn what_is_outside_of_all_clips_is_not_seen() {
    let black = Paint::fill(BLACK);
    let seen = ink(|svg| {
        svg.clipped(rect(10.0, 10.0, 50.0, 50.0), |svg| {
            svg.clipped(rect(30.0, 0.0, 70.0, 40.0), |svg| svg.rect(rect(0.0, 0.0, 100.0, 100.0), &black));
        });
        svg.rect(rect(90.0, 90.0, 5.0, 5.0), &black);
    });
    let inside = |k: usize| {
        let (x, y) = (k % SIDE, k / SIDE);
        (30..60).contains(&x) && (10..40).contains(&y) || (90..95).contains(&x) && (90..95).contains(&y)
    };
    assert!(seen.iter().enumerate().all(|(k, ink)| *ink == if inside(k) { 255 } else { 0 }));
}

#[test]
fn opacities_multiply() {
    let half = ink(|svg| svg.rect(rect(0.0, 0.0, 100.0, 100.0), &Paint::fill(BLACK).opacity(0.5)));
    let quarter =
        ink(|svg| svg.rect(rect(0.0, 0.0, 100.0, 100.0), &Paint::fill(BLACK).tint(BLACK, 0.5).opacity(0.5)));
    assert!(half[0].abs_diff(128) <= 1 && quarter[0].abs_diff(64) <= 1, "{} and {}", half[0], quarter[0]);
}

#[test]
fn dashes_have_their_lengths() {
    let line =
        ink(|svg| svg.line([0.0, 50.5], [100.0, 50.5], &Paint::stroke(BLACK, 1.0).dashed("10 5 20 5")));
    let along = &line[50 * SIDE..51 * SIDE];
    let on = |x: usize| matches!(x % 40, 0..10 | 15..35);
    assert!((0..SIDE).all(|x| along[x] == if on(x) { 255 } else { 0 }), "{along:?}");
}

/// Two lines on each other that begin at different places of one pattern.
#[test]
fn dashes_that_go_on_coincide() {
    let pen = Paint::stroke(BLACK, 1.0).dashed("10 5");
    let one = |from: f64| ink(|svg| svg.line([from, 50.5], [100.0, 50.5], &pen.dash_from(from % 15.0)));
    let (all, part) = (one(0.0), one(32.0));
    assert_eq!(all[50 * SIDE + 40..51 * SIDE], part[50 * SIDE + 40..51 * SIDE]);
    assert_ne!(all[50 * SIDE..51 * SIDE], part[50 * SIDE..51 * SIDE]);
}

#[test]
fn another_svg_is_refused_with_what_is_in_it() {
    let svg = |body: &str| format!("<svg width=\"9\" height=\"9\" viewBox=\"0 0 9 9\">{body}</svg>");
    assert!(png(&svg(""), 1.0, &[]).is_ok());
    for (body, says) in [
        ("<ellipse/>", "<ellipse>"),
        ("<path d=\"M0 0C1 1 2 2 3 3\"/>", "a path with C"),
        ("<path d=\"M0 0L1\" fill=\"none\"/>", "without y"),
        ("<circle cx=\"1\" cy=\"1\" r=\"nan\"/>", "nan"),
        ("<rect width=\"1\" height=\"1\" fill=\"red\"/>", "red"),
        ("<g clip-path=\"url(#none)\"/>", "unknown clip"),
        ("<image x=\"0\" y=\"0\" width=\"1\" height=\"1\" href=\"data:image/png;base64,AAAA\"/>", "PNG"),
    ] {
        let why = png(&svg(body), 1.0, &[]).expect_err(body).to_string();
        assert!(why.contains(says), "{body}: {why}");
    }
}
