//! Branches as data: which motion is followed, along which parameter, how far.

use crate::plan::{Computation, Plan, Question, RunPlan, check, check_no_noise};
use crate::scan::Axis;
use crate::titles::capital;
use crate::{Error, Given, Stride, Study, Ties, UnitSettings};
use motiform_analysis::Regime;
use motiform_models::parameters::index_of;
use motiform_models::spelling::ascii;
use motiform_models::{ModelInfo, ModelName};
use motiform_store::Kind;
use serde::{Deserialize, Serialize};

/// Version of the meaning of a plan of branches; part of the hash. A change that moves a number raises it.
pub const BRANCH_FORMAT: u32 = 3;

/// The regimes that are steady or repeat: motions that can be followed.
pub const FOLLOWED: [Regime; 7] = [
    Regime::Motionless,
    Regime::Straight,
    Regime::Circular,
    Regime::Spinning,
    Regime::Zigzag,
    Regime::QuasiPeriodic,
    Regime::PulsatingStraight,
];

/// A parameter that is varied, with its range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Along {
    /// The parameter.
    pub name: String,
    /// Beginning of the range.
    pub from: f64,
    /// End of the range, above its beginning.
    pub to: f64,
}

/// Which branches are followed.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchSettings {
    /// The parameter and its range.
    pub along: Along,
    /// The motion that the start must settle on; any that can be followed, if `None`.
    pub origin: Option<Regime>,
    /// Most points of a branch to each side, special ones not counted.
    pub points: usize,
    /// Most branches; 1 follows the motion itself and none that begins on it.
    pub branches: usize,
    /// Values of the parameter at which motions are sampled, swept upwards and downwards; 0 for none.
    pub samples: usize,
    /// Steps, tolerance, sides, and whether orbits are followed.
    pub stride: Stride,
    /// The kind of the start, if it was taken from an earlier result; otherwise it is simulated.
    pub given: Option<Given>,
}

impl BranchSettings {
    /// The defaults: the motion that the start settles on and what begins on its branch, to both sides.
    pub fn over(along: Along) -> Self {
        let stride = Stride::default();
        Self { along, origin: None, points: 2000, branches: 8, samples: 0, stride, given: None }
    }
}

/// The plan of branches.
pub type BranchPlan = Plan<BranchComputation>;

/// Everything that the numbers depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BranchComputation {
    /// [`BRANCH_FORMAT`].
    pub format: u32,
    /// The parameter and its range.
    pub along: Along,
    /// The motion that the start must settle on.
    pub origin: Option<Regime>,
    /// Most points to each side.
    pub points: usize,
    /// Most branches.
    pub branches: usize,
    /// Values of the parameter at which motions are sampled; 0 for none.
    #[serde(default, skip_serializing_if = "is_none")]
    pub samples: usize,
    /// Steps, tolerance, sides, and whether orbits are followed.
    #[serde(default, skip_serializing_if = "Stride::is_default")]
    pub stride: Stride,
    /// The kind of the start, if it was taken from an earlier result; otherwise it is simulated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub given: Option<Given>,
    /// Parameters that follow from others.
    #[serde(default, skip_serializing_if = "Ties::is_empty")]
    pub ties: Ties,
    /// The start: model, parameters, initial state, method.
    pub start: Computation,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
const fn is_none(count: &usize) -> bool {
    *count == 0
}

impl Along {
    /// Reads `NAME=LOW:HIGH`.
    ///
    /// # Errors
    /// [`Error::Along`] with the remedy.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let read = || {
            let (name, range) = text.split_once('=')?;
            let (from, to) = range.split_once(':')?;
            let (from, to): (f64, f64) = (from.trim().parse().ok()?, to.trim().parse().ok()?);
            let name = ascii(name.trim());
            (!name.is_empty() && from.is_finite() && to.is_finite()).then_some(Self { name, from, to })
        };
        read().ok_or_else(|| wrong(text.to_owned(), "write NAME=LOW:HIGH, e.g. kappa2=0.3:1.6".to_owned()))
    }

    pub(crate) fn check(&self, info: &'static ModelInfo, value: f64) -> Result<(), Error> {
        let spec = &info.parameters()[index_of(info.parameters(), info.name, &self.name)?];
        let refuse = |problem: String| Err(wrong(self.to_string(), problem));
        let (from, to, (min, max)) = (self.from, self.to, spec.allowed);
        if spec.whole {
            return refuse(format!("{} is a whole number: nothing can be followed along it", self.name));
        }
        if from >= to {
            return refuse("the range must rise: give LOW below HIGH".to_owned());
        }
        if from < min || to > max {
            return refuse(format!("{} can be from {min} to {max}: give a range inside", self.name));
        }
        if !(from..=to).contains(&value) {
            let name = &self.name;
            return refuse(format!(
                "the start, {name} = {value}, is outside: give a range that holds it, or a value of {name} inside"
            ));
        }
        Ok(())
    }
}

