//! The plan of an atlas: exactly the numbers that its cells and lines depend on.

use crate::branches::{Along, BRANCH_FORMAT, BranchComputation, BranchSettings};
use crate::curves::{CURVE_FORMAT, CurveComputation, CurveKind};
use crate::described::settings;
use crate::plan::{Computation, Named, Plan, Question, check, stepper};
use crate::scan::{Axis, ScanComputation};
use crate::{BranchPlan, CurvePlan, Error, ScanPlan, Stride, Study};
use motiform_analysis::Regime;
use motiform_dynamics::sample::ascending;
use motiform_dynamics::steppers::Method;
use motiform_models::ModelName;
use motiform_store::Kind;
use serde::{Deserialize, Serialize};

/// Version of the meaning of a plan; part of the hash.
pub const ATLAS_FORMAT: u32 = 4;

/// Steps of the flow along orbits that a line may take, a few seconds of them. The lines of the plane of the
/// paper's Fig. 4 take up to half of it; curves on which orbits come
/// close to a connection, with periods ten times those at their start, take any number.
const LINE_STEPS: u64 = 1_000_000;

/// Values of an axis whose number is not given: of models that are classified in the lanes of vector
/// registers, and of others.
const VALUES: [usize; 2] = [65, 17];

/// Initial states of each cell, if nobody says how many.
const SAMPLES: u64 = 3;

/// An axis of a plane from text, as [`Axis::parse`] reads it, or by its ends alone, `NAME=LOW:HIGH`: the
/// number of values is then that of the model.
///
/// # Errors
/// [`Error::Axis`].
pub fn axis(text: &str) -> Result<Axis, Error> {
    if text.matches(':').count() != 1 {
        let axis = Axis::parse(text)?;
        if axis.values.len() == 2 && text.contains(',') {
            let problem =
                "two values are the ends of an axis: give NAME=LOW:HIGH or NAME=LOW:HIGH:COUNT".to_owned();
            return Err(Error::Axis { text: text.to_owned(), problem });
        }
        return Ok(axis);
    }
    let Along { name, from, to } = Along::parse(text)?;
    Ok(Axis { name, values: vec![from, to] })
}

/// Initial states of each cell: those asked for, or those of the study.
pub fn samples(study: &Study, asked: Option<u64>) -> u64 {
    match (asked, study.scan.samples) {
        (Some(asked), _) => asked,
        (None, 1) => SAMPLES,
        (None, own) => own,
    }
}

settings! {
    /// The lines of an atlas, along which motions are followed.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub struct AtlasSettings {
        /// Most lines across boundaries along which motions are followed, by default 24, at most 1000; 0 follows none.
        pub lines: u64,
        /// Most branches on each line, by default 4.
        pub branches: u64,
        /// Follow steady motions alone, not the orbits that begin at Hopf points (by default so for stiff models).
        pub steady: Option<bool>,
    }
}

impl Default for AtlasSettings {
    fn default() -> Self {
        Self { lines: 24, branches: 4, steady: None }
    }
}

/// The plan of an atlas.
pub type AtlasPlan = Plan<AtlasComputation>;

/// Everything that the numbers depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AtlasComputation {
    /// [`ATLAS_FORMAT`].
    pub format: u32,
    /// The finest grid.
    pub scan: ScanComputation,
    /// Most lines.
    pub lines: usize,
    /// Most branches on a line.
    pub branches: usize,
    /// Most steps of the flow along the orbits of a line.
    pub line_steps: u64,
    /// Steps along branches.
    pub stride: Stride,
    /// A start in the plane: lines have its method, and their own parameters and initial states. Its tolerances and bounds are those of
    /// the scan: at the middle alone terms may vanish that give the equations their unit.
    pub start: Computation,
}

impl Question for AtlasComputation {
    type Figure = ();
    const KIND: Kind = Kind::Atlas;
    const KEY: &'static str = "atlas";

    fn value(&self) -> serde_json::Value {
        serde_json::to_value(self).unwrap_or_default()
    }

    fn model(&self) -> &ModelName {
        &self.scan.model
    }

    fn title(&self, name: &str) -> String {
        self.scan.title(name)
    }

    fn stated(&self) -> Vec<(&'static str, String)> {
        vec![("scan.axes", self.scan.axes_in_words())]
    }
}

impl AtlasPlan {
    /// Makes a study explicit whose scan has two axes, and checks every number. Without axes the plane is
    /// that of the study's display.
    ///
    /// # Errors
    /// [`Error`] naming the key, the value and the remedy.
    pub fn new(study: &Study) -> Result<Self, Error> {
        let (mut study, settings) = (study.clone(), &study.atlas);
        let whole = |count: u64| usize::try_from(count).unwrap_or(usize::MAX);
        let method = stepper(&study.run.stepper)?;
        let stiff = matches!(method, Method::Exponential(_));
        let axes =
            if study.scan.axes.is_empty() { study.display.plane.clone() } else { study.scan.axes.clone() };
        let [first, second] = &axes[..] else {
            let text = axes.first().map_or_else(String::new, |axis| axis.name.clone());
            let problem =
                "an atlas has two parameters: give two axes, NAME=LOW:HIGH or NAME=LOW:HIGH:COUNT".to_owned();
            return Err(Error::Axis { text, problem });
        };
        study.scan.axes = [first, second]
            .into_iter()
            .map(|axis| even(axis, VALUES[usize::from(stiff)]))
            .collect::<Result<_, _>>()?;
        check("lines", settings.lines as f64, settings.lines <= 1000, "give at most 1000 lines")?;
        for axis in study.scan.axes.clone() {
            study.set(&axis.name, middle(&axis))?;
        }
        let steady = settings.steady.unwrap_or(stiff);
        let stride = Stride { steady, ..Stride::default() };
        let mut start = None;
        for axis in &study.scan.axes {
            let settings = BranchSettings {
                branches: whole(settings.branches),
                stride,
                ..BranchSettings::over(along(axis))
            };
            start = Some(BranchPlan::new(&study, &settings)?.computation.start);
        }
        let ScanPlan { name, title, computation: scan, .. } = ScanPlan::new(&study)?;
        let Some(start) = start else { return Err(Error::NoAxis { free: String::new() }) };
        let start = Computation { control: scan.control, escape_norm: scan.escape_norm, ..start };
        let computation = AtlasComputation {
            format: ATLAS_FORMAT,
            scan,
            lines: whole(settings.lines),
            branches: whole(settings.branches),
            line_steps: LINE_STEPS,
            stride,
            start,
        };
        Ok(Self::of(&name, &title, computation))
    }

