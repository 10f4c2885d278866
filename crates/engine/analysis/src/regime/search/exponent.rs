//! The answer to an exponent: do neighbouring orbits separate?

use super::super::ask::Ask;
use super::super::case::Case;
use super::super::chaos;
use super::super::growth::{Growth, in_motion};
use super::super::look::RESTS;
use super::super::settings::{EXACT, ended};
use super::{Pending, Search};
use crate::isotropy::Isotropy;
use crate::{Lyapunov, Result};
use motiform_dynamics::{Equivariant, Watch};

impl Search {
    /// Takes in an exponent: do neighbouring orbits separate?
    pub(in crate::regime) fn measured(
        &mut self,
        body: &dyn Equivariant,
        run: &Lyapunov,
        watch: &dyn Watch,
    ) -> Result<Ask> {
        let case = Case { body, settings: &{ self.settings }, watch };
        if let Some(outcome) = ended(&run.outcome) {
            return Ok(self.ended(&outcome, 0.0));
        }
        let Pending::Exponent(look) = std::mem::replace(&mut self.pending, Pending::Look) else {
            return self.again(case); // nothing was asked
        };
        self.time += run.time + run.transient;
        self.shape.clone_from(&run.shape);
        let run = match in_motion(run, RESTS, look.fastest) {
            Ok(run) => run,
            Err(none) => {
                self.repeats.measured(none.cancels);
                self.missing = none.why;
                return self.again(case);
            }
        };
        self.repeats.measured(false);
        let witness = chaos::Witness::of(&look);
        self.growth.extend(Growth::of(&run, self.time));
        let chaos = chaos::chaotic(&self.growth, &run, &witness, self.time)?;
        // Out of a subspace of exact symmetry neighbouring orbits may separate at a rate that no chaos has made.
        let symmetric = chaos.is_some() && !Isotropy::of(body, &self.shape, EXACT).is_trivial();
        let plane = chaos.is_some() && is_plane(body);
        if let Some(verdict) = chaos.filter(|_| !symmetric && !plane) {
            return Ok(self.described(verdict, case, look.end - look.start)?.into());
        }
        self.missing = if symmetric {
            "the orbit keeps an exact symmetry, and neighbouring orbits leave it".to_owned()
        } else if plane {
            "two unknowns are never chaotic (Poincare and Bendixson): errors of the steps separate neighbouring orbits"
                .to_owned()
        } else {
            chaos::missing(&self.growth, &witness)
        };
        if let Some(verdict) = self.on_a_curve(case, &look, &run, &witness)? {
            return Ok(verdict.into());
        }
        self.again(case)
    }
}

/// Returns `true` for a flow of at most two unknowns, rotations divided out: it has no chaos.
///
/// Source: theorem of Poincare and Bendixson, Guckenheimer and Holmes (1983), Nonlinear Oscillations, section 1.8.
fn is_plane(body: &dyn Equivariant) -> bool {
    body.dim() <= 2 + usize::from(body.symmetry().rotations)
}

#[cfg(test)]
mod tests {
    use super::is_plane;
    use motiform_models::zoo::{Lorenz, VanDerPol};

    #[test]
    fn a_plane_has_two_unknowns() {
        assert!(is_plane(&VanDerPol { mu: 1.0 }) && !is_plane(&Lorenz::default()));
    }
}
