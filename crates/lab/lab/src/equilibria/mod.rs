//! The steady motions of a plan: shapes that are constant up to a steady rotation.

mod families;
mod search;

use crate::analyse;
use motiform_analysis::regime::Direction;
use motiform_analysis::{Regime, SteadyMotion};
use motiform_dynamics::{Model, Part, Watch};
use motiform_study::plan::{Named, check};
use motiform_study::{Error, Plan};
use search::{Found, Search};
use serde::Serialize;

/// A steady motion: at rest, straight, or circular.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Equilibrium {
    /// Its name: motionless, straight or circular.
    pub motion: Regime,
    /// Its direction, as far as the symmetry of the model distinguishes directions.
    #[serde(flatten)]
    pub direction: Direction,
    /// Its shape; all rotated copies are equilibria too.
    pub shape: Named,
    /// Speed of the centre of mass (model length per model time).
    pub speed: f64,
    /// Turning rate (rad per model time).
    pub turning_rate: f64,
    /// Eigenvalues of the reduced linearisation, real and imaginary parts, largest real part first (inverse model time).
    pub eigenvalues: Vec<(f64, f64)>,
    /// Number of eigenvalues with a positive real part, beyond round-off.
    pub unstable: usize,
    /// The residual of `f(u) - omega G u` after Newton's method.
    pub residual: f64,
    /// The fraction of the random starts that converged to it.
    pub share: f64,
    /// The method that led to it first.
    pub found_by: FoundBy,
    /// Dimension of the family of equilibria that it stands for (rotated copies not counted); 0 where it is
    /// alone. So many eigenvalues are 0.
    #[serde(skip_serializing_if = "is_zero")]
    pub family: usize,
}

/// For serde, which gives a reference.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
const fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// The method that led to an equilibrium first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FoundBy {
    /// Newton's method from the circle or a random start.
    Starts,
    /// Deflation.
    Deflation,
    /// It is the mirror image of another one.
    Mirror,
}

/// The equilibria that Newton's method finds from the circle and from `starts` random shapes of several sizes, and those that deflation
/// finds beside them, the most stable first; mirror images count as different, and a family counts once. The list may be incomplete.
///
/// Deflated searches start from sizes about those at which terms of the equations balance (from a tenth of the smallest to ten times the
/// largest), half of them from shapes with symmetries of the model, and end when so many of them in turn found nothing:
/// half of `starts` for each unknown up to 10, and fewer for larger models, whose steps take longer (`1.5 starts` for the cell).
///
/// `None` if the watch stopped it.
///
/// # Errors
/// A plan with noise; parameters that the model rejects.
///
/// # Checked by  tests/all/equilibria/: closed forms of the tensor model and of the Lorenz equations, a search by other means
pub fn equilibria(plan: &Plan, starts: usize, watch: &dyn Watch) -> Result<Option<Vec<Equilibrium>>, Error> {
    check("starts", starts as f64, starts > 0, "give at least 1")?;
    let model = analyse::model(plan)?;
    let mut search = Search::new(plan.info()?, model.as_ref(), plan.computation.seed);
    let (first, second) = (Part { watch, from: 0.0, to: 0.5 }, Part { watch, from: 0.5, to: 1.0 });
    if search
        .starts(starts, &first)
        .and_then(|()| search.deflate(patience(starts, model.dim()), &second))
        .is_none()
    {
        return Ok(None);
    }
    let found = search.finish().into_iter();
    Ok(Some(found.map(|found| describe(model.as_ref(), found, starts)).collect()))
}

/// The number of deflated searches in turn that may find nothing. In random equations of 5 and 6 unknowns up
/// to 428 found nothing before one that did (of 24 lists).
fn patience(starts: usize, dim: usize) -> usize {
    let dim = dim.max(1) as f64;
    let many = (60.0 / dim).max(1.5) * (48.0 / dim).powi(2).min(1.0);
    (starts as f64 * (0.5 * dim).min(many).max(0.25)).ceil() as usize
}

fn describe(model: &dyn Model, found: Found, starts: usize) -> Equilibrium {
    let Found { equilibrium: found, by, hits, family } = found;
    let values = model.decoded(&found.shape);
    let names = model.coordinates().iter().map(|coordinate| coordinate.name.to_owned());
    let steady = SteadyMotion::of(model, &found);
    Equilibrium {
        motion: steady.regime(),
        direction: steady.direction(model, &found),
        shape: Named(names.zip(values).collect()),
        speed: steady.pace(),
        turning_rate: steady.turning().unwrap_or(0.0),
        unstable: found.growing(),
        residual: found.residual,
        share: hits as f64 / starts as f64,
        found_by: by,
        family,
        eigenvalues: found.eigenvalues,
    }
}
