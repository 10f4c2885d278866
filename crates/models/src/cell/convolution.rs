//! The quadratic terms of (C) as direct convolutions: sums run over whole rows of modes, which become vector instructions.

use super::MAX_MODES;
use motiform_dynamics::{Row, Scalar};

/// Most modes in short rows: rows of [`MAX_MODES`] take longer to clear than to sum.
const SHORT: usize = 24;

/// `N(u)` of one orbit into `du`, with the coefficients of `(phi_ss^2)_s` and `(phi_s^2)_s`.
#[inline(always)]
pub(super) fn in_rows<T: Scalar>(coefficients: (T::Real, Option<T::Real>), u: &[T], du: &mut [T]) {
    if u.len() / 2 <= SHORT {
        in_rows_of::<T, SHORT>(coefficients, u, du);
    } else {
        in_rows_of::<T, MAX_MODES>(coefficients, u, du);
    }
}

#[inline(always)]
fn in_rows_of<T: Scalar, const N: usize>(
    (bending, stretching): (T::Real, Option<T::Real>),
    u: &[T],
    du: &mut [T],
) {
    let modes = u.len() / 2;
    let square = convolve(&Rows::<T, N>::derivative(u, 2), modes, 1.0); // phi_ss^2
    for x in du.iter_mut() {
        *x = x.zero();
    }
    square.add_derivative(bending, du); // (C), g5
    if let Some(stretching) = stretching {
        let square = convolve(&Rows::<T, N>::derivative(u, 1), modes, -1.0); // phi_s^2
        square.add_derivative(stretching, du); // (C), g4
    }
}

/// Complex numbers of the modes in two rows; index `n - 1` holds mode `n`.
struct Rows<T: Scalar, const N: usize> {
    re: T::Row<N>,
    im: T::Row<N>,
}

impl<T: Scalar, const N: usize> Rows<T, N> {
    #[inline(always)]
    fn zero(like: T) -> Self {
        Self { re: Row::zeros(like), im: Row::zeros(like) }
    }

    /// `n^power phi_n`.
    #[inline(always)]
    fn derivative(u: &[T], power: i32) -> Self {
        let mut rows = Self::zero(u[0]);
        for (i, mode) in u.chunks_exact(2).enumerate() {
            let factor = (i as f64 + 1.0).powi(power);
            rows.re.set(i, mode[0] * factor);
            rows.im.set(i, mode[1] * factor);
        }
        rows
    }

    /// `rate_n += factor i n rows_n`.
    #[inline(always)]
    fn add_derivative(&self, factor: T::Real, du: &mut [T]) {
        for (i, rate) in du.chunks_exact_mut(2).enumerate() {
            let n = i as f64 + 1.0;
            rate[0] += (self.im.get(i) * -n).scale(factor);
            rate[1] += (self.re.get(i) * n).scale(factor);
        }
    }
}

/// `sum_{p+q=n} a_p a_q` over all `p, q` of either sign, for `n = 1 ..= modes`; `a_{-p} = sign conj(a_p)`.
#[inline(always)]
fn convolve<T: Scalar, const N: usize>(a: &Rows<T, N>, modes: usize, sign: f64) -> Rows<T, N> {
    let Rows { mut re, mut im } = Rows::<T, N>::zero(a.re.get(0));
    for p in 1..modes {
        let [a_re, a_im] = [a.re.get(p - 1), a.im.get(p - 1)];
        // a_p a_q, p < q, at n = p + q
        if 2 * p < modes {
            Row::add_turned([&mut re, &mut im], 2 * p, [&a.re, &a.im], p..modes - p, [a_re, a_im]);
        }
        // a_{n+p} a_{-p}
        let conjugate = [a_re * sign, a_im * -sign];
        Row::add_turned([&mut re, &mut im], 0, [&a.re, &a.im], p..modes, conjugate);
    }
    for n in 0..modes {
        re.set(n, re.get(n) * 2.0);
        im.set(n, im.get(n) * 2.0);
    }
    for p in 1..=modes / 2 {
        let [a_re, a_im] = [a.re.get(p - 1), a.im.get(p - 1)];
        re.set(2 * p - 1, re.get(2 * p - 1) + (a_re * a_re - a_im * a_im));
        im.set(2 * p - 1, im.get(2 * p - 1) + a_re * a_im * 2.0);
    }
    Rows { re, im }
}
