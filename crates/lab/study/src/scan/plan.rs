//! The plan of a scan: exactly the numbers that its rows depend on.

use super::Axis;
use crate::plan::{
    Control, Named, Plan, Question, check, check_no_noise, check_stability, check_steps, control,
    escape_norm, stepper,
};
use crate::random::Random;
use crate::{Error, Perturbation, Scales, Study, Ties, UnitSettings};
use motiform_dynamics::steppers::Method;
use motiform_models::{ModelInfo, ModelName, parameters};
use motiform_store::Kind;
use serde::{Deserialize, Serialize};

/// Version of a scan's numbers; part of the hash. Raised whenever a plan's meaning or a row's bits change
/// (tests/all/scan/bits.rs notices), so that no
/// folder ever contains rows of two programs that compute differently.
pub const SCAN_FORMAT: u32 = 14;

/// Maximum number of cells of a scan, and of initial states per cell.
const MOST: (usize, u64) = (100_000_000, 100_000);

/// Maximum number of cells and rows of a part: a kill loses little, and memory is bounded. About 256 parts if
/// there are fewer cells.
const PART: (usize, usize, usize) = (160, 4096, 256);

/// The plan of a scan.
pub type ScanPlan = Plan<ScanComputation>;

/// Everything that the rows depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScanComputation {
    /// [`SCAN_FORMAT`].
    pub format: u32,
    /// The model.
    pub model: ModelName,
    /// The parameters that no axis varies and that are not tied, in registry order.
    pub parameters: Named,
    /// Parameters that follow from others.
    #[serde(default, skip_serializing_if = "Ties::is_empty")]
    pub ties: Ties,
    /// One or two axes, each a parameter or a coordinate of the start; the first runs fastest.
    pub axes: Vec<Axis>,
    /// Initial states per cell.
    pub samples: usize,
    /// Seed of the random starts.
    pub seed: u64,
    /// The distribution of the random starts.
    pub random: Random,
    /// The start of sample 0 if given (values not named are 0); empty if that one is random too. Where an
    /// axis is a coordinate, sample 0 is never
    /// random.
    pub initial: Named,
    /// Stepper.
    pub stepper: String,
    /// Step control.
    pub control: Control,
    /// Maximum number of steps of one run.
    pub max_steps: u64,
    /// A shape beyond this norm has escaped.
    pub escape_norm: f64,
    /// Maximum model time of one evaluation; 0 is the evaluation's default.
    pub budget: f64,
}

impl Question for ScanComputation {
    type Figure = UnitSettings;
    const KIND: Kind = Kind::Scan;
    /// Readers of folders of Parquet files (pandas, pyarrow, polars) skip names that begin with `_`: they
    /// open the folder as one table.
    const MANIFEST: &'static str = "_manifest.json";
    const KEY: &'static str = "plan";

    fn value(&self) -> serde_json::Value {
        serde_json::to_value(self).unwrap_or_default()
    }

    fn model(&self) -> &ModelName {
        &self.model
    }

    fn title(&self, _: &str) -> String {
        crate::titles::of_motions(self.model.as_str())
    }

    fn stated(&self) -> Vec<(&'static str, String)> {
        vec![("axes", self.axes_in_words())]
    }
}

impl ScanComputation {
    /// The axes as they are typed: `[kappa2=0.1:1:64] x [kappa3=0:1:32]`.
    pub(crate) fn axes_in_words(&self) -> String {
        self.axes.iter().map(|axis| format!("[{axis}]")).collect::<Vec<_>>().join(" x ")
    }
}

