//! Random starts that sample basins: sizes, directions, text; what scans and single runs draw.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_dynamics::model::velocity;
use motiform_lab::scan::Axis;
use motiform_models::{MODELS, ModelInfo};
use motiform_study::{Random, RunPlan, ScanPlan, Study};

/// The coordinates of the start that a study draws with this seed.
fn start(study: &Study, seed: u64) -> Vec<f64> {
    let mut study = study.clone();
    study.run.seed = seed;
    let all = RunPlan::new(&study).unwrap().computation.initial.values();
    all[..all.len() - 2].to_vec()
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// `ln r` is uniform: mean and variance within five standard errors of those of the uniform law, and no size beyond the ends.
#[test]
fn sizes_are_log_uniform() {
    for info in MODELS {
        let mut study = Study::of_model(info);
        study.random = Some(Random::Sizes { min: 0.01, max: 2.0 });
        let n = 2000;
        let (low, high) = (0.01_f64.ln(), 2.0_f64.ln());
        let places: Vec<f64> =
            (0..n).map(|seed| (norm(&start(&study, seed)).ln() - low) / (high - low)).collect();
        assert!(places.iter().all(|&x| (-1e-12..=1.0 + 1e-12).contains(&x)), "{}", info.name);
        let n = n as f64;
        let mean = places.iter().sum::<f64>() / n;
        let variance = places.iter().map(|x| (x - 0.5) * (x - 0.5)).sum::<f64>() / n;
        assert!((mean - 0.5).abs() < 5.0 * (1.0 / 12.0 / n).sqrt(), "{}: {mean}", info.name);
        assert!((variance - 1.0 / 12.0).abs() < 5.0 * (1.0 / 180.0 / n).sqrt(), "{}: {variance}", info.name);
    }
}

/// No direction is preferred: over the unit sphere in six dimensions `<x_i> = 0`, `<x_i x_j> = delta_ij / 6`, `<x_i^4> = 3 / 48`.
#[test]
fn directions_are_isotropic() {
    let mut study = Study::of_model(ModelInfo::find("tensor").unwrap());
    study.random = Some(Random::Sizes { min: 1.0, max: 1.0 });
    let all: Vec<Vec<f64>> = (0..4000).map(|seed| start(&study, seed)).collect();
    let n = all.len() as f64;
    let mean = |of: &dyn Fn(&[f64]) -> f64| all.iter().map(|x| of(x)).sum::<f64>() / n;
    for i in 0..6 {
        assert!(mean(&|x| x[i]).abs() < 5.0 * (1.0 / 6.0 / n).sqrt());
        assert!((mean(&|x| x[i].powi(4)) - 3.0 / 48.0).abs() < 5.0 * (0.01 / n).sqrt());
        for j in 0..6 {
            let want = if i == j { 1.0 / 6.0 } else { 0.0 };
            assert!((mean(&|x| x[i] * x[j]) - want).abs() < 5.0 * (1.0 / 36.0 / n).sqrt(), "{i} {j}");
        }
    }
}

/// Harmonic n of a cell is drawn with weight 1/n^2, both coordinates alike.
#[test]
fn cells_are_smooth() {
    let mut study = Study::of_model(ModelInfo::find("cell").unwrap());
    study.random = Some(Random::Sizes { min: 1.0, max: 1.0 });
    let all: Vec<Vec<f64>> = (0..2000).map(|seed| start(&study, seed)).collect();
    for (place, weight) in [(1, 1.0), (2, 0.25), (3, 0.25), (5, 1.0 / 9.0)] {
        // The quotient of two normal numbers has a median of 1 in absolute value, known to pi/2 / sqrt(2000) here; five times that.
        let mut quotients: Vec<f64> = all.iter().map(|x| (x[place] / x[0]).abs() / weight).collect();
        quotients.sort_by(f64::total_cmp);
        assert!((quotients[1000] - 1.0).abs() < 0.18, "{place}: {}", quotients[1000]);
    }
}

/// A small start of a cell is no faster than the motions that grow from it: its speed is quadratic in the amplitudes, and modes that die at
/// once must not make it.
#[test]
fn small_starts_of_cells_have_the_speed_of_their_slow_modes() {
    let info = ModelInfo::find("cell").unwrap();
    let mut study = Study::of_model(info);
    study.set("length", 21.6).unwrap();
    for seed in 1..9 {
        let all = start(&study, seed);
        assert!(all.iter().enumerate().all(|(place, x)| x.abs() <= 0.01 * (info.weight)(place)), "{all:?}");
        let speed = |start: &[f64]| {
            let model = info.build(&study.values().unwrap()).unwrap();
            let mut shape = vec![0.0; model.dim()];
            model.encode(start, &mut shape);
            let velocity = velocity(model.as_ref(), &shape);
            libm::hypot(velocity[0], velocity[1])
        };
        // uniform within 0.01 in all modes they were 0.02 to 0.06
        assert!(speed(&all) < 1e-4, "seed {seed}: {}", speed(&all));
    }
}

#[test]
fn text_reads_back_and_nonsense_is_refused() {
    for (text, random) in [
        ("0.3", Random::Within(0.3)),
        ("0", Random::Within(0.0)),
        ("0.01:1", Random::Sizes { min: 0.01, max: 1.0 }),
    ] {
        assert_eq!(Random::parse(text).unwrap(), random);
        assert_eq!(Random::parse(&random.to_string()).unwrap(), random);
    }
    for text in ["", "a", "-1", "nan", "inf", "0:1", "1:0.5", "0.1:", "0.1:0.2:0.3", "-1:1", "0.1:inf"] {
        let refusal = Random::parse(text).unwrap_err().to_string();
        assert!(refusal.contains("random"), "{text}: {refusal}");
    }
    let study =
        |value: &str| Study::parse(&format!("preset = \"fig4\"\n[initial]\nrandom = {value}\n"), "text", "t");
    assert_eq!(study("\"0.1:0.5\"").unwrap().random, Some(Random::Sizes { min: 0.1, max: 0.5 }));
    assert_eq!(study("0.5").unwrap().random, Some(Random::Within(0.5)));
    assert!(study("\"1:0.5\"").unwrap_err().to_string().contains("largest"));
    assert!(study("true").is_err());
}

/// One start stays small, as it was; several sample basins, unless they are told.
#[test]
fn many_starts_sample_basins_and_one_stays_small() {
    let plan = |text: &str| {
        let study = format!("preset = \"fig4\"\n[scan]\naxes = [\"kappa2=0.5,1\"]\n{text}");
        ScanPlan::new(&Study::parse(&study, "text", "t").unwrap()).unwrap()
    };
    assert_eq!(plan("samples = 1\n").computation.random, Random::Within(0.01));
    let many = plan("samples = 3\n");
    assert_eq!(many.computation.random, Random::Sizes { min: 0.01, max: 1.0 });
    assert_eq!(plan("samples = 3\n[initial]\nrandom = 0.01\n").computation.random, Random::Within(0.01));
    // plans of small starts are those of earlier versions, to the byte
    let json = serde_json::to_value(&plan("samples = 1\n").computation).unwrap();
    assert_eq!(json["random"], 0.01);
    let back: ScanPlan = serde_json::from_str(&serde_json::to_string(&many).unwrap()).unwrap();
    assert_eq!((back.hash(), &back), (many.hash(), &many));
    let sizes: Vec<f64> = (0..6)
        .map(|row| {
            let model = many.model_of(row / 3).unwrap();
            let mut coordinates = vec![0.0; 6];
            model.decode(&many.start(row / 3, row % 3, model.as_ref()).unwrap(), &mut coordinates);
            norm(&coordinates)
        })
        .collect();
    assert!(sizes.iter().all(|size| (0.01..=1.0 + 1e-12).contains(size)), "{sizes:?}");
    assert!(sizes.iter().any(|size| *size > 0.1), "{sizes:?}");
}

/// Lorenz's equations, whose sizes grow from 1 to 30 with r: the value that an axis replaces is in no number of the plan.
#[test]
fn a_value_that_an_axis_replaces_changes_no_plan() {
    let plan = |r: f64, axis: &str| {
        let mut study = Study::parse(
            "[model.amplitudes]\nmodes = [2, 3]\nsymmetry = \"none\"\nvelocity = \"z2\"\n\
             [model.amplitudes.parameters]\nr = 0.5\n[model.amplitudes.equations]\n\
             z2 = \"10*(im(z2) - re(z2)) + i*(r*re(z2) - im(z2) - re(z2)*re(z3))\"\n\
             z3 = \"re(z2)*im(z2) - 8/3*re(z3) - i*im(z3)\"",
            "text",
            "lorenz",
        )
        .unwrap();
        study.set("r", r).unwrap();
        study.scan.axes = vec![Axis::parse(axis).unwrap()];
        study.scan.samples = 6;
        ScanPlan::new(&study).unwrap()
    };
    let [small, large] = [0.5, 1e4].map(|r| plan(r, "r=22:24:3"));
    assert_eq!((small.hash(), small.computation.random), (large.hash(), large.computation.random));
    let Random::Sizes { max, .. } = small.computation.random else { panic!("{:?}", small.computation) };
    assert!((20.0..=100.0).contains(&max), "{max}");
}

/// Sprott's simplest flow and Lorenz's equations, their variables in all orders, two in an amplitude: sizes of starts that differ by no
/// more than a factor of two.
#[test]
fn the_order_of_equations_does_not_move_the_sizes_of_starts() {
    let flows =
        [(["y", "z", "y^2-x-2.017*z"], 4.0..=16.0), (["10*(y-x)", "28*x-y-x*z", "x*y-8/3*z"], 30.0..=100.0)];
    for (rates, expected) in flows {
        for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
            let place = |variable: usize| order.iter().position(|at| *at == variable).unwrap();
            let names = ["re(z2)", "im(z2)", "re(z3)"];
            let rate = |at: usize| {
                let symbol = |letter: char| match "xyz".find(letter) {
                    Some(variable) => names[place(variable)].to_owned(),
                    None => letter.to_string(),
                };
                rates[order[at]].chars().map(symbol).collect::<String>()
            };
            let text = format!(
                "[model.amplitudes]\nmodes = [2, 3]\nsymmetry = \"none\"\nvelocity = \"z2\"\n[model.amplitudes.equations]\n\
                 z2 = \"{} + i*({})\"\nz3 = \"{} - i*im(z3)\"\n[scan]\nsamples = 2\n",
                rate(0),
                rate(1),
                rate(2)
            );
            let study = Study::parse(&text, "text", "test").unwrap();
            let Random::Sizes { min, max } = study.starts_over(2, &[]).unwrap() else { panic!("{text}") };
            assert!(expected.contains(&max) && min == max / 100.0, "{order:?}: {min} to {max}\n{text}");
        }
    }
}

