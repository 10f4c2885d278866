//! The model and the start of one row: functions of the plan and the row's position alone.

use super::{Axis, ScanPlan};
use crate::Error;
use crate::plan::check_closed;
use motiform_dynamics::Model;

impl ScanPlan {
    /// The model of a cell.
    ///
    /// # Errors
    /// Parameters that the model rejects.
    pub fn model_of(&self, cell: usize) -> Result<Box<dyn Model>, Error> {
        Ok(self.info()?.build(&self.parameters_of(cell)?)?)
    }

    /// The initial shape of a row, in the representation of `model`: the given values for sample 0, if any; otherwise drawn
    /// from the plan's distribution ([`crate::Random`]) by the generator's stream `cell * samples + sample + 1` (stream 0 is
    /// that of a single run). Coordinates on the axes have the values of the cell.
    ///
    /// # Errors
    /// [`Error::NotClosed`] for given values that do not describe a body; a given name that the model does not have here.
    pub fn start(&self, cell: usize, sample: usize, model: &dyn Model) -> Result<Vec<f64>, Error> {
        let c = &self.computation;
        let on_axes = self.start_on_axes(cell)?;
        let mut coordinates = vec![0.0; model.coordinates().len()];
        if sample > 0 || self.draws_first()? {
            let stream = cell as u64 * c.samples as u64 + sample as u64 + 1;
            let shape = c.random.shape(self.info()?, model, c.seed, stream);
            if on_axes.is_empty() {
                return Ok(shape);
            }
            model.decode(&shape, &mut coordinates);
        }
        let parameters = self.parameters_of(cell)?;
        let given = if sample == 0 { c.initial.0.as_slice() } else { &[] };
        for (name, value) in given.iter().chain(&on_axes) {
            coordinates[self.info()?.coordinate(&parameters, name)?] = *value;
        }
        let shape = model.encoded(&coordinates);
        check_closed(model, &shape)?;
        Ok(shape)
    }

    /// Returns `true` if sample 0 is drawn at random: nothing is given of it, and no axis varies the start.
    ///
    /// # Errors
    /// An unknown model.
    pub fn draws_first(&self) -> Result<bool, Error> {
        Ok(self.computation.initial.is_empty() && !self.varies_start()?)
    }

    /// Returns `true` if an axis is a coordinate of the start: the scan is a map of basins.
    ///
    /// # Errors
    /// An unknown model.
    pub fn varies_start(&self) -> Result<bool, Error> {
        Ok(!self.start_on_axes(0)?.is_empty())
    }

    /// The coordinates of the start that the axes give in a cell.
    fn start_on_axes(&self, cell: usize) -> Result<Vec<(String, f64)>, Error> {
        let parameters = self.info()?.parameters();
        let start = |axis: &Axis| parameters.iter().all(|spec| spec.name != axis.name);
        let axes = self.computation.axes.iter().zip(self.axis_values(cell));
        Ok(axes.filter(|(axis, _)| start(axis)).map(|(axis, value)| (axis.name.clone(), value)).collect())
    }
}