impl ScanPlan {
    /// Resolves the scan of a study and checks every number. A given start is perturbed
    /// ([`Study::perturbed`]); a coordinate on an axis counts as
    /// given, with its largest value.
    ///
    /// # Errors
    /// [`Error`] naming the key, the value and the remedy; values of an axis that a model rejects.
    pub fn new(study: &Study) -> Result<Self, Error> {
        let info = study.info()?;
        let starts = starts(study, info)?;
        let study = &started(study, &starts)?.perturbed()?.0;
        let method = stepper(&study.run.stepper)?;
        let (run, scan) = (&study.run, &study.scan);
        check_axes(study)?;
        let scales = study.scales_over(&scan.axes)?;
        check_settings(study, scales)?;
        check_no_noise(run.largest_noise())?;
        let free = |name: &str| scan.axes.iter().any(|axis| axis.name == name);
        study.ties.check_free(scan.axes.iter().map(|axis| axis.name.as_str()))?;
        let varies = |name: &str| free(name) || study.ties.get(name).is_some();
        let names = info.parameters().iter().map(|spec| spec.name.to_owned());
        let fixed = names.zip(study.values()?).filter(|(name, _)| !varies(name)).collect();
        // Nothing that a row tells depends on the position, and the axes give what they vary.
        let stays = |(name, _): &&(String, f64)| !["x", "y"].contains(&name.as_str()) && !free(name);
        let mut initial: Vec<_> = study.initial.iter().filter(stays).cloned().collect();
        initial.sort_by(|a, b| a.0.cmp(&b.0)); // the order of typing changes no number
        let computation = ScanComputation {
            format: SCAN_FORMAT,
            model: ModelName::from(info),
            parameters: Named(fixed),
            ties: study.ties.clone(),
            axes: scan.axes.clone(),
            samples: usize::try_from(scan.samples).unwrap_or(usize::MAX),
            seed: run.seed,
            random: study.starts_over(scan.samples, &scan.axes)?,
            initial: Named(initial),
            stepper: method.name().to_owned(),
            control: control(study, method, scales)?,
            max_steps: run.max_steps,
            escape_norm: escape_norm(study, scales)?,
            budget: scan.budget,
        };
        let title = crate::titles::of_scan(study, info);
        let figure = UnitSettings { units: study.figure.units.clone() };
        let plan = Self { figure, ..Self::of(&study.name, &title, computation) };
        plan.check_cells()?;
        Ok(plan)
    }

    /// The small values that a scan of this study gives to coordinates that its start leaves at zero
    /// ([`Study::perturbed`]).
    ///
    /// # Errors
    /// As [`ScanPlan::new`].
    pub fn perturbation(study: &Study) -> Result<Option<Perturbation>, Error> {
        Ok(started(study, &starts(study, study.info()?)?)?.perturbed()?.1)
    }

    /// Builds the model and its start at every value of each axis (the other axis at its ends): errors
    /// are reported before anything is computed.
    fn check_cells(&self) -> Result<(), Error> {
        let axes = &self.computation.axes;
        let first = axes.first().map_or(1, |axis| axis.values.len());
        let second = self.cells() / first;
        let edges = (0..first).flat_map(|i| [i, i + first * (second - 1)]);
        let sides = (0..second).flat_map(|j| [j * first, j * first + first - 1]);
        for cell in edges.chain(sides) {
            let model = self.model_of(cell)?;
            check_stability(model.as_ref(), self.method()?, self.computation.control)?;
            // Looks, exponents and periodic orbits repeat such times: a thousand looks are a day.
            let time = 1e3 * self.look_of(cell)?;
            check_steps(model.as_ref(), self.method()?, self.computation.control, time)?;
            self.start(cell, 0, model.as_ref())?;
        }
        Ok(())
    }