/// A particle with friction in three wells, at 0 and at +-2: its terms balance at 1 to 4. Starts by Runge and Kutta's method come to all.
#[test]
fn starts_reach_the_wells_between_which_terms_balance() {
    let rate = |[x, v]: [f64; 2]| [v, -0.3 * v - x * (x * x - 1.0) * (x * x - 4.0)];
    let text = "[model.amplitudes]\nmodes = [1]\nsymmetry = \"none\"\n[model.amplitudes.equations]\n\
                z1 = \"im(z1) + i*(-0.3*im(z1) - re(z1)*(re(z1)^2 - 1)*(re(z1)^2 - 4))\"\n";
    let study = Study::parse(text, "text", "test").unwrap();
    let random = study.starts(24).unwrap();
    let well = |stream| {
        let coordinates = random.coordinates(study.info().unwrap(), 2, 1, stream);
        let mut at = [coordinates[0], coordinates[1]];
        for _ in 0..10_000 {
            let beside = |k: [f64; 2], h: f64| rate([at[0] + h * k[0], at[1] + h * k[1]]);
            let first = rate(at);
            let second = beside(first, 0.005);
            let third = beside(second, 0.005);
            let fourth = beside(third, 0.01);
            let step = |i: usize| (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]) * 0.01 / 6.0;
            at = [at[0] + step(0), at[1] + step(1)];
        }
        at[0].round() as i32
    };
    let wells: std::collections::BTreeSet<i32> = (1..=24).map(well).collect();
    assert_eq!(wells, [-2, 0, 2].into(), "{random:?}");
}
