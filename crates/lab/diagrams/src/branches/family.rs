//! The bodies along a branch: one model, one of its parameters varied.

use motiform_analysis::equilibrium::Units;
use motiform_analysis::periodic::Flow;
use motiform_analysis::{Error as Refused, regime};
use motiform_continuation::{Allowance, Family, Settings};
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Equivariant, Model, StepControl};
use motiform_lab::analyse::settings_of;
use motiform_models::ModelInfo;
use motiform_study::{BranchPlan, Error, Stride};

/// Tolerance of the flow along orbits for models that need an exponential stepper.
const STIFF: StepControl = StepControl::Adaptive { rtol: 1e-10, atol: 1e-12 };

/// The bodies of a plan, by the value of its parameter.
pub(crate) struct Bodies<'p> {
    pub(crate) plan: &'p BranchPlan,
    info: &'static ModelInfo,
    method: Method,
    /// The units of the equations at the start.
    pub(crate) units: Units,
    allowance: Option<&'p Allowance>,
}

impl<'p> Bodies<'p> {
    pub(crate) fn new(plan: &'p BranchPlan) -> Result<Self, Error> {
        let method = motiform_study::plan::stepper(&plan.computation.start.stepper)?;
        let units = Units { length: 1.0, rate: 1.0 };
        let mut bodies = Self { plan, info: plan.info()?, method, units, allowance: None };
        if let Ok(model) = bodies.model(plan.start_value()) {
            bodies.units = Units::of(model.as_ref());
        }
        Ok(bodies)
    }

    /// The same; on orbits no more is spent than this.
    pub(crate) fn within(self, allowance: Option<&'p Allowance>) -> Self {
        Self { allowance, ..self }
    }

    /// Returns `true` if no more than an allowance is spent.
    pub(crate) const fn is_bounded(&self) -> bool {
        self.allowance.is_some()
    }

    /// Returns `true` if the work that is allowed is done.
    pub(crate) fn is_spent(&self) -> bool {
        self.allowance.is_some_and(Allowance::is_spent)
    }

    /// The model at a value of the parameter.
    pub(crate) fn model(&self, parameter: f64) -> Result<Box<dyn Model>, Refused> {
        self.info
            .build(&self.plan.parameters_at(parameter))
            .map_err(|error| Refused::NoBody { value: parameter, why: error.to_string() })
    }

    /// Settings of branches, first towards larger values.
    pub(crate) fn settings(&self) -> Settings {
        let c = &self.plan.computation;
        let mut settings = Settings::over(c.along.from, c.along.to);
        settings.most_points = c.points;
        settings.largest_size = c.start.escape_norm * self.units.length;
        settings.longest_time = LOOKS * self.look();
        let Stride { first_step, branch_step, tolerance, steady, .. } = c.stride;
        settings.steady = steady;
        settings.first_step = first_step.unwrap_or(settings.first_step);
        settings.largest_step = branch_step.unwrap_or(settings.largest_step);
        settings.tolerance = tolerance.unwrap_or(settings.tolerance);
        if matches!(self.method, Method::Exponential(_)) {
            settings.flow = Flow { method: self.method, control: STIFF, max_steps: settings.flow.max_steps };
        }
        settings
    }

    /// The time in which the model's motions are looked at.
    pub(crate) fn look(&self) -> f64 {
        self.info.look_at(&self.plan.computation.start.parameters.values())
    }

    /// Settings by which the motion of the start is named and the path on an orbit is computed: the plan's own method.
    pub(crate) fn looks(&self) -> regime::Settings {
        let start = &self.plan.computation.start;
        let values = start.parameters.values();
        settings_of(self.info, &values, self.method, start.control, start.escape_norm, start.max_steps, 0.0)
    }
}

/// An orbit whose time is longer than so many looks of the model, and than so many times that of the first one of its branch, is followed
/// no further.
const LOOKS: f64 = 10.0;
const LONGER: f64 = 30.0;

/// The settings for a branch that begins with an orbit of this time, whatever the unit of time.
pub(crate) fn lasting(settings: &Settings, time: f64) -> Settings {
    Settings { longest_time: settings.longest_time.max(LONGER * time), ..*settings }
}

impl Family for Bodies<'_> {
    fn at(&self, parameter: f64) -> Result<Box<dyn Equivariant>, Refused> {
        let model: Box<dyn Equivariant> = self.model(parameter)?;
        Ok(model)
    }

    fn allowance(&self) -> Option<&Allowance> {
        self.allowance
    }
}
