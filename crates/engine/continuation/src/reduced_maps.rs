//! The maps of an orbit's parts without its neutral directions.

use super::orbits::{Local, Orbits};
use motiform_analysis::linear::{apply, basis, dot};
use motiform_analysis::periodic::back;
use nalgebra::DMatrix;

/// The maps of reduced deviations over the parts of the period in their order, class by class; the last one brings back.
///
/// At every node the neutral directions (time, and the rotation) are divided out; they are mapped to those at the next node, so that
/// the quotient is exact.
///
/// Source: Fairgrieve and Jepson (1991), SIAM J. Numer. Anal. 28, 1446.
pub(super) fn reduced_maps(orbits: &Orbits<'_>, x: &[f64], local: &Local) -> Vec<Vec<DMatrix<f64>>> {
    let neutral = |i: usize| {
        let columns = [local.spins[i].as_slice(), local.rates[i].as_slice()];
        let columns: Vec<&[f64]> = columns.into_iter().filter(|c| c.iter().any(|v| *v != 0.0)).collect();
        basis(&columns, 1e-8)
    };
    let bases: Vec<_> = (0..orbits.parts).map(|i| orbits.classes.without(&neutral(i))).collect();
    let part = |class: usize, i: usize| {
        let next = (i + 1) % orbits.parts;
        let mut map = DMatrix::zeros(bases[next][class].len(), bases[i][class].len());
        for (j, direction) in bases[i][class].iter().enumerate() {
            let mut image = apply(&local.segments[i].tangents, direction);
            if next == 0 {
                back(local.body.as_ref(), orbits.angle(x), orbits.mirrored, &mut image);
            }
            for (k, row) in bases[next][class].iter().enumerate() {
                map[(k, j)] = dot(row, &image);
            }
        }
        map
    };
    let classes = 0..orbits.classes.bases.len();
    classes.map(|class| (0..orbits.parts).map(|i| part(class, i)).collect()).collect()
}
