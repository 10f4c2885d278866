//! The model and the start of one row: functions of the plan and the row's position alone.

use super::ScanPlan;
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
    /// that of a single run).
    ///
    /// # Errors
    /// [`Error::NotClosed`] for given values that do not describe a body; a given name that the model does not have here.
    pub fn start(&self, cell: usize, sample: usize, model: &dyn Model) -> Result<Vec<f64>, Error> {
        let c = &self.computation;
        if sample > 0 || c.initial.is_empty() {
            let stream = cell as u64 * c.samples as u64 + sample as u64 + 1;
            return Ok(c.random.shape(self.info()?, model, c.seed, stream));
        }
        let parameters = self.parameters_of(cell)?;
        let mut named = vec![0.0; model.coordinates().len()];
        for (name, value) in &c.initial.0 {
            named[self.info()?.coordinate(&parameters, name)?] = *value;
        }
        let mut shape = vec![0.0; model.dim()];
        model.encode(&named, &mut shape);
        check_closed(model, &shape)?;
        Ok(shape)
    }
}
