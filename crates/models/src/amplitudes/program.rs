//! Polynomials as a list of products that is evaluated over any scalar.
//!
//! Each equation is a sum over products of amplitudes, each times a sum over products of squared moduli:
//! `sum_b b (c_b + sum_k c_bk N_k)`. A product that occurs several times is computed once.

use super::coefficient::{Kind, Place, Tape, Value};
use super::polynomial::{Monomial, Polynomial};
use motiform_dynamics::{Complex, Scalar};
use std::collections::BTreeMap;

/// An amplitude or a product: its register, and whether the conjugate is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Operand {
    register: u16,
    conj: bool,
}

/// A factor of a base: a coefficient, times a product of squared moduli if there is one.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Factor {
    norm: Option<u16>,
    place: Place,
}

/// A base with its factors.
#[derive(Clone, Debug, PartialEq)]
struct Group {
    base: Option<Operand>,
    complex: bool,
    factors: std::ops::Range<usize>,
}

/// Several polynomials, ready to be evaluated.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Program {
    /// Register `modes + k` is the product of these two.
    products: Vec<[Operand; 2]>,
    /// The amplitudes whose squared moduli are the first real registers.
    norms: Vec<u16>,
    /// The next real registers are products of earlier ones.
    norm_products: Vec<[u16; 2]>,
    factors: Vec<Factor>,
    groups: Vec<Group>,
    /// The groups of each polynomial.
    sums: Vec<std::ops::Range<usize>>,
}

/// Number of registers of each kind that are available.
pub(super) const REGISTERS: usize = 256;

impl Program {
    /// The program of these polynomials in `modes` amplitudes; `None` if it needs too many registers.
    pub(super) fn new(polynomials: &[Polynomial], modes: usize, tape: &Tape) -> Option<Self> {
        let mut builder = Builder { modes, ..Builder::default() };
        for (_, moduli) in polynomials.iter().flat_map(|polynomial| polynomial.0.keys().map(parts)) {
            moduli.into_iter().for_each(|mode| _ = builder.norm_of(mode));
        }
        let mut sums = Vec::new();
        for polynomial in polynomials {
            let first = builder.groups.len();
            builder.sum(polynomial, tape);
            sums.push(first..builder.groups.len());
        }
        let Builder { products, norms, norm_products, factors, groups, .. } = builder;
        let fits = products.len() <= REGISTERS && norms.len() + norm_products.len() <= REGISTERS;
        fits.then_some(Self { products, norms, norm_products, factors, groups, sums })
    }

    /// The coefficient of each factor, of all values of a tape.
    pub(super) fn coefficients(&self, values: &[Value]) -> Box<[Value]> {
        self.factors.iter().map(|factor| values[factor.place as usize]).collect()
    }

    /// The factors whose coefficient multiplies amplitude `register` alone in polynomial `sum`.
    pub(super) fn linear(&self, sum: usize, register: u16) -> impl Iterator<Item = usize> + '_ {
        let own = Some(Operand { register, conj: false });
        let groups = self.groups[self.sums[sum].clone()].iter().filter(move |group| group.base == own);
        groups.flat_map(|group| group.factors.clone()).filter(|&factor| self.factors[factor].norm.is_none())
    }

    /// Evaluates all polynomials at the amplitudes `u` (real and imaginary parts in turn).
    #[inline(always)]
    pub(super) fn eval<T: Scalar>(&self, coefficients: &[[T::Real; 2]], u: &[T], du: &mut [T]) {
        let needed = self.products.len().max(self.norms.len() + self.norm_products.len());
        match needed {
            ..=8 => self.eval_in::<T, 8>(coefficients, u, du),
            9..=32 => self.eval_in::<T, 32>(coefficients, u, du),
            _ => self.eval_in::<T, REGISTERS>(coefficients, u, du),
        }
    }

    #[inline(always)]
    fn eval_in<T: Scalar, const N: usize>(&self, coefficients: &[[T::Real; 2]], u: &[T], du: &mut [T]) {
        let Some(&some) = u.first() else { return };
        let zero = some.zero();
        let mut products = [Complex::new(zero, zero); N];
        let mut norms = [zero; N];
        for (k, &[a, b]) in self.products.iter().enumerate() {
            products[k] = read(a, u, &products) * read(b, u, &products);
        }
        for (k, &mode) in self.norms.iter().enumerate() {
            norms[k] = Complex::new(u[2 * mode as usize], u[2 * mode as usize + 1]).norm_sqr();
        }
        for (k, &[a, b]) in self.norm_products.iter().enumerate() {
            norms[self.norms.len() + k] = norms[a as usize] * norms[b as usize];
        }
        for (sum, rate) in self.sums.iter().zip(du.chunks_exact_mut(2)) {
            let mut total = Complex::new(zero, zero);
            for group in &self.groups[sum.clone()] {
                let factor = self.factor(group, coefficients, zero, &norms);
                total = match group.base {
                    None => total + factor,
                    Some(base) if group.complex => total.add_product(read(base, u, &products), factor),
                    Some(base) => {
                        let z = read(base, u, &products);
                        Complex::new(z.re.mul_add(factor.re, total.re), z.im.mul_add(factor.re, total.im))
                    }
                };
            }
            (rate[0], rate[1]) = (total.re, total.im);
        }
    }

    /// The sum over the factors of a group.
    #[inline(always)]
    fn factor<T: Scalar>(
        &self,
        group: &Group,
        coefficients: &[[T::Real; 2]],
        zero: T,
        norms: &[T],
    ) -> Complex<T> {
        let mut sum = Complex::new(zero, zero);
        for (factor, &[re, im]) in
            self.factors[group.factors.clone()].iter().zip(&coefficients[group.factors.clone()])
        {
            match factor.norm {
                None => sum.re += zero.lift(re),
                Some(norm) => sum.re = sum.re.add_scaled(norms[norm as usize], re),
            }
            if group.complex {
                match factor.norm {
                    None => sum.im += zero.lift(im),
                    Some(norm) => sum.im = sum.im.add_scaled(norms[norm as usize], im),
                }
            }
        }
        sum
    }
}

