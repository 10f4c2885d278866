//! Colours of every kind of figure stay apart for colour-blind readers, in both media.

use crate::drawing::colours;
use crate::kinds::kinds;
use motiform_figures::palette::{
    BLACK, CATEGORIES, Colour, DEEP_PURPLE, INK, WHITE, YELLOW, signed_colour, time_colour,
};
use motiform_figures::{Medium, REGIMES, Style};

/// Colours as an eye sees them: rows of a matrix that is applied to sRGB values. Source: Machado, Oliveira & Fernandes (2009), IEEE TVCG
/// 15,
/// 1291, severity 1.
const EYES: [(&str, [[f64; 3]; 3], f64); 4] = [
    ("normal", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], 48.0),
    ("deuteranope", [[0.367, 0.861, -0.228], [0.280, 0.673, 0.047], [-0.012, 0.043, 0.969]], 48.0),
    ("protanope", [[0.152, 1.053, -0.205], [0.115, 0.786, 0.099], [-0.004, -0.048, 1.052]], 48.0),
    // one in ten thousand, for whom blue and bluish green of Okabe and Ito are close
    ("tritanope", [[1.256, -0.077, -0.179], [-0.078, 0.931, 0.148], [0.005, 0.691, 0.304]], 30.0),
];

fn apart(rows: [[f64; 3]; 3], a: [u8; 3], b: [u8; 3]) -> f64 {
    let seen = |colour: [u8; 3]| {
        rows.map(|row| row.iter().zip(colour).map(|(m, c)| m * f64::from(c)).sum::<f64>().clamp(0.0, 255.0))
    };
    seen(a).iter().zip(seen(b)).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

fn parts(Colour(r, g, b): Colour) -> [u8; 3] {
    [r, g, b]
}

fn is_grey([r, g, b]: [u8; 3]) -> bool {
    r == g && g == b
}

/// Colours that mean something by themselves: those of curves and of regimes.
fn meaning() -> Vec<[u8; 3]> {
    let regimes = REGIMES.iter().flat_map(|mark| [mark.area, mark.colour]);
    let all = CATEGORIES.into_iter().chain([YELLOW, DEEP_PURPLE]).chain(regimes).map(parts);
    let mut all: Vec<[u8; 3]> = all.filter(|colour| !is_grey(*colour)).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Colours that are made of these, by the place on a scale, or neutral: edges of marks, grounds, time, sign, greys.
fn derived(colour: [u8; 3]) -> bool {
    let near = |other: Colour| parts(other).iter().zip(colour).all(|(a, b)| a.abs_diff(b) <= 2);
    let marks = REGIMES.iter().flat_map(|mark| [mark.colour, mark.area]).chain(CATEGORIES);
    let steps = || (0..=400).map(|i| f64::from(i) / 400.0);
    is_grey(colour)
        || marks.clone().any(|of| near(of.mix(BLACK, 0.35)) || near(of.mix(BLACK, 0.25)))
        || marks
            .clone()
            .any(|of| (1..20).any(|i| near(WHITE.mix(of, 0.05 * f64::from(i)))) || near(WHITE.mix(of, 0.28)))
        || steps().any(|at| near(time_colour(at)) || near(time_colour(at).mix(BLACK, 0.25)))
        || steps().any(|at| near(signed_colour(2.0 * at - 1.0)))
        || near(INK)
}

#[test]
fn colours_of_a_figure_stay_apart_for_every_eye() {
    let meaning = meaning();
    let mut pairs = 0;
    for medium in [Medium::Journal, Medium::Slide] {
        let style = Style { medium: Some(medium), ..Style::default() };
        for (name, mut figure) in kinds() {
            let svg = style.draw(figure.as_mut()).expect("a figure").svg;
            let used = colours(&svg);
            let unknown: Vec<_> =
                used.iter().filter(|colour| !meaning.contains(colour) && !derived(**colour)).collect();
            assert!(unknown.is_empty(), "{name}: colours beside the palette {unknown:?}");
            let own: Vec<[u8; 3]> = used.into_iter().filter(|colour| meaning.contains(colour)).collect();
            for (i, a) in own.iter().enumerate() {
                for b in own[..i].iter().chain([&parts(WHITE)]) {
                    for (eye, rows, least) in EYES {
                        let found = apart(rows, *a, *b);
                        assert!(found > least, "{name}, {eye}: {a:?} and {b:?} are {found:.0} apart");
                        pairs += 1;
                    }
                }
            }
        }
    }
    assert!(pairs > 500, "{pairs} pairs of colours are compared");
}
