//! Amplitude equations given as text: against the tensor model, symmetries, known answers, refusals.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::conformance::{
    mirror_defect, purity_defect, rotation_defect, semilinear_defect, spin_defect,
};
use motiform_dynamics::model::velocity;
use motiform_dynamics::tangent::jacobian;
use motiform_dynamics::{Symmetry, VectorField};
use motiform_models::amplitudes::{self, Definition, ParameterDefinition, Part, info};
use motiform_models::tensor::{FourierField, Tensor, TensorParameters};
use motiform_models::{ModelInfo, Parameters};
use proptest::prelude::*;

pub(crate) fn definition(modes: &[u32], equations: &[&str], parameters: &[(&str, f64)]) -> Definition {
    Definition {
        modes: modes.to_vec(),
        velocity: None,
        symmetry: None,
        parameters: parameters.iter().map(|&(name, value)| ParameterDefinition::new(name, value)).collect(),
        equations: equations.iter().map(|&text| text.to_owned()).collect(),
        noise: std::collections::BTreeMap::new(),
    }
}

/// The tensor model as text, with all its parameters.
fn tensor_as_text() -> &'static ModelInfo {
    let defaults: Vec<f64> = TensorParameters::specs().iter().map(|spec| spec.default).collect();
    info(&amplitudes::tensor_as_text(&defaults, true)).unwrap()
}

fn rates<F: VectorField<f64> + ?Sized>(field: &F, shape: &[f64]) -> [f64; 6] {
    let mut rates = [0.0; 6];
    field.eval(0.0, shape, &mut rates);
    rates
}

fn largest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

proptest! {
    /// 22 terms, each rounded a few times: 1e-15 of the sum of their sizes. The oracle is the field with all terms written out, which no
    /// front end uses: the tensor model itself computes terms beyond those of the paper by the list.
    #[test]
    fn the_tensor_model_as_text_is_the_tensor_model(
        values in prop::collection::vec(-2.0_f64..2.0, 21),
        shape in prop::collection::vec(-1.0_f64..1.0, 6),
    ) {
        let mut parameters = TensorParameters::default();
        for (index, &value) in values.iter().enumerate() {
            parameters.set_at(index, value);
        }
        let (tensor, text) =
            (FourierField::<f64>::all((&parameters).into()), tensor_as_text().build(&values).unwrap());
        prop_assert_eq!(rates(&Tensor::new(&parameters), &shape), rates(text.as_ref(), &shape));
        let (rate, rate_of_text) = (rates(&tensor, &shape), rates(text.as_ref(), &shape));
        let scale = 100.0;
        prop_assert!(largest(&rate, &rate_of_text) < 1e-15 * scale, "{rate:?} {rate_of_text:?}");
        prop_assert_eq!(velocity(&tensor, &shape), velocity(text.as_ref(), &shape));
        let difference = largest(&jacobian(&tensor, &shape), &jacobian(text.as_ref(), &shape));
        prop_assert!(difference < 1e-15 * 3.0 * scale, "{difference}");
    }

    /// Rotations, the mirror, the split into a linear part and the rest, for terms of order up to 7 and handed ones.
    #[test]
    fn equations_have_the_symmetry_that_they_say(
        shape in prop::collection::vec(-1.0_f64..1.0, 6),
        angle in -3.0_f64..3.0,
        omega in -1.0_f64..1.0,
    ) {
        let handed = [
            "(1 + i*omega - |z1|^2)*z1 + exp(i*omega)*conj(z2)*z3",
            "-z2 + i*z1^2*|z3|^4",
            "-z3 + z1*z2 + conj(z2)^2*z1^5*conj(z1)^0*conj(z2)^0*|z1|^0",
        ];
        let mut even = handed.map(|text| text.replace("i*omega", "omega").replace("i*z1", "z1"));
        even[2] = "-z3 + z1*z2 + |z2|^6*z3".to_owned();
        let with = |texts: &[&str]| info(&definition(&[1, 2, 3], texts, &[("omega", 0.0)])).unwrap().build(&[omega]).unwrap();
        let texts = ["(1 + i*omega - |z1|^2)*z1 + exp(i*omega)*conj(z2)*z3", "-z2 + i*z1^2*|z3|^4", "-z3 + z1*z2 + |z2|^6*z3"];
        let body = with(&texts);
        prop_assert_eq!(body.symmetry(), Symmetry { rotations: true, mirror: false });
        let mirrored = with(&[&even[0], &even[1], &even[2]]);
        prop_assert_eq!(mirrored.symmetry(), Symmetry::FULL);
        for model in [&body, &mirrored] {
            prop_assert!(rotation_defect(model.as_ref(), &shape, angle) < 1e-14);
            prop_assert!(spin_defect(model.as_ref(), &shape) < 1e-9);
            prop_assert!(semilinear_defect(&model.as_ref(), &shape) < 1e-15);
            prop_assert_eq!(purity_defect(model.as_ref(), &shape), 0.0);
        }
        prop_assert!(mirror_defect(mirrored.as_ref(), &shape) < 1e-15);
    }

    /// Texts of the right letters: a refusal or a model, never a panic. `PROPTEST_CASES` sets the number.
    #[test]
    fn any_text_is_read_or_refused(text in "[-+*/^()|z123 .a-eigopsqrtx0-9]{0,60}", other in ".{0,40}") {
        for text in [text, other] {
            let definition = definition(&[1, 2, 3], &[&text, "-z2", "-z3"], &[("a", 1.0)]);
            if let Err(error) = amplitudes::Equations::new(&definition) {
                prop_assert!(error.span.end <= text.len().max(10_001), "{text:?} {error:?}");
                prop_assert!(text.is_char_boundary(error.span.start.min(text.len())));
            }
        }
    }
}

