//! The quadratic terms of (C) as direct convolutions, in two forms with the same order of additions.
//!
//! [`in_rows`] is for one orbit: sums run over whole rows of modes, which become vector instructions.
//! [`in_blocks`] is for bundles, where every number is a vector already: the sums of a few neighbouring modes stay in
//! registers until they are complete.

use super::MAX_MODES;
use motiform_dynamics::{Complex, Scalar};

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

/// Modes whose sums are computed together.
const BLOCK: usize = 4;

/// Zeros that [`in_blocks`] reads behind the modes.
pub(super) const PADDING: usize = BLOCK - 1;

/// [`in_rows`] for bundles; `waves` is room for the modes, with [`PADDING`] zeros (or more) behind them.
#[inline(always)]
pub(super) fn in_blocks<T: Scalar>(
    (bending, stretching): (T::Real, Option<T::Real>),
    waves: &mut [Complex<T>],
    u: &[T],
    du: &mut [T],
) {
    derivative(u, 2, waves);
    squares::<T, false>(waves, bending, du); // (C), g5: phi_ss^2
    if let Some(stretching) = stretching {
        derivative(u, 1, waves);
        squares::<T, true>(waves, stretching, du); // (C), g4: phi_s^2, added
    }
}

/// `n^power phi_n`.
#[inline(always)]
fn derivative<T: Scalar>(u: &[T], power: i32, waves: &mut [Complex<T>]) {
    for (i, (mode, wave)) in u.chunks_exact(2).zip(waves).enumerate() {
        let factor = (i as f64 + 1.0).powi(power);
        *wave = Complex::new(mode[0] * factor, mode[1] * factor);
    }
}

/// `rate_n = factor i n sum_{p+q=n} a_p a_q` with `a_{-p} = conj(a_p)`; or with `ODD`, `a_{-p} = -conj(a_p)`, added to the rate.
#[inline(always)]
fn squares<T: Scalar, const ODD: bool>(a: &[Complex<T>], factor: T::Real, du: &mut [T]) {
    let (modes, zero) = (du.len() / 2, a[0].re.zero());
    for first in (1..=modes).step_by(BLOCK) {
        let sums = block::<T, ODD>(a, modes, first);
        for k in 0..BLOCK.min(modes + 1 - first) {
            let n = first + k;
            let mut sum = Complex::new(sums[k].re * 2.0, sums[k].im * 2.0);
            if n % 2 == 0 {
                let Complex { re, im } = a[n / 2 - 1];
                sum.re += re * re - im * im;
                sum.im += re * im * 2.0;
            }
            let rate =
                if ODD { Complex::new(du[2 * n - 2], du[2 * n - 1]) } else { Complex::new(zero, zero) };
            du[2 * n - 2] = rate.re + (sum.im * -(n as f64)).scale(factor);
            du[2 * n - 1] = rate.im + (sum.re * n as f64).scale(factor);
        }
    }
}

/// Half of `sum_{p+q=n} a_p a_q`, `p != q`, for `n = first ..`, `first` odd: for `p = 1, 2, ..` the term `a_{n-p} a_p`
/// while `p < n - p`, then `a_{n+p} a_{-p}` while `n + p <= modes` (for the whole block while its first `n` does: zeros
/// follow).
#[inline(always)]
fn block<T: Scalar, const ODD: bool>(a: &[Complex<T>], modes: usize, first: usize) -> [Complex<T>; BLOCK] {
    let zero = a[0].re.zero();
    let mut sums = [Complex::new(zero, zero); BLOCK];
    let (below, above) = ((first - 1) / 2, modes - first);
    let both = below.min(above);
    let before = a[first - 1 - both..first + BLOCK - 2].windows(BLOCK).rev();
    let behind = a[first..first + both + BLOCK - 1].windows(BLOCK);
    for ((&z, p), q) in a[..both].iter().zip(before).zip(behind) {
        add(&mut sums, 0, p, z);
        add(&mut sums, 0, q, conjugate::<T, ODD>(z));
    }
    if below > above {
        let before = a[first - 1 - below..first + BLOCK - 2 - above].windows(BLOCK).rev();
        for (&z, p) in a[above..below].iter().zip(before) {
            add(&mut sums, 0, p, z);
        }
    }
    // The upper half of the block has one more term of the first kind.
    add(&mut sums, BLOCK / 2, &a[below + 1..], a[below]);
    if above > below {
        let behind = a[first + below..first + above + BLOCK - 1].windows(BLOCK);
        for (&z, q) in a[below..above].iter().zip(behind) {
            add(&mut sums, 0, q, conjugate::<T, ODD>(z));
        }
    }
    sums
}

/// `sums_k += q_k z` from `k = from` on; `q` starts there.
#[inline(always)]
fn add<T: Scalar>(sums: &mut [Complex<T>; BLOCK], from: usize, q: &[Complex<T>], z: Complex<T>) {
    let q = &q[..BLOCK - from];
    for k in from..BLOCK {
        let (x, q) = (sums[k], q[k - from]);
        sums[k].re = x.re.add_difference((q.re, z.re), (q.im, z.im));
        sums[k].im = x.im.add_sum((q.re, z.im), (q.im, z.re));
    }
}

/// `a_{-p}` for `z = a_p`.
#[inline(always)]
fn conjugate<T: Scalar, const ODD: bool>(z: Complex<T>) -> Complex<T> {
    if ODD { -z.conj() } else { z.conj() }
}
