//! The distance of the samples of bodies, where it is not given.

use motiform_study::study::RunSettings;

/// Samples of a run whose distance is not given.
const OF_A_RUN: f64 = 2000.0;

/// Samples of all bodies together, at most.
const OF_ALL: f64 = 2e6;

/// Time between the samples of so many bodies that run for `t_end`, where the study has times of its own: those of its run, however long
/// the bodies are followed, unless all of them together have more than two million samples; then the next of 1, 2 and 5 times a power of
/// ten that leaves no more. A run has 2000 samples at least. Longer runs so have more samples, not coarser ones.
///
/// # Units   model time
pub fn samples_apart(own: &RunSettings, t_end: f64, bodies: u64) -> f64 {
    let usual = usual(own);
    let fewest = bodies as f64 * t_end / OF_ALL;
    let longest = t_end / OF_A_RUN;
    if usual.max(fewest) >= longest || !fewest.is_finite() {
        longest
    } else if usual >= fewest {
        usual
    } else {
        round_up(fewest).min(longest)
    }
}

/// The sentence for samples that [`samples_apart`] puts farther apart than the subject's own run does.
pub fn coarser_than_own(own: &RunSettings, apart: f64) -> Option<String> {
    let usual = usual(own);
    (apart > usual * (1.0 + 1e-9)).then(|| {
        format!(
            "samples are {apart} apart, and {usual} in the subject's own run: all bodies together would have more than two million; \
             dt_out = {usual} keeps them all"
        )
    })
}

fn usual(own: &RunSettings) -> f64 {
    if own.dt_out > 0.0 { own.dt_out } else { own.t_end / OF_A_RUN }
}

/// The next of 1, 2 and 5 times a power of ten.
fn round_up(x: f64) -> f64 {
    let power = libm::pow(10.0, libm::floor(libm::log10(x)));
    let least = x * (1.0 - 1e-9);
    [1.0, 2.0, 5.0].map(|step| step * power).into_iter().find(|y| *y >= least).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn farther_apart_than_usual_is_said() {
        let own = RunSettings { dt_out: 0.05, ..RunSettings::default() };
        assert_eq!(coarser_than_own(&own, samples_apart(&own, 100.0, 50)), None);
        let said = coarser_than_own(&own, samples_apart(&own, 4000.0, 500)).unwrap_or_default();
        assert!(
            said.starts_with("samples are 1 apart, and 0.05") && said.contains("dt_out = 0.05"),
            "{said}"
        );
    }

    #[test]
    fn longer_runs_have_more_samples_until_there_are_too_many() {
        let own = RunSettings { dt_out: 0.05, t_end: 60.0, ..RunSettings::default() };
        assert_eq!([100.0, 2000.0].map(|t_end| samples_apart(&own, t_end, 50)), [0.05; 2]);
        assert_eq!(samples_apart(&own, 10_000.0, 64), 0.5); // 20,000 samples of each
        assert_eq!(samples_apart(&RunSettings { dt_out: 0.0, ..own.clone() }, 100.0, 1), 0.03);
        // 2000 samples of each at least, of a short run and of many bodies
        assert_eq!([(10.0, 1), (1000.0, 1_000_000)].map(|(t, n)| samples_apart(&own, t, n)), [0.005, 0.5]);
        assert_eq!([0.1, 0.11, 0.3, 0.6].map(round_up), [0.1, 0.2, 0.5, 1.0]);
    }
}
