//! The same numbers within their intervals, whatever cannot matter: seed, number of bodies, time recorded, sampling interval.

use super::coverage::{depends_on_sampling, printed};
use super::motions::{Motion, measured};
use motiform_statistics::{Measured, Track};

/// Half widths together (95 %) within which two numbers are one: three standard errors.
const ALIKE: f64 = 1.5;

fn compare(what: &str, one: &[Track], other: &[Track], motion: &Motion, steps: [usize; 2]) {
    let [one, other] =
        [(one, steps[0]), (other, steps[1])].map(|(bodies, step)| printed(&measured(motion, bodies, step)));
    let mut compared = 0;
    for (name, answer) in &one {
        let pair = answer.known().zip(other.get(name).and_then(motiform_statistics::Answer::known));
        let Some((a, b)) = pair else { continue };
        let own = steps[0] != steps[1] && depends_on_sampling(name);
        if own || name.contains("longest") || name.contains("middle") || name.contains("octave") {
            continue; // other lags
        }
        let half = a.half_width().hypot(b.half_width());
        assert!((a.value - b.value).abs() <= ALIKE * half, "{what}, {name}: {a:?} and {b:?}");
        compared += 1;
    }
    assert!(compared >= 8, "{what}: {compared}");
}

/// Chaos, whose correlations oscillate: `-0.21`, `0.53` and `0.27` were once the correlation time of its speed.
#[test]
fn what_cannot_matter_does_not() {
    let motion = Motion::all()[1];
    let sets = motion.sets(0, 3);
    let [first, second, third] = [0, 1, 2].map(|set| sets[set].clone());
    compare("another seed", &first, &second, &motion, [1, 1]);
    let many: Vec<Track> = first.iter().chain(&second).chain(&third).cloned().collect();
    compare("three times the bodies", &first, &many, &motion, [1, 1]);
    let half = |track: &Track| Motion::part(track, 0, motion.samples / 2);
    compare("half of the time", &first, &third.iter().map(half).collect::<Vec<_>>(), &motion, [1, 1]);
    compare("half as often", &first, &second, &motion, [1, 2]);
    let time = |bodies: &[Track]| -> Measured {
        printed(&measured(&motion, bodies, 1))["time of speed"].known().expect("a time")
    };
    // an integral over the spectrum is never negative, and small where a correlation oscillates: 0.125 of a period of 14
    assert!((0.05..0.25).contains(&time(&many).value) && time(&first).lower() > 0.0);
}
