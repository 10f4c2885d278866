//! A fit as a model of the models crate.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_dynamics::{Complex, Normal, VectorField};
use motiform_inference::{Library, equations};
use motiform_models::amplitudes;
use motiform_models::tensor::{FourierField, TensorParameters};

/// The library's field, term by term, and the sum of the terms' sizes.
fn field(library: &Library, c: &[Complex<f64>], u: &[f64]) -> Vec<(Complex<f64>, f64)> {
    let mut rates = vec![(Complex::new(0.0, 0.0), 0.0); library.modes];
    for (term, c) in library.terms.iter().zip(c) {
        let mut product = *c;
        for (m, &[z, conj]) in term.powers.iter().enumerate().take(library.modes) {
            let amplitude = Complex::new(u[2 * m], u[2 * m + 1]);
            (0..z).for_each(|_| product = product * amplitude);
            (0..conj).for_each(|_| product = product * amplitude.conj());
        }
        let (rate, size) = &mut rates[term.equation];
        *rate += product;
        *size += libm::hypot(product.re, product.im);
    }
    rates
}

#[test]
fn the_models_field_is_the_librarys() {
    let mut normal = Normal::new(3, 0);
    for (modes, order, handed) in [(3, 3, false), (3, 3, true), (3, 5, true), (4, 3, false)] {
        let library = Library::new(modes, order).unwrap();
        let n = library.terms.len();
        let values: Vec<f64> = (0..if handed { 2 * n } else { n }).map(|_| normal.next()).collect();
        let definition = equations(&library, handed, &values);
        if definition.parameters.len() > 200 {
            continue;
        }
        let model = amplitudes::info(&definition).unwrap();
        let defaults: Vec<f64> = definition.parameters.iter().map(|p| p.default).collect();
        let body = model.build(&defaults).unwrap();
        let imaginary = |i: usize| if handed { values[n + i] } else { 0.0 };
        let c: Vec<_> = (0..n).map(|i| Complex::new(values[i], imaginary(i))).collect();
        for _ in 0..20 {
            let u: Vec<f64> = (0..2 * modes).map(|_| 0.7 * normal.next()).collect();
            let mut du = vec![0.0; 2 * modes];
            VectorField::<f64>::eval(&*body, 0.0, &u, &mut du);
            for (m, (rate, size)) in field(&library, &c, &u).into_iter().enumerate() {
                let error = (du[2 * m] - rate.re).abs().max((du[2 * m + 1] - rate.im).abs());
                assert!(error <= 1e-15 * size.max(1e-3), "{modes} {order}: {error:e} of {size}");
            }
        }
    }
}

/// An equation whose terms were all left out: its amplitude stays as it is.
#[test]
fn equations_without_terms() {
    for names in [["z1: z1", "z2: z2"], ["z1: z1", "z3: z1 z2"], ["z2: z1^2", "z3: z3"]] {
        let library = Library::tensor().select(&names).unwrap();
        let definition = equations(&library, false, &[0.3, -0.4]);
        let model = amplitudes::info(&definition).unwrap_or_else(|error| panic!("{names:?}: {error}"));
        let values: Vec<f64> = definition.parameters.iter().map(|p| p.default).collect();
        let body = model.build(&values).unwrap();
        let (u, mut du) = ([0.5, -0.3, 0.1, 0.2, -0.15, 0.05], [1.0; 6]);
        VectorField::<f64>::eval(&*body, 0.0, &u, &mut du);
        let c = [0.3, -0.4].map(|c| Complex::new(c, 0.0));
        for (m, (rate, _)) in field(&library, &c, &u).into_iter().enumerate() {
            assert!(
                (du[2 * m] - rate.re).abs() < 1e-15 && (du[2 * m + 1] - rate.im).abs() < 1e-15,
                "{names:?} {m}"
            );
        }
    }
}

/// The names are the paper's: its parameters, put in as values, give its field.
#[test]
fn the_papers_parameters() {
    let p = TensorParameters { a2: 0.3, a3: -0.2, b3: 0.7, d6: 0.4, ..TensorParameters::full(0.5, 0.1) };
    let fields = FourierField::<f64>::all((&p).into());
    let library = Library::tensor();
    let mut definition = equations(&library, false, &[0.0; 22]);
    let values = [
        ("gamma", p.gamma),
        ("kappa2", p.kappa2),
        ("kappa3", p.kappa3),
        ("a1", p.a1),
        ("a2", p.a2),
        ("a3", p.a3),
        ("b1", p.b1),
        ("b2", p.b2),
        ("b3", p.b3),
        ("d1", p.d1),
        ("d2", p.d2),
        ("d6", p.d6),
        ("d11", -1.0),
    ];
    for (name, value) in values {
        definition.parameters.iter_mut().find(|q| q.name == name).unwrap().default = value;
    }
    let model = amplitudes::info(&definition).unwrap();
    let defaults: Vec<f64> = definition.parameters.iter().map(|p| p.default).collect();
    let body = model.build(&defaults).unwrap();
    let u = [0.5, -0.3, 0.1, 0.2, -0.15, 0.05];
    let (mut du, mut expected) = ([0.0; 6], [0.0; 6]);
    VectorField::<f64>::eval(&*body, 0.0, &u, &mut du);
    fields.eval(0.0, &u, &mut expected);
    for (a, b) in du.into_iter().zip(expected) {
        assert!((a - b).abs() < 1e-15, "{du:?} {expected:?}");
    }
}
