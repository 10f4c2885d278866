use motiform_analysis::regime::{Settings, classify};
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Equivariant, StepControl, System};
use motiform_models::cell::{Cell, CellParameters};
use motiform_models::tensor::{Tensor, TensorParameters};
use std::time::Instant;

fn rnd(seed: u64, n: usize) -> Vec<f64> {
    let mut s = seed;
    (0..n)
        .map(|_| {
            s = s.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let mut z = s;
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            0.01 * (((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0)
        })
        .collect()
}
fn go(body: &dyn Equivariant, s: &Settings, seed: u64, n: usize) -> String {
    let mut start = vec![0.0; body.dim()];
    start[..n].copy_from_slice(&rnd(seed, n));
    let t0 = Instant::now();
    let v = classify(body, &start, s, &mut ()).unwrap().unwrap();
    format!(
        "{:14} {:6.2}s T={:8.0} m={:8.1e} {} | per {:?} legs {:?} swing {:?} rests {:?}",
        v.regime.name(),
        t0.elapsed().as_secs_f64(),
        v.time,
        v.margin.unwrap_or(f64::NAN),
        v.why,
        v.period,
        v.legs,
        v.swing,
        v.rests.iter().map(|x| x.round()).collect::<Vec<_>>().iter().rev().take(4).collect::<Vec<_>>()
    )
}
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let seed: u64 = args.get(2).map_or(1, |s| s.parse().unwrap());
    let tens = Settings {
        method: Method::find("dop853").unwrap(),
        control: StepControl::Adaptive { rtol: 1e-9, atol: 1e-12 },
        first_look: 200.0,
        budget: 2e4,
        escape_norm: 1e6,
        max_steps: 100_000_000,
    };
    match args[1].as_str() {
        "fig1" => {
            for g in [0.1, 0.05, 0.025, -0.0125, -0.0375, -0.1] {
                for k in [-0.22, -0.18, -0.14, -0.10, -0.06, -0.02, 0.02, 0.06, 0.10, 0.14, 0.18, 0.22] {
                    let body = Tensor::new(&TensorParameters {
                        gamma: g,
                        kappa2: k,
                        kappa3: 1.0,
                        a1: 1.0,
                        b1: 0.5,
                        b3: 1.0,
                        ..Default::default()
                    });
                    println!("g={g:7} k={k:6} {}", go(&body, &tens, seed, 6));
                }
            }
        }
        "fig4" => {
            for k3 in [1.0, 0.6, 0.4, 0.3, 0.2, 0.1] {
                for i in 1..=16 {
                    let k = 0.1 * f64::from(i);
                    let body = Tensor::new(&TensorParameters {
                        gamma: 1.0,
                        kappa2: k,
                        kappa3: k3,
                        a1: -1.0,
                        b1: -0.5,
                        b2: 0.3,
                        d1: 0.1,
                        d2: 0.8,
                        ..Default::default()
                    });
                    println!("k3={k3} k2={k:.1} {}", go(&body, &tens, seed, 6));
                }
            }
        }
        "cell" => {
            for l in args[3..].iter() {
                let length: f64 = l.parse().unwrap();
                let modes = (4.0 * length / std::f64::consts::TAU).ceil().max(8.0);
                let body = Cell::new(&CellParameters { length, modes, ..Default::default() }).unwrap();
                let s = Settings {
                    method: Method::find("krogstad4").unwrap(),
                    control: StepControl::Adaptive { rtol: 1e-6, atol: 1e-7 },
                    first_look: 1500.0,
                    budget: 4e4,
                    escape_norm: 1e6,
                    max_steps: 100_000_000,
                };
                println!("L={length} {}", go(&body, &s, seed, 10));
            }
        }
        _ => {}
    }
}
