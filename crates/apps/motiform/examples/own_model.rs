#![doc = "A model of one's own, from its equations to a named motion and a figure: `cargo run --release --example own_model`."]

use motiform::prelude::*;

motiform::parameters! {
    /// Parameters of the particle.
    MemoryParameters for "memory" {
        gamma = 1.0 in 0.0 .. 2.0, "*γ*", "(v)", "gamma v: self-propulsion.";
        k = 0.9 in 0.0 .. 1.0, "*k*", "(v)", "-k w: the trail pushes the particle away.";
        tau = 2.0 in 0.5 .. 4.0 within 0.01 .. 100.0, "*τ*", "(w)", "time in which the trail fades.";
    }
}

/// The particle.
pub struct Memory(pub MemoryParameters);

impl System for Memory {
    fn dim(&self) -> usize {
        4
    }
}

/// The equations, once for every scalar: numbers, lanes, dual numbers.
impl<T: Scalar> VectorField<T> for Memory {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let MemoryParameters { gamma, k, tau } = self.0;
        let growth = u[0].constant(gamma) - (u[0] * u[0] + u[1] * u[1]);
        for i in 0..2 {
            du[i] = growth * u[i] - u[2 + i] * k;
            du[2 + i] = (u[i] - u[2 + i]) * (1.0 / tau);
        }
    }
}

impl<T: Scalar> Semilinear<T> for Memory {} // no stiff linear part

impl<T: Scalar> Shape<T> for Memory {
    fn velocity(&self, u: &[T]) -> [T; 2] {
        [u[0], u[1]]
    }
}

/// Action of rotations and of the mirror: on two vectors.
impl Equivariant for Memory {
    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }

    fn rotate(&self, angle: f64, u: &mut [f64]) {
        let (sin, cos) = angle.sin_cos();
        for v in u.chunks_exact_mut(2) {
            (v[0], v[1]) = (cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]);
        }
    }

    fn spin(&self, u: &[f64], out: &mut [f64]) {
        for (v, out) in u.chunks_exact(2).zip(out.chunks_exact_mut(2)) {
            (out[0], out[1]) = (-v[1], v[0]);
        }
    }

    fn mirror(&self, u: &mut [f64]) {
        (u[1], u[3]) = (-u[1], -u[3]);
    }
}

/// Its names. Everything else has a default: no observables, a round outline.
impl Model for Memory {
    fn coordinates(&self) -> &[Coordinate] {
        const NAMES: [Coordinate; 4] = [
            Coordinate { name: "v1", meaning: "velocity along x" },
            Coordinate { name: "v2", meaning: "velocity along y" },
            Coordinate { name: "w1", meaning: "memory of the velocity along x" },
            Coordinate { name: "w2", meaning: "memory of the velocity along y" },
        ];
        &NAMES
    }

    fn velocities(&self) -> usize {
        2
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let about =
        About { name: "memory", title: "a particle pushed by its own past", look: 100.0, ..About::default() };
    let memory = register(&about, |parameters: &MemoryParameters| Ok(Memory(*parameters)))?;

    // A study: what moves, and how. Parameters have the names that were declared.
    let mut study = Study::of_model(memory);
    study.set("k", 0.9)?;
    study.run.t_end = 60.0;
    let plan = RunPlan::new(&study)?;

    // Its motion, named, with the evidence.
    let verdict = classify(&plan, 0.0, &())?.ok_or("interrupted")?;
    let speed = verdict.speed.ok_or("no speed")?.mean;
    println!("{}, speed {speed:.9}", verdict.regime);
    assert!(verdict.regime.name() == "circular" && (speed - 0.5_f64.sqrt()).abs() < 1e-8);

    // Its path, as a figure.
    let dataset = simulate(&plan, &())?;
    let path = still(&dataset, "path")?.ok_or("too short to be drawn")?;
    std::fs::write(std::env::temp_dir().join("memory.svg"), path)?;
    Ok(())
}