/// `z1' = (gamma + i omega - |z1|^2) z1`: a circle of speed sqrt(gamma), turning at -omega because `z1 = v1 - i v2`.
#[test]
fn a_handed_swimmer_turns_at_its_rate() {
    let info = info(&definition(&[1], &["(gamma + i*omega - |z1|^2)*z1"], &[("gamma", 1.0), ("omega", 0.3)]))
        .unwrap();
    let body = info.build(&[0.25, 0.3]).unwrap();
    let state = [0.5, 0.0];
    let mut rate = [0.0; 2];
    VectorField::<f64>::eval(body.as_ref(), 0.0, &state, &mut rate);
    assert!((rate[0]).abs() < 1e-16 && (rate[1] - 0.15).abs() < 1e-16, "{rate:?}");
    let names: Vec<&str> = body.coordinates().iter().map(|c| c.name).collect();
    assert_eq!(names, ["v1", "v2"]);
    let mut coordinates = [0.0; 2];
    body.decode(&[0.1, 0.2], &mut coordinates);
    assert_eq!(coordinates, [0.1, -0.2]);
}

/// FitzHugh and Nagumo's equations in real variables, written with `re` and `im`.
#[test]
fn equations_in_real_variables_are_written_with_real_and_imaginary_parts() {
    let text =
        "re(z2) - re(z2)^3/3 - im(z2) + J + i*0.08*(re(z2) + 0.7 - 0.8*im(i*conj(i*z2) + z2) + 0*im(J))";
    let mut fields = definition(&[2], &[text], &[("J", 0.5)]);
    fields.velocity = Some("z2".to_owned());
    fields.symmetry = Some("none".to_owned());
    let body = info(&fields).unwrap().build(&[0.5]).unwrap();
    for [x, y] in [[0.3_f64, -1.2], [-1.7, 0.4], [0.0, 2.0]] {
        let mut rate = [0.0; 2];
        VectorField::<f64>::eval(body.as_ref(), 0.0, &[x, y], &mut rate);
        // i conj(i z) = conj(z): the sum in im() is real, and the term with 0.8 is nothing
        let expected = [x - x.powi(3) / 3.0 - y + 0.5, 0.08 * (x + 0.7)];
        assert!(largest(&rate, &expected) < 1e-15 * 5.0, "{rate:?} {expected:?}");
    }
    let wrong = definition(&[2], &["rre(z2)"], &[]);
    assert!(info(&wrong).unwrap_err().problem.contains("did you mean re?"));
    let open = definition(&[2], &["im z2"], &[]);
    assert!(info(&open).unwrap_err().problem.contains("expected ( after im"));
}

