//! All possible couplings, those of the equations, and their coefficients.

use super::super::claims::claim;
use super::super::context::Context;
use super::fields::{C, Monomial, Z, apart, parameters, rates, state, turned};
use motiform_analysis::linear;
use motiform_figures::report::Claim;
use motiform_models::tensor::TensorParameters;
use motiform_study::Error;
use motiform_study::initial::Uniform;

/// Random states of a fit, and sets of random coefficients.
const STATES: usize = 160;
const SETS: u64 = 3;

/// The size of an absent coefficient due to round-off: the condition of the fit is about 1e3.
const NOTHING: f64 = 1e-9;

pub(super) fn claims(context: &Context<'_>) -> Result<Vec<Claim>, Error> {
    let mut fits =
        context.kept.once("fits of all monomials", || Ok((0..SETS).map(Fit::new).collect::<Vec<_>>()))?;
    let coefficients = fits.iter_mut().flat_map(|fit| fit.coefficients.iter_mut().flatten());
    coefficients.for_each(|c| c.re = context.number(c.re));
    Ok(vec![possible(&fits), reduced(&fits), table(&fits)])
}

/// The rates of z1, z2, z3, computed with indices, as sums of all monomials of degree 1 to 3.
#[derive(Clone)]
struct Fit {
    parameters: TensorParameters,
    monomials: Vec<Monomial>,
    /// For each amplitude the complex coefficient of each monomial.
    coefficients: [Vec<C>; 3],
    /// The residual of the rates.
    left: f64,
}

impl Fit {
    fn new(seed: u64) -> Self {
        let (parameters, monomials) = (parameters(seed), Monomial::all());
        let mut random = Uniform::new(seed, 0);
        let states: Vec<Z> = (0..STATES).map(|_| state(&mut random)).collect();
        let both = |z: C| [z.re, z.im];
        let column = |factor: C| {
            let states = &states;
            move |m: &Monomial| states.iter().flat_map(|z| both(m.value(*z) * factor)).collect::<Vec<f64>>()
        };
        let mut columns: Vec<Vec<f64>> = monomials.iter().map(column(C::new(1.0, 0.0))).collect();
        columns.extend(monomials.iter().map(column(C::new(0.0, 1.0))));
        let mut left: f64 = 0.0;
        let coefficients = std::array::from_fn(|n| {
            let right: Vec<f64> = states.iter().flat_map(|z| both(rates(&parameters, *z)[n])).collect();
            let x = linear::least_squares(&columns, &right).unwrap_or_else(|| vec![f64::NAN; columns.len()]);
            let explained =
                |row: usize| columns.iter().zip(&x).map(|(column, x)| column[row] * x).sum::<f64>();
            left = right
                .iter()
                .enumerate()
                .map(|(row, rate)| (rate - explained(row)).abs())
                .fold(left, f64::max);
            let (real, imaginary) = x.split_at(monomials.len());
            real.iter().zip(imaginary).map(|(re, im)| C::new(*re, *im)).collect()
        });
        Self { parameters, monomials, coefficients, left }
    }

    /// The monomials in the rate of an amplitude.
    fn present(&self, n: usize) -> Vec<Monomial> {
        let there = |entry: &(&Monomial, &C)| libm::hypot(entry.1.re, entry.1.im) > NOTHING;
        self.monomials.iter().zip(&self.coefficients[n]).filter(there).map(|entry| *entry.0).collect()
    }

    fn coefficient(&self, n: usize, powers: [u8; 6]) -> C {
        let place = self.monomials.iter().position(|m| m.0 == powers);
        place.map_or(C::new(f64::NAN, f64::NAN), |place| self.coefficients[n][place])
    }
}

/// The monomials that turn with amplitude `n` (0 to 2) and go over into their conjugates in the mirror: by numbers.
fn allowed(n: usize) -> Vec<Monomial> {
    let mut random = Uniform::new(11, 0);
    let (z, angle) = (state(&mut random), 1.0 + random.draw().abs());
    let phase = turned([C::new(1.0, 0.0); 3], angle)[n];
    let mirror: Z = z.map(C::conj);
    let keeps = |m: &Monomial| {
        apart(m.value(turned(z, angle)), m.value(z) * phase) < 1e-12
            && apart(m.value(mirror), m.value(z).conj()) < 1e-12
    };
    Monomial::all().into_iter().filter(keeps).collect()
}

fn possible(fits: &[Fit]) -> Claim {
    let lists = [0, 1, 2].map(allowed);
    let count: usize = lists.iter().map(Vec::len).sum();
    let same = fits.iter().all(|fit| (0..3).all(|n| fit.present(n) == lists[n]));
    let left = fits.iter().map(|fit| fit.left).fold(0.0, f64::max);
    let words = |n: usize| lists[n].iter().map(|m| m.words()).collect::<Vec<_>>().join(", ");
    claim(
        &[36, 37],
        "The equations of *v*, *S* and *U* are derived by considering the possible couplings, up to the third order of these variables.",
        format!(
            "of {} monomials of degree 1 to 3 rotations and the mirror allow {count}, and the equations \
            hold {}: in the rate of *z*_1 {}; of *z*_2 {}; of *z*_3 {}. With 21 parameters and the fixed \
            −*v*^2*v* nothing is missing",
            3 * Monomial::all().len(),
            if same { "exactly these" } else { "others" },
            words(0),
            words(1),
            words(2),
        ),
        "all monomials in *z*_n and their conjugates, turned and mirrored by numbers; the equations with indices, at 160 random states and \
         three sets of random coefficients, fitted by all of them: coefficients above 10^{-9}, nothing left over",
        same && left < 1e-10 && count == 22,
    )
}

