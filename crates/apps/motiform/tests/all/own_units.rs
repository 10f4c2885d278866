//! A model of one's own in any units, and with a symmetry that it does not have: a body in circles, with its exact motion.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform::prelude::*;

motiform::parameters! {
    /// Parameters of the circle.
    CircleParameters for "circle" {
        rate = 1.0 in 0.5 .. 2.0 within 1e-15 .. 1e15, "*r*", "(v)", "the unit of rates.";
        length = 1.0 in 0.5 .. 2.0 within 1e-15 .. 1e15, "*l*", "(v)", "the speed over the unit of rates.";
        omega = 0.3 in -1.0 .. 1.0, "*ω*", "(v)", "turning rate over the unit of rates.";
    }
}

/// `v' = r (1 - v^2/(l r)^2 + omega J) v`: circles of the speed `l r`, turning rate `omega r`.
struct Circle {
    parameters: CircleParameters,
    symmetry: Symmetry,
    /// Factor of the angle in `spin`.
    spin: f64,
}

impl System for Circle {
    fn dim(&self) -> usize {
        2
    }
}

impl<T: Scalar> VectorField<T> for Circle {
    fn eval(&self, _t: T::Real, v: &[T], dv: &mut [T]) {
        let CircleParameters { rate, length, omega } = self.parameters;
        let w = [v[0] * (1.0 / (length * rate)), v[1] * (1.0 / (length * rate))];
        let growth = v[0].constant(1.0) - (w[0] * w[0] + w[1] * w[1]);
        dv[0] = (growth * v[0] - v[1] * omega) * rate;
        dv[1] = (growth * v[1] + v[0] * omega) * rate;
    }
}

impl<T: Scalar> Semilinear<T> for Circle {}

impl<T: Scalar> Shape<T> for Circle {
    fn velocity(&self, v: &[T]) -> [T; 2] {
        [v[0], v[1]]
    }
}

impl Equivariant for Circle {
    fn symmetry(&self) -> Symmetry {
        self.symmetry
    }

    fn rotate(&self, angle: f64, v: &mut [f64]) {
        let (sin, cos) = angle.sin_cos();
        (v[0], v[1]) = (cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]);
    }

    fn spin(&self, v: &[f64], out: &mut [f64]) {
        (out[0], out[1]) = (-self.spin * v[1], self.spin * v[0]);
    }

    fn mirror(&self, v: &mut [f64]) {
        v[1] = -v[1];
    }
}

impl Model for Circle {
    fn coordinates(&self) -> &[Coordinate] {
        &[
            Coordinate { name: "v1", meaning: "velocity along x" },
            Coordinate { name: "v2", meaning: "velocity along y" },
        ]
    }

    fn velocities(&self) -> usize {
        2
    }
}

const TURNS: Symmetry = Symmetry { rotations: true, mirror: false };

fn circle(about: &About, symmetry: Symmetry, spin: f64) -> Result<&'static ModelInfo, String> {
    let build = move |parameters: &CircleParameters| Ok(Circle { parameters: *parameters, symmetry, spin });
    register(about, build).map_err(|error| error.to_string())
}

#[test]
fn its_motion_is_the_same_in_any_units() {
    for (name, rate, length) in [
        ("circle", 1.0, 1.0),
        ("large", 1.0, 1e9),
        ("small", 1.0, 1e-9),
        ("slow", 1e-9, 1e12),
        ("fast", 1e9, 1e-15),
    ] {
        let about = About { name, look: 100.0 / rate, ..About::default() };
        let mut study = Study::of_model(circle(&about, TURNS, 1.0).unwrap());
        study.set("rate", rate).unwrap();
        study.set("length", length).unwrap();
        study.run.t_end = 100.0 / rate;
        let plan = RunPlan::new(&study).unwrap();
        let (speed, omega) = (length * rate, 0.3 * rate);
        let verdict = classify(&plan, 0.0, &()).unwrap().unwrap();
        assert_eq!(verdict.regime.name(), "circular", "{name}: {}", verdict.why);
        assert!((verdict.speed.unwrap().mean / speed - 1.0).abs() < 1e-8, "{name}");
        assert!((verdict.turning_rate.unwrap() / omega - 1.0).abs() < 1e-8, "{name}");
        let dataset = simulate(&plan, &()).unwrap();
        let columns = &dataset.trajectory.columns;
        let last =
            |name: &str| columns.iter().find(|c| c.name == name).unwrap().values.last().copied().unwrap();
        assert!(
            (last("v1").hypot(last("v2")) / speed - 1.0).abs() < 1e-7,
            "{name}: {}",
            dataset.manifest.outcome
        );
        let found = lyapunov(&plan, 2, Spans::default(), &()).unwrap();
        assert!((found.exponents[1].value / rate + 2.0).abs() < 1e-3, "{name}: {:?}", found.exponents);
    }
}

/// It turns, so its mirror image is another motion; and `spin` must be the derivative of `rotate`.
#[test]
fn a_symmetry_that_it_does_not_have_is_refused() {
    for size in [1e-9, 1.0, 10.0] {
        let about = About { name: "wrong", size, ..About::default() };
        let error = circle(&about, Symmetry::FULL, 1.0).unwrap_err();
        assert!(error.contains("mirrored"), "{error}");
        let error = circle(&about, TURNS, 1.01).unwrap_err();
        assert!(error.contains("`spin`"), "{error}");
    }
}
