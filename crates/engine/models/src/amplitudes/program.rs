//! Polynomials as a list of products (evaluated in `evaluation`).
//!
//! Each equation is a sum over products of amplitudes, each times a sum over products of squared moduli:
//! `sum_b b (c_b + sum_k c_bk N_k)`. A product that occurs several times is computed once. Where that is shorter the products are those of
//! the real and imaginary parts of the amplitudes ([`super::real_parts`]).

use super::coefficient::{Kind, Place, Tape, Value};
use super::paper::Paper;
use super::polynomial::{Monomial, Polynomial};
use super::real_parts::{Combination, RealTerms, value};
use std::collections::BTreeMap;
use std::ops::Range;

/// An amplitude or a product: its register, and whether the conjugate is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Operand {
    pub(super) register: u16,
    pub(super) conj: bool,
}

/// A factor of a base: a coefficient, times a product of squared moduli if there is one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Factor {
    pub(super) norm: Option<u16>,
    place: Place,
}

/// A base with its factors.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Group {
    pub(super) base: Operand,
    pub(super) factors: Range<usize>,
}

/// The groups of a polynomial.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sum {
    /// Those whose only factor is a real coefficient.
    pub(super) plain: Range<usize>,
    /// Those with other real factors.
    pub(super) real: Range<usize>,
    /// Those with complex factors.
    pub(super) complex: Range<usize>,
}

/// A list of products as the evaluation reads it: one that is made when the program runs, or one that is known when it is compiled.
pub(super) trait List {
    /// Numbers of coefficients, unknowns and rates, which are `given`: lengths that are known when the
    /// program is compiled take loops apart.
    fn lengths(&self, given: [usize; 3]) -> [usize; 3];
    /// [`Program::one`].
    fn one(&self) -> bool;
    /// `true` if the first registers are the real and imaginary parts of the amplitudes.
    fn parts(&self) -> bool;
    /// [`Program::products`].
    fn products(&self) -> &[[Operand; 2]];
    /// [`Program::norms`].
    fn norms(&self) -> &[u16];
    /// [`Program::norm_products`].
    fn norm_products(&self) -> &[[u16; 2]];
    /// [`Factor::norm`] of each of [`Program::factors`].
    fn norm(&self, factor: usize) -> Option<u16>;
    /// [`Program::groups`].
    fn groups(&self) -> &[Group];
    /// [`Program::sums`].
    fn sums(&self) -> &[Sum];
}

impl List for Program {
    #[inline(always)]
    fn lengths(&self, given: [usize; 3]) -> [usize; 3] {
        given
    }

    #[inline(always)]
    fn one(&self) -> bool {
        self.one
    }

    #[inline(always)]
    fn parts(&self) -> bool {
        !self.combined.is_empty()
    }

    #[inline(always)]
    fn products(&self) -> &[[Operand; 2]] {
        &self.products
    }

    #[inline(always)]
    fn norms(&self) -> &[u16] {
        &self.norms
    }

    #[inline(always)]
    fn norm_products(&self) -> &[[u16; 2]] {
        &self.norm_products
    }

    #[inline(always)]
    fn norm(&self, factor: usize) -> Option<u16> {
        self.factors[factor].norm
    }

    #[inline(always)]
    fn groups(&self) -> &[Group] {
        &self.groups
    }

    #[inline(always)]
    fn sums(&self) -> &[Sum] {
        &self.sums
    }
}

/// Several polynomials, ready to be evaluated.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Program {
    /// `true` if register `modes` is 1: some polynomial has a term without amplitudes. (A register less may
    /// be a smaller form of the evaluation.)
    pub(super) one: bool,
    /// The next registers are products of these two.
    pub(super) products: Vec<[Operand; 2]>,
    /// The amplitudes whose squared moduli are the first real registers.
    pub(super) norms: Vec<u16>,
    /// The next real registers are products of earlier ones.
    pub(super) norm_products: Vec<[u16; 2]>,
    pub(super) factors: Vec<Factor>,
    pub(super) groups: Vec<Group>,
    pub(super) sums: Vec<Sum>,
    /// In real and imaginary parts: the coefficients, which are combinations of those of the polynomials. Empty in amplitudes.
    pub(super) combined: Vec<Combination>,
    /// `true` if it is the list of [`Paper`].
    pub(super) paper: bool,
}

/// Number of registers of each kind that are available.
pub(super) const REGISTERS: usize = 256;

impl Program {
    /// The program of these polynomials in `modes` amplitudes; `None` if it needs too many registers.
    pub(super) fn new(polynomials: &[Polynomial], modes: usize, tape: &Tape) -> Option<Self> {
        let mut keys = polynomials.iter().flat_map(|polynomial| polynomial.0.keys());
        let one = keys.any(|key| parts(key).0.is_empty());
        let mut builder = Builder { modes, first: modes + usize::from(one), ..Builder::default() };
        for (_, moduli) in polynomials.iter().flat_map(|polynomial| polynomial.0.keys().map(parts)) {
            moduli.into_iter().for_each(|mode| _ = builder.norm_of(mode));
        }
        let mut sums = Vec::new();
        for polynomial in polynomials {
            sums.push(builder.sum(polynomial, tape));
        }
        let mut program = builder.finish(one, sums, Vec::new())?;
        program.paper = modes == 3 && Paper::is(&program);
        Some(program)
    }

