//! Points as they are handed out.

use super::certificate::{Certificate, TestFunction};
use super::levels::{CLEAR, unclear, unstable, vanishing};
use super::normal_form::{NormalForm, Undetermined};
use super::place::Place;
use super::point::Point;
use super::problem::Problem;
use super::special::{Hopf, Special};
use super::tangents::changes;
use super::tracer::{Tracer, neutral};

/// Copies of the critical level, which symmetry makes equal to it, differ from it by less than its residual.
const RESIDUALS: f64 = 3.0;

/// A special point and its certificate; without a normal form of one direction, which decides nothing, where several are critical.
fn forms(
    special: Option<Special>,
    certificate: Option<Certificate>,
    critical: usize,
) -> (Option<Special>, Option<Certificate>) {
    if critical < 2 {
        return (special, certificate);
    }
    let undetermined = NormalForm::Undetermined(Undetermined::Directions);
    let special = special.map(|special| match special {
        Special::Hopf(hopf) => Special::Hopf(Hopf { first_lyapunov: undetermined, ..hopf }),
        other => other,
    });
    let shown =
        |shown: Certificate| Certificate { normal_form: shown.normal_form.and(Some(undetermined)), ..shown };
    (special, certificate.map(shown))
}

impl<P: Problem> Tracer<'_, P> {
    /// Number of growing levels at a special point, those left out that are as close to 0 as the critical one was brought, or not told from
    /// 0.
    fn beside_critical(&self, place: &Place<P::Local>) -> usize {
        let least = place.levels.first().into_iter().flatten().map(|level| level.growth.abs());
        let residual = match place.certificate {
            Some(shown) if shown.test == TestFunction::Growth => shown.residual.abs(),
            _ => least.fold(f64::INFINITY, f64::min),
        };
        let critical = (CLEAR * self.problem.noise(&place.levels)).max(RESIDUALS * residual);
        place.levels.iter().flatten().filter(|level| level.growth > critical).count()
    }

    /// Number of critical directions at a special point, where there are more than its symmetry explains; 0 elsewhere.
    fn several(&self, place: &Place<P::Local>, special: Special) -> usize {
        if matches!(special, Special::Unresolved { .. } | Special::Continuum | Special::Fold) {
            return 0;
        }
        let shown = place.certificate.filter(|shown| shown.test == TestFunction::Growth);
        let residual = shown.map_or(0.0, |shown| shown.residual.abs());
        let within = unclear(&self.problem, &place.levels).max(RESIDUALS * residual);
        let count = vanishing(&place.levels, (within, self.problem.time().is_some()));
        if count > self.problem.alike(&place.x, &place.local) { count } else { 0 }
    }

    pub(super) fn point(&self, place: &Place<P::Local>, special: Option<Special>) -> Point {
        let located = special
            .is_some_and(|special| !matches!(special, Special::Unresolved { .. } | Special::Touch { .. }));
        let critical = special.map_or(0, |special| self.several(place, special));
        let (special, certificate) = forms(special, special.and(place.certificate), critical);
        Point {
            parameter: place.parameter(),
            arclength: place.arclength,
            motion: self.problem.motion(&place.x, &place.local, &place.levels),
            unstable: if located { self.beside_critical(place) } else { unstable(&place.levels) },
            neutral: if special.is_some() {
                0
            } else {
                neutral(&self.problem, place).max(usize::from(self.is_family(place)))
            },
            family: self.problem.family().len(),
            critical,
            slope: place.slope(),
            tangent: special.map(|_| changes(&self.problem, &place.x, &place.tangent)),
            special,
            certificate,
        }
    }
}