    /// The scan of its finest grid: a cell of the atlas has the rows of this scan.
    pub fn scan(&self) -> ScanPlan {
        ScanPlan::of(&self.name, &self.title, self.computation.scan.clone())
    }

    /// The plane, across and upwards.
    pub fn plane(&self) -> [Along; 2] {
        [0, 1].map(|side| along(&self.computation.scan.axes[side]))
    }

    /// A run from an initial state of a cell.
    ///
    /// # Errors
    /// Parameters that the model refuses.
    pub fn start(&self, scan: &ScanPlan, (cell, sample): (usize, usize)) -> Result<Computation, Error> {
        let model = scan.model_of(cell)?;
        let state = model.decoded(&scan.start(cell, sample, model.as_ref())?);
        let names = self.info()?.parameters().iter().map(|spec| spec.name.to_owned());
        let parameters = Named(names.zip(scan.parameters_of(cell)?).collect());
        let coordinates = model.coordinates().iter().map(|one| one.name.to_owned()).zip(state);
        let place = ["x", "y"].map(|name| (name.to_owned(), 0.0));
        let initial = Named(coordinates.chain(place).collect());
        Ok(Computation { parameters, initial, ..self.computation.start.clone() })
    }

    /// The branches along a side of the plane that begin with the motion of an initial state of a cell, and
    /// the curves through their special points.
    ///
    /// # Errors
    /// Parameters that the model refuses.
    pub fn line(
        &self,
        scan: &ScanPlan,
        (cell, sample): (usize, usize),
        side: usize,
    ) -> Result<CurvePlan, Error> {
        let c = &self.computation;
        let start = self.start(scan, (cell, sample))?;
        let branches = BranchComputation {
            format: BRANCH_FORMAT,
            along: window(&c.scan.axes[side], scan.axis_values(cell)[side]),
            origin: None::<Regime>,
            points: POINTS,
            branches: c.branches,
            samples: 0,
            stride: c.stride,
            given: None,
            ties: c.scan.ties.clone(),
            start,
        };
        let computation = CurveComputation {
            format: CURVE_FORMAT,
            kinds: CurveKind::ALL.to_vec(),
            plane: self.plane(),
            branches,
        };
        Ok(CurvePlan::of(&self.name, "", computation))
    }
}

/// Most points of a branch or curve to each side.
const POINTS: usize = 400;

/// The reach of a line to both sides of its start, as a part of the range: the boundary that it is for is next to it.
const REACH: f64 = 0.15;

fn middle(axis: &Axis) -> f64 {
    let Along { from, to, .. } = along(axis);
    0.5 * from + 0.5 * to
}

/// The part of an axis around a value.
fn window(axis: &Axis, value: f64) -> Along {
    let Along { name, from, to } = along(axis);
    let width = REACH * (to - from);
    Along { name, from: from.max(value - width), to: to.min(value + width) }
}

/// The range of an axis.
fn along(axis: &Axis) -> Along {
    let (from, to) = axis
        .values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)));
    Along { name: axis.name.clone(), from, to }
}

/// Largest distance of a value from its place among evenly spaced ones, as a part of the range.
const UNEVEN: f64 = 1e-6;

/// The axis with evenly spaced, rising values; one that has its two ends alone gets `count` of them.
fn even(axis: &Axis, count: usize) -> Result<Axis, Error> {
    let Along { name, from, to } = along(axis);
    let refuse = |problem: &str| Err(Error::Axis { text: axis.name.clone(), problem: problem.to_owned() });
    let last = axis.values.len().saturating_sub(1).max(1) as f64;
    let off = |(place, value): (usize, &f64)| (value - from - (to - from) * place as f64 / last).abs();
    if axis.values.len() < 2 {
        return refuse(
            "an atlas needs two values or more along each axis: give NAME=LOW:HIGH or NAME=LOW:HIGH:COUNT",
        );
    }
    let mut rising = axis.values.clone();
    ascending(&mut rising);
    if rising.iter().enumerate().map(off).any(|off| off > UNEVEN * (to - from).abs()) {
        return refuse(
            "the values of an atlas rise in equal steps: give NAME=LOW:HIGH:COUNT (a scan takes any list)",
        );
    }
    let count = if axis.values.len() == 2 { count } else { axis.values.len() };
    let last = count.saturating_sub(1).max(1);
    let value = |place: usize| {
        let part = place as f64 / last as f64;
        if place == last { to } else { from * (1.0 - part) + to * part }
    };
    Ok(Axis { name, values: (0..count).map(value).collect() })
}