/// The value of an operand.
#[inline(always)]
fn read<T: Scalar>(operand: Operand, u: &[T], products: &[Complex<T>]) -> Complex<T> {
    let (register, modes) = (operand.register as usize, u.len() / 2);
    let z = if register < modes {
        Complex::new(u[2 * register], u[2 * register + 1])
    } else {
        products[register - modes]
    };
    if operand.conj { z.conj() } else { z }
}

/// What is known while a program is made.
#[derive(Default)]
struct Builder {
    modes: usize,
    products: Vec<[Operand; 2]>,
    known: BTreeMap<Vec<u16>, Operand>,
    norms: Vec<u16>,
    norm_products: Vec<[u16; 2]>,
    known_norms: BTreeMap<Vec<u16>, u16>,
    factors: Vec<Factor>,
    groups: Vec<Group>,
}

impl Builder {
    /// The groups of one polynomial.
    fn sum(&mut self, polynomial: &Polynomial, tape: &Tape) {
        let mut groups: BTreeMap<Vec<u16>, Vec<(Vec<u16>, Place)>> = BTreeMap::new();
        for (monomial, &place) in &polynomial.0 {
            let (base, moduli) = parts(monomial);
            groups.entry(base).or_default().push((moduli, place));
        }
        for (base, parts) in groups {
            let base = (!base.is_empty()).then(|| self.base(&base));
            let first = self.factors.len();
            let complex = parts.iter().any(|&(_, place)| tape.kind(place) != Kind::Real);
            for (moduli, place) in parts {
                let norm = (!moduli.is_empty()).then(|| self.norm(&moduli));
                self.factors.push(Factor { norm, place });
            }
            self.groups.push(Group { base, complex, factors: first..self.factors.len() });
        }
    }

    /// The operand that is the product of these factors (see [`parts`]).
    fn base(&mut self, factors: &[u16]) -> Operand {
        if let &[only] = factors {
            return Operand { register: only / 2, conj: only % 2 == 1 };
        }
        if let Some(&known) = self.known.get(factors) {
            return known;
        }
        let conj: Vec<u16> = factors.iter().map(|factor| factor ^ 1).collect();
        if let Some(&known) = self.known.get(&conj) {
            return Operand { conj: !known.conj, ..known };
        }
        let (last, rest) = (factors.len() - 1, &factors[..factors.len() - 1]);
        let pair = [self.base(rest), self.base(&factors[last..])];
        self.products.push(pair);
        let register = (self.modes + self.products.len() - 1) as u16;
        let operand = Operand { register, conj: false };
        self.known.insert(factors.to_vec(), operand);
        operand
    }

    fn norm_of(&mut self, mode: u16) -> u16 {
        let known = self.norms.iter().position(|&known| known == mode);
        known.unwrap_or_else(|| {
            self.norms.push(mode);
            self.norms.len() - 1
        }) as u16
    }

    /// The real register that is the product of these squared moduli, all of which have registers.
    fn norm(&mut self, moduli: &[u16]) -> u16 {
        if let &[only] = moduli {
            return self.norm_of(only);
        }
        if let Some(&known) = self.known_norms.get(moduli) {
            return known;
        }
        let (last, rest) = (moduli.len() - 1, &moduli[..moduli.len() - 1]);
        let pair = [self.norm(rest), self.norm(&moduli[last..])];
        self.norm_products.push(pair);
        let register = (self.norms.len() + self.norm_products.len() - 1) as u16;
        self.known_norms.insert(moduli.to_vec(), register);
        register
    }
}

/// A monomial as its factors that are left (`2 k` for amplitude k, `2 k + 1` for its conjugate) and its squared moduli.
fn parts(monomial: &Monomial) -> (Vec<u16>, Vec<u16>) {
    let (mut base, mut moduli) = (Vec::new(), Vec::new());
    for (mode, &[z, conj]) in (0_u16..).zip(&monomial.0) {
        let pairs = z.min(conj);
        moduli.extend((0..pairs).map(|_| mode));
        base.extend((pairs..z).map(|_| 2 * mode));
        base.extend((pairs..conj).map(|_| 2 * mode + 1));
    }
    (base, moduli)
}