/// The Brusselator far out, where powers of z are 10^8 times what is left of them, in two forms of one text; the plane x = 0 of a product.
#[test]
fn terms_in_real_variables_that_cancel_leave_nothing() {
    let forms = [
        "1 - (b+1)*re(z2) + re(z2)^2*im(z2) + i*(b*re(z2) - re(z2)^2*im(z2))",
        "1 - (b+1)*(z2+conj(z2))/2 + (1 - i)*(z2+conj(z2))^2/4*(z2-conj(z2))/(2*i) + i*b*(z2+conj(z2))/2",
    ];
    let b = 2.3;
    for text in forms {
        let mut fields = definition(&[2], &[text], &[("b", b)]);
        (fields.velocity, fields.symmetry) = (Some("z2".to_owned()), Some("none".to_owned()));
        let body = info(&fields).unwrap().build(&[b]).unwrap();
        for [x, y] in [[1.3e-4, 7.1e7], [1.0, b], [-3e3, 0.2], [0.0, 1e8]] {
            let mut rate = [0.0; 2];
            VectorField::<f64>::eval(body.as_ref(), 0.0, &[x, y], &mut rate);
            let product: f64 = x * x * y;
            let expected = [1.0 - (b + 1.0) * x + product, b * x - product];
            let terms = 1.0 + (b + 1.0) * x.abs() + product.abs();
            assert!(largest(&rate, &expected) < 1e-15 * terms, "{text} {x} {y}: {rate:?} {expected:?}");
        }
    }
    let mut plane = definition(&[2], &["re(z2)*(1 - re(z2)^2/3 - b*im(z2)) - i*im(z2)"], &[("b", b)]);
    (plane.velocity, plane.symmetry) = (Some("z2".to_owned()), Some("none".to_owned()));
    let body = info(&plane).unwrap().build(&[b]).unwrap();
    let mut rate = [0.0; 2];
    VectorField::<f64>::eval(body.as_ref(), 0.0, &[0.0, 0.7], &mut rate);
    assert_eq!(rate, [0.0, -0.7]);
    assert!(semilinear_defect(&body.as_ref(), &[0.3, -0.4]) < 1e-15);
}

/// Planes that no orbit crosses: those of a variable that is a factor of its own rate, at any values of the parameters.
#[test]
fn planes_that_the_flow_keeps_are_known() {
    let kept = |text: &str| {
        let mut fields = definition(&[2], &[text], &[("a", 1.0), ("b", 1.0)]);
        (fields.velocity, fields.symmetry) = (Some("z2".to_owned()), Some("none".to_owned()));
        motiform_dynamics::System::kept(info(&fields).unwrap().build(&[0.3, 0.7]).unwrap().as_ref())
    };
    let both = "re(z2)*(a - im(z2)) + i*im(z2)*(re(z2) - b)";
    assert_eq!(kept(both), 0b11, "Lotka and Volterra");
    assert_eq!(kept(&both.replace("re(z2)*(a", "(a - b)*re(z2)^0 + re(z2)*(a")), 0b10, "a = b is no law");
    assert_eq!(
        kept("a*(1 - re(z2)) - b*re(z2)*im(z2) + i*(b*re(z2)*im(z2) - a*im(z2))"),
        0b10,
        "an epidemic"
    );
    assert_eq!(kept("re(z2) - re(z2)^3 - i*im(z2)"), 0b01, "im(z2) decays at a constant rate");
    assert_eq!(kept("im(z2) - i*re(z2)"), 0);
}

