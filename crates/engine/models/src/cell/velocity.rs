//! The velocity (VEL): forces along the normals of the closed boundary.

use super::Cell;
use super::circle::MAX_POINTS;
use super::closure::Closed;
use motiform_dynamics::Scalar;
use motiform_dynamics::simd::Kernel;

impl Cell {
    /// The closed boundary of a shape.
    ///
    /// # Errors
    /// The residual of (CLOSE), if it could not be closed.
    #[inline(always)]
    pub(super) fn close<T: Scalar<Real = f64>>(&self, shape: &[T]) -> Result<Closed<T>, f64> {
        let (theta, first) = self.normal_angles(shape);
        self.closure.solve(&self.circle, &theta[..self.circle.points()], first)
    }

    /// The normal angles `k_1 (s + phi)` at the points, and mode 1 of `k_1 phi` as `c cos(k_1 s) + s sin(k_1 s)`.
    #[inline(always)]
    fn normal_angles<T: Scalar<Real = f64>>(&self, shape: &[T]) -> ([T; MAX_POINTS], [f64; 2]) {
        let points = self.circle.points();
        let k = self.parameters.wavenumber();
        let mut theta = [shape[0].zero(); MAX_POINTS];
        for (j, angle) in theta[..points].iter_mut().enumerate() {
            *angle = angle.constant(std::f64::consts::TAU * j as f64 / points as f64 + k * self.mean);
        }
        self.circle.add_modes(shape, |_| k, &mut theta[..points]);
        (theta, [2.0 * k * shape[0].real(), -2.0 * k * shape[1].real()])
    }

    /// `phi + eps`: a shape that is closed without an error function.
    ///
    /// # Errors
    /// The residual of (CLOSE), if it could not be closed.
    pub(super) fn feed_back(&self, shape: &[f64], closed: &mut [f64]) -> Result<(), f64> {
        let (theta, first) = self.normal_angles(shape);
        let waves = self.closure.estimate(&self.circle, &theta[..self.circle.points()], first)?;
        let k = self.parameters.wavenumber();
        closed.copy_from_slice(shape);
        for (mode, wave) in closed.chunks_exact_mut(2).zip(waves.chunks_exact(2)) {
            mode[0] += wave[0] / (2.0 * k); // phi_n = (c_n - i s_n) / 2
            mode[1] -= wave[1] / (2.0 * k);
        }
        Ok(())
    }

    /// `v = ((2 pi)^2 / L^3) int (alpha2 phi_s^2 + alpha3 phi_ss^2) n ds`, with the normals of the closed boundary; not a
    /// number where it cannot be closed (see `obstacle`).
    #[inline(always)]
    pub(super) fn push<T: Scalar<Real = f64>>(&self, shape: &[T]) -> [T; 2] {
        let Ok(closed) = self.close(shape) else { return [shape[0].constant(f64::NAN); 2] };
        let points = self.circle.points();
        let (p, k) = (&self.parameters, self.parameters.wavenumber());
        let mut push = [shape[0].zero(); MAX_POINTS];
        self.square(shape, 2, p.alpha3_total(), &mut push[..points]); // (VEL), alpha3
        if p.alpha2 != 0.0 {
            let mut other = [shape[0].zero(); MAX_POINTS];
            self.square(shape, 1, p.alpha2, &mut other[..points]); // (VEL), alpha2
            push.iter_mut().zip(&other[..points]).for_each(|(x, &other)| *x += other);
        }
        let mut v = [shape[0].zero(); 2];
        for (j, &w) in push[..points].iter().enumerate() {
            v[0] += w * closed.normals.cos[j];
            v[1] += w * closed.normals.sin[j];
        }
        v.map(|sum| sum * (k * k / points as f64))
    }

    /// `alpha (d^power phi / ds^power)^2` in the place of zeros.
    #[inline(always)]
    fn square<T: Scalar>(&self, shape: &[T], power: i32, alpha: f64, out: &mut [T]) {
        self.add_derivative(shape, power, out);
        for x in out {
            *x = *x * *x * alpha;
        }
    }

    /// Adds `d^power phi / ds^power` at the points, for power 1 or 2.
    #[inline(always)]
    fn add_derivative<T: Scalar>(&self, shape: &[T], power: i32, out: &mut [T]) {
        let k = self.parameters.wavenumber();
        for (i, mode) in shape.chunks_exact(2).enumerate() {
            let wave = k * (i as f64 + 1.0);
            let waves = if power == 2 {
                let factor = -2.0 * wave * wave;
                [mode[0] * factor, mode[1] * -factor]
            } else {
                [mode[1] * (-2.0 * wave), mode[0] * (-2.0 * wave)]
            };
            self.circle.add_wave(i + 1, waves, out);
        }
    }
}

/// [`Cell::push`] as a kernel.
pub(super) struct Push<'a, T> {
    pub(super) cell: &'a Cell,
    pub(super) shape: &'a [T],
}

impl<T: Scalar<Real = f64>> Kernel for Push<'_, T> {
    type Output = [T; 2];

    #[inline(always)]
    fn run(self) -> [T; 2] {
        self.cell.push(self.shape)
    }
}
