//! The terms of the active cell's equation that derive from a potential.

use super::super::claims::claim;
use super::super::context::Context;
use super::terms::{PAPER, Term, derivative, inner, random};
use motiform_figures::report::Claim;

/// The size of round-off for a variational term.
const NOTHING: f64 = 1e-8;

pub(super) fn claims(context: &Context<'_>) -> [Claim; 2] {
    let turning = PAPER.map(|term| context.number(term.turning()));
    [variational(&turning), not_variational(&turning)]
}

/// The variation of `int phi_s^3 ds` along a random function, over the same with `phi_s phi_ss`: -6, exactly.
fn ratio() -> f64 {
    let (phi, w) = (random(5), random(6));
    let functional = |sign: f64| {
        let moved: Vec<f64> = phi.iter().zip(&w).map(|(x, d)| x + sign * d).collect();
        derivative(&moved, 1).iter().map(|x| x * x * x).sum::<f64>()
    };
    // a cubic: the central difference is off by the third variation, int w_s^3
    let third: f64 = derivative(&w, 1).iter().map(|x| x * x * x).sum();
    let variation = 0.5 * (functional(1.0) - functional(-1.0)) - third;
    variation / inner(&w, &Term::Bilinear(1, 2).of(&phi))
}

fn variational(turning: &[f64; 5]) -> Claim {
    let ratio = ratio();
    claim(
        &[56],
        "The nonlinear term with the coefficient *g*_4 can be written in a variational form *δ*∫ d*s* (∂_s*φ*)^3/*δφ*.",
        format!(
            "the derivative of the term is symmetric to {:.0e} (the linear terms to {:.0e}), and the \
            variation of the integral is {ratio:.9} times the term",
            turning[3],
            turning[..3].iter().copied().fold(0.0, f64::max)
        ),
        "⟨*u*, *Jw*⟩ − ⟨*w*, *Ju*⟩ over the sum of their sizes for random functions of ten modes, below \
        10^{-8}; the factor is −6 to 10^{-9}",
        turning[..4].iter().all(|x| *x < NOTHING) && (ratio + 6.0).abs() < 1e-9,
    )
}

fn not_variational(turning: &[f64; 5]) -> Claim {
    claim(
        &[59],
        "The last term is not variational.",
        format!(
            "the derivative of the term with *g*_5 is not symmetric: {:.2} of the size of the products compared",
            turning[4]
        ),
        "as above; above 0.01",
        turning[4] > 0.01,
    )
}
