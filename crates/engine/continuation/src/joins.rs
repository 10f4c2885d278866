//! The relation of the saddles of a connection.

use super::homoclinic::rounding;
use motiform_analysis::RelativeEquilibrium;
use serde::{Deserialize, Serialize};

motiform_dynamics::named! {
    /// The relation of the saddles that an orbit passes in its period.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Joins by name {
        /// It is one saddle, up to rotations: a homoclinic connection.
        Itself = "itself",
        /// They are mirror images: a heteroclinic connection of a saddle with its image.
        Images = "images",
        /// They differ: a heteroclinic cycle.
        Different = "different",
    }
}

/// The words of what a saddle is connected with.
pub(super) const fn words(joins: Option<Joins>) -> &'static str {
    match joins {
        Some(Joins::Images) => " with its mirror image",
        Some(Joins::Itself) => " with itself",
        Some(Joins::Different) | None => "",
    }
}

/// A saddle of a heteroclinic cycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Passed {
    /// The saddle.
    pub saddle: RelativeEquilibrium,
    /// Its slowest eigenvalues `(re, |im|)` that grow and that decay, in the directions that keep the symmetry of the orbit's shapes.
    pub sides: [(f64, f64); 2],
    /// The part of the time that passes near it.
    pub share: f64,
}

impl Passed {
    /// The saddle quantity: the sum of the real parts of the slowest eigenvalues.
    pub fn quantity(&self) -> f64 {
        self.sides[0].0 + self.sides[1].0
    }

    /// Bound of its error.
    pub fn quantity_error(&self) -> f64 {
        rounding(self.sides)
    }
}
