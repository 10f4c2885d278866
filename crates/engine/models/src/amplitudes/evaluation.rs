//! The list of products, evaluated over any scalar.

use super::paper::Paper;
use super::program::{Group, List, Operand, Program, REGISTERS};
use motiform_dynamics::simd::Kernel;
use motiform_dynamics::{Complex, Scalar};

/// `true` if the paper's terms have an evaluation of their own. In the module of a page, which integrates one
/// body at a time, it would gain little.
const KNOWN: bool = !cfg!(target_family = "wasm");

/// Registers of the largest programs: amplitudes, 1 and products.
const MOST: usize = 2 * REGISTERS;

impl Program {
    /// Evaluates all polynomials at the amplitudes `u` (real and imaginary parts in turn).
    #[inline(always)]
    pub(super) fn eval<T: Scalar>(&self, coefficients: &[[T::Real; 2]], u: &[T], du: &mut [T]) {
        match self.registers(u.len() / 2) {
            _ if KNOWN && self.paper => {
                T::apart(Evaluation::<T, Paper, 8> { program: &Paper, coefficients, u, du });
            }
            ..=8 => T::apart(Evaluation::<T, Self, 8> { program: self, coefficients, u, du }),
            9..=16 => T::apart(Evaluation::<T, Self, 16> { program: self, coefficients, u, du }),
            17..=64 => T::apart(Evaluation::<T, Self, 64> { program: self, coefficients, u, du }),
            _ => T::apart(Evaluation::<T, Self, MOST> { program: self, coefficients, u, du }),
        }
    }
}

/// One evaluation with at most `N` registers of each kind, a power of 2: registers that are not needed cost time, they are cleared.
///
/// It is compiled once for each scalar, and no closure may be in it: see [`Scalar::apart`] and [`Kernel`].
struct Evaluation<'e, T: Scalar, L, const N: usize> {
    program: &'e L,
    coefficients: &'e [[T::Real; 2]],
    u: &'e [T],
    du: &'e mut [T],
}

impl<T: Scalar, L: List, const N: usize> Kernel for Evaluation<'_, T, L, N> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { program, coefficients, u, du } = self;
        let [factors, unknowns, rates] = program.lengths([coefficients.len(), u.len(), du.len()]);
        let (coefficients, u, du) = (&coefficients[..factors], &u[..unknowns], &mut du[..rates]);
        let Some(&some) = u.first() else { return };
        let zero = some.zero();
        let mut registers = [Complex::new(zero, zero); N];
        products(program, u, &mut registers);
        let mut norms = [zero; N];
        squares(program, &registers, &mut norms);
        for (sum, rate) in program.sums().iter().zip(du.chunks_exact_mut(2)) {
            let mut total = Complex::new(zero, zero);
            for group in &program.groups()[sum.plain.clone()] {
                let coefficient = coefficients[group.factors.start][0];
                total = total.add_scaled(read(group.base, &registers), coefficient);
            }
            for group in &program.groups()[sum.real.clone()] {
                let (z, factor) = (
                    read(group.base, &registers),
                    factor::<T, L, N, 0>(program, group, coefficients, zero, &norms),
                );
                total = Complex::new(z.re.mul_add(factor, total.re), z.im.mul_add(factor, total.im));
            }
            for group in &program.groups()[sum.complex.clone()] {
                let re = factor::<T, L, N, 0>(program, group, coefficients, zero, &norms);
                let im = factor::<T, L, N, 1>(program, group, coefficients, zero, &norms);
                total = total.add_product(read(group.base, &registers), Complex::new(re, im));
            }
            (rate[0], rate[1]) = (total.re, total.im);
        }
    }
}

/// The amplitudes or their parts, then 1 if a term needs it, then the products.
#[inline(always)]
fn products<T: Scalar, L: List, const N: usize>(program: &L, u: &[T], registers: &mut [Complex<T>; N]) {
    let mut next = 0;
    if program.parts() {
        for &part in u {
            registers[next % N].re = part;
            next += 1;
        }
    } else {
        for z in u.chunks_exact(2) {
            registers[next % N] = Complex::new(z[0], z[1]);
            next += 1;
        }
    }
    if program.one() {
        registers[next % N].re = registers[0].re.constant(1.0);
        next += 1;
    }
    for &[a, b] in program.products() {
        registers[next % N] = read(a, registers) * read(b, registers);
        next += 1;
    }
}

/// Squared moduli, then their products.
#[inline(always)]
fn squares<T: Scalar, L: List, const N: usize>(program: &L, registers: &[Complex<T>; N], norms: &mut [T; N]) {
    let mut next = 0;
    for &mode in program.norms() {
        norms[next % N] = registers[mode as usize % N].norm_sqr();
        next += 1;
    }
    for &[a, b] in program.norm_products() {
        norms[next % N] = norms[a as usize % N] * norms[b as usize % N];
        next += 1;
    }
}

/// The sum over the factors of a group: the real or the imaginary part. Only the first one may be a coefficient alone.
#[inline(always)]
fn factor<T: Scalar, L: List, const N: usize, const PART: usize>(
    program: &L,
    group: &Group,
    coefficients: &[[T::Real; 2]],
    zero: T,
    norms: &[T; N],
) -> T {
    let mut sum = zero;
    for place in group.factors.clone() {
        let coefficient = coefficients[place][PART];
        sum = match program.norm(place) {
            None => zero.lift(coefficient),
            Some(norm) => sum.add_scaled(norms[norm as usize % N], coefficient),
        };
    }
    sum
}

/// The value of an operand.
#[inline(always)]
fn read<T: Scalar, const N: usize>(operand: Operand, registers: &[Complex<T>; N]) -> Complex<T> {
    let z = registers[operand.register as usize % N];
    if operand.conj { z.conj() } else { z }
}