#[test]
fn definitions_that_are_no_model_are_refused_at_their_place() {
    let two = |first: &str, second: &str| definition(&[1, 2], &[first, second], &[("a", 1.0)]);
    let mut field = two("z1 - |z1|^2*z1 + a", "-z2");
    let refusal = |definition: &Definition| info(definition).unwrap_err();
    assert!(refusal(&field).problem.contains("constant term breaks rotations"));
    let zeros = definition(&[1], &["(z1 - 0)*g + 0*g - |z1|^2*z1 - 0*conj(z1)"], &[("g", 1.0)]);
    assert!(amplitudes::Equations::new(&zeros).is_ok(), "terms that are 0 break nothing");
    field.symmetry = Some("mirror".to_owned());
    assert_eq!(
        info(&field).unwrap().build(&[1.0]).unwrap().symmetry(),
        Symmetry { rotations: false, mirror: true }
    );
    field.symmetry = Some("mirrored".to_owned());
    assert_eq!(refusal(&field).part, Part::Symmetry);
    let handed = Definition { symmetry: Some("rotation+mirror".to_owned()), ..two("i*z1", "-z2") };
    assert!(refusal(&handed).problem.contains("not real"));
    let wrong = refusal(&two("z1", "z1*z2"));
    assert_eq!(wrong.part, Part::Equation(1));
    assert!(wrong.problem.contains("z1*z2") && wrong.problem.contains("index is 3"), "{wrong}");
    assert_eq!(refusal(&definition(&[2, 3], &["-z2", "-z3"], &[])).part, Part::Modes);
    assert_eq!(refusal(&definition(&[1, 1], &["-z1", "-z1"], &[])).part, Part::Modes);
    assert_eq!(refusal(&definition(&[1], &["-z1"], &[("z1", 1.0)])).part, Part::Parameter(0));
    assert_eq!(refusal(&definition(&[1], &["-z1"], &[("pi", 1.0)])).part, Part::Parameter(0));
    let root = info(&definition(&[1], &["sqrt(a)*z1/b"], &[("a", 1.0), ("b", 1.0)])).unwrap();
    for bad in [[-1.0, 1.0], [1.0, 0.0]] {
        let error = root.build(&bad).err().unwrap().to_string();
        assert!(error.contains("z1: z1"), "{error}");
    }
}

/// Powers and the imaginary unit as other languages write them are named with what is written here.
#[test]
fn notation_of_other_languages_is_refused_with_the_remedy() {
    for (text, remedy) in [
        ("z1**2*conj(z1)", "a power is written ^"),
        ("-|z1|**2*z1", "a power is written ^"),
        ("2j*z1", "the imaginary unit is i"),
        ("2i*z1", "the imaginary unit is i"),
        ("j*z1", "the imaginary unit is i"),
    ] {
        let error = info(&definition(&[1], &[text], &[])).unwrap_err();
        assert!(error.problem.contains(remedy), "{text}: {error}");
    }
}

/// A body without a mode 1: its velocity is read off its shape.
#[test]
fn a_velocity_may_be_read_off_the_shape() {
    let mut definition = definition(&[2, 3], &["(1 - |z2|^2)*z2", "-z3 + |z2|^2*z3"], &[]);
    definition.velocity = Some("2*z2*conj(z3)".to_owned());
    let body = info(&definition).unwrap().build(&[]).unwrap();
    assert_eq!(body.velocities(), 0);
    assert_eq!(velocity(body.as_ref(), &[1.0, 0.0, 0.0, 0.5]), [0.0, -1.0]);
    assert!(rotation_defect(body.as_ref(), &[0.3, 0.2, -0.1, 0.4], 0.7) < 1e-15);
    assert!(body.speed_resolution(&[1.0, 0.0, 0.0, 0.5], 1e-9) < 1e-8);
}

/// Constant strengths are additive; others move their amplitude along `g` and `i g`.
#[test]
fn noise_is_a_part_of_the_equations() {
    let mut with =
        definition(&[1, 2], &["(a - |z1|^2)*z1", "-2*z2 + z1^2"], &[("a", 1.0), ("s", 0.3), ("D", 0.2)]);
    with.noise = [(1, "s*z1".to_owned()), (2, "D*i".to_owned())].into();
    let body = info(&with).unwrap().build(&[1.0, 0.3, 0.2]).unwrap();
    let noise = body.noise();
    assert_eq!(noise.amplitudes, [0.0, 0.0, 0.2, 0.2]);
    let diffusion = noise.diffusion.unwrap();
    assert_eq!((diffusion.processes(), diffusion.rate()), (2, 0.3 * 0.3));
    let start = [0.4, -0.2, 0.1, 0.3, 5.0, 6.0];
    let (mut grown, mut turned) = (start, start);
    diffusion.kick(0, 0.1, &mut grown);
    diffusion.kick(1, 0.1, &mut turned);
    let (sin, cos) = 0.03_f64.sin_cos();
    let expected =
        [[0.4 * 0.03_f64.exp(), -0.2 * 0.03_f64.exp()], [0.4 * cos + 0.2 * sin, 0.4 * sin - 0.2 * cos]];
    for (found, expected) in [grown, turned].iter().zip(expected) {
        assert!(largest(&found[..2], &expected) < 1e-10, "{found:?} {expected:?}");
        assert_eq!(found[2..], start[2..]);
    }
    assert!(info(&with).unwrap().build(&[1.0, 0.0, 0.0]).unwrap().noise().is_none());
    with.noise = [(5, "D".to_owned())].into();
    assert_eq!(info(&with).unwrap_err().part, Part::Noise(5));
    with.noise = [(2, "z1 + z2".to_owned())].into();
    assert!(info(&with).unwrap_err().problem.contains("turn differently"));
}

