//! The names of a cell's state and observables.

use super::MAX_MODES;
use motiform_dynamics::model::{Coordinate, Observable};
use std::sync::LazyLock;

/// The names `c1, s1, c2, s2, ..` of all modes that can be computed; leaked once, so that names are static everywhere.
static COORDINATES: LazyLock<Vec<Coordinate>> = LazyLock::new(|| {
    let name = |letter: char, n: usize| &*String::leak(format!("{letter}{n}"));
    let pair = |n: usize| {
        [
            Coordinate { name: name('c', n), meaning: "amplitude of cos(k_n s) in phi, k_n = 2 pi n / L" },
            Coordinate { name: name('s', n), meaning: "amplitude of sin(k_n s) in phi, k_n = 2 pi n / L" },
        ]
    };
    (1..=MAX_MODES).flat_map(pair).collect()
});

/// The names of the state with `modes` modes, in file order.
pub(super) fn coordinates(modes: usize) -> &'static [Coordinate] {
    &COORDINATES[..2 * modes.min(MAX_MODES)]
}

pub(super) const MEASURES: [Observable; 4] = [
    Observable {
        name: "length",
        symbol: "length",
        meaning: "length of the closed boundary, from its tangents",
        length: 1,
    },
    Observable { name: "area", symbol: "area", meaning: "area inside the closed boundary", length: 2 },
    Observable {
        name: "closure_residual",
        symbol: "closure residual",
        meaning: "|int n ds| / L that closing the boundary left",
        length: 0,
    },
    Observable {
        name: "self_intersecting",
        symbol: "number of self-intersecting outlines",
        meaning: "1 where the closed boundary crosses itself, else 0",
        length: 0,
    },
];

pub(super) const OBSERVABLES: [Observable; 4] = [
    Observable {
        name: "mode1",
        symbol: "2|*φ*_1|",
        meaning: "amplitude of mode 1 of phi, 2 |phi_1|",
        length: 1,
    },
    Observable {
        name: "mode2",
        symbol: "2|*φ*_2|",
        meaning: "amplitude of mode 2 of phi, 2 |phi_2|",
        length: 1,
    },
    Observable {
        name: "mode3",
        symbol: "2|*φ*_3|",
        meaning: "amplitude of mode 3 of phi, 2 |phi_3|",
        length: 1,
    },
    Observable {
        name: "mode4",
        symbol: "2|*φ*_4|",
        meaning: "amplitude of mode 4 of phi, 2 |phi_4|",
        length: 1,
    },
];
