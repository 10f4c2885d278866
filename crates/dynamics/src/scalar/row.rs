//! Rows of numbers, kept so that sums along them become vector instructions.

use super::{Dual, Scalar};
use std::ops::Range;

/// A row of numbers of type `T`. Plain numbers lie side by side; of duals, all values and then all derivatives do: numbers whose parts
/// alternate would be shuffled before every sum.
pub trait Row<T>: Clone {
    /// Zeros, of the same kind as `like`.
    fn zeros(like: T) -> Self;

    /// The number at `i`.
    fn get(&self, i: usize) -> T;

    /// Sets the number at `i`.
    fn set(&mut self, i: usize, x: T);

    /// Complex numbers in two rows each, real and imaginary parts: `out[to + i] += rows[from.start + i] * by`, for all of `from`.
    ///
    /// The same bits as the sums over single numbers, `x += a re - b im`, `y += a im + b re`.
    fn add_turned(out: [&mut Self; 2], to: usize, rows: [&Self; 2], from: Range<usize>, by: [T; 2]);
}

impl<T: Scalar, const N: usize> Row<T> for [T; N] {
    #[inline(always)]
    fn zeros(like: T) -> Self {
        [like.zero(); N]
    }

    #[inline(always)]
    fn get(&self, i: usize) -> T {
        self[i]
    }

    #[inline(always)]
    fn set(&mut self, i: usize, x: T) {
        self[i] = x;
    }

    #[inline(always)]
    fn add_turned([x, y]: [&mut Self; 2], to: usize, [a, b]: [&Self; 2], from: Range<usize>, by: [T; 2]) {
        let to = to..to + from.len();
        add_products([&mut x[to.clone()], &mut y[to]], [&a[from.clone()], &b[from]], by);
    }
}

/// A row of duals: the values, and the derivatives along each direction.
#[derive(Clone, Copy, Debug)]
pub struct DualRow<T, const K: usize, const N: usize> {
    value: [T; N],
    derivative: [[T; N]; K],
}

impl<T: Scalar, const K: usize, const N: usize> Row<Dual<T, K>> for DualRow<T, K, N> {
    #[inline(always)]
    fn zeros(like: Dual<T, K>) -> Self {
        let zeros = [like.value.zero(); N];
        Self { value: zeros, derivative: [zeros; K] }
    }

    #[inline(always)]
    fn get(&self, i: usize) -> Dual<T, K> {
        let mut out = Dual::constant_of(self.value[i]);
        for k in 0..K {
            out.derivative[k] = self.derivative[k][i];
        }
        out
    }

    #[inline(always)]
    fn set(&mut self, i: usize, x: Dual<T, K>) {
        self.value[i] = x.value;
        for k in 0..K {
            self.derivative[k][i] = x.derivative[k];
        }
    }

    #[inline(always)]
    fn add_turned(
        [x, y]: [&mut Self; 2],
        to: usize,
        [a, b]: [&Self; 2],
        from: Range<usize>,
        [re, im]: [Dual<T, K>; 2],
    ) {
        let to = to..to + from.len();
        let values = [&a.value[from.clone()], &b.value[from.clone()]];
        add_products([&mut x.value[to.clone()], &mut y.value[to.clone()]], values, [re.value, im.value]);
        for k in 0..K {
            let out = [&mut x.derivative[k][to.clone()], &mut y.derivative[k][to.clone()]];
            let rates = [&a.derivative[k][from.clone()], &b.derivative[k][from.clone()]];
            let by = [(re.value, re.derivative[k]), (im.value, im.derivative[k])];
            add_derivatives(out, values, rates, by);
        }
    }
}

/// `x += a re - b im`, `y += a im + b re`.
#[inline(always)]
fn add_products<T: Scalar>([x, y]: [&mut [T]; 2], [a, b]: [&[T]; 2], [re, im]: [T; 2]) {
    for ((x, y), (&a, &b)) in x.iter_mut().zip(y).zip(a.iter().zip(b)) {
        *x += a * re - b * im;
        *y += a * im + b * re;
    }
}

/// The derivatives of these sums by the product rule, as [`Dual`] has them: `(a b)' = a' b + a b'`.
#[inline(always)]
fn add_derivatives<T: Scalar>(
    [x, y]: [&mut [T]; 2],
    [a, b]: [&[T]; 2],
    [da, db]: [&[T]; 2],
    [(re, d_re), (im, d_im)]: [(T, T); 2],
) {
    let rows = a.iter().zip(b).zip(da.iter().zip(db));
    for ((x, y), ((&a, &b), (&da, &db))) in x.iter_mut().zip(y).zip(rows) {
        *x += da.mul_add(re, a * d_re) - db.mul_add(im, b * d_im);
        *y += da.mul_add(im, a * d_im) + db.mul_add(re, b * d_re);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Number = Dual<f64, 2>;

    fn number(seed: u32) -> Number {
        let part = |k: u32| libm::sin(f64::from(7 * seed + 3 * k + 1)) * 3.0;
        Dual { value: part(0), derivative: [part(1), part(2)] }
    }

    /// Sums along rows of duals have the bits of sums of duals.
    #[test]
    fn rows_of_duals_add_up_as_duals_do() {
        const N: usize = 24;
        let mut rows: [<Number as Scalar>::Row<N>; 4] = std::array::from_fn(|_| Row::zeros(number(0)));
        let mut plain = [[number(0); N]; 4];
        for (r, row) in rows.iter_mut().enumerate() {
            for i in 0..N {
                let x = number((r * N + i) as u32);
                row.set(i, x);
                plain[r][i] = x;
            }
        }
        let by = [number(500), number(501)];
        let [x, y, a, b] = &mut rows;
        Row::add_turned([x, y], 3, [a, b], 5..22, by);
        let [x, y, a, b] = &mut plain;
        Row::add_turned([x, y], 3, [a, b], 5..22, by);
        for (row, plain) in rows.iter().zip(&plain) {
            for (i, expected) in plain.iter().enumerate() {
                assert_eq!(row.get(i), *expected);
            }
        }
        assert_eq!(plain[0][3], number(3) + (number(53) * by[0] - number(77) * by[1]));
    }
}
