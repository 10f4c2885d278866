//! The quadratic terms of (C) as direct convolutions: sums over blocks of modes, which become vector instructions.

use super::MAX_MODES;
use motiform_dynamics::{ROW_BLOCK, Row, Scalar};

/// Numbers in short rows: long rows take longer to clear than to sum.
const SHORT: usize = 24 + ROW_BLOCK;

/// Numbers in long rows. Blocks read up to `ROW_BLOCK - 1` zeros behind the last mode.
const LONG: usize = MAX_MODES + ROW_BLOCK;

/// `N(u)` of one orbit into `du`, with the coefficients of `(phi_ss^2)_s` and `(phi_s^2)_s`.
#[inline(always)]
pub(super) fn in_rows<T: Scalar>(coefficients: (T::Real, Option<T::Real>), u: &[T], du: &mut [T]) {
    if u.len() / 2 + ROW_BLOCK <= SHORT {
        in_rows_of::<T, SHORT>(coefficients, u, du);
    } else {
        in_rows_of::<T, LONG>(coefficients, u, du);
    }
}

#[inline(always)]
fn in_rows_of<T: Scalar, const N: usize>(
    (bending, stretching): (T::Real, Option<T::Real>),
    u: &[T],
    du: &mut [T],
) {
    let mut rows = Workspace::<T, N>::new(u[0]);
    for x in du.iter_mut() {
        *x = x.zero();
    }
    rows.square_derivative(2, 1.0, u); // phi_ss^2
    rows.square.add_derivative(bending, du); // (C), g5
    if let Some(stretching) = stretching {
        rows.square_derivative(1, -1.0, u); // phi_s^2
        rows.square.add_derivative(stretching, du); // (C), g4
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

    #[inline(always)]
    fn get(&self, i: usize) -> [T; 2] {
        [self.re.get(i), self.im.get(i)]
    }

    #[inline(always)]
    fn set(&mut self, i: usize, [re, im]: [T; 2]) {
        self.re.set(i, re);
        self.im.set(i, im);
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

/// The rows of a convolution. They are filled where they lie: rows that functions return are copied.
struct Workspace<T: Scalar, const N: usize> {
    /// `a_p`.
    a: Rows<T, N>,
    /// `a_{-p} = sign conj(a_p)`.
    conjugate: Rows<T, N>,
    /// For each block that starts at `first`: zeros in its first half, `a_q` with `q = n - first / 2 - 1` in the second.
    halves: Rows<T, N>,
    /// `sum_{p+q=n} a_p a_q` over all `p, q` of either sign.
    square: Rows<T, N>,
}

impl<T: Scalar, const N: usize> Workspace<T, N> {
    #[inline(always)]
    fn new(like: T) -> Self {
        Self {
            a: Rows::zero(like),
            conjugate: Rows::zero(like),
            halves: Rows::zero(like),
            square: Rows::zero(like),
        }
    }

    /// The square of `sum_n n^power phi_n exp(i k_n s)`; `sign` is that of its modes -n.
    #[inline(always)]
    fn square_derivative(&mut self, power: i32, sign: f64, u: &[T]) {
        let modes = u.len() / 2;
        self.fill(power, sign, u);
        for first in (0..modes).step_by(ROW_BLOCK) {
            let sums = convolve_block([&self.a, &self.conjugate, &self.halves], modes, first);
            for i in 0..ROW_BLOCK {
                self.square.set(first + i, [sums[0].get(i) * 2.0, sums[1].get(i) * 2.0]);
            }
        }
        for p in 1..modes / 2 + 1 {
            let ([a, b], [re, im]) = (self.a.get(p - 1), self.square.get(2 * p - 1));
            self.square.set(2 * p - 1, [re + (a * a - b * b), im + a * b * 2.0]);
        }
    }

    /// The rows that products are made of.
    #[inline(always)]
    fn fill(&mut self, power: i32, sign: f64, u: &[T]) {
        for (i, mode) in u.chunks_exact(2).enumerate() {
            let factor = (i as f64 + 1.0).powi(power);
            let [re, im] = [mode[0] * factor, mode[1] * factor];
            self.a.set(i, [re, im]);
            self.conjugate.set(i, [re * sign, im * -sign]);
        }
        for first in (0..u.len() / 2).step_by(ROW_BLOCK) {
            for i in ROW_BLOCK / 2..ROW_BLOCK {
                self.halves.set(first + i, self.a.get(first + i - (first / 2 + 1)));
            }
        }
    }
}

/// Real and imaginary parts of a block of sums.
type Sums<T, const N: usize> = [<<T as Scalar>::Row<N> as Row<T>>::Block; 2];

/// `sum_{p < q, p+q=n} a_p a_q + sum_p a_{n+p} a_{-p}` for `n = first + 1 ..= first + ROW_BLOCK`, in the
/// order of p: at each p first the product of the first kind.
#[inline(always)]
fn convolve_block<T: Scalar, const N: usize>(
    [a, conjugate, halves]: [&Rows<T, N>; 3],
    modes: usize,
    first: usize,
) -> Sums<T, N> {
    let like = a.re.get(0);
    let mut sums: Sums<T, N> = [Row::zeros(like), Row::zeros(like)];
    // Products of the first kind are in all places up to p = first / 2, then at one p in half of them.
    let (whole, turns) = (first / 2, modes - 1 - first);
    for p in 1..whole.min(turns) + 1 {
        add(&mut sums, a, first - p, (a, p));
        add(&mut sums, a, first + p, (conjugate, p));
    }
    for p in turns + 1..whole + 1 {
        add(&mut sums, a, first - p, (a, p));
    }
    add(&mut sums, halves, first, (a, whole + 1));
    for p in whole + 1..turns + 1 {
        add(&mut sums, a, first + p, (conjugate, p));
    }
    sums
}

/// `sums += a b_p`, with `a` from `start` on.
#[inline(always)]
fn add<T: Scalar, const N: usize>(
    [x, y]: &mut Sums<T, N>,
    a: &Rows<T, N>,
    start: usize,
    (b, p): (&Rows<T, N>, usize),
) {
    Row::add_turned([x, y], [&a.re, &a.im], start, b.get(p - 1));
}
