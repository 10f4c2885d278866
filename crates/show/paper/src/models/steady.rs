//! A steady shape of either model, with the properties that name it.

use super::super::context::Context;
use motiform_analysis::equilibrium::Saddle;
use motiform_analysis::symmetry::align;
use motiform_analysis::{Estimate, RelativeEquilibrium, SteadyMotion};
use motiform_dynamics::Model;
use motiform_study::{Error, RunPlan, Study};

/// The properties of a steady shape.
#[derive(Clone)]
pub(super) struct Steady {
    /// Its motion (translation, rotation), and its symmetry.
    pub(super) motion: SteadyMotion,
    /// Size of the deformation (norm of the state).
    pub(super) size: f64,
    /// The distance of the shape from its mirror image, against its size.
    pub(super) asymmetry: f64,
    /// Leading eigenvalue.
    pub(super) growth: Estimate,
    /// The rates of a saddle.
    pub(super) saddle: Option<Saddle>,
}

impl Steady {
    /// As [`Steady::followed`], on the way to the claims.
    pub(super) fn along(context: &Context<'_>, name: &str, studies: &[Study]) -> Result<Option<Self>, Error> {
        let found = context.kept.once(&format!("steady: {name}"), || Self::followed(context, studies))?;
        let change = |s: Self| {
            let mut motion = s.motion;
            motion.speed = context.estimate(motion.speed);
            motion.turning_rate = context.estimate(motion.turning_rate);
            let saddle = |rates: Saddle| Saddle {
                out: context.number(rates.out),
                inward: context.number(rates.inward),
                ..rates
            };
            Self { motion, growth: context.estimate(s.growth), saddle: s.saddle.map(saddle), ..s }
        };
        Ok(found.map(change))
    }

    /// Returns `true` if every deviation decays, beyond the error of the leading eigenvalue.
    pub(super) fn is_stable(&self) -> bool {
        self.growth.value < -self.growth.error
    }

    /// The shape that a random start settles on at the first study, followed through the others by Newton's method.
    fn followed(context: &Context<'_>, studies: &[Study]) -> Result<Option<Self>, Error> {
        let Some(first) = studies.first() else { return Ok(None) };
        let mut run = first.clone();
        run.run.transient = 3000.0;
        (run.run.t_end, run.run.dt_out) = (1.0, 1.0);
        run.return_map = None;
        let last = context.simulate(&run)?.manifest.state.values();
        let mut found: Option<(RelativeEquilibrium, Self)> = None;
        for study in studies {
            let plan = RunPlan::new(study)?;
            let model = plan.body()?;
            let mut guess = vec![0.0; model.dim()];
            match &found {
                Some((before, _)) => guess.clone_from(&before.shape),
                None => model.encode(&last, &mut guess),
            }
            let Some(shape) = RelativeEquilibrium::find(model.as_ref(), &guess) else { return Ok(None) };
            let steady = Self::at(model.as_ref(), &shape);
            found = Some((shape, steady));
        }
        Ok(found.map(|entry| entry.1))
    }

    fn at(model: &dyn Model, found: &RelativeEquilibrium) -> Self {
        let motion = SteadyMotion::of(model, found);
        let size = found.shape.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mirror = align(model, &found.shape, &found.shape, true).distance;
        Self {
            motion,
            size,
            asymmetry: if motion.symmetry.circle { 0.0 } else { mirror / size },
            growth: Estimate { value: found.growth(), error: found.growth_error() },
            saddle: found.saddle(model),
        }
    }
}
