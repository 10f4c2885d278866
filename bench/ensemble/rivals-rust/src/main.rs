//! The crate `differential-equations`, DOP853, one orbit of the tensor model after the other.
//!
//! rivals-rust MEMBERS T RTOL ATOL GAMMA KAPPA3 E11 E21 E22 E31 E32 KAPPA2_LOW KAPPA2_HIGH BASE(6)  ->  one JSON object

use differential_equations::prelude::*;
use std::time::Instant;

struct Tensor {
    p: [f64; 7],
    kappa2: f64,
}

impl ODE<f64, [f64; 6]> for Tensor {
    fn diff(&self, _t: f64, u: &[f64; 6], f: &mut [f64; 6]) {
        let [gamma, kappa3, e11, e21, e22, e31, e32] = self.p;
        let [a, b, c, d, x, y] = *u;
        let (aa, bb) = (a * a, b * b);
        let q = gamma - (aa + bb);
        let (re, im) = (aa - bb, 2.0 * (a * b));
        let (wr, wi) = (e31 * re + e32 * c, e31 * im + e32 * d);
        f[0] = q * a + e11 * (a * c + b * d);
        f[1] = q * b + e11 * (a * d - b * c);
        f[2] = e21 * re + e22 * (a * x + b * y) - self.kappa2 * c;
        f[3] = e21 * im + e22 * (a * y - b * x) - self.kappa2 * d;
        f[4] = a * wr - b * wi - kappa3 * x;
        f[5] = a * wi + b * wr - kappa3 * y;
    }
}

/// Keeps the last state only: nothing else is asked of the others either.
struct Last {
    t: f64,
}

impl Solout<f64, [f64; 6]> for Last {
    fn solout<I>(
        &mut self,
        t: f64,
        _t_previous: f64,
        u: &[f64; 6],
        _u_previous: &[f64; 6],
        _interpolator: &mut I,
        solution: &mut Solution<f64, [f64; 6]>,
    ) -> ControlFlag<f64, [f64; 6]>
    where
        I: Interpolation<f64, [f64; 6]> + ?Sized,
    {
        if t >= self.t {
            solution.push(t, *u);
        }
        ControlFlag::Continue
    }
}

fn main() {
    let v: Vec<f64> = std::env::args().skip(1).map(|word| word.parse().expect("a number")).collect();
    assert_eq!(v.len(), 19, "19 numbers");
    let (n, t, rtol, atol) = (v[0] as usize, v[1], v[2], v[3]);
    let p: [f64; 7] = v[4..11].try_into().expect("seven");
    let members: Vec<(f64, [f64; 6])> = (0..n)
        .map(|i| {
            let i = i as f64;
            let kappa2 = v[11] + (v[12] - v[11]) * i / (n.max(2) - 1) as f64;
            (kappa2, std::array::from_fn(|j| v[13 + j] * (1.0 + 0.1 * (1.0 + 0.7 * i + 1.3 * j as f64).sin())))
        })
        .collect();
    let begin = Instant::now();
    let ends: Vec<[f64; 6]> = members
        .iter()
        .map(|&(kappa2, start)| {
            let solver = ExplicitRungeKutta::dop853().rtol(rtol).atol(atol).max_steps(1_000_000);
            let found = IVP::ode(&Tensor { p, kappa2 }, 0.0, t, start).method(solver).solout(Last { t }).solve();
            *found.expect("solved").last().expect("an end").1
        })
        .collect();
    let seconds = begin.elapsed().as_secs_f64();
    let sum: f64 = ends.iter().flatten().sum();
    println!("{{\"seconds\": {seconds}, \"work\": {}, \"sum\": {sum}, \"check\": {:?}}}", n as f64 * t, &ends[..8]);
}