    /// The look of the body of a cell.
    ///
    /// # Errors
    /// An unknown model.
    pub fn look_of(&self, cell: usize) -> Result<f64, Error> {
        Ok(self.info()?.look_at(&self.parameters_of(cell)?))
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.computation.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// Number of rows: cells times samples.
    pub fn rows(&self) -> usize {
        self.cells() * self.computation.samples
    }

    /// Cells of a part (the last one may have fewer). It depends on the plan alone.
    pub fn cells_per_part(&self) -> usize {
        let (cells, rows, parts) = PART;
        self.cells().div_ceil(parts).min(cells).min(rows / self.computation.samples).max(1)
    }

    /// Number of parts.
    pub fn parts(&self) -> usize {
        self.cells().div_ceil(self.cells_per_part())
    }

    /// The cells of a part.
    pub fn cells_of(&self, part: usize) -> std::ops::Range<usize> {
        let first = part * self.cells_per_part();
        first..(first + self.cells_per_part()).min(self.cells())
    }

    /// The values of the axes in a cell: `cell = i1 + n1 i2`.
    pub fn axis_values(&self, cell: usize) -> Vec<f64> {
        let mut rest = cell;
        let value = |axis: &Axis| {
            let value = axis.values[rest % axis.values.len()];
            rest /= axis.values.len();
            value
        };
        self.computation.axes.iter().map(value).collect()
    }

    /// All parameters in a cell, in registry order.
    ///
    /// # Errors
    /// An unknown model.
    pub fn parameters_of(&self, cell: usize) -> Result<Vec<f64>, Error> {
        let (axes, values) = (&self.computation.axes, self.axis_values(cell));
        let free = |name: &str| axes.iter().position(|axis| axis.name == name).map(|place| values[place]);
        let value = |spec: &parameters::ParameterSpec| {
            free(spec.name).or_else(|| self.computation.parameters.get(spec.name)).unwrap_or(spec.default)
        };
        let specs = self.info()?.parameters();
        let mut values: Vec<f64> = specs.iter().map(value).collect();
        self.computation.ties.apply(specs, &mut values);
        Ok(values)
    }

    /// Its stepper.
    ///
    /// # Errors
    /// An unknown stepper.
    pub fn method(&self) -> Result<Method, Error> {
        stepper(&self.computation.stepper)
    }
}

/// The numbers that a scan uses in addition to its axes.
fn check_settings(study: &Study, scales: Scales) -> Result<(), Error> {
    let (run, scan) = (&study.run, &study.scan);
    study.starts(1)?.check()?;
    let budget = (0.0..=scales.longest()).contains(&scan.budget);
    check("budget", scan.budget, budget, "give a model time above 0, at most 1e9, or 0 for the default")?;
    let counts = [("samples", scan.samples, MOST.1), ("max_steps", run.max_steps, u64::MAX)];
    for (key, value, most) in counts {
        if !(1..=most).contains(&value) {
            let remedy = if value == 0 { "give at least 1" } else { "give at most 100000" };
            return Err(Error::Setting { key, value: value.to_string(), remedy });
        }
    }
    for (_, value) in &study.initial {
        check("initial", *value, true, "give finite numbers")?;
    }
    Ok(())
}

/// The axes that vary the start.
fn starts<'s>(study: &'s Study, info: &ModelInfo) -> Result<Vec<&'s Axis>, Error> {
    let values = study.values()?;
    let mut starts = Vec::new();
    for axis in &study.scan.axes {
        if axis.varies_start(info, &values)? {
            starts.push(axis);
        }
    }
    Ok(starts)
}

/// The study with a start that has the largest values of these axes.
fn started(study: &Study, starts: &[&Axis]) -> Result<Study, Error> {
    let mut started = study.clone();
    for axis in starts {
        let largest = axis.values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        started.set_initial(&axis.name, largest)?;
    }
    Ok(started)
}

/// One or two different axes and not too many cells.
fn check_axes(study: &Study) -> Result<(), Error> {
    let axes = &study.scan.axes;
    let wrong = |text: String, problem: &str| Error::Axis { text, problem: problem.to_owned() };
    let free = if study.free.is_empty() { String::new() } else { format!(" ({})", study.free.join(", ")) };
    match axes.len() {
        0 => return Err(Error::NoAxis { free }),
        1 | 2 => {}
        n => return Err(wrong(axes[n - 1].name.clone(), "a scan has one or two axes: leave one out")),
    }
    for axis in axes {
        axis.check()?;
    }
    if axes.len() == 2 && axes[0].name == axes[1].name {
        return Err(wrong(axes[1].name.clone(), "both axes vary it: give two different parameters"));
    }
    let cells: usize = axes.iter().map(|axis| axis.values.len()).product();
    if cells > MOST.0 {
        return Err(wrong(
            axes[0].name.clone(),
            &format!("{cells} cells are too many: give fewer points, at most {} in all", MOST.0),
        ));
    }
    Ok(())
}
