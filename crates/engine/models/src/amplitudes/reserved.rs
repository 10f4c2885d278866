//! Names that a parameter cannot have, because they mean something else in equations, tables or settings.

use super::parser::RESERVED;

/// Columns of trajectories, other than the coordinates.
const TRAJECTORY: [&str; 5] = ["t", "x", "y", "heading", "turning_rate"];

/// Columns of scans and atlases.
const SCAN: [&str; 21] = [
    "cell",
    "sample",
    "regime",
    "attractor",
    "course",
    "why",
    "margin",
    "resolution",
    "speed_mean",
    "speed_min",
    "speed_max",
    "period",
    "net_rotation",
    "drift",
    "swing",
    "lambda_1",
    "lambda_1_error",
    "escape_time",
    "time",
    "rows",
    "computed",
];

/// Columns of lifetimes.
const LIVES: [&str; 14] = [
    "blew_up", "captured", "lasting", "regular", "lost", "delay", "events", "watched", "early", "life",
    "lower", "upper", "starts", "until",
];

/// Columns of branches, of sweeps beneath them, and of curves of special points.
const BRANCHES: [&str; 25] = [
    "branch",
    "point",
    "motion",
    "form",
    "special",
    "stable",
    "unstable",
    "speed",
    "size",
    "leading_re",
    "leading_im",
    "slope",
    "up",
    "curve",
    "kind",
    "codimension_2",
    "critical_re",
    "critical_im",
    "first_lyapunov",
    "first_lyapunov_error",
    "residual",
    "transversality",
    "angle",
    "arclength",
    "parameter",
];

/// Keys of the special points of branches, beside those of [`BRANCHES`]: the parameter is one more of them.
const SPECIAL: [&str; 27] = [
    "amplitude",
    "amplitude_error",
    "attraction",
    "breaks",
    "coefficient",
    "coefficient_error",
    "connection",
    "criticality",
    "error",
    "frequency",
    "joins",
    "law",
    "leading_decaying",
    "leading_growing",
    "normal_form",
    "on",
    "others",
    "period_error",
    "rate",
    "rate_error",
    "remaining",
    "saddle",
    "saddle_quantity",
    "saddle_quantity_error",
    "saddles",
    "test",
    "undecided",
];

/// Settings of a run, which share the arguments of Python's `replace` with the parameters.
const SETTINGS: [&str; 15] = [
    "model",
    "initial",
    "t_end",
    "transient",
    "dt_out",
    "random",
    "seed",
    "noise",
    "noise_velocity",
    "stepper",
    "rtol",
    "atol",
    "step",
    "max_steps",
    "escape_norm",
];

/// The meaning that a name already has; `None` if a parameter can have it.
pub fn meaning(name: &str) -> Option<&'static str> {
    let is = |list: &[&str]| list.contains(&name);
    if is(&RESERVED) {
        Some("a function or a number in equations")
    } else if is_amplitude(name) {
        Some("an amplitude")
    } else if is(&["v1", "v2"]) || is_part(name) {
        Some("a coordinate of the body")
    } else if [&TRAJECTORY[..], &SCAN, &LIVES, &BRANCHES, &SPECIAL].into_iter().any(is) {
        Some("a column of result tables")
    } else if is(&SETTINGS) {
        Some("a setting of runs")
    } else {
        None
    }
}

/// `z2`
fn is_amplitude(name: &str) -> bool {
    name.strip_prefix('z').is_some_and(|rest| rest.parse::<u32>().is_ok())
}

/// `z2_re`
fn is_part(name: &str) -> bool {
    let amplitude = name.rsplit_once('_').filter(|(_, part)| ["re", "im", "abs"].contains(part));
    amplitude.is_some_and(|(amplitude, _)| is_amplitude(amplitude))
}