/// In other units of time a look is as many times as long, also of an oscillator, whose linear part acts across its unknowns.
#[test]
fn a_look_lasts_as_long_in_every_unit_of_time() {
    let look = |rate: f64, equation: &str| {
        let mut own = definition(&[2], &[&*format!("r*({equation})")], &[("r", rate)]);
        (own.symmetry, own.velocity) = (Some("none".to_owned()), Some("z2".to_owned()));
        info(&own).unwrap().look
    };
    for (equation, expected) in [
        ("im(z2) - i*re(z2)", 400.0),                       // a centre
        ("im(z2) - i*(re(z2) + 0.02*im(z2))", 400.0),       // an oscillator of weak damping
        ("im(z2) - i*(re(z2) + 0.2*im(z2))", 200.0),        // its rate of decay is 0.1
        ("im(z2) + i*re(z2) - i*re(z2)^3", 20.0),           // a saddle
        ("im(z2) - i*re(z2) + 0.02*re(z2) - 0.3*i", 400.0), // it rests elsewhere
    ] {
        for unit in [1e-6, 1e-2, 1.0, 1e2, 1e12] {
            let found = look(1.0 / unit, equation) / unit;
            assert!((found / expected - 1.0).abs() < 1e-9, "{equation} in units of {unit}: {found}");
        }
    }
}

/// The length of a look follows the slow amplitudes, not one fast one beside them, and not the place of the origin.
#[test]
fn a_look_lasts_as_the_slow_amplitudes_ask() {
    let beside = |rate: f64| {
        let equations = ["z1 - |z1|^2*z1", "-0.1*z2 + 0.2*z1^2", "-z3", "-r*z4"];
        info(&definition(&[1, 2, 3, 4], &equations, &[("r", rate)])).unwrap().look
    };
    assert_eq!([beside(1.0), beside(1e3)], [200.0, 200.0]);
    assert_eq!(beside(1e6), 0.4, "a look takes some steps for each of the fastest times");
    let shifted = |by: f64| {
        let z = format!("(z1 - {by})");
        let text = format!("(i - 0.1)*{z} - {z}^2*(conj(z1) - {by})");
        let own = Definition { symmetry: Some("none".to_owned()), ..definition(&[1], &[&text], &[]) };
        info(&own).unwrap().look
    };
    assert_eq!([shifted(3.0), shifted(50.0)], [200.0, 200.0]);
}

/// A velocity whose terms are 0 says nothing about the sense in which amplitudes turn.
#[test]
fn a_velocity_of_zero_leaves_the_sense_of_rotations() {
    let turned = |velocity: Option<&str>| {
        let text = Definition {
            velocity: velocity.map(str::to_owned),
            ..definition(&[1, 2], &["-z1", "(1+0.5*i-|z2|^2)*z2"], &[])
        };
        let model = info(&text).unwrap().build(&[]).unwrap();
        let mut shape = vec![0.1, 0.2, 0.3, -0.4];
        model.rotate(0.3, &mut shape);
        shape
    };
    let usual = turned(None);
    for velocity in ["conj(z1)", "0*z2", "0*z2*z1", "0*conj(z1)"] {
        assert!(largest(&turned(Some(velocity)), &usual) < 1e-15, "{velocity}");
    }
    assert!(largest(&turned(Some("z1")), &usual) > 0.1);
}
