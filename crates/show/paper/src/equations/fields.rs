//! The tensor model as a map of the Fourier amplitudes, computed with indices; and monomials of these amplitudes.

use motiform_models::Parameters as _;
use motiform_models::tensor::TensorParameters;
use motiform_models::tensor::indices::{Tensors, rate};
use motiform_study::initial::Uniform;

/// A complex number.
pub(super) type C = motiform_dynamics::Complex<f64>;

/// The amplitudes z1, z2, z3.
pub(super) type Z = [C; 3];

/// `z1 = v1 - i v2`, `z2 = (S11 - i S12)/2`, `z3 = (U111 + i U222)/2`.
pub(super) fn amplitudes(tensors: &Tensors) -> Z {
    let [v1, v2, s11, s12, u111, u222] = tensors.components();
    [C::new(v1, -v2), C::new(0.5 * s11, -0.5 * s12), C::new(0.5 * u111, 0.5 * u222)]
}

/// The inverse.
pub(super) fn tensors([z1, z2, z3]: Z) -> Tensors {
    Tensors::from_components([z1.re, -z1.im, 2.0 * z2.re, -2.0 * z2.im, 2.0 * z3.re, 2.0 * z3.im])
}

/// Rates of the amplitudes by the equations with indices.
pub(super) fn rates(parameters: &TensorParameters, z: Z) -> Z {
    amplitudes(&rate(parameters, &tensors(z)))
}

/// `z_n -> exp(i n angle) z_n`.
pub(super) fn turned(z: Z, angle: f64) -> Z {
    let phase = |n: f64| {
        let (sin, cos) = libm::sincos(n * angle);
        C::new(cos, sin)
    };
    [z[0] * phase(1.0), z[1] * phase(2.0), z[2] * phase(3.0)]
}

/// A random state, each part in -1..1.
pub(super) fn state(random: &mut Uniform) -> Z {
    std::array::from_fn(|_| C::new(random.draw(), random.draw()))
}

/// All 21 parameters, uniform in 0..1.
pub(super) fn parameters(seed: u64) -> TensorParameters {
    let mut random = Uniform::new(seed, 1);
    let mut parameters = TensorParameters::default();
    for spec in TensorParameters::specs() {
        // a name from the registry is never refused, nor is a value within 0..1
        let _ = parameters.set(spec.name, random.draw().abs());
    }
    parameters
}

/// `|a - b|`.
pub(super) fn apart(a: C, b: C) -> f64 {
    libm::hypot(a.re - b.re, a.im - b.im)
}

/// Powers of z1, conj z1, z2, conj z2, z3, conj z3.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Monomial(pub(super) [u8; 6]);

impl Monomial {
    /// All of degree 1 to 3: 83.
    pub(super) fn all() -> Vec<Self> {
        let powers = |rest: &[u8; 5]| rest.iter().sum::<u8>() <= 3;
        let mut all = Vec::new();
        for code in 0..4_u32.pow(6) {
            let digit = |place: u32| (code / 4_u32.pow(place) % 4) as u8;
            let exponents: [u8; 6] = std::array::from_fn(|i| digit(5 - i as u32));
            let [first, rest @ ..] = exponents;
            let degree = first + rest.iter().sum::<u8>();
            if powers(&rest) && (1..=3).contains(&degree) {
                all.push(Self(exponents));
            }
        }
        all
    }

    pub(super) fn value(self, z: Z) -> C {
        let factors = [z[0], z[0].conj(), z[1], z[1].conj(), z[2], z[2].conj()];
        let mut product = C::new(1.0, 0.0);
        for (factor, power) in factors.into_iter().zip(self.0) {
            for _ in 0..power {
                product = product * factor;
            }
        }
        product
    }

    /// Without the triangle.
    pub(super) fn is_planar(self) -> bool {
        self.0[4] == 0 && self.0[5] == 0
    }

    /// In usual notation.
    pub(super) fn words(self) -> String {
        let names = ["*z*_1", "*z̄*_1", "*z*_2", "*z̄*_2", "*z*_3", "*z̄*_3"];
        let factor = |(name, power): (&str, u8)| match power {
            0 => String::new(),
            1 => name.to_owned(),
            power => format!("{name}^{power}"),
        };
        names.into_iter().zip(self.0).map(factor).collect()
    }
}
