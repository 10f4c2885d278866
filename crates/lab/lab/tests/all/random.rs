//! The random start is fixed by its seed, on every machine.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{preset, tensor};
use motiform_study::{RunPlan, Study};

fn start(study: &Study) -> Vec<f64> {
    RunPlan::new(study).unwrap().computation.initial.values()
}

fn seeded(seed: u64) -> Study {
    let mut study = Study::of_model(tensor());
    study.run.seed = seed;
    study
}

/// Bits of v1 v2 s11 s12 u111 u222. Computed by another implementation of ChaCha8 (a few lines of Python after
/// Bernstein (2008), ChaCha, a variant of Salsa20; key = seed in 8 little-endian bytes and 24 zeros, stream 0), as
/// 0.01 (floor(u64 / 2^11) / 2^52 - 1).
const REFERENCE: [(u64, [u64; 6]); 2] = [
    (
        1,
        [
            0xbf63_6ab1_bc65_d10f,
            0xbf70_ccaf_894d_7e66,
            0x3f78_6ed8_4c49_7c76,
            0x3f81_0bae_cb06_6b12,
            0x3f7d_268b_ea8b_8697,
            0xbf7d_8ed9_5093_6f12,
        ],
    ),
    (
        2,
        [
            0x3f83_83ca_07ce_cb5e,
            0xbf7e_0d61_b49f_d683,
            0xbf59_6469_6fb0_f81f,
            0x3f81_8cf1_67b3_d5ca,
            0x3f81_3f31_1a6d_85c4,
            0xbf83_e45f_eff0_0f0d,
        ],
    ),
];

#[test]
fn reference_bits() {
    for (seed, bits) in REFERENCE {
        let start = start(&seeded(seed));
        let expected: Vec<f64> = bits.map(f64::from_bits).into_iter().chain([0.0, 0.0]).collect();
        assert_eq!(start, expected, "seed {seed}");
    }
}

/// Uniform in -random..random: mean 0 within 5 standard errors, sqrt(1/3 / n), variance 1/3 within 5 of
/// sqrt(4/45 / n); every seed another start.
#[test]
fn values_are_uniform() {
    let all: Vec<Vec<f64>> = (0..2000).map(|seed| start(&seeded(seed))).collect();
    let values: Vec<f64> = all.iter().flat_map(|start| &start[..6]).map(|x| x / 0.01).collect();
    assert!(values.iter().all(|x| x.abs() <= 1.0));
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|x| x * x).sum::<f64>() / n;
    assert!(mean.abs() < 5.0 * (1.0 / 3.0 / n).sqrt(), "{mean}");
    assert!((variance - 1.0 / 3.0).abs() < 5.0 * (4.0 / 45.0 / n).sqrt(), "{variance}");
    let mut firsts: Vec<u64> = all.iter().map(|start| start[0].to_bits()).collect();
    firsts.sort_unstable();
    firsts.dedup();
    assert_eq!(firsts.len(), all.len());
    assert_ne!(start(&seeded(u64::MAX)), start(&seeded(u64::from(u32::MAX))), "all 64 bits count");
}

#[test]
fn size_scales_and_zero_is_rest() {
    let unit = start(&seeded(3));
    let mut study = seeded(3);
    study.random = Some(0.02.into()); // twice the default: exact in binary
    assert_eq!(start(&study), unit.iter().map(|x| 2.0 * x).collect::<Vec<_>>());
    study.random = Some(0.0.into());
    assert!(start(&study).iter().all(|&x| x == 0.0));
}

/// A place given says nothing about the shape: it stays random. A shape value given makes the others 0.
#[test]
fn what_is_given_and_what_is_drawn() {
    let mut study = seeded(1);
    let shape = start(&study)[..6].to_vec();
    study.set_initial("y", 5.0).unwrap();
    assert_eq!(start(&study), [&shape[..], &[0.0, 5.0]].concat());
    study.set_initial("s12", 0.25).unwrap();
    assert_eq!(start(&study), [0.0, 0.0, 0.0, 0.25, 0.0, 0.0, 0.0, 5.0]);
}

#[test]
fn the_order_of_settings_does_not_matter() {
    let values = [("v1", 0.1), ("u222", -0.2), ("x", 3.0), ("s11", 0.3)];
    let parameters = [("kappa2", 0.7), ("a6", 0.1), ("gamma", 0.9)];
    let plan = |reversed: bool| {
        let mut study = preset("fig4", |_| {});
        let (mut values, mut parameters) = (values.to_vec(), parameters.to_vec());
        if reversed {
            values.reverse();
            parameters.reverse();
        }
        values.iter().for_each(|(name, value)| study.set_initial(name, *value).unwrap());
        parameters.iter().for_each(|(name, value)| study.set(name, *value).unwrap());
        RunPlan::new(&study).unwrap()
    };
    assert_eq!(plan(false), plan(true));
    assert_eq!(plan(false).hash(), plan(true).hash());
}
