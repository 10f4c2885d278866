//! Physical units of length and time.

use crate::errors::of_keywords;
use motiform_study::{Dimension, Shown};
use pyo3::prelude::*;

/// A unit of length and one of time of a model.
#[pyclass(frozen, module = "motiform._motiform")]
pub(crate) struct Units(Shown);

#[pymethods]
impl Units {
    /// Units as study files and the command line give them, such as `20um,1min`; `None` of an empty text.
    #[staticmethod]
    fn parse(text: &str) -> PyResult<Option<Self>> {
        let shown = Shown::parse(text).map_err(of_keywords)?;
        Ok(shown.is_physical().then_some(Self(shown)))
    }

    /// The factor from model units to these, of a quantity with such powers of length and time.
    fn factor(&self, length: i8, time: i8) -> f64 {
        self.0.factor(Dimension::of(length, time))
    }

    /// The name of the unit of such a quantity.
    fn name(&self, length: i8, time: i8) -> String {
        self.0.name(Dimension::of(length, time), "")
    }
}
