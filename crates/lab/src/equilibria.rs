//! The steady motions of a plan: shapes that are constant up to a steady rotation.

use crate::analyse;
use motiform_analysis::regime::Direction;
use motiform_analysis::{Regime, RelativeEquilibrium, SteadyMotion};
use motiform_dynamics::Watch;
use motiform_dynamics::{Model, escape::norm};
use motiform_study::initial::random_shape;
use motiform_study::plan::{Named, check};
use motiform_study::{Error, Plan};
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
    /// Number of eigenvalues with a positive real part, beyond round-off: 0 is stable.
    pub unstable: usize,
    /// The residual of `f(u) - omega G u` after Newton's method.
    pub residual: f64,
    /// The fraction of the random starts that converged to it.
    pub share: f64,
}

/// Starts are drawn with these sizes in turn: the states of these models have entries of about 1.
const SIZES: [f64; 6] = [0.01, 0.1, 0.3, 1.0, 2.0, 4.0];

/// Equilibria nearer to each other than this, relative to their size, are identified. If eigenvalues vanish, Newton's method
/// gives few digits.
const SAME: f64 = 1e-6;

/// The equilibria that Newton's method finds from the circle and from `starts` random shapes of several sizes, the most
/// stable first; mirror images count as different. The list may be incomplete.
///
/// `None` if the watch stopped it.
///
/// # Errors
/// A plan with noise; parameters that the model rejects.
pub fn equilibria(plan: &Plan, starts: usize, watch: &dyn Watch) -> Result<Option<Vec<Equilibrium>>, Error> {
    check("starts", starts as f64, starts > 0, "give at least 1")?;
    let model = analyse::model(plan)?;
    let circle = vec![0.0; model.dim()];
    let mut found: Vec<(RelativeEquilibrium, usize)> = Vec::new();
    for start in 0..=starts {
        if watch.stopped() {
            return Ok(None);
        }
        let size = SIZES[start % SIZES.len()];
        let guess = match start {
            0 => circle.clone(),
            _ => random_shape(model.as_ref(), size, plan.computation.seed, start as u64),
        };
        if let Some(equilibrium) = RelativeEquilibrium::find(model.as_ref(), &guess) {
            count(&mut found, equilibrium, model.as_ref(), start > 0);
        }
        watch.progress((start + 1) as f64 / (starts + 1) as f64);
    }
    found.sort_by(|a, b| a.0.growth().total_cmp(&b.0.growth()));
    Ok(Some(found.into_iter().map(|(found, hits)| describe(model.as_ref(), found, hits, starts)).collect()))
}

/// Adds an equilibrium, or counts another start for an existing one.
fn count(
    found: &mut Vec<(RelativeEquilibrium, usize)>,
    new: RelativeEquilibrium,
    model: &dyn Model,
    drawn: bool,
) {
    let size = norm(&new.shape).max(1e-3);
    let same = found.iter_mut().find(|(known, _)| known.distance(model, &new.shape) < SAME * size);
    match same {
        Some((_, hits)) => *hits += usize::from(drawn),
        None => found.push((new, usize::from(drawn))),
    }
}

fn describe(model: &dyn Model, found: RelativeEquilibrium, hits: usize, starts: usize) -> Equilibrium {
    let mut values = vec![0.0; model.coordinates().len()];
    model.decode(&found.shape, &mut values);
    let names = model.coordinates().iter().map(|coordinate| coordinate.name.to_owned());
    let steady = SteadyMotion::of(model, &found);
    let turning = steady.turns().then_some(found.turning_rate);
    let drift = if steady.moves() { found.velocity } else { [0.0; 2] };
    Equilibrium {
        motion: steady.regime(),
        direction: Direction::of(model, turning, drift),
        shape: Named(names.zip(values).collect()),
        speed: if steady.moves() { steady.speed.value } else { 0.0 },
        turning_rate: turning.unwrap_or(0.0),
        unstable: found.growing(),
        residual: found.residual,
        share: hits as f64 / starts as f64,
        eigenvalues: found.eigenvalues,
    }
}
