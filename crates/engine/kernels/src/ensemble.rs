//! Orbits from their starts to given times, in lanes.

use crate::kernel::{Common, FromModel, Kernel, TEXT, Text};
use motiform_dynamics::ensemble::{Member, Propagation, Queue, propagate};
use motiform_dynamics::{Model, Watch};

/// A body, and the initial state of its orbit.
pub struct Start<'m> {
    /// The key that is returned with its states.
    pub key: usize,
    /// The body.
    pub body: &'m dyn Model,
    /// Shape and position at time 0.
    pub state: Vec<f64>,
}

/// Provides the next orbit; `None` at the end.
type Next<'n, 'm> = &'n mut dyn FnMut() -> Option<Start<'m>>;

/// Receives the states of an orbit at all times.
type Done<'d> = &'d mut dyn FnMut(usize, Option<Vec<&[f64]>>);

/// Runs the orbits that `next` gives, on this thread; `kernel` must compute their bodies, and amplitude equations must be those of the
/// first one, with any parameters. `done` gets the states of each at all times, or `None` where a single orbit has to say what happened.
/// `false`, without any work, on a machine without lanes. See [`propagate`].
pub fn propagate_bodies(
    kernel: Kernel,
    how: &Propagation<'_>,
    next: Next<'_, '_>,
    done: Done<'_>,
    watch: &dyn Watch,
) -> bool {
    match kernel {
        Kernel::Tensor => run::<Common, 8>(how, next, done, watch),
        Kernel::Amplitudes(1) if TEXT => run::<Text<2>, 4>(how, next, done, watch),
        Kernel::Amplitudes(2) if TEXT => run::<Text<4>, 6>(how, next, done, watch),
        Kernel::Amplitudes(3) if TEXT => run::<Text<6>, 8>(how, next, done, watch),
        Kernel::Amplitudes(_) if TEXT => run::<Text<8>, 10>(how, next, done, watch),
        Kernel::Amplitudes(_) => false,
    }
}

fn run<F: FromModel, const D: usize>(
    how: &Propagation<'_>,
    next: Next<'_, '_>,
    done: Done<'_>,
    watch: &dyn Watch,
) -> bool {
    let mut member = || {
        let Start { key, body, state } = next()?;
        Some(Member { key, field: F::from_model(body)?, start: state.try_into().ok()? })
    };
    let mut arrived = |key: usize, states: Option<Vec<[f64; D]>>| {
        done(key, states.as_ref().map(|states| states.iter().map(<[f64; D]>::as_slice).collect()));
    };
    propagate(how, Queue { next: &mut member, done: &mut arrived, watch })
}