    /// The program of polynomials in the real and imaginary parts of `modes` amplitudes; `None` if it needs too many registers.
    pub(super) fn of_parts(polynomials: &[RealTerms], modes: usize) -> Option<Self> {
        let one =
            polynomials.iter().flat_map(BTreeMap::keys).any(|powers| powers.iter().all(|power| *power == 0));
        let mut builder =
            Builder { modes: 2 * modes, first: 2 * modes + usize::from(one), ..Builder::default() };
        let (mut sums, mut combined) = (Vec::new(), Vec::new());
        for polynomial in polynomials {
            let first = builder.groups.len();
            for (powers, combination) in polynomial {
                let part = |(part, &power): (usize, &u8)| (0..power).map(move |_| 2 * part as u16);
                let base: Vec<u16> = powers.iter().enumerate().flat_map(part).collect();
                builder.group(&base, vec![(Vec::new(), combined.len() as Place)]);
                combined.push(combination.clone());
            }
            let end = builder.groups.len();
            sums.push(Sum { plain: first..first, real: first..first, complex: first..end });
        }
        builder.finish(one, sums, combined)
    }

    /// The coefficient of each factor, of all values of a tape.
    pub(super) fn coefficients(&self, values: &[Value]) -> Box<[Value]> {
        let of =
            |place: usize| self.combined.get(place).map_or_else(|| values[place], |sum| value(sum, values));
        self.factors.iter().map(|factor| of(factor.place as usize)).collect()
    }

    /// Takes the real linear rates of the unknowns of amplitude `n` out of the coefficients of polynomial `n`.
    pub(super) fn take_linear(&self, n: usize, coefficients: &mut [Value]) -> [f64; 2] {
        let mut take = |register: usize, part: usize| {
            let own = self.linear(n, register as u16);
            own.map(|place| std::mem::take(&mut coefficients[place][part])).sum()
        };
        if self.parts() {
            return [take(2 * n, 0), take(2 * n + 1, 1)];
        }
        [take(n, 0); 2]
    }

    /// The factors whose coefficient multiplies `register` alone in polynomial `sum`.
    fn linear(&self, sum: usize, register: u16) -> impl Iterator<Item = usize> + '_ {
        let own = Operand { register, conj: false };
        let all = self.sums[sum].plain.start..self.sums[sum].complex.end;
        let groups = self.groups[all].iter().filter(move |group| group.base == own);
        groups.flat_map(|group| group.factors.clone()).filter(|&factor| self.factors[factor].norm.is_none())
    }

    /// The factors of a polynomial.
    pub(super) fn places(&self, sum: usize) -> Range<usize> {
        let groups = &self.groups[self.sums[sum].plain.start..self.sums[sum].complex.end];
        let first = groups.first().map_or(0, |group| group.factors.start);
        first..groups.last().map_or(first, |group| group.factors.end)
    }

    /// Registers of the kind of which most are needed.
    #[inline(always)]
    pub(super) fn registers(&self, modes: usize) -> usize {
        let first = if self.parts() { 2 * modes } else { modes };
        (first + usize::from(self.one) + self.products.len()).max(self.norms.len() + self.norm_products.len())
    }
}

/// The state of a program under construction.
#[derive(Default)]
struct Builder {
    modes: usize,
    /// The register of the first product.
    first: usize,
    products: Vec<[Operand; 2]>,
    known: BTreeMap<Vec<u16>, Operand>,
    norms: Vec<u16>,
    norm_products: Vec<[u16; 2]>,
    known_norms: BTreeMap<Vec<u16>, u16>,
    factors: Vec<Factor>,
    groups: Vec<Group>,
}

impl Builder {
    /// The program of these sums; `None` if it needs too many registers.
    fn finish(self, one: bool, sums: Vec<Sum>, combined: Vec<Combination>) -> Option<Program> {
        let Self { products, norms, norm_products, factors, groups, .. } = self;
        let fits = products.len() <= REGISTERS && norms.len() + norm_products.len() <= REGISTERS;
        let program =
            Program { one, products, norms, norm_products, factors, groups, sums, combined, paper: false };
        fits.then_some(program)
    }

    /// The groups of one polynomial.
    fn sum(&mut self, polynomial: &Polynomial, tape: &Tape) -> Sum {
        let mut groups: BTreeMap<Vec<u16>, Vec<(Vec<u16>, Place)>> = BTreeMap::new();
        for (monomial, &place) in &polynomial.0 {
            let (base, moduli) = parts(monomial);
            groups.entry(base).or_default().push((moduli, place));
        }
        let mut kinds = [const { Vec::new() }; 3];
        for (base, mut parts) in groups {
            parts.sort(); // a coefficient alone comes first
            let complex = parts.iter().any(|&(_, place)| tape.kind(place) != Kind::Real);
            let plain = parts.len() == 1 && parts[0].0.is_empty();
            kinds[if complex { 2 } else { usize::from(!plain) }].push((base, parts));
        }
        let [plain, real, complex] = kinds.map(|groups| {
            let first = self.groups.len();
            groups.into_iter().for_each(|(base, parts)| self.group(&base, parts));
            first..self.groups.len()
        });
        Sum { plain, real, complex }
    }

    fn group(&mut self, base: &[u16], parts: Vec<(Vec<u16>, Place)>) {
        let base = self.base(base);
        let first = self.factors.len();
        for (moduli, place) in parts {
            let norm = (!moduli.is_empty()).then(|| self.norm(&moduli));
            self.factors.push(Factor { norm, place });
        }
        self.groups.push(Group { base, factors: first..self.factors.len() });
    }

    /// The operand that is the product of these factors (see [`parts`]).
    fn base(&mut self, factors: &[u16]) -> Operand {
        if factors.is_empty() {
            return Operand { register: self.modes as u16, conj: false };
        }
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
        let register = (self.first + self.products.len()) as u16;
        self.products.push(pair);
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
