//! Perturbation of given starts that breaks exact symmetry: coordinates left at zero get small random values.

use crate::initial::Uniform;
use crate::plan::check;
use crate::{Error, Study};
use std::fmt;

/// Stream of the generator: far from those of random starts and of noise.
const STREAM: u64 = u64::MAX / 2;

/// The perturbation of a given start.
#[derive(Clone, Debug, PartialEq)]
pub struct Perturbation {
    /// The coordinates that were zero.
    pub names: Vec<String>,
    /// Their new values lie within plus and minus this.
    pub size: f64,
}

impl fmt::Display for Perturbation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.names.len();
        // to three digits: a product with a power of ten has sixteen
        let size: f64 = format!("{:.2e}", self.size).parse().unwrap_or(self.size);
        let names = if count > 6 { format!("{count} coordinates") } else { self.names.join(", ") };
        write!(
            f,
            "{names} left at zero: random values within +-{size:e} instead, because an orbit never leaves an exact symmetry"
        )
    }
}

impl Study {
    /// The default of `perturb`.
    pub const PERTURB: f64 = 1e-6;

    /// The same study, with a small random value for each coordinate that its given start leaves at zero: uniform within
    /// `perturb` times the largest value given (1 where all are zero). `None` with it if nothing was changed: no start is given,
    /// none of its coordinates is zero, or `perturb` is 0.
    ///
    /// The flow preserves the symmetry of a start. A mirror symmetric start, a pure mode, or a circle may end at an unstable shape that
    /// no other
    /// start leads to. Coordinates that a model has only at some values of the scan's axes are not changed.
    ///
    /// # Errors
    /// A `perturb` below 0; parameters that the model rejects.
    ///
    /// # Checked by  tests/all/perturbation.rs
    pub fn perturbed(&self) -> Result<(Self, Option<Perturbation>), Error> {
        check("initial.perturb", self.perturb, self.perturb >= 0.0, "give a size of at least 0")?;
        let info = self.info()?;
        let given = |name: &str| self.initial.iter().find(|(known, _)| known == name).map(|entry| entry.1);
        let coordinates = info.coordinates(&self.values()?);
        let values: Vec<f64> = coordinates.iter().filter_map(|coordinate| given(coordinate.name)).collect();
        if values.is_empty() || self.perturb == 0.0 {
            return Ok((self.clone(), None));
        }
        let largest = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let size = self.perturb * if largest > 0.0 { largest } else { 1.0 };
        let corners = self.values_over(&self.scan.axes)?;
        let mut random = Uniform::new(self.run.seed, STREAM);
        let (mut study, mut names) = (self.clone(), Vec::new());
        for coordinate in coordinates {
            let value = size * random.draw();
            let everywhere = corners.iter().all(|values| info.coordinate(values, coordinate.name).is_ok());
            if given(coordinate.name).unwrap_or(0.0) == 0.0 && everywhere {
                study.set_initial(coordinate.name, value)?;
                names.push(coordinate.name.to_owned());
            }
        }
        let perturbation = (!names.is_empty()).then_some(Perturbation { names, size });
        Ok((study, perturbation))
    }
}
