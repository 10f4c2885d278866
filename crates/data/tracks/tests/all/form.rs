//! Form of polygons against closed forms.

use motiform_tracks::modes::{ModeOptions, outline_modes};
use motiform_tracks::{Form, area, form, perimeter};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// An affine map of a regular polygon: an ellipse with these half axes, turned.
fn ellipse([a, b]: [f64; 2], turn: f64, count: u32) -> Vec<[f64; 2]> {
    let vertex = |k: u32| {
        let (sin, cos) = libm::sincos(TAU * f64::from(k) / f64::from(count));
        let (s, c) = libm::sincos(turn);
        [7.0 + a * cos * c - b * sin * s, -3.0 + a * cos * s + b * sin * c]
    };
    (0..count).map(vertex).collect()
}

fn of(points: &[[f64; 2]]) -> Form {
    form(points).expect("it encloses an area")
}

/// Complete elliptic integral of the second kind, E(m), by the arithmetic-geometric mean (Abramowitz and Stegun 17.6).
fn complete_e(m: f64) -> f64 {
    let (mut a, mut b, mut c, mut sum, mut power) = (1.0, (1.0 - m).sqrt(), m.sqrt(), 0.0, 0.5);
    while c > 1e-16 {
        sum += power * c * c;
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        power *= 2.0;
    }
    FRAC_PI_2 / a * (1.0 - sum)
}

#[test]
fn an_ellipse_has_its_exact_numbers() {
    for (a, b) in [(3.0, 3.0), (3.0, 2.0), (5.0, 1.0)] {
        let points = ellipse([a, b], 0.4, 4000);
        let found = of(&points);
        // polygon of n vertices: area (n/2) sin(2 pi/n) a b, so 1 - 4e-7 of pi a b; the perimeter errs as little
        assert!((area(&points) / (PI * a * b) - 1.0).abs() < 1e-6);
        let exact = 4.0 * a * complete_e(1.0 - (b / a) * (b / a));
        assert!((perimeter(&points) / exact - 1.0).abs() < 1e-5, "{} {exact}", perimeter(&points));
        assert!((found.aspect_ratio - a / b).abs() < 1e-10, "{found:?}");
        assert!((found.solidity - 1.0).abs() < 1e-12);
        assert!((found.circularity - 4.0 * PI * PI * a * b / (exact * exact)).abs() < 1e-5);
        assert!(a <= b || (found.axis - 0.4).abs() < 1e-10);
    }
}

/// Few vertices, either sense of going round, any place: the aspect ratio is exact all the same.
#[test]
fn the_aspect_ratio_of_a_coarse_polygon_is_exact() {
    for count in [3, 5, 16] {
        let mut points = ellipse([2.0, 0.5], -0.9, count);
        assert!((of(&points).aspect_ratio - 4.0).abs() < 1e-10);
        points.reverse();
        assert!((of(&points).aspect_ratio - 4.0).abs() < 1e-10 && (of(&points).axis + 0.9).abs() < 1e-10);
    }
}

/// A plus of five squares: area 5, hull 7, perimeter 12. Its moments are isotropic.
#[test]
fn a_cross_is_not_convex() {
    let corners =
        [[1, 0], [2, 0], [2, 1], [3, 1], [3, 2], [2, 2], [2, 3], [1, 3], [1, 2], [0, 2], [0, 1], [1, 1]];
    let found = of(&corners.map(|corner| corner.map(f64::from)));
    assert!((found.solidity - 5.0 / 7.0).abs() < 1e-14 && (found.aspect_ratio - 1.0).abs() < 1e-14);
    assert!((found.circularity - 4.0 * PI * 5.0 / 144.0).abs() < 1e-14);
}

/// A rod six times as long as wide has no modes of the radius, and all numbers of its form.
#[test]
fn a_rod_is_seen() {
    let (half, r) = (5.0, 1.0);
    let cap = |end: f64, from: f64| {
        (0..=40).map(move |k| {
            let (sin, cos) = libm::sincos(from + PI * f64::from(k) / 40.0);
            [end + r * cos, r * sin]
        })
    };
    let points: Vec<[f64; 2]> = cap(half, -FRAC_PI_2).chain(cap(-half, FRAC_PI_2)).collect();
    let modes = outline_modes(&points, &ModeOptions::default());
    assert!(modes.radius.is_none() && modes.is_seen() && !modes.is_left_out(), "{:?}", modes.flags);
    let found = of(&points);
    // second moments of a rectangle 10 x 2 and of half discs shifted along x (exact), by integration
    let (l, disc) = (2.0 * half, PI * r * r);
    let shift = half + 4.0 * r / (3.0 * PI);
    let own = disc * r * r / 4.0 - disc * (4.0 * r / (3.0 * PI)) * (4.0 * r / (3.0 * PI));
    let xx = 2.0 * r * l * l * l / 12.0 + own + disc * shift * shift;
    let yy = l * 8.0 * r * r * r / 12.0 + disc * r * r / 4.0;
    assert!((found.aspect_ratio / (xx / yy).sqrt() - 1.0).abs() < 1e-3, "{found:?}, {}", (xx / yy).sqrt());
    assert!((found.solidity - 1.0).abs() < 1e-12 && found.axis.abs() < 1e-12);
}

#[test]
fn lines_and_points_have_no_form_and_few_vertices_do() {
    assert_eq!(form(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), None);
    assert_eq!(form(&[[1.0, 1.0]]), None);
    assert_eq!(form(&[]), None);
    let square = outline_modes(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], &ModeOptions::default());
    assert!(square.is_left_out() && square.is_seen());
}
