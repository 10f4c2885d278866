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

    /// The factor from model units to these, of a quantity with such powers of length and time, and an angle or none.
    #[pyo3(signature = (length, time, angle=false))]
    fn factor(&self, length: i8, time: i8, angle: bool) -> f64 {
        self.0.factor(Dimension::Powers { length, time, angle })
    }

    /// The name of the unit of such a quantity.
    #[pyo3(signature = (length, time, angle=false))]
    fn name(&self, length: i8, time: i8, angle: bool) -> String {
        self.0.name(Dimension::Powers { length, time, angle }, "")
    }

    /// The unit of a model for such a quantity, in words.
    #[staticmethod]
    #[pyo3(signature = (length, time, angle=false))]
    fn of_model(length: i8, time: i8, angle: bool) -> String {
        Dimension::Powers { length, time, angle }.words()
    }
}
