//! The distance of a fitted cell from a change of its motion: the nearest bifurcations along its parameters.

use crate::Fitted;
use crate::regime::natural_study;
use motiform_diagrams::{SpecialEntry, follow};
use motiform_dynamics::Watch;
use motiform_dynamics::digits::with_error;
use motiform_dynamics::in_words;
use motiform_inference::{Fit, paper};
use motiform_study::branches::{Along, BranchSettings};
use motiform_study::{BranchPlan, Error};
use serde::{Deserialize, Serialize};

/// Linear terms, whose coefficients are the parameters.
const TERMS: [&str; 3] = ["z1: z1", "z2: z2", "z3: z3"];
/// Half the range that is searched: this many errors, or this share of the value, whichever is larger.
const REACH: (f64, f64) = (10.0, 0.5);
/// Most points of the branch to each side.
const POINTS: usize = 400;

/// A bifurcation of the motion of a fitted cell.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NearBifurcation {
    /// The parameter that is varied; all others stay those of the fit.
    pub parameter: String,
    /// Its value in the fit, with its standard error (units of the data).
    pub value: f64,
    /// See `value`.
    pub error: f64,
    /// Its value at the bifurcation.
    pub at: f64,
    /// The kind: `fold`, `hopf`, `pitchfork`, `symmetry-breaking`, `period-doubling`, `torus`, `branch-point`, `continuum`, `homoclinic`.
    pub kind: String,
    /// The symmetry broken there: the `mirror` symmetry, or `rotations`.
    pub breaks: Option<String>,
}

impl NearBifurcation {
    /// `kappa2 = 0.51 ± 0.01: pitchfork (breaks the mirror symmetry) at 0.55, 0.04 away (3.1 standard errors)`.
    pub fn sentence(&self) -> String {
        let Self { parameter, value, error, at, kind, breaks } = self;
        let breaks = breaks.as_ref().map_or_else(String::new, |what| format!(" (breaks {what})"));
        let (off, kind) = ((at - value).abs(), in_words(kind));
        format!(
            "{parameter} = {}: {kind}{breaks} at {at:.4}, {off:.4} away ({:.1} standard errors)",
            with_error(*value, *error),
            off / error.max(f64::MIN_POSITIVE)
        )
    }
}

/// The nearest bifurcations below and above the fitted value of gamma, kappa2 and kappa3, as far as the model has them: the motion of
/// the fitted equations is followed over 10 standard errors or half the value to both sides, whichever is more. Empty without a named
/// motion, or where it is neither steady nor periodic.
///
/// # Errors
/// [`Error::Interrupted`].
///
/// # Checked by  tests/all/bifurcations.rs: a cell on the plane of Fig. 1, whose lines are known in closed form
pub fn near_bifurcations(fitted: &Fitted, watch: &dyn Watch) -> Result<Vec<NearBifurcation>, Error> {
    let fit = fitted.model();
    let Some(found) = &fitted.regime else { return Ok(Vec::new()) };
    let Some(regime) = found.regime else { return Ok(Vec::new()) };
    let mut all = Vec::new();
    for term in TERMS {
        let Some(along) = Varied::of(fit, term) else { continue };
        let mut study = natural_study(&fit.library, fit.handed, &fit.natural.coefficients, &found.start)?;
        study.run.seed = 1;
        let range = Along {
            name: along.name.clone(),
            from: along.value - along.reach,
            to: along.value + along.reach,
        };
        let settings = BranchSettings {
            origin: Some(regime),
            points: POINTS,
            branches: 1,
            ..BranchSettings::over(range)
        };
        let Ok(plan) = BranchPlan::new(&study, &settings) else { continue };
        let found = match follow(&plan, None, watch) {
            Ok(found) => found,
            Err(Error::Interrupted) => return Err(Error::Interrupted),
            Err(_) => return Ok(Vec::new()), // neither steady nor periodic: nothing can be followed
        };
        if watch.stopped() {
            return Err(Error::Interrupted);
        }
        all.extend(along.nearest(&found.special(0)));
    }
    Ok(all)
}

/// A parameter in natural units.
struct Varied {
    name: String,
    value: f64,
    reach: f64,
    error: f64,
    /// Its unit, in those of the data.
    unit: f64,
}

impl Varied {
    fn of(fit: &Fit, term: &str) -> Option<Self> {
        let place = fit.coefficients.iter().position(|c| c.name == term && !c.imaginary)?;
        let c = &fit.coefficients[place];
        let (name, factor) = paper(&c.term, false);
        let unit = fit.scales.coefficient(&c.term);
        let value = fit.natural.coefficients[place] / factor;
        let error = (c.estimate.error.max(c.estimate.robust) / unit).abs();
        let reach = (REACH.0 * error).max(REACH.1 * value.abs());
        Some(Self { name, value, reach, error, unit })
    }

    /// The nearest special point on each side.
    fn nearest(&self, special: &[SpecialEntry]) -> Vec<NearBifurcation> {
        let side = |above: bool| {
            let there = special.iter().filter(|entry| (entry.parameter > self.value) == above);
            let off = |entry: &&SpecialEntry| (entry.parameter - self.value).abs();
            there.min_by(|a, b| off(a).total_cmp(&off(b)))
        };
        let found = [false, true].into_iter().filter_map(side);
        let one = |entry: &SpecialEntry| NearBifurcation {
            parameter: self.name.clone(),
            value: self.value * self.unit,
            error: self.error * self.unit.abs(),
            at: entry.parameter * self.unit,
            kind: entry.kind.to_owned(),
            breaks: entry.breaks.map(str::to_owned),
        };
        found.map(one).collect()
    }
}
