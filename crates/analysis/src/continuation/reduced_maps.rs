//! The maps of an orbit's period without its neutral directions.

use super::orbits::{Local, Orbits};
use crate::linear::{apply, basis, dot};
use crate::periodic::back;

/// The map of reduced deviations over the period, class by class, column by column.
///
/// At every node the neutral directions (time, and the rotation) are divided out; they are mapped to those at the next node, so that
/// the quotient is exact. The product of the parts' maps is taken from the start on.
///
/// Source: Fairgrieve and Jepson (1991), SIAM J. Numer. Anal. 28, 1446.
pub(super) fn reduced_maps(orbits: &Orbits<'_>, x: &[f64], local: &Local) -> Vec<Vec<Vec<f64>>> {
    let neutral = |i: usize| {
        let columns = [local.spins[i].as_slice(), local.rates[i].as_slice()];
        let columns: Vec<&[f64]> = columns.into_iter().filter(|c| c.iter().any(|v| *v != 0.0)).collect();
        basis(&columns, 1e-8)
    };
    let bases: Vec<_> = (0..orbits.parts).map(|i| orbits.classes.without(&neutral(i))).collect();
    let classes = orbits.classes.bases.len();
    (0..classes)
        .map(|class| {
            let mut columns: Vec<Vec<f64>> = Vec::new();
            for (i, segment) in local.segments.iter().enumerate() {
                let next = (i + 1) % orbits.parts;
                let map = |v: &Vec<f64>| {
                    let mut image = apply(&segment.tangents, v);
                    if next == 0 {
                        back(local.body.as_ref(), orbits.angle(x), orbits.mirrored, &mut image);
                    }
                    bases[next][class].iter().map(|row| dot(row, &image)).collect::<Vec<f64>>()
                };
                let part: Vec<Vec<f64>> = bases[i][class].iter().map(map).collect();
                columns = if i == 0 { part } else { columns.iter().map(|c| combine(&part, c)).collect() };
            }
            columns
        })
        .collect()
}

/// `sum_j factor_j columns_j`.
fn combine(columns: &[Vec<f64>], factors: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; columns.first().map_or(0, Vec::len)];
    for (column, &factor) in columns.iter().zip(factors) {
        crate::linear::add(&mut out, factor, column);
    }
    out
}
