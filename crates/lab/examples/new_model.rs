//! A model of one's own, from scratch: a particle that is pushed by its own past.
//!
//!     v' = (gamma - |v|^2) v - k w,    w' = (v - w) / tau
//!
//! `v` is the velocity, `w` its fading memory (a trail that repels). For `k tau < 1` the particle goes straight with the speed
//! `sqrt(gamma - k)`. Beyond, it goes in circles: speed `sqrt(gamma - 1/tau)`, turning rate `sqrt(k tau - 1)/tau`.
//!
//! `cargo run --release -p motiform-lab --example new_model`

use motiform_analysis::regime::{Settings, Verdict, classify};
use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::{DOP853, Method};
use motiform_dynamics::{
    Equivariant, InPlane, Orbit, Request, Scalar, Semilinear, Shape, StepControl, Symmetry, System,
    Trajectory, VectorField, conformance,
};
use motiform_figures::{PathFigure, PathPoint, png};

/// The model with its parameters.
struct Memory {
    gamma: f64,
    k: f64,
    tau: f64,
}

impl System for Memory {
    fn dim(&self) -> usize {
        4
    }
}

/// The equations, once for every scalar: numbers, lanes, dual numbers.
impl<T: Scalar> VectorField<T> for Memory {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let growth = u[0].constant(self.gamma) - (u[0] * u[0] + u[1] * u[1]);
        for i in 0..2 {
            du[i] = growth * u[i] - u[2 + i] * self.k;
            du[2 + i] = (u[i] - u[2 + i]) * (1.0 / self.tau);
        }
    }
}

/// Without a stiff linear part all is nonlinear.
impl<T: Scalar> Semilinear<T> for Memory {
    fn linear(&self, lambda: &mut [T::Real]) {
        lambda.iter_mut().for_each(|rate| *rate = rate.zero());
    }

    fn nonlinear(&self, t: T::Real, u: &[T], du: &mut [T]) {
        VectorField::<T>::eval(self, t, u, du);
    }
}

/// The velocity is read off the shape: here it is part of it.
impl<T: Scalar> Shape<T> for Memory {
    fn velocity(&self, u: &[T]) -> [T; 2] {
        [u[0], u[1]]
    }
}

/// How rotations and the mirror act: on two vectors.
impl Equivariant for Memory {
    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }

    fn rotate(&self, angle: f64, u: &mut [f64]) {
        let (sin, cos) = angle.sin_cos();
        for vector in u.chunks_exact_mut(2) {
            (vector[0], vector[1]) = (cos * vector[0] - sin * vector[1], sin * vector[0] + cos * vector[1]);
        }
    }

    fn spin(&self, u: &[f64], out: &mut [f64]) {
        for (vector, out) in u.chunks_exact(2).zip(out.chunks_exact_mut(2)) {
            (out[0], out[1]) = (-vector[1], vector[0]);
        }
    }

    fn mirror(&self, u: &mut [f64]) {
        (u[1], u[3]) = (-u[1], -u[3]);
    }
}

const CONTROL: StepControl = StepControl::Adaptive { rtol: 1e-10, atol: 1e-13 };
const START: [f64; 4] = [0.1, 0.02, 0.0, 0.01];

/// The name of its motion.
fn named(body: &Memory) -> Result<Verdict, Box<dyn std::error::Error>> {
    let settings = Settings {
        method: Method::Explicit(&DOP853),
        control: CONTROL,
        first_look: 100.0,
        budget: 5000.0,
        escape_norm: 1e6,
        max_steps: 1_000_000,
    };
    Ok(classify(body, &START, &settings, &())?.ok_or("interrupted")?)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let body = Memory { gamma: 1.0, k: 0.9, tau: 2.0 };
    // what every model must satisfy
    assert!(conformance::rotation_defect(&body, &START, 1.0) < 1e-14);
    assert!(
        conformance::spin_defect(&body, &START) < 1e-8 && conformance::mirror_defect(&body, &START) == 0.0
    );

    for (k, regime, exact) in [(0.3, "straight", 0.7_f64.sqrt()), (0.9, "circular", 0.5_f64.sqrt())] {
        let verdict = named(&Memory { k, ..body })?;
        let speed = verdict.speed.ok_or("no speed")?.mean;
        println!("k = {k}: {}, speed {speed:.9} (exact {exact:.9})", verdict.regime);
        assert!(verdict.regime.name() == regime && (speed - exact).abs() < 1e-8);
    }

    let in_plane = InPlane(&body);
    let mut orbit = Orbit::new(&in_plane, &DOP853, CONTROL, 0.0, &[&START[..], &[0.0, 0.0]].concat())?;
    let mut path = Trajectory::new(6);
    let request = Request { sample_every: Some(0.1), ..Request::until(60.0, 6) };
    drive(&mut orbit, &request, &mut path)?;
    let points = path.iter().map(|(t, u)| PathPoint { t, x: u[4], y: u[5] }).collect();
    let figure = PathFigure {
        title: "Pushed by its own past".to_owned(),
        segments: vec![points],
        ..PathFigure::default()
    };
    std::fs::write("new_model.png", png(&figure.svg()?, 2.0, &[])?)?;
    println!("the path is drawn in new_model.png");
    Ok(())
}
