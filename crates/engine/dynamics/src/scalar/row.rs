//! Rows of numbers, kept so that sums along them become vector instructions.

use super::{Dual, Scalar};

/// Numbers of a [`Row::Block`]: few enough for the sums of duals to stay in 256-bit registers.
pub const BLOCK: usize = 4;

/// A row of numbers of type `T`. Plain numbers lie side by side; of duals, all values and then all derivatives do: numbers whose parts
/// alternate would be shuffled before every sum.
pub trait Row<T>: Clone {
    /// [`BLOCK`] numbers of a row.
    type Block: Row<T>;

    /// Zeros, of the same kind as `like`.
    fn zeros(like: T) -> Self;

    /// The number at `i`.
    fn get(&self, i: usize) -> T;

    /// Sets the number at `i`.
    fn set(&mut self, i: usize, x: T);

    /// Complex numbers in two rows each, real and imaginary parts: `sums[i] += rows[start + i] * by`.
    ///
    /// The same bits as the sums over single numbers, `x += a re - b im`, `y += a im + b re`.
    fn add_turned(sums: [&mut Self::Block; 2], rows: [&Self; 2], start: usize, by: [T; 2]);
}

impl<T: Scalar, const N: usize> Row<T> for [T; N] {
    type Block = [T; BLOCK];

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
    fn add_turned(sums: [&mut [T; BLOCK]; 2], [a, b]: [&Self; 2], start: usize, by: [T; 2]) {
        let cut = start..start + BLOCK;
        add_products(sums, [&a[cut.clone()], &b[cut]], by);
    }
}

/// A row of duals: the values, and the derivatives along each direction.
#[derive(Clone, Copy, Debug)]
pub struct DualRow<T, const K: usize, const N: usize> {
    value: [T; N],
    derivative: [[T; N]; K],
}

impl<T: Scalar, const K: usize, const N: usize> Row<Dual<T, K>> for DualRow<T, K, N> {
    type Block = DualRow<T, K, BLOCK>;

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
        [x, y]: [&mut Self::Block; 2],
        [a, b]: [&Self; 2],
        start: usize,
        [re, im]: [Dual<T, K>; 2],
    ) {
        let cut = start..start + BLOCK;
        let values = [&a.value[cut.clone()], &b.value[cut.clone()]];
        add_products([&mut x.value, &mut y.value], values, [re.value, im.value]);
        for k in 0..K {
            let rates = [&a.derivative[k][cut.clone()], &b.derivative[k][cut.clone()]];
            let by = [(re.value, re.derivative[k]), (im.value, im.derivative[k])];
            add_derivatives([&mut x.derivative[k], &mut y.derivative[k]], values, rates, by);
        }
    }
}

/// `x += a re - b im`, `y += a im + b re`.
#[inline(always)]
fn add_products<T: Scalar>([x, y]: [&mut [T; BLOCK]; 2], [a, b]: [&[T]; 2], [re, im]: [T; 2]) {
    for i in 0..BLOCK {
        x[i] += a[i] * re - b[i] * im;
        y[i] += a[i] * im + b[i] * re;
    }
}

/// The derivatives of these sums by the product rule, as [`Dual`] has them: `(a b)' = a' b + a b'`.
#[inline(always)]
fn add_derivatives<T: Scalar>(
    [x, y]: [&mut [T; BLOCK]; 2],
    [a, b]: [&[T]; 2],
    [da, db]: [&[T]; 2],
    [(re, d_re), (im, d_im)]: [(T, T); 2],
) {
    for i in 0..BLOCK {
        x[i] += da[i].mul_add(re, a[i] * d_re) - db[i].mul_add(im, b[i] * d_im);
        y[i] += da[i].mul_add(im, a[i] * d_im) + db[i].mul_add(re, b[i] * d_re);
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
        let mut sums: [<Number as Scalar>::Row<BLOCK>; 2] = [Row::zeros(by[0]), Row::zeros(by[0])];
        let [x, y] = &mut sums;
        Row::add_turned([x, y], [&rows[2], &rows[3]], 5, by);
        for i in 0..BLOCK {
            let [a, b] = [plain[2][5 + i], plain[3][5 + i]];
            assert_eq!(sums[0].get(i), a * by[0] - b * by[1]);
            assert_eq!(sums[1].get(i), a * by[1] + b * by[0]);
        }
    }
}
