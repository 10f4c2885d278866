//! Lyapunov exponents of a given function.

use super::{Flow, Settings, check_start};
use motiform_analysis::{Lyapunov, LyapunovSettings};
use motiform_dynamics::Watch;
use motiform_study::Error;

/// The `count` largest exponents of the orbit from `start`, averaged over `t_end` after `transient`, by the tangent flow: exact with a
/// Jacobian, otherwise with differences of an error of about 1e-12. The number of neutral exponents is that
/// of the flow's direction; rotations of the plane are not known.
///
/// # Errors
/// A count that there is not, times or a start out of range, a function that depends on the time (at the start or at the end of the orbit).
///
/// # Checked by  tests/all/given.rs: a linear flow (exact), the zoo's Lorenz system with and without a Jacobian
pub fn exponents(
    flow: &Flow<'_>,
    start: &[f64],
    count: usize,
    transient: f64,
    t_end: f64,
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<Lyapunov, Error> {
    check_start(flow, start)?;
    if count == 0 || count > start.len() {
        return Err(Error::Count { count, dim: start.len() });
    }
    settings.scales.check_time("transient", transient, false)?;
    settings.scales.check_time("t_end", t_end, true)?;
    check_autonomous(flow, start, t_end)?;
    let Settings { method, control, max_steps, escape_norm, .. } = *settings;
    let settings =
        LyapunovSettings { count, method, control, transient, span: t_end, escape_norm, max_steps };
    let found = motiform_analysis::lyapunov(flow, start, &settings, watch)?;
    check_autonomous(flow, &found.shape, t_end)?;
    Ok(found.bounded())
}

/// The function must have the same rates at other times.
fn check_autonomous(flow: &Flow<'_>, x: &[f64], t_end: f64) -> Result<(), Error> {
    let rates = |t: f64| {
        let mut dx = vec![f64::NAN; x.len()];
        flow.rates(t, x, &mut dx);
        dx.into_iter().map(f64::to_bits).collect::<Vec<_>>()
    };
    let first = rates(0.0);
    match [0.37 * t_end, 0.81 * t_end, t_end].into_iter().find(|&t| rates(t) != first) {
        None => Ok(()),
        Some(t) => Err(Error::Setting {
            key: "function",
            value: format!("other rates at t = {t} than at t = 0"),
            remedy: "exponents are those of a flow that does not depend on the time: make the phase a coordinate, with a constant rate",
        }),
    }
}
