//! A steady shape of either model, with the properties that name it.

use super::super::context::Context;
use motiform_analysis::RelativeEquilibrium;
use motiform_analysis::symmetry::align;
use motiform_study::{Error, Plan, Study};

/// What is known of a steady shape.
#[derive(Clone)]
pub(super) struct Steady {
    /// Size of the deformation (norm of the state).
    pub(super) size: f64,
    pub(super) speed: f64,
    pub(super) turning: f64,
    /// How far the shape is from its mirror image, against its size.
    pub(super) asymmetry: f64,
    /// Leading eigenvalue.
    pub(super) growth: f64,
    /// `lambda_+` and `lambda_-`, for a saddle.
    pub(super) saddle: Option<(f64, f64)>,
}

impl Steady {
    /// As [`Steady::followed`], on the way to the claims.
    pub(super) fn along(context: &Context<'_>, name: &str, studies: &[Study]) -> Result<Option<Self>, Error> {
        let found = context.kept.once(&format!("steady: {name}"), || Self::followed(context, studies))?;
        let change = |s: Self| Self {
            size: context.number(s.size),
            speed: context.number(s.speed),
            turning: context.number(s.turning),
            asymmetry: context.number(s.asymmetry),
            growth: context.number(s.growth),
            saddle: s.saddle.map(|(out, inward)| (context.number(out), context.number(inward))),
        };
        Ok(found.map(change))
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
            let plan = Plan::new(study)?;
            let model = plan.body()?;
            let mut guess = vec![0.0; model.dim()];
            match &found {
                Some((before, _)) => guess.clone_from(&before.shape),
                None => model.encode(&last, &mut guess),
            }
            let Some(shape) = RelativeEquilibrium::find(model.as_ref(), &guess) else { return Ok(None) };
            let size = shape.shape.iter().map(|x| x * x).sum::<f64>().sqrt();
            let mirror = align(model.as_ref(), &shape.shape, &shape.shape, true).distance;
            let steady = Self {
                size,
                speed: shape.speed(),
                turning: shape.turning_rate,
                asymmetry: if size > 1e-8 { mirror / size } else { 0.0 },
                growth: shape.growth(),
                saddle: shape.saddle(model.as_ref()).map(|rates| (rates.out, rates.inward)),
            };
            found = Some((shape, steady));
        }
        Ok(found.map(|entry| entry.1))
    }
}
