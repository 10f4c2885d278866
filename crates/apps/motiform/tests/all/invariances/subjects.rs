//! The motions that are asked for.

use super::texts::Text;

/// A moving body of the tests.
#[derive(Clone, Debug)]
pub(crate) enum System {
    BuiltIn(&'static str),
    Text(Text),
}

/// A motion: a system, its parameters, the seed of its start.
#[derive(Clone, Debug)]
pub(crate) struct Subject {
    pub(crate) name: String,
    pub(crate) system: System,
    pub(crate) set: Vec<(String, f64)>,
    pub(crate) seed: u64,
}

impl Subject {
    /// Its name in the report.
    pub(crate) fn kind(&self) -> &'static str {
        match self.system {
            System::BuiltIn("cell") => "cell",
            System::BuiltIn(_) => "tensor model",
            System::Text(_) => "random equations",
        }
    }

    pub(crate) fn parameter(&self, name: &str) -> f64 {
        self.set.iter().find(|(known, _)| known == name).map_or(0.0, |entry| entry.1)
    }
}

/// Places in the plane (kappa2, gamma) of the reduced model: every region of its analytic diagram.
const REDUCED: [(f64, f64); 10] = [
    (-0.10, 0.10),
    (-0.14, 0.05),
    (-0.10, -0.0375),
    (-0.02, -0.044),
    (-0.20, -0.1),
    (0.06, -0.05),
    (0.02, 0.05),
    (0.10, 0.05),
    (0.22, 0.1),
    (-0.06, 0.02),
];

/// Places in the plane (kappa2, kappa3) of the full model: steady motions, zigzags, chaos, their neighbourhood.
const FULL: [(f64, f64); 12] = [
    (0.3, 1.0),
    (1.4, 1.0),
    (0.5, 0.4),
    (1.2, 0.4),
    (0.9, 0.1),
    (0.75, 0.1),
    (0.728, 0.1),
    (0.6, 0.1),
    (0.5, 0.1),
    (1.14, 0.1),
    (1.3, 0.1),
    (1.11, 0.105),
];

/// Lengths of the cell: its windows, the gaps between them, and beside its bifurcations.
const LENGTHS: [f64; 16] =
    [6.1, 8.0, 11.0, 12.2, 12.297, 12.6, 12.9, 13.2, 13.5, 14.5, 16.0, 20.0, 21.8, 22.1, 26.0, 29.6];

/// Systems of random equations.
const TEXTS: u64 = 28;

pub(crate) fn subjects() -> Vec<Subject> {
    let set =
        |pairs: &[(&str, f64)]| pairs.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let tensor = System::BuiltIn("tensor");
    let reduced = REDUCED.iter().map(|&(kappa2, gamma)| Subject {
        name: format!("reduced kappa2 {kappa2} gamma {gamma}"),
        system: tensor.clone(),
        set: set(&[
            ("kappa2", kappa2),
            ("gamma", gamma),
            ("kappa3", 1.0),
            ("a1", 1.0),
            ("b1", 0.5),
            ("b3", 1.0),
        ]),
        seed: 1,
    });
    let full = FULL.iter().map(|&(kappa2, kappa3)| Subject {
        name: format!("full kappa2 {kappa2} kappa3 {kappa3}"),
        system: tensor.clone(),
        set: set(&[
            ("kappa2", kappa2),
            ("kappa3", kappa3),
            ("gamma", 1.0),
            ("a1", -1.0),
            ("b1", -0.5),
            ("b2", 0.3),
            ("d1", 0.1),
            ("d2", 0.8),
        ]),
        seed: 2,
    });
    let cells = LENGTHS.iter().map(|&length| Subject {
        name: format!("cell length {length}"),
        system: System::BuiltIn("cell"),
        set: set(&[("length", length)]),
        seed: 3,
    });
    let texts = (0..TEXTS).map(|seed| Subject {
        name: format!("random {seed}, {} modes", Text::modes(seed)),
        system: System::Text(Text::random(seed)),
        set: Vec::new(),
        seed: 4,
    });
    reduced.chain(full).chain(cells).chain(texts).collect()
}
