//! Shapes of the cell that are constant up to a steady rotation, continued in length: where their stability ends is
//! computed from their eigenvalues, not from runs.

use super::super::context::Context;
use super::lengths::study;
use motiform_analysis::{RelativeEquilibrium, SteadyMotion};
use motiform_dynamics::Model;
use motiform_study::Error;

/// First step in length, and the accuracy of an edge.
const STEP: (f64, f64) = (0.05, 1e-5);

/// Time in which a random start settles.
const SETTLE: f64 = 3000.0;

/// A family of steady shapes, one per length.
pub(crate) struct Branch {
    modes: usize,
    /// A length on it.
    pub(crate) length: f64,
    /// The shape there.
    pub(crate) shape: RelativeEquilibrium,
}

impl Branch {
    /// The shape that a random start settles on at `length`; an error names the length where it settles on none.
    pub(crate) fn settled(context: &Context<'_>, length: f64, modes: usize) -> Result<Self, Error> {
        let mut study = study(length, modes)?;
        study.run.transient = SETTLE;
        (study.run.t_end, study.run.dt_out) = (1.0, 1.0);
        let last = context.simulate(&study)?.manifest.state.values();
        let cell = cell(length, modes)?;
        let guess = cell.encoded(&last);
        let shape = RelativeEquilibrium::find(cell.as_ref(), &guess).ok_or_else(|| Error::Setting {
            key: "length",
            value: length.to_string(),
            remedy: "no steady shape was reached there: settle for longer",
        })?;
        Ok(Self { modes, length, shape })
    }

    /// The branches that random starts settle on at several lengths.
    pub(crate) fn all(context: &Context<'_>, places: &[(f64, usize)]) -> Result<Vec<Self>, Error> {
        context.each(places, |&(length, modes)| Self::settled(context, length, modes))
    }

    /// The same branch computed with other modes.
    pub(super) fn refined(&self, modes: usize) -> Result<Option<Self>, Error> {
        let mut guess = self.shape.shape.clone();
        guess.resize(2 * modes, 0.0);
        let found = RelativeEquilibrium::find(cell(self.length, modes)?.as_ref(), &guess);
        Ok(found.map(|shape| Self { modes, length: self.length, shape }))
    }

    /// The shape at a length near this one.
    pub(crate) fn at(&self, length: f64) -> Result<Option<Self>, Error> {
        let found = RelativeEquilibrium::find(cell(length, self.modes)?.as_ref(), &self.shape.shape);
        Ok(found.map(|shape| Self { modes: self.modes, length, shape }))
    }

    /// The model at its length.
    pub(crate) fn cell(&self) -> Result<Box<dyn Model>, Error> {
        cell(self.length, self.modes)
    }

    /// Follows the branch towards the length `end` while `keeps` is true; where it stops being so (or the branch ends).
    /// `None` if it is true up to `end`.
    pub(crate) fn edge(
        &self,
        end: f64,
        keeps: impl Fn(&dyn Model, &RelativeEquilibrium) -> bool,
    ) -> Result<Option<f64>, Error> {
        let mut here = Self { modes: self.modes, length: self.length, shape: self.shape.clone() };
        let mut step = STEP.0.copysign(end - self.length);
        while step.abs() > STEP.1 {
            let next = here.length + step;
            if (next - end) * step > 0.0 {
                return Ok(None);
            }
            match here.at(next)? {
                Some(branch) if keeps(branch.cell()?.as_ref(), &branch.shape) => here = branch,
                _ => step *= 0.5,
            }
        }
        Ok(Some(here.length + step))
    }

    /// Follows the branch while it is stable and of the same kind (number of folds, at rest or not).
    pub(crate) fn stable_until(&self, end: f64) -> Result<Option<f64>, Error> {
        let kind = |cell: &dyn Model, found: &RelativeEquilibrium| {
            let steady = SteadyMotion::of(cell, found);
            (steady.symmetry.folds, steady.moves())
        };
        let own = kind(self.cell()?.as_ref(), &self.shape);
        self.edge(end, |cell, found| found.is_stable() && kind(cell, found) == own)
    }

    /// The order of the rotations that leave its shape unchanged.
    pub(crate) fn folds(&self) -> Result<usize, Error> {
        Ok(SteadyMotion::of(self.cell()?.as_ref(), &self.shape).symmetry.folds)
    }
}

/// The cell of a length.
fn cell(length: f64, modes: usize) -> Result<Box<dyn Model>, Error> {
    let study = study(length, modes)?;
    Ok(study.info()?.build(&study.values()?)?)
}
