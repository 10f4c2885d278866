//! The velocity of the active cell, (VEL), against direct quadrature: both terms, each alone, their signs; and what closes the boundary.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_dynamics::model::velocity;
use motiform_dynamics::{Model, Outline, System};
use motiform_models::cell::{Cell, CellParameters};
use std::f64::consts::TAU;

const MODES: usize = 12;

/// Points of the quadrature: spacing 1e-3 of the shortest wave times 12, so differences of order 8 are exact to 1e-13.
const POINTS: usize = 2048;

/// Shapes in general position, `c1, s1, c2, ..`: mode n falls like 1.6^-n.
fn coordinates(seed: u32) -> Vec<f64> {
    let entry = |i: usize| {
        let angle = 1.7 * f64::from(seed) + 2.3 * i as f64 + 0.9 * (i * i) as f64;
        angle.sin() * 1.6_f64.powf(-(1.0 + (i / 2) as f64))
    };
    (0..2 * MODES).map(entry).collect()
}

/// phi at equally spaced points, from its definition.
fn phi(coordinates: &[f64]) -> Vec<f64> {
    let at = |j: usize| {
        let angle = TAU * j as f64 / POINTS as f64;
        let wave = |(n, c): (f64, &[f64])| c[0] * (n * angle).cos() + c[1] * (n * angle).sin();
        (1..).map(f64::from).zip(coordinates.chunks_exact(2)).map(wave).sum()
    };
    (0..POINTS).map(at).collect()
}

/// df/ds of a periodic function by central differences of order 8.
fn slope(f: &[f64], spacing: f64) -> Vec<f64> {
    const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let n = f.len();
    let at = |j: usize| -> f64 {
        let pair = |(i, weight): (usize, &f64)| weight * (f[(j + i) % n] - f[(j + n - i) % n]);
        (1..).zip(&WEIGHTS).map(pair).sum()
    };
    (0..n).map(|j| at(j) / spacing).collect()
}

/// `((2 pi)^2 / L^3) int (alpha2 phi_s^2 + alpha3 phi_ss^2) n ds` by the trapezoidal rule.
fn quadrature(p: &CellParameters, phi: &[f64], normals: &[[f64; 2]]) -> [f64; 2] {
    let spacing = p.length / POINTS as f64;
    let first = slope(phi, spacing);
    let second = slope(&first, spacing);
    let alpha3 = p.alpha3 + p.alpha3_per_length * p.length;
    let mut v = [0.0; 2];
    for ((a, b), n) in first.iter().zip(&second).zip(normals) {
        let push = p.alpha2 * a * a + alpha3 * b * b;
        v = [v[0] + push * n[0], v[1] + push * n[1]];
    }
    v.map(|sum| sum * spacing * TAU * TAU / p.length.powi(3))
}

/// The normals of the drawn boundary: its tangent, turned to the left (`dX/ds = -i n`).
fn drawn_normals(cell: &Cell, shape: &[f64]) -> Vec<[f64; 2]> {
    let Outline::Curve(points) = cell.outline(shape, 1.0, POINTS) else { panic!("no outline") };
    let spacing = cell.parameters().length / POINTS as f64;
    let along = |axis: usize| slope(&points.iter().map(|p| p[axis]).collect::<Vec<_>>(), spacing);
    along(0).into_iter().zip(along(1)).map(|(x, y)| [-y, x]).collect()
}

fn body(alpha2: f64, alpha3: f64, closure_modes: f64) -> Cell {
    let modes = f64::from(u32::try_from(MODES).unwrap());
    let numbers = CellParameters {
        length: 14.0,
        alpha2,
        alpha3,
        alpha3_per_length: 0.0,
        modes,
        closure_modes,
        ..CellParameters::default()
    };
    Cell::new(&numbers).unwrap()
}

