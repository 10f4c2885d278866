//! Doubts that leave a fit without motion, place and symmetry.

use crate::regime::FittedRegime;
use motiform_inference::{COLOURED, HANDED_RATE, Handedness, PValue, Symmetry, Warning};

/// Least p-value of white innovations, of any channel, of a handed cell: that of white noise is lower in 10 to 20 of 1000 records of 120
/// to 300 frames and six channels (the test is one of many frames). Below [`COLOURED`] it is a warning, handed or not.
const WHITE: f64 = 1e-3;

/// Serious warnings, and what speaks against the test of handedness; `beside`: its p-values beside a velocity of the stage, in
/// stretched images, and beside a change of the law.
pub(super) fn doubts(
    warnings: &[Warning],
    handedness: &Handedness,
    [beside_stage, beside_stretch, beside_change]: [Option<f64>; 3],
    white: Option<f64>,
) -> Vec<String> {
    let mut doubts: Vec<String> = warnings.iter().filter(|w| serious(w)).map(ToString::to_string).collect();
    let handed = handedness.symmetry == Symmetry::Handed;
    if warnings.iter().any(|warning| matches!(warning, Warning::NotConverged { .. })) {
        // the test decides nothing then
    } else if handedness.p_value < HANDED_RATE && !handed {
        let robust = PValue(handedness.robust_p_value);
        let but = match handedness.robust_p_value < HANDED_RATE {
            true => "but the fit with imaginary parts did not converge".to_owned(),
            false => format!("but its imaginary parts are within their robust errors ({robust})"),
        };
        doubts.push(format!(
            "whether the cell is handed is not decided: its likelihood says so ({}), {but}",
            PValue(handedness.p_value)
        ));
    } else if handedness.is_doubted() && !handed {
        doubts.push(format!(
            "whether the cell is handed is not decided: a mirror-symmetric one has such a likelihood ratio with {}",
            PValue(handedness.p_value)
        ));
    }
    if let Some(p) = white.filter(|p| handed && (COLOURED..WHITE).contains(p)) {
        doubts.push(format!(
            "whether the cell is handed is not decided: innovations of the handed law are not white ({}), and what it leaves out, as a \
             drive that comes and goes, may look like a handedness",
            PValue(p)
        ));
    }
    let others = [
        (beside_stage, "the stage drifts: beside a velocity that does not turn with the cell"),
        (
            beside_stretch,
            "the images are stretched: beside a strain of the path and an elongation that do not turn with the cell",
        ),
        (beside_change, "it changes: where parts of the record have coefficients of their own"),
    ];
    for (p, other) in others {
        if let Some(p) = p.filter(|p| *p >= HANDED_RATE) {
            doubts.push(format!(
                "it is handed, or {other}, a mirror-symmetric one has such a likelihood ratio with {}",
                PValue(p)
            ));
        }
    }
    doubts
}

/// Why neither intervals of the coefficients nor a place are stated: for the sake of the motion ([`FittedRegime::no_intervals`]), because
/// the sampling biases the coefficients, or because the noise is not as the model has it.
pub(super) fn no_intervals(regime: Option<&FittedRegime>, warnings: &[Warning]) -> Option<&'static str> {
    regime.and_then(FittedRegime::no_intervals).or_else(|| bias(warnings))
}

pub(super) fn bias(warnings: &[Warning]) -> Option<&'static str> {
    warnings.iter().find_map(|warning| match warning {
        Warning::CoarseSampling { .. } => {
            Some("the sampling is too coarse for the fastest rate of the equations, which biases the coefficients")
        }
        Warning::Drifting { .. } => Some(
            "coefficients change with the sampling interval: they have a bias that intervals from the noise do not hold",
        ),
        Warning::Changing { .. } => Some(
            "coefficients of the first half of the record are not those of the second: one set of them does not describe the cell",
        ),
        Warning::UnequalNoise(_) => Some(
            "modes of the shape have different noise, and the model has one amplitude for all of them: errors of coefficients are wrong",
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

#[cfg(test)]
mod tests {
    use super::{no_intervals, serious};
    use motiform_inference::Warning;

    #[test]
    fn coefficients_that_the_sampling_biases_have_no_intervals() {
        let drifting = Warning::Drifting { names: vec!["z2: z2".to_owned()] };
        let coarse = Warning::CoarseSampling { product: 2.5 };
        let other = Warning::ErrorsDiffer { ratio: 2.0 };
        let why = |warnings: &[Warning]| no_intervals(None, warnings);
        assert!(why(&[other.clone(), drifting.clone()]).is_some_and(|why| why.contains("sampling interval")));
        assert!(why(std::slice::from_ref(&coarse)).is_some_and(|why| why.contains("too coarse")));
        assert_eq!((why(&[]), why(&[other])), (None, None));
        // one is a doubt about the motion, too, the other is not
        assert!(serious(&coarse) && !serious(&drifting));
    }
}
