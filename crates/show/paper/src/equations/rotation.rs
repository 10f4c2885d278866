//! The invariance of the equations, and its origin.

use super::super::claims::claim;
use super::super::context::Context;
use super::fields::{C, Z, amplitudes, apart, parameters, rates, state, tensors, turned};
use motiform_figures::report::Claim;
use motiform_models::tensor::indices::Tensors;
use motiform_study::initial::Uniform;

pub(super) fn claims(context: &Context<'_>) -> [Claim; 2] {
    [invariance(context), isotropy(context)]
}

/// f(R z) = R f(z), for the equations with indices.
fn invariance(context: &Context<'_>) -> Claim {
    let mut random = Uniform::new(5, 0);
    let (mut worst, mut broken): (f64, f64) = (0.0, f64::INFINITY);
    for seed in 0..1000 {
        let (parameters, z) = (parameters(seed), state(&mut random));
        let angle = std::f64::consts::PI * random.draw();
        let (moved, rate) = (rates(&parameters, turned(z, angle)), rates(&parameters, z));
        let size = rate.iter().map(|c| libm::hypot(c.re, c.im)).fold(0.0, f64::max);
        let off = |a: Z, b: Z| a.iter().zip(b).map(|(a, b)| apart(*a, b)).fold(0.0, f64::max) / size;
        worst = worst.max(off(moved, turned(rate, angle)));
        // one phase wrong: z3 turned by twice the angle
        let wrong =
            [turned(z, angle)[0], turned(z, angle)[1], z[2] * turned([C::new(1.0, 0.0); 3], angle)[1]];
        if libm::sin(0.5 * angle).abs() > 0.2 {
            broken = broken.min(off(rates(&parameters, wrong), turned(rate, angle)));
        }
    }
    let worst = context.number(worst);
    claim(
        &[163],
        "This set of equations is invariant under (*z*_1, *z*_2, *z*_3) → (e^{i*θ*}*z*_1, e^{2i*θ*}*z*_2, e^{3i*θ*}*z*_3) for an \
         arbitrary *θ*.",
        format!(
            "turned rates and rates of turned states differ by at most {worst:.0e}; with e^{{2i*θ*}} for *z*_3 by at least {broken:.0e}"
        ),
        "the equations with indices at 1000 random states, angles and sets of coefficients; relative to the rates, below 10^{-12}",
        worst < 1e-12 && broken > 1e-4,
    )
}

/// A rotation of the plane, applied to every index, is that transformation.
fn isotropy(context: &Context<'_>) -> Claim {
    let mut random = Uniform::new(6, 0);
    let mut worst: f64 = 0.0;
    for _ in 0..1000 {
        let (z, angle) = (state(&mut random), std::f64::consts::PI * random.draw());
        let turned_plane = amplitudes(&rotated(&tensors(z), angle));
        let phases = turned(z, -angle);
        worst = turned_plane.iter().zip(phases).map(|(a, b)| apart(*a, b)).fold(worst, f64::max);
    }
    let worst = context.number(worst);
    claim(
        &[164],
        "This invariance arises from the isotropy of space.",
        format!(
            "a rotation of the plane by *α*, applied to each index of *v*, *S* and *U*, is this \
            transformation with *θ* = −*α*, to {worst:.0e}"
        ),
        "1000 random states and angles; below 10^{-13}",
        worst < 1e-13,
    )
}

/// Every index turned by an angle.
fn rotated(tensors: &Tensors, angle: f64) -> Tensors {
    let (sin, cos) = libm::sincos(angle);
    let q = [[cos, -sin], [sin, cos]];
    let axes = [0, 1];
    let v = axes.map(|i| axes.iter().map(|&a| q[i][a] * tensors.v[a]).sum());
    let s = axes.map(|i| {
        axes.map(|j| axes.iter().flat_map(|&a| axes.map(|b| q[i][a] * q[j][b] * tensors.s[a][b])).sum())
    });
    let entry = |i: usize, j: usize, k: usize| {
        let mut sum = 0.0;
        for a in axes {
            for b in axes {
                for c in axes {
                    sum += q[i][a] * q[j][b] * q[k][c] * tensors.u[a][b][c];
                }
            }
        }
        sum
    };
    Tensors { v, s, u: axes.map(|i| axes.map(|j| axes.map(|k| entry(i, j, k)))) }
}
