//! The decision: one question after the other, from the cheapest and most certain evidence to the most expensive ([`super::search`]).
//!
//! 1. Did the orbit leave every bound?                         blow-up
//! 2. Does it approach a stable relative equilibrium?           motionless, straight, circular
//! 3. Does it stay at an unstable one, by its exact symmetry?    the same, named unstable
//! 4. Does it rest near saddles that attract as a cycle?        rectangular
//! 5. Does its shape come back, stably?                         pulsating straight, zigzag, quasi-periodic
//! 6. Do neighbouring orbits separate exponentially?            chaotic
//! 7. Do its returns lie on a curve, without chaos?             quasi-periodic (a torus of shapes)
//!
//! If nothing is decided the next look is twice as long, until the budget is spent. A look ends early where question 2 is answered.

use super::ask::Ask;
use super::case::Case;
use super::chaos;
use super::look::{Look, Seen};
use super::search::Search;
use super::settings::Settings;
use super::verdict::Verdict;
use crate::Result;
use motiform_dynamics::{Equivariant, StopOnly, Watch};

/// Classifies the motion that starts from `start`; `None` if `stop` broke off.
///
/// The evidence and its numbers are in the verdict. Thresholds: an equilibrium counts as reached at 1e-3 of the shape's
/// size if it is stable by its eigenvalues and the orbit comes closer at the rate they say; a shape comes back if Newton's
/// method finds a stable orbit beside a return that closes to 0.5 % of the motion's diameter; chaos needs a motion, lambda_1 above
/// three times its 95 % error and growth by more than e^10, both pooled over two consecutive runs and more (1.3 times as much where the
/// 0-1 test sees order, K < 0.3); a torus needs returns on a curve that early and late ones fill alike,
/// in two looks, and whose size has no trend.
///
/// An orbit that begins with an exact symmetry keeps it, and may end where no other orbit does: at an unstable shape. The verdict
/// then says so ([`super::Attractor::Unstable`]); front ends perturb such starts.
///
/// # Errors
/// Input that the numerics refuse (a start of the wrong length, say). Everything that happens to the orbit is a verdict.
///
/// # Checked by  tests/all/regimes.rs (tensor: the analytic lines; cell: the known windows), tests/all/zoo.rs (known answers)
pub fn classify(
    body: &dyn Equivariant,
    start: &[f64],
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<Option<Verdict>> {
    Ok(settle(body, start, settings, watch)?.map(|(verdict, _)| verdict))
}

/// As [`classify()`], with the shape that the orbit had when it was decided: one on the motion, or close to it; of a cycle that of a rest.
/// The watch is told the part of the budget that is spent.
///
/// # Errors
/// As [`classify()`].
pub fn settle(
    body: &dyn Equivariant,
    start: &[f64],
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<Option<(Verdict, Vec<f64>)>> {
    let mut orbit = Case { body, settings, watch }.orbit(start)?;
    let (mut search, mut ask) = Search::new(settings, start);
    loop {
        ask = match ask {
            Ask::Look(span) => {
                let request = settings.request(orbit.t() + span, body.dim());
                let part = search.part(span, watch);
                let mut ends = |seen: &Seen, shape: &[f64]| search.arrives(body, seen, shape);
                let look = Look::take_until(body, orbit.as_mut(), span, Some(&mut ends), &request, &part)?;
                search.looked(body, look, &StopOnly(watch))?
            }
            Ask::Exponent(span) => {
                let case = Case { body, settings, watch: &search.part(span, watch) };
                let run = chaos::exponent(case, orbit.state(), span)?;
                orbit.restart(&run.shape);
                search.measured(body, &run, &StopOnly(watch))?
            }
            Ask::Nothing(verdict) => return Ok(verdict.map(|verdict| (*verdict, search.into_shape()))),
        };
        if watch.stopped() {
            return Ok(None); // what was decided while it stopped may rest on half of a run
        }
    }
}
