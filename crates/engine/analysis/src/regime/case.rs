//! A body under examination.

use super::look::Look;
use super::place::find_placed;
use super::settings::Settings;
use crate::periodic::{PeriodicGuess, PeriodicOrbit};
use motiform_dynamics::{Equivariant, Error, Integration, Request, Watch};

/// A body whose motion is examined by these settings, until the watch says stop.
#[derive(Clone, Copy)]
pub(super) struct Case<'c> {
    pub(super) body: &'c dyn Equivariant,
    pub(super) settings: &'c Settings,
    pub(super) watch: &'c dyn Watch,
}

impl<'c> Case<'c> {
    /// The orbit from a shape.
    pub(super) fn orbit(&self, shape: &[f64]) -> Result<Box<dyn Integration + 'c>, Error> {
        self.settings.method.shape_orbit(self.body, self.settings.control, 0.0, shape)
    }

    /// A run to the time `t`.
    pub(super) fn request(&self, t: f64) -> Request<'c> {
        Request { watch: self.watch, ..self.settings.request(t, self.body.dim()) }
    }

    /// A look at the orbit from a shape.
    pub(super) fn look(&self, shape: &[f64], span: f64) -> Result<Look, Error> {
        let request = self.settings.request(span, self.body.dim());
        Look::take(self.body, self.orbit(shape)?.as_mut(), span, &request, self.watch)
    }

    /// The periodic orbit that Newton's method finds from a guess, however long it takes.
    pub(super) fn find(&self, guess: &PeriodicGuess<'_>) -> Option<PeriodicOrbit> {
        let mut effort = f64::INFINITY;
        find_placed(self.body, guess, &self.settings.flow(), &mut effort, self.watch)
    }

    /// The images of a shape under which it may come back: mirrored first, if the body has a mirror.
    pub(super) fn images(&self) -> &'static [bool] {
        if self.body.symmetry().mirror { &[true, false] } else { &[false] }
    }
}