/// Each term alone and both, of the paper's sign and of the other, with the bare normal and the closed boundary's.
#[test]
fn velocity_is_the_quadrature_of_its_definition() {
    for (alpha2, alpha3) in [(0.03, 0.0), (-0.03, 0.0), (0.0, -0.02), (0.05, -0.02), (-0.05, -0.02)] {
        for seed in 0..4 {
            let c = coordinates(seed);
            let phi = phi(&c);
            for closure_modes in [0.0, 8.0] {
                let cell = body(alpha2, alpha3, closure_modes);
                let mut shape = vec![0.0; 2 * MODES];
                cell.encode(&c, &mut shape);
                let k = cell.parameters().wavenumber();
                let bare = |(j, phi): (usize, &f64)| {
                    let angle = TAU * j as f64 / POINTS as f64 + k * phi;
                    [angle.cos(), angle.sin()]
                };
                let normals = match closure_modes {
                    0.0 => phi.iter().enumerate().map(bare).collect(),
                    _ => drawn_normals(&cell, &shape),
                };
                let expected = quadrature(cell.parameters(), &phi, &normals);
                let v = velocity(&cell, &shape);
                let size = expected[0].hypot(expected[1]);
                let off = (v[0] - expected[0]).hypot(v[1] - expected[1]) / size;
                // differences of order 8 are good to 1e-9 here, the drawn boundary (128 points, 63 waves) to 1e-6
                assert!(
                    size > 1e-6 && off < 1e-5,
                    "{alpha2} {alpha3} {seed} {closure_modes}: {v:?} {expected:?}"
                );
            }
        }
    }
}

/// One wave by hand: phi = c cos(k s) with the bare normal has `v = i alpha2 k^5 c^3 / 8` to leading order, along +y.
#[test]
fn one_wave_pushes_along_its_crest() {
    let cell = body(0.04, 0.0, 0.0);
    let (k, c) = (cell.parameters().wavenumber(), 1e-2);
    let mut shape = vec![0.0; 2 * MODES];
    shape[0] = 0.5 * c; // phi_1 = (c_1 - i s_1) / 2
    let v = velocity(&cell, &shape);
    let expected = 0.04 * k.powi(5) * c.powi(3) / 8.0;
    // the next order is (k c)^2 = 2e-5 of it
    assert!((v[1] / expected - 1.0).abs() < 1e-4 && v[0].abs() < 1e-4 * expected, "{v:?}, not {expected}");
}

/// The error function, as feedback adds it to phi, closes the boundary by quadrature; its size is the stated correction.
#[test]
fn the_correction_is_what_closes_the_boundary() {
    for seed in 0..4 {
        let open = body(0.0, -0.02, 8.0);
        let numbers = CellParameters { feedback: 1.0, ..*open.parameters() };
        let cell = Cell::new(&numbers).unwrap();
        let (mut shape, mut closed) = (vec![0.0; 2 * MODES], vec![0.0; 2 * MODES]);
        cell.encode(&coordinates(seed), &mut shape);
        assert!(cell.project(&shape, &mut closed).unwrap());
        let k = numbers.wavenumber();
        let mean_normal = |u: &[f64]| {
            let (mut c, mut sum) = (vec![0.0; 2 * MODES], [0.0; 2]);
            cell.decode(u, &mut c);
            for (j, phi) in phi(&c).into_iter().enumerate() {
                let angle = TAU * j as f64 / POINTS as f64 + k * phi;
                sum = [sum[0] + angle.cos(), sum[1] + angle.sin()];
            }
            sum[0].hypot(sum[1]) / POINTS as f64
        };
        // Newton's method stops at 1e-13
        assert!(mean_normal(&shape) > 1e-2 && mean_normal(&closed) < 1e-12, "{seed}");
        let change: f64 = shape.iter().zip(&closed).map(|(a, b)| (a - b) * (a - b)).sum();
        let rms = k * (2.0 * change).sqrt(); // mean square of 2 Re(eps_n exp(i n k s)) is 2 |eps_n|^2
        let stated = open.boundary(&shape, 128).unwrap().correction;
        assert!((stated / rms - 1.0).abs() < 1e-9, "{seed}: {stated}, not {rms}");
    }
}
