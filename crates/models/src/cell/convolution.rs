//! The quadratic terms of (C) as direct convolutions: sums run over whole rows of modes, which become vector instructions.

use super::MAX_MODES;
use motiform_dynamics::Scalar;

/// `N(u)` of one orbit into `du`, with the coefficients of `(phi_ss^2)_s` and `(phi_s^2)_s`.
#[inline(always)]
pub(super) fn in_rows<T: Scalar>((bending, stretching): (T::Real, Option<T::Real>), u: &[T], du: &mut [T]) {
    let modes = u.len() / 2;
    let square = convolve(&Rows::derivative(u, 2), modes, 1.0); // phi_ss^2
    for x in du.iter_mut() {
        *x = x.zero();
    }
    square.add_derivative(bending, du); // (C), g5
    if let Some(stretching) = stretching {
        let square = convolve(&Rows::derivative(u, 1), modes, -1.0); // phi_s^2
        square.add_derivative(stretching, du); // (C), g4
    }
}

/// Complex numbers of the modes in two rows; index `n - 1` holds mode `n`.
struct Rows<T> {
    re: [T; MAX_MODES],
    im: [T; MAX_MODES],
}

impl<T: Scalar> Rows<T> {
    #[inline(always)]
    fn zero(like: T) -> Self {
        Self { re: [like.zero(); MAX_MODES], im: [like.zero(); MAX_MODES] }
    }

    /// `n^power phi_n`.
    #[inline(always)]
    fn derivative(u: &[T], power: i32) -> Self {
        let mut rows = Self::zero(u[0]);
        for (i, mode) in u.chunks_exact(2).enumerate() {
            let factor = (i as f64 + 1.0).powi(power);
            rows.re[i] = mode[0] * factor;
            rows.im[i] = mode[1] * factor;
        }
        rows
    }

    /// `rate_n += factor i n rows_n`.
    #[inline(always)]
    fn add_derivative(&self, factor: T::Real, du: &mut [T]) {
        for (i, rate) in du.chunks_exact_mut(2).enumerate() {
            let n = i as f64 + 1.0;
            rate[0] += (self.im[i] * -n).scale(factor);
            rate[1] += (self.re[i] * n).scale(factor);
        }
    }
}

/// `sum_{p+q=n} a_p a_q` over all `p, q` of either sign, for `n = 1 ..= modes`; `a_{-p} = sign conj(a_p)`.
#[inline(always)]
fn convolve<T: Scalar>(a: &Rows<T>, modes: usize, sign: f64) -> Rows<T> {
    let mut out = Rows::zero(a.re[0]);
    for p in 1..modes {
        // a_p a_q, p < q, at n = p + q
        let (re, im) = (a.re[p - 1], a.im[p - 1]);
        if 2 * p < modes {
            let (to, from) = (2 * p..modes, p..modes - p);
            let target = out.re[to.clone()].iter_mut().zip(&mut out.im[to]);
            let source = a.re[from.clone()].iter().zip(&a.im[from]);
            for ((x, y), (&q_re, &q_im)) in target.zip(source) {
                *x += q_re * re - q_im * im;
                *y += q_re * im + q_im * re;
            }
        }
        // a_{n+p} a_{-p}
        let (re, im) = (re * sign, im * -sign);
        let target = out.re[..modes - p].iter_mut().zip(&mut out.im[..modes - p]);
        let source = a.re[p..modes].iter().zip(&a.im[p..modes]);
        for ((x, y), (&q_re, &q_im)) in target.zip(source) {
            *x += q_re * re - q_im * im;
            *y += q_re * im + q_im * re;
        }
    }
    for n in 0..modes {
        (out.re[n], out.im[n]) = (out.re[n] * 2.0, out.im[n] * 2.0);
    }
    for p in 1..=modes / 2 {
        let (re, im) = (a.re[p - 1], a.im[p - 1]);
        out.re[2 * p - 1] += re * re - im * im;
        out.im[2 * p - 1] += re * im * 2.0;
    }
    out
}
