//! Orbits under noise, in lanes.

use crate::kernel::{Common, FromModel, Kernel, TEXT, Text};
use motiform_dynamics::ensemble::{
    Extent, NoisyMember, NoisyQueue, NoisySpan, NoisyTrack, ShapeAlone, WithPosition, propagate_noisy,
};
use motiform_dynamics::{Model, NoiseSteps, Watch};

/// A body, the initial state of its orbit, and its noise.
pub struct NoisyStart<'m> {
    /// The key that is returned with its states.
    pub key: usize,
    /// The body.
    pub body: &'m dyn Model,
    /// The state: the shape, and the position if that is integrated.
    pub state: Vec<f64>,
    /// Its noise, from the start on.
    pub noise: NoiseSteps,
}

/// The part of the state that is integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stretch {
    /// The shape alone.
    Shape,
    /// Shape and position.
    Plane,
}

/// The states of an orbit: its rows, and the last one.
pub struct NoisyStates<'s> {
    /// The rows.
    pub rows: Vec<&'s [f64]>,
    /// The state at the end.
    pub last: &'s [f64],
}

/// Provides the next orbit; `None` at the end.
type Next<'n, 'm> = &'n mut dyn FnMut() -> Option<NoisyStart<'m>>;

/// Receives the states of an orbit.
type Done<'d> = &'d mut dyn FnMut(usize, Option<NoisyStates<'_>>);

/// Runs the orbits that `next` gives, on this thread; `kernel` must compute their bodies, and amplitude equations must be those of the
/// first one, with any parameters. `done` gets the states of each, or `None` where a single orbit has to say what happened.
/// `false`, without any work, on a machine without lanes. See [`propagate_noisy`].
pub fn propagate_noisy_bodies(
    kernel: Kernel,
    stretch: Stretch,
    span: &NoisySpan,
    next: Next<'_, '_>,
    done: Done<'_>,
    watch: &dyn Watch,
) -> bool {
    match (kernel, stretch) {
        (Kernel::Tensor, Stretch::Shape) => run::<Common, ShapeAlone, 6>(span, next, done, watch),
        (Kernel::Tensor, Stretch::Plane) => run::<Common, WithPosition, 8>(span, next, done, watch),
        (Kernel::Amplitudes(1), Stretch::Shape) if TEXT => {
            run::<Text<2>, ShapeAlone, 2>(span, next, done, watch)
        }
        (Kernel::Amplitudes(1), Stretch::Plane) if TEXT => {
            run::<Text<2>, WithPosition, 4>(span, next, done, watch)
        }
        (Kernel::Amplitudes(2), Stretch::Shape) if TEXT => {
            run::<Text<4>, ShapeAlone, 4>(span, next, done, watch)
        }
        (Kernel::Amplitudes(2), Stretch::Plane) if TEXT => {
            run::<Text<4>, WithPosition, 6>(span, next, done, watch)
        }
        (Kernel::Amplitudes(3), Stretch::Shape) if TEXT => {
            run::<Text<6>, ShapeAlone, 6>(span, next, done, watch)
        }
        (Kernel::Amplitudes(3), Stretch::Plane) if TEXT => {
            run::<Text<6>, WithPosition, 8>(span, next, done, watch)
        }
        (Kernel::Amplitudes(_), Stretch::Shape) if TEXT => {
            run::<Text<8>, ShapeAlone, 8>(span, next, done, watch)
        }
        (Kernel::Amplitudes(_), Stretch::Plane) if TEXT => {
            run::<Text<8>, WithPosition, 10>(span, next, done, watch)
        }
        (Kernel::Amplitudes(_), _) => false,
    }
}

fn run<F: FromModel, E: Extent, const D: usize>(
    span: &NoisySpan,
    next: Next<'_, '_>,
    done: Done<'_>,
    watch: &dyn Watch,
) -> bool {
    let mut member = || {
        let NoisyStart { key, body, state, noise } = next()?;
        Some(NoisyMember { key, field: F::from_model(body)?, start: state.try_into().ok()?, noise })
    };
    let mut arrived = |key: usize, track: Option<NoisyTrack<D>>| match &track {
        Some(NoisyTrack { rows, last }) => {
            let rows = rows.iter().map(<[f64; D]>::as_slice).collect();
            done(key, Some(NoisyStates { rows, last }));
        }
        None => done(key, None),
    };
    propagate_noisy::<F, E, D>(span, NoisyQueue { next: &mut member, done: &mut arrived, watch })
}
