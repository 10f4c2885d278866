//! What leaves a fit without motion, place and symmetry.

use motiform_inference::{HANDED_RATE, Handedness, Stretch, Symmetry, Track, Warning};

/// Significance below which innovations that are not white leave a cell without motion and place.
const COLOURED: f64 = 1e-6;

/// Serious warnings, and what speaks against the test of handedness; `beside`: its p-values beside a velocity of the stage, and in
/// stretched images.
pub(super) fn doubts(
    tracks: &[Track],
    warnings: &[Warning],
    handedness: &Handedness,
    [beside_stage, beside_stretch]: [Option<f64>; 2],
) -> Vec<String> {
    let mut doubts: Vec<String> = warnings.iter().filter(|w| serious(w)).map(ToString::to_string).collect();
    let handed = handedness.symmetry == Symmetry::Handed;
    if handedness.p_value < HANDED_RATE && !handed {
        doubts.push(format!(
            "whether the cell is handed is not decided: its likelihood says so (p = {:.1e}), but its imaginary parts are within their robust errors (p = {:.1e}), or the fit did not converge",
            handedness.p_value, handedness.robust_p_value
        ));
    } else if handedness.is_doubted() && !handed {
        doubts.push(format!(
            "whether the cell is handed is not decided: a mirror-symmetric one has such a likelihood ratio with p = {:.1e}",
            handedness.p_value
        ));
    }
    if let Some(p) = beside_stage.filter(|p| *p >= HANDED_RATE) {
        doubts.push(format!("it is handed, or the stage drifts: beside a velocity that does not turn with the cell, a mirror-symmetric one has such a likelihood ratio with p = {p:.1e}"));
    }
    if let Some(p) = beside_stretch.filter(|p| *p >= HANDED_RATE) {
        doubts.push(format!("it is handed, or the images are stretched: beside a strain of the path and an elongation that do not turn with the cell, a mirror-symmetric one has such a likelihood ratio with p = {p:.1e}"));
    }
    let suspected = |found: &Stretch| found.is_suspected(tracks.len()) && !found.is_clear(tracks.len());
    if let Some(found) = tracks.iter().filter_map(Stretch::of).find(suspected).filter(|_| handed) {
        doubts.push(format!(
            "it is handed, or the images are stretched: beside what turns with the cell, outlines have a constant elongation of {:.1} % of the mean size of z2 (p = {:.1e} without a stretch)",
            100.0 * found.share, found.p_value
        ));
    }
    doubts
}

/// Why the coefficients are biased by more than their intervals say; `None` where nothing shows it.
pub(super) fn bias(warnings: &[Warning]) -> Option<&'static str> {
    warnings.iter().find_map(|warning| match warning {
        Warning::CoarseSampling { .. } => {
            Some("the sampling is too coarse for the fastest rate of the equations, which biases the coefficients")
        }
        Warning::Drifting { .. } => Some(
            "coefficients change with the sampling interval: they have a bias that intervals from the noise do not hold",
        ),
        _ => None,
    })
}

/// `true` if there is no motion and no place with this warning.
fn serious(warning: &Warning) -> bool {
    match warning {
        Warning::Unbounded { .. }
        | Warning::NotConverged { .. }
        | Warning::CoarseSampling { .. }
        | Warning::Carried { .. }
        | Warning::Stretched { .. } => true,
        Warning::Coloured { channels } => channels.iter().any(|channel| channel.p_value < COLOURED),
        _ => false,
    }
}
