//! Equations as text: random ones that are covariant and bounded, and the paper's.

use super::subjects::Subject;

/// A term `c w`, with w a product of amplitudes written out.
#[derive(Clone, Debug)]
struct Term {
    factor: f64,
    imaginary: f64,
    /// Number of amplitudes.
    order: i32,
    word: String,
}

/// A system of amplitude equations.
#[derive(Clone, Debug)]
pub(crate) struct Text {
    /// Modes with the terms of their equations.
    equations: Vec<(u32, Vec<Term>)>,
    /// `true` if left and right differ: the coefficients are then complex.
    pub(crate) handed: bool,
}

/// Numbers in -1..1 (splitmix64).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// The amplitude of index n, conjugated for a negative one.
fn amplitude(n: i64) -> String {
    if n < 0 { format!("conj(z{})", -n) } else { format!("z{n}") }
}

impl Text {
    /// The number of modes of the system of this seed.
    pub(crate) fn modes(seed: u64) -> u32 {
        2 + u32::try_from(seed % 7).expect("it is small")
    }

    /// `z_n' = mu_n z_n + sum c z_p z_q - z_n (|z_n|^2 + b sum |z_m|^2)` with all quadratic terms that rotations allow; real but in every
    /// third system. The cubic terms keep every orbit bounded.
    pub(crate) fn random(seed: u64) -> Self {
        let (count, mut random) = (i64::from(Self::modes(seed)), Random(1000 + seed));
        let handed = seed % 3 == 2;
        let mut equations = Vec::new();
        for n in 1..=count {
            let mu = if n == 1 { 0.6 + 0.4 * random.next() } else { 0.3 * random.next() - 0.2 };
            let frequency = if handed { 0.8 * random.next() } else { 0.0 };
            let mut terms = vec![Term { factor: mu, imaginary: frequency, order: 1, word: format!("z{n}") }];
            for p in -count..=count {
                let q = n - p;
                if p != 0 && q != 0 && q.abs() <= count && p <= q {
                    // opposite signs of z1* z2 and z1^2: energy goes back and forth between modes
                    let sign = if n == 1 && (p, q) == (-1, 2) { 1.0 } else { random.next().signum() };
                    let sign = if n == 2 && (p, q) == (1, 1) { -1.0 } else { sign };
                    let factor = sign * (0.5 + random.next().abs());
                    let imaginary = if handed { 0.5 * random.next() } else { 0.0 };
                    terms.push(Term {
                        factor,
                        imaginary,
                        order: 2,
                        word: format!("{}*{}", amplitude(p), amplitude(q)),
                    });
                }
            }
            for m in 1..=count {
                let factor = if m == n { -1.0 } else { -0.2 + 0.2 * random.next() };
                terms.push(Term { factor, imaginary: 0.0, order: 3, word: format!("|z{m}|^2*z{n}") });
            }
            equations.push((u32::try_from(n).expect("it is positive"), terms));
        }
        Self { equations, handed }
    }

    /// The tensor model at the parameters of a subject, in its Fourier form (the coefficients of the paper's terms that the subjects use).
    pub(crate) fn tensor(subject: &Subject) -> Self {
        let of = |name: &str| subject.parameter(name);
        let term = |factor: f64, order: i32, word: &str| Term {
            factor,
            imaginary: 0.0,
            order,
            word: word.to_owned(),
        };
        let equations = vec![
            (
                1,
                vec![
                    term(of("gamma"), 1, "z1"),
                    term(-1.0, 3, "|z1|^2*z1"),
                    term(-2.0 * of("a1"), 2, "conj(z1)*z2"),
                ],
            ),
            (
                2,
                vec![
                    term(-of("kappa2"), 1, "z2"),
                    term(0.25 * of("b1"), 2, "z1^2"),
                    term(of("b2"), 2, "conj(z1)*z3"),
                    term(-8.0 * of("b3"), 3, "|z2|^2*z2"),
                ],
            ),
            (
                3,
                vec![
                    term(-of("kappa3"), 1, "z3"),
                    term(0.125 * of("d1"), 3, "z1^3"),
                    term(0.5 * of("d2"), 2, "z1*z2"),
                ],
            ),
        ];
        Self { equations, handed: false }
    }

    /// With two modes more that act on nothing: one dies out, one is driven by the square of the last mode.
    pub(crate) fn with_silent_modes(&self) -> Self {
        let mut equations = self.equations.clone();
        let term = |factor: f64, order: i32, word: &str| Term {
            factor,
            imaginary: 0.0,
            order,
            word: word.to_owned(),
        };
        equations.push((17, vec![term(-0.7, 1, "z17"), term(-1.0, 3, "|z17|^2*z17")]));
        let last = equations.iter().map(|(n, _)| *n).filter(|n| *n < 17).max().expect("there is one");
        let driven = 2 * last;
        equations
            .push((driven, vec![term(-0.4, 1, &format!("z{driven}")), term(0.3, 2, &format!("z{last}^2"))]));
        equations.sort_by_key(|(n, _)| *n);
        Self { equations, handed: self.handed }
    }

    /// With a mode more that acts on nothing, of constant size `sqrt(.3)` and with a phase that nothing fixes: every motion is one of a
    /// family.
    pub(crate) fn with_free_phase(&self) -> Self {
        let mut equations = self.equations.clone();
        let term = |factor: f64, order: i32, word: &str| {
            let word = word.to_owned();
            Term { factor, imaginary: 0.0, order, word }
        };
        equations.push((19, vec![term(0.3, 1, "z19"), term(-1.0, 3, "|z19|^2*z19")]));
        Self { equations, handed: self.handed }
    }

    /// The study file, with a unit of time and of amplitudes.
    pub(crate) fn study(&self, time: f64, length: f64) -> String {
        let modes: Vec<String> = self.equations.iter().map(|(n, _)| n.to_string()).collect();
        let symmetry = if self.handed { "symmetry = \"rotation\"\n" } else { "" };
        let modes = modes.join(", ");
        let mut text =
            format!("[model.amplitudes]\nmodes = [{modes}]\n{symmetry}[model.amplitudes.equations]\n");
        for (n, terms) in &self.equations {
            let word = |term: &Term| {
                let unit = 1.0 / time / length.powi(term.order - 1);
                let (re, im) = (term.factor * unit, term.imaginary * unit);
                if self.handed {
                    format!("({re:?} + ({im:?})*i)*{}", term.word)
                } else {
                    format!("({re:?})*{}", term.word)
                }
            };
            text += &format!("z{n} = \"{}\"\n", terms.iter().map(word).collect::<Vec<_>>().join(" + "));
        }
        // the velocity is z1 in units of length per time: amplitudes are lengths here
        text
    }
}
