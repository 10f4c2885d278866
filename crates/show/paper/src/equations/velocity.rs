//! The velocity of the active cell as an expansion in the curvature.

use super::super::claims::claim;
use super::super::context::Context;
use motiform_figures::report::Claim;
use motiform_study::initial::Uniform;
use std::f64::consts::TAU;

/// Points along the boundary; modes of phi.
const POINTS: usize = 256;
const MODES: usize = 6;

/// A boundary of length L = 2 pi: `phi` by its modes `c_n cos(n s) + s_n sin(n s)`.
#[derive(Clone)]
struct Shape(Vec<[f64; 2]>);

impl Shape {
    fn random(random: &mut Uniform) -> Self {
        Self((1..=MODES).map(|n| [0.4 * random.draw(), 0.4 * random.draw()].map(|x| x / n as f64)).collect())
    }

    /// phi and its first two derivatives at `s`.
    fn at(&self, s: f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (n, [c, d]) in (1..).zip(&self.0) {
            let k = f64::from(n);
            let (sin, cos) = libm::sincos(k * s);
            sum[0] += c * cos + d * sin;
            sum[1] += k * (d * cos - c * sin);
            sum[2] -= k * k * (c * cos + d * sin);
        }
        sum
    }

    /// The mean over the boundary of `weight(phi, phi_s, phi_ss)` times the normal, (cos, sin) of `s + phi`.
    fn mean(&self, weight: impl Fn([f64; 3]) -> f64) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for j in 0..POINTS {
            let s = TAU * j as f64 / POINTS as f64;
            let phi = self.at(s);
            let (sin, cos) = libm::sincos(s + phi[0]);
            sum[0] += weight(phi) * cos / POINTS as f64;
            sum[1] += weight(phi) * sin / POINTS as f64;
        }
        sum
    }

    /// The same closed: mode 1 is changed by Newton's method until the mean normal vanishes.
    fn closed(mut self) -> Self {
        for _ in 0..30 {
            let open = self.mean(|_| 1.0);
            if size(open) < 1e-15 {
                break;
            }
            let mut columns = [[0.0; 2]; 2];
            for (i, column) in columns.iter_mut().enumerate() {
                let (h, before) = (1e-6, self.0[0][i]);
                let mut end = |x: f64| {
                    self.0[0][i] = x;
                    self.mean(|_| 1.0)
                };
                let (high, low) = (end(before + h), end(before - h));
                *column = [0, 1].map(|p| (high[p] - low[p]) / (2.0 * h));
                self.0[0][i] = before;
            }
            let [[a, c], [b, d]] = columns;
            let determinant = a * d - b * c;
            self.0[0][0] -= (d * open[0] - b * open[1]) / determinant;
            self.0[0][1] -= (a * open[1] - c * open[0]) / determinant;
        }
        self
    }
}

fn size([x, y]: [f64; 2]) -> f64 {
    libm::hypot(x, y)
}

pub(super) fn claims(context: &Context<'_>) -> [Claim; 3] {
    let mut random = Uniform::new(9, 0);
    let open: Vec<Shape> = (0..100).map(|_| Shape::random(&mut random)).collect();
    let of = |shapes: &[Shape], weight: fn([f64; 3]) -> f64| {
        let sizes: Vec<f64> = shapes.iter().map(|shape| size(shape.mean(weight))).collect();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        (context.number(largest), context.number(sizes.iter().sum::<f64>() / sizes.len() as f64))
    };
    let (unclosed, first_open) = (of(&open, |_| 1.0), of(&open, |phi| 1.0 + phi[1]));
    let closed: Vec<Shape> = open.into_iter().map(Shape::closed).collect();
    let (lowest, first) = (of(&closed, |_| 1.0), of(&closed, |phi| 1.0 + phi[1]));
    [
        claim(
            &[71, 72],
            "The lowest order term vanishes because ∫ d*s* **n** = 0, the condition that the boundary is closed.",
            format!(
                "the mean normal of 100 random shapes is {:.2} on average; of the same shapes, closed by another mode 1, at most {:.0e}",
                unclosed.1, lowest.0
            ),
            "quadrature on 256 points; shapes of six modes, closed by Newton's method: closed to 10^{-12}, open by more than 0.05",
            lowest.0 < 1e-12 && unclosed.1 > 0.05,
        ),
        claim(
            &[73],
            "The first order term also vanishes identically, ∫ d*s* *κ***n** = 0.",
            format!(
                "at most {:.0e} for the closed shapes and {:.0e} for the open ones: it needs no closure",
                first.0, first_open.0
            ),
            "the same shapes, *κ* = (2π/*L*)(1 + ∂_s*φ*); below 10^{-12}",
            first.0 < 1e-12 && first_open.0 < 1e-12,
        ),
        result(context, &closed),
    ]
}

/// All orders of the expansion against the paper's result.
fn result(context: &Context<'_>, closed: &[Shape]) -> Claim {
    let alpha = [0.7, -1.1, 0.4, -0.9];
    let expansion = |[_, first, second]: [f64; 3]| {
        let kappa = 1.0 + first;
        alpha[0] + alpha[1] * kappa + alpha[2] * kappa * kappa + alpha[3] * second * second
    };
    let paper = |[_, first, second]: [f64; 3]| alpha[2] * first * first + alpha[3] * second * second;
    let apart = |shape: &Shape| {
        let (a, b) = (shape.mean(expansion), shape.mean(paper));
        size([a[0] - b[0], a[1] - b[1]]) / size(b)
    };
    let worst = context.number(closed.iter().map(apart).fold(0.0, f64::max));
    claim(
        &[74],
        "As a result **v** = ((2π)^2/*L*^3) ∫ d*s* [*α*_2(∂_s*φ*)^2 + *α*_3(∂_s^2*φ*)^2] **n**.",
        format!(
            "*Y* = *α*_0 + *α*_1*κ* + *α*_2*κ*^2 + *α*_3(∂_s*κ*)^2 gives the same velocity to {worst:.0e}"
        ),
        "the closed shapes, *L* = 2π, four coefficients that are not 0; relative difference below 10^{-9}",
        worst < 1e-9,
    )
}