/// Without the triangle: the normal form of Armbruster, Guckenheimer and Holmes.
fn reduced(fits: &[Fit]) -> Claim {
    let planar = |n: usize| {
        let keep =
            |list: Vec<Monomial>| list.into_iter().filter(|m| m.is_planar()).map(|m| m.0).collect::<Vec<_>>();
        fits.iter().map(|fit| keep(fit.present(n))).collect::<Vec<_>>()
    };
    // their eq.: z1' = z1 (mu1 + e11|z1|^2 + e12|z2|^2) + conj(z1) z2, z2' = z2 (mu2 + e21|z1|^2 + e22|z2|^2) +- z1^2
    let first = [[0, 1, 1, 0, 0, 0], [1, 0, 0, 0, 0, 0], [1, 0, 1, 1, 0, 0], [2, 1, 0, 0, 0, 0]];
    let second = [[0, 0, 1, 0, 0, 0], [0, 0, 2, 1, 0, 0], [1, 1, 1, 0, 0, 0], [2, 0, 0, 0, 0, 0]];
    let sorted = |mut list: Vec<[u8; 6]>| {
        list.sort_unstable();
        list
    };
    let same = |n: usize, theirs: &[[u8; 6]]| planar(n).into_iter().all(|list| sorted(list) == theirs);
    let holds = same(0, &first) && same(1, &second);
    claim(
        &[168],
        "When *z*_3 is omitted, the equations are the same as those considered by Armbruster et al.",
        if holds {
            "the rate of *z*_1 holds *z*_1, |*z*_1|^2*z*_1, |*z*_2|^2*z*_1, *z̄*_1*z*_2, that of *z*_2 holds *z*_2, |*z*_1|^2*z*_2, \
             |*z*_2|^2*z*_2, *z*_1^2: their normal form, all real"
        } else {
            "other terms are left"
        },
        "the terms of the fit above that are free of *z*_3, against those of the normal form of modes 1 and 2 with O(2) symmetry",
        holds,
    )
}

/// The printed table compared with the coefficients of the fit.
fn table(fits: &[Fit]) -> Claim {
    type Row = (&'static str, usize, [u8; 6], fn(&TensorParameters) -> f64);
    let rows: [Row; 18] = [
        ("d11", 0, [2, 1, 0, 0, 0, 0], |_| -1.0),
        ("d12", 0, [1, 0, 1, 1, 0, 0], |p| -8.0 * p.a4),
        ("d13", 0, [1, 0, 0, 0, 1, 1], |p| -16.0 * p.a5),
        ("d21", 1, [1, 1, 1, 0, 0, 0], |p| -p.b4),
        ("d22", 1, [0, 0, 2, 1, 0, 0], |p| -8.0 * p.b3),
        ("d23", 1, [0, 0, 1, 0, 1, 1], |p| -16.0 * p.b5),
        ("d31", 2, [1, 1, 0, 0, 1, 0], |p| -p.d4),
        ("d32", 2, [0, 0, 1, 1, 1, 0], |p| -8.0 * p.d5),
        ("d33", 2, [0, 0, 0, 0, 2, 1], |p| -16.0 * p.d3),
        ("e11", 0, [0, 1, 1, 0, 0, 0], |p| -2.0 * p.a1),
        ("e12", 0, [0, 2, 0, 0, 1, 0], |p| -2.0 * p.a2),
        ("e13", 0, [0, 0, 0, 1, 1, 0], |p| -8.0 * p.a3),
        ("e14", 0, [0, 0, 2, 0, 0, 1], |p| 16.0 * p.a6),
        ("e21", 1, [2, 0, 0, 0, 0, 0], |p| p.b1 / 4.0),
        ("e22", 1, [0, 1, 0, 0, 1, 0], |p| p.b2),
        ("e23", 1, [1, 0, 0, 1, 1, 0], |p| 2.0 * p.b6),
        ("e31", 2, [3, 0, 0, 0, 0, 0], |p| p.d1 / 8.0),
        ("e32", 2, [1, 0, 1, 0, 0, 0], |p| p.d2 / 2.0),
    ];
    let last: Row = ("e33", 2, [0, 1, 2, 0, 0, 0], |p| 2.0 * p.d6);
    let off = |fit: &Fit| {
        let row = |(_, n, powers, value): &Row| {
            apart(fit.coefficient(*n, *powers), C::new(value(&fit.parameters), 0.0))
        };
        rows.iter().chain([&last]).map(row).fold(0.0, f64::max)
    };
    let imaginary = |fit: &Fit| fit.coefficients.iter().flatten().map(|c| c.im.abs()).fold(0.0, f64::max);
    let (worst, unreal) =
        (fits.iter().map(off).fold(0.0, f64::max), fits.iter().map(imaginary).fold(0.0, f64::max));
    claim(
        &[159, 160, 161, 162],
        "In Fourier components the equations are (Z1), (Z2), (Z3); all the coefficients are real and are given by the table.",
        format!(
            "all 19 coefficients of the table agree to {worst:.0e}; imaginary parts are below {unreal:.0e}, \
            and no other term is there (see above)"
        ),
        "coefficients of the fit above, which knows only the equations with indices, against the printed table, for three sets of random \
         parameters; to 10^{-9}",
        worst < NOTHING && unreal < NOTHING,
    )
}
