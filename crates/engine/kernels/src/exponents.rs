//! All Lyapunov exponents, in lanes.

use crate::kernel::{Common, FromModel, Kernel, TEXT, Text};
use motiform_analysis::Result;
use motiform_analysis::lyapunov::{
    Lyapunov, LyapunovSettings, TangentMember, lyapunov_in_lanes, runs_in_lanes,
};
use motiform_dynamics::{Equivariant, Model, StepControl, Tolerance, Watch};

/// A borrowed body.
struct Body<'m>(&'m (dyn Model + 'static));

impl AsRef<dyn Equivariant> for Body<'_> {
    fn as_ref(&self) -> &(dyn Equivariant + 'static) {
        self.0
    }
}

/// Most modes of amplitude equations whose exponents have a kernel.
const MOST_MODES: usize = 3;

/// The kernel of all exponents of a body, by a method that has lanes; `None` if there is none.
fn kernel(body: &(dyn Model + 'static), settings: &LyapunovSettings) -> Option<Kernel> {
    let kernel = Kernel::of(body)?;
    let compiled = match kernel {
        Kernel::Tensor => true,
        Kernel::Amplitudes(modes) => modes <= MOST_MODES,
    };
    (compiled && settings.count == body.dim() && runs_in_lanes(settings)).then_some(kernel)
}

/// Returns `true` if [`exponents_of_body`] is applicable: all exponents, of a model within a kernel's terms,
/// by a method that has lanes.
pub fn has_exponents(body: &(dyn Model + 'static), settings: &LyapunovSettings) -> bool {
    kernel(body, settings).is_some()
}

/// Provides the next initial shape with its key; `None` at the end.
type Next<'n> = &'n mut dyn FnMut() -> Option<(usize, Vec<f64>)>;

/// Receives a result with its start's key.
type Done<'d> = &'d mut dyn FnMut(usize, Result<Lyapunov>);

/// All exponents of the orbits of one body with the initial states from `next`; each result is passed to `done` with the start's
/// key. The same bits as [`motiform_analysis::lyapunov()`] gives one by one. When `watch` stops it, the rest is left.
/// Does nothing if [`has_exponents`] is false.
pub fn exponents_of_body(
    body: &(dyn Model + 'static),
    settings: &LyapunovSettings,
    next: Next<'_>,
    done: Done<'_>,
    watch: &dyn Watch,
) {
    match kernel(body, settings) {
        Some(Kernel::Tensor) => run::<Common, 6, 42>(body, settings, next, done, watch),
        Some(Kernel::Amplitudes(1)) if TEXT => run::<Text<2>, 2, 6>(body, settings, next, done, watch),
        Some(Kernel::Amplitudes(2)) if TEXT => run::<Text<4>, 4, 20>(body, settings, next, done, watch),
        Some(Kernel::Amplitudes(3)) if TEXT => run::<Text<6>, 6, 42>(body, settings, next, done, watch),
        _ => {}
    }
}

fn run<F: FromModel, const N: usize, const D: usize>(
    body: &(dyn Model + 'static),
    settings: &LyapunovSettings,
    next: Next<'_>,
    done: Done<'_>,
    watch: &dyn Watch,
) {
    let (StepControl::Adaptive { rtol, atol }, Some(field)) = (settings.control, F::from_model(body)) else {
        return;
    };
    let mut member = || {
        let (key, start) = next()?;
        let start = start.try_into().ok()?;
        Some(TangentMember { key, body: Body(body), field: field.clone(), start, settings: *settings })
    };
    lyapunov_in_lanes::<_, F, N, N, D>(Tolerance { rtol, atol }, &mut member, done, watch);
}
