//! The bodies over a plane of two parameters.

use crate::branches::family::Bodies;
use motiform_analysis::Error as Refused;
use motiform_continuation::{Allowance, Family2, Settings};
use motiform_dynamics::{Equivariant, Model};
use motiform_models::ModelInfo;
use motiform_study::{CurvePlan, Error};

/// The bodies of a plan. Pairs of parameters are in the order of the numerics: the parameter of the branches, then the other one.
pub(super) struct PlaneBodies<'p> {
    pub(super) plan: &'p CurvePlan,
    info: &'static ModelInfo,
    allowance: Option<&'p Allowance>,
}

impl<'p> PlaneBodies<'p> {
    pub(super) fn new(plan: &'p CurvePlan) -> Result<Self, Error> {
        Ok(Self { plan, info: plan.info()?, allowance: None })
    }

    /// The same; on orbits no more is spent than this.
    pub(super) fn within(self, allowance: Option<&'p Allowance>) -> Self {
        Self { allowance, ..self }
    }

    /// From the order of the numerics to that of the plane, across and upwards, and back.
    pub(super) fn oriented(plan: &CurvePlan, [first, second]: [f64; 2]) -> [f64; 2] {
        if plan.varied() == 0 { [first, second] } else { [second, first] }
    }

    pub(super) fn model(&self, parameters: [f64; 2]) -> Result<Box<dyn Model>, Refused> {
        let values = self.plan.parameters_at(Self::oriented(self.plan, parameters));
        self.info
            .build(&values)
            .map_err(|error| Refused::NoBody { value: parameters[1], why: error.to_string() })
    }

    /// Settings of curves, first towards larger values of the second parameter, and the range of that one.
    pub(super) fn settings(&self, bodies: &Bodies<'_>) -> (Settings, (f64, f64)) {
        let sides = &self.plan.computation.plane;
        let [first, second] = [self.plan.varied(), 1 - self.plan.varied()].map(|side| &sides[side]);
        let settings = Settings { range: (first.from, first.to), ..bodies.settings() };
        (settings, (second.from, second.to))
    }
}

impl Family2 for PlaneBodies<'_> {
    fn at(&self, parameters: [f64; 2]) -> Result<Box<dyn Equivariant>, Refused> {
        let model: Box<dyn Equivariant> = self.model(parameters)?;
        Ok(model)
    }

    fn allowance(&self) -> Option<&Allowance> {
        self.allowance
    }
}
