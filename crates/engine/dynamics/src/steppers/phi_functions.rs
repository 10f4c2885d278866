//! The phi functions of exponential integrators, accurate for every real argument.
//!
//! `phi_0 = e^z`, `phi_k = (phi_{k-1} - 1/(k-1)!) / z`, so `phi_k(z) = sum_j z^j / (j+k)!`. Their differences in the
//! weights of ETDRK4 cancel near `z = 0` (where 12 of 16 digits would be lost) and, to leading order, for large
//! `|z|`. Every formula here is used only where it does not cancel. Source: Cox and Matthews (2002), J. Comput. Phys.
//! 176, 430; Kassam and Trefethen (2005), SIAM J. Sci. Comput. 26, 1214 (the contour).
//! Checked by `tests/all/phi_functions.rs` against `reference/phi-functions.toml`.

/// Below this `|z|` the Taylor series is summed.
const TAYLOR: f64 = 1.5;

/// Terms of the series: `1.5^24 / 27! < 1e-23`.
const TERMS: usize = 24;

/// Above this `|z|` the closed form of the weights does not cancel.
const CLOSED: f64 = 16.0;

/// Points on the upper half of the contour: the rule's error is below `1 / 32!`.
const CONTOUR: u32 = 16;

/// `[phi_0, phi_1, phi_2, phi_3]` at `z`.
pub fn phi(z: f64) -> [f64; 4] {
    let exp = libm::exp(z);
    if z.abs() < TAYLOR {
        return [exp, series(z, 1, |_| 1.0), series(z, 2, |_| 1.0), series(z, 3, |_| 1.0)];
    }
    let phi1 = libm::expm1(z) / z;
    let phi2 = (phi1 - 1.0) / z;
    [exp, phi1, phi2, (phi2 - 0.5) / z]
}

/// The weights of ETDRK4 at `z`: `[phi1 - 3 phi2 + 4 phi3, phi2 - 2 phi3, 4 phi3 - phi2]`.
///
/// Accurate to 1e-14 relative (beside the zeros at z = -2.7 and 3.0: to 1e-16 absolute).
pub fn etdrk4_weights(z: f64) -> [f64; 3] {
    if z.abs() < TAYLOR {
        // 1/(j+1)! - 3/(j+2)! + 4/(j+3)! = (j+1)^2/(j+3)! and so on
        return [
            series(z, 3, |j| (j + 1.0) * (j + 1.0)),
            series(z, 3, |j| j + 1.0),
            series(z, 3, |j| 1.0 - j),
        ];
    }
    if z.abs() >= CLOSED {
        return closed((z, 0.0)).map(|(re, _)| re);
    }
    // The mean over a circle around z (the weights are entire); real z: the upper half is enough.
    let mut mean = [0.0; 3];
    for point in 0..CONTOUR {
        let (sin, cos) = libm::sincos(std::f64::consts::PI * (f64::from(point) + 0.5) / f64::from(CONTOUR));
        for (sum, (re, _)) in mean.iter_mut().zip(closed((z + cos, sin))) {
            *sum += re / f64::from(CONTOUR);
        }
    }
    mean
}

/// `sum_j numerator(j) z^j / (j + shift)!`, by Horner's rule.
fn series(z: f64, shift: u32, numerator: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for j in (0..TERMS).rev() {
        // the sum from term j on is scaled by (j + shift)!
        let j = j as f64;
        sum = numerator(j) + sum * z / (j + 1.0 + f64::from(shift));
    }
    (2..=shift).fold(sum, |scaled, k| scaled / f64::from(k))
}

/// A complex number `(re, im)`.
type C = (f64, f64);

fn multiply(a: C, b: C) -> C {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

fn divide(a: C, b: C) -> C {
    let square = b.0 * b.0 + b.1 * b.1;
    let product = multiply(a, (b.0, -b.1));
    (product.0 / square, product.1 / square)
}

/// The weights at complex `w`: `(p(w) + e^w q(w)) / w^3` with polynomials p, q; Cox and Matthews, eq. (29).
fn closed(w: C) -> [C; 3] {
    let (sin, cos) = libm::sincos(w.1);
    let exp = libm::exp(w.0);
    let (e, square) = ((exp * cos, exp * sin), multiply(w, w));
    let cube = multiply(square, w);
    // p = p0 + p1 w + p2 w^2, likewise q
    let term = |p: [f64; 3], q: [f64; 3]| {
        let at = |c: [f64; 3]| (c[0] + c[1] * w.0 + c[2] * square.0, c[1] * w.1 + c[2] * square.1);
        let grown = multiply(e, at(q));
        let rest = at(p);
        divide((rest.0 + grown.0, rest.1 + grown.1), cube)
    };
    [
        term([-4.0, -1.0, 0.0], [4.0, -3.0, 1.0]),
        term([2.0, 1.0, 0.0], [-2.0, 1.0, 0.0]),
        term([-4.0, -3.0, -1.0], [4.0, -1.0, 0.0]),
    ]
}