impl Along {
    /// It for people: `kappa2 = 0.3 to 1.6`.
    pub fn words(&self) -> String {
        let [from, to] = [self.from, self.to].map(motiform_dynamics::digits::given);
        format!("{} = {from} to {to}", self.name)
    }
}

/// As it is typed.
impl std::fmt::Display for Along {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}={}:{}", self.name, self.from, self.to)
    }
}

fn wrong(text: String, problem: String) -> Error {
    Error::Along { text, problem }
}

/// Refuses a kind of motion beside a motion that is known.
fn check_known(origin: Option<Regime>, given: Option<Given>) -> Result<(), Error> {
    match origin {
        Some(regime) if given.is_some_and(Given::is_motion) => Err(Error::Setting {
            key: "from",
            value: regime.name().to_owned(),
            remedy: "the start is a motion that is known, whose kind needs no check: leave this out",
        }),
        _ => Ok(()),
    }
}

/// The regime of a kind of start.
///
/// # Errors
/// [`Error::UnknownName`] for a name that is none, or that of a motion that cannot be followed.
pub fn origin(name: &str) -> Result<Regime, Error> {
    let known = FOLLOWED.map(Regime::name);
    FOLLOWED.into_iter().find(|regime| regime.name() == name).ok_or_else(|| {
        let choice = format!("the motions that can be followed are {}", known.join(", "));
        Error::unknown("start", name, &known, choice)
    })
}

impl BranchPlan {
    /// Makes a study and the settings explicit and checks every number.
    ///
    /// # Errors
    /// [`Error`] naming the key, the value and the remedy.
    pub fn new(study: &Study, settings: &BranchSettings) -> Result<Self, Error> {
        let BranchSettings { along, origin, points, branches, samples, stride, given } = settings.clone();
        let plan = RunPlan::new(study)?;
        let start = plan.computation;
        check_no_noise(start.noise.map_or(0.0, |noise| noise.largest()))?;
        let info = study.info()?;
        let value = start.parameters.get(&along.name).unwrap_or(f64::NAN);
        along.check(info, value)?;
        study.ties.check_free([along.name.as_str()])?;
        stride.check(value, (along.from, along.to))?;
        check_known(origin, given)?;
        check("points", points as f64, (2..=1_000_000).contains(&points), "give from 2 to 1000000")?;
        check("branches", branches as f64, (1..=1000).contains(&branches), "give from 1 to 1000")?;
        let some = samples == 0 || (2..=100_000).contains(&samples);
        check(
            "samples",
            samples as f64,
            some,
            "give from 2 to 100000 values of the parameter, or 0 for none",
        )?;
        // at the start alone terms may vanish that give the equations their unit
        let ends = Axis { name: along.name.clone(), values: vec![along.from, along.to] };
        let start = RunPlan::over(study, &[ends])?.computation;
        let format = BRANCH_FORMAT;
        let ties = study.ties.clone();
        let computation = BranchComputation {
            format,
            along,
            origin,
            points,
            branches,
            samples,
            stride,
            given,
            ties,
            start,
        };
        let figure = UnitSettings { units: study.figure.units.clone() };
        Ok(Self { figure, ..Self::of(&plan.name, &plan.title, computation) })
    }

    /// The value of the varied parameter at the start.
    pub fn start_value(&self) -> f64 {
        self.computation.start.parameters.get(&self.computation.along.name).unwrap_or(f64::NAN)
    }

    /// The parameters with the varied one at `value`, in registry order.
    pub fn parameters_at(&self, value: f64) -> Vec<f64> {
        let c = &self.computation;
        c.parameters_with(|name| (name == c.along.name).then_some(value))
    }
}

impl Question for BranchComputation {
    type Figure = UnitSettings;
    const KIND: Kind = Kind::Branches;
    const KEY: &'static str = "branches";

    fn value(&self) -> serde_json::Value {
        serde_json::to_value(self).unwrap_or_default()
    }

    fn model(&self) -> &ModelName {
        &self.start.model
    }

    fn title(&self, _: &str) -> String {
        let specs = self.model().info().map_or(&[][..], ModelInfo::parameters);
        let symbol = specs.iter().find(|spec| spec.name == self.along.name).map_or("", |spec| spec.symbol);
        format!("{} model: branches along {symbol}", capital(self.model().as_str()))
    }
}

impl BranchComputation {
    /// The parameters, in registry order: of those that vary the given values, of tied ones those that follow.
    pub(crate) fn parameters_with(&self, varied: impl Fn(&str) -> Option<f64>) -> Vec<f64> {
        let entries = self.start.parameters.0.iter();
        let mut values: Vec<f64> = entries.map(|(name, fixed)| varied(name).unwrap_or(*fixed)).collect();
        self.ties.apply(self.start.model.info().map_or(&[], ModelInfo::parameters), &mut values);
        values
    }
}
