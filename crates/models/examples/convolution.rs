//! The quadratic term of the cell: direct convolution against a real FFT. Numbers in `docs/convolution.md`.
//!
//! Times one evaluation of `N(u)` for 8 to 64 modes: direct over f64, `realfft` with the smallest grid of size 2^a 3^b that
//! the 2/3 rule allows, and direct in the lanes of vector registers (per lane).

use motiform_dynamics::ensemble::{StiffInLanes as _, StiffLanes as _};
use motiform_dynamics::simd::{LaneKernel, run_lanes};
use motiform_dynamics::{Bundle, Semilinear};
use motiform_models::cell::{CellField, CellParameters};
use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

/// `-1/2 d/ds (phi_ss^2)` by transforms; all room is made beforehand.
struct ByTransform {
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
    spectrum: Vec<Complex<f64>>,
    grid: Vec<f64>,
    scratch: Vec<Complex<f64>>,
    k: f64,
}

impl ByTransform {
    fn new(modes: usize, k: f64) -> Self {
        let size = (3 * modes + 1..).find(|&n| {
            let mut rest = n;
            while rest % 2 == 0 {
                rest /= 2;
            }
            while rest % 3 == 0 {
                rest /= 3;
            }
            rest == 1 && n % 2 == 0
        });
        let size = size.unwrap_or(4 * modes);
        let mut planner = RealFftPlanner::new();
        let (forward, backward) = (planner.plan_fft_forward(size), planner.plan_fft_inverse(size));
        let room = forward.get_scratch_len().max(backward.get_scratch_len());
        Self {
            spectrum: forward.make_output_vec(),
            grid: forward.make_input_vec(),
            scratch: vec![Complex::default(); room],
            forward,
            backward,
            k,
        }
    }

    fn nonlinear(&mut self, u: &[f64], du: &mut [f64]) -> Result<(), realfft::FftError> {
        self.spectrum.fill(Complex::default());
        for (i, mode) in u.chunks_exact(2).enumerate() {
            let wave = self.k * (i as f64 + 1.0);
            self.spectrum[i + 1] = Complex::new(mode[0], mode[1]) * (-wave * wave);
        }
        self.backward.process_with_scratch(&mut self.spectrum, &mut self.grid, &mut self.scratch)?;
        for x in &mut self.grid {
            *x *= *x;
        }
        self.forward.process_with_scratch(&mut self.grid, &mut self.spectrum, &mut self.scratch)?;
        let scale = 0.5 / self.grid.len() as f64;
        for (i, rate) in du.chunks_exact_mut(2).enumerate() {
            let factor = scale * self.k * (i as f64 + 1.0);
            (rate[0], rate[1]) = (factor * self.spectrum[i + 1].im, -factor * self.spectrum[i + 1].re);
        }
        Ok(())
    }
}

/// Many evaluations in lanes: nanoseconds of one, per lane.
struct InLanes<'a> {
    field: &'a CellField<f64>,
    u: &'a [f64],
}

impl LaneKernel for InLanes<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<B: Bundle>(self) -> f64 {
        let mut lanes = self.field.lanes::<B>();
        let mut u = vec![B::splat(0.0); self.u.len()];
        for (wide, &x) in u.iter_mut().zip(self.u) {
            *wide = B::splat(x);
        }
        let mut du = u.clone();
        let clock = Instant::now();
        for _ in 0..500 {
            lanes.nonlinear(B::splat(0.0), black_box(&u), black_box(&mut du));
        }
        clock.elapsed().as_secs_f64() * 1e9 / 500.0 / B::LANES as f64
    }
}

/// Smallest time of one call over several rounds (ns).
fn time(mut call: impl FnMut()) -> f64 {
    let round = |call: &mut dyn FnMut()| {
        let clock = Instant::now();
        for _ in 0..2000 {
            call();
        }
        clock.elapsed().as_secs_f64() * 1e9 / 2000.0
    };
    (0..50).map(|_| round(&mut call)).fold(f64::INFINITY, f64::min)
}

fn main() -> Result<(), realfft::FftError> {
    println!("| modes | direct f64 | realfft f64 (points) | direct in lanes, per lane |");
    println!("| --- | --- | --- | --- |");
    for modes in [8, 12, 16, 21, 32, 42, 64] {
        let p = CellParameters::default();
        let field = CellField::new(&p, modes);
        let u: Vec<f64> = (0..2 * modes).map(|i| 0.3 / (1.0 + i as f64)).collect();
        let (mut direct, mut other) = (u.clone(), u.clone());
        let mut transform = ByTransform::new(modes, p.wavenumber());
        transform.nonlinear(&u, &mut other)?;
        field.nonlinear(0.0, &u, &mut direct);
        let scale = direct.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        assert!(direct.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-12 * scale), "they agree");
        let one = time(|| field.nonlinear(0.0, black_box(&u), black_box(&mut direct)));
        let fft = time(|| {
            let _ = transform.nonlinear(black_box(&u), black_box(&mut other));
        });
        let round = |_| run_lanes(InLanes { field: &field, u: &u });
        let wide = (0..50).map(round).fold(f64::INFINITY, f64::min);
        let points = transform.grid.len();
        println!("| {modes} | {one:.0} ns | {fft:.0} ns ({points}) | {wide:.0} ns |");
    }
    Ok(())
}
