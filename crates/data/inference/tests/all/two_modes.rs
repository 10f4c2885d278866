//! Models of z1 and z2 alone, and the noise of the centre.

use crate::common::{Experiment, FULL, full, quasi_periodic, vertex_noise};
use motiform_dynamics::Normal;
use motiform_inference::{Library, Settings, Track, fit, identifiability};

/// A quasi-periodic cell whose z3 is below its errors: with z3 nothing is identifiable, and z1 and z2 alone have their coefficients.
#[test]
fn a_mode_that_is_not_seen_is_left_out() {
    let experiment = Experiment {
        errors: vertex_noise(0.35),
        interval: 1.0,
        transient: 600.0,
        ..Experiment::new(quasi_periodic(), 0.0005, 5)
    };
    let tracks = [experiment.track()];
    let library = Library::tensor().seen(&tracks);
    assert_eq!((library.modes, library.terms.len()), (2, 8));
    let found = fit(&tracks, &Settings { library, ..Settings::default() }, &()).expect("a fit");
    assert!(found.converged() && found.noise.eta_v.value < 0.001, "{:?}", found.noise);
    let truth = [
        ("z1: z1", 0.02),
        ("z1: z1* z2", -2.0),
        ("z1: |z1|^2 z1", -1.0),
        ("z2: z2", 0.06),
        ("z2: z1^2", 0.125),
        ("z2: |z2|^2 z2", -8.0),
    ];
    for (name, value) in truth {
        let one = found.coefficient(name).expect("a term").estimate;
        assert!((one.value - value).abs() < 4.0 * one.error, "{name}: {one:?}");
    }
    let whole = fit(&tracks, &Settings::default(), &()).expect("a fit");
    let reasons = identifiability(&whole).reasons.join("; ");
    assert!(reasons.contains("z3 does not exceed its errors"), "{reasons}");
}

#[test]
fn modes_that_are_seen_stay() {
    let tracks = [Experiment { frames: 100, ..Experiment::new(full(0.5, 0.1), 0.02, 5) }.track()];
    assert_eq!(Library::tensor().seen(&tracks), Library::tensor());
}

/// Outlines of each frame displaced together by 0.5 % of R0 = 2: the noise of the centre is that, and is 0
/// without it, where the fit is that of a centre without noise.
#[test]
fn a_jitter_is_the_noise_of_the_centre() {
    let settings =
        Settings { library: Library::tensor().select(&FULL).expect("terms"), ..Settings::default() };
    let (mut zeros, jitter) = (0, 0.01);
    for seed in 0..6 {
        let still = Experiment { frames: 400, ..Experiment::new(full(0.5, 0.1), 0.02, 60 + seed) }.track();
        let mut random = Normal::new(seed, 5);
        let mut moved = Track(still.0.clone());
        moved.0.iter_mut().flat_map(|frame| &mut frame.y[..2]).for_each(|x| *x += jitter * random.next());
        let [still, moved] = [still, moved].map(|track| fit(&[track], &settings, &()).expect("a fit"));
        zeros += usize::from(still.noise.centre.value == 0.0);
        let centre = moved.noise.centre;
        println!("{:?} {centre:?} s {:.3}", still.noise.centre, moved.noise.s.value);
        assert!(still.noise.centre.value < 0.003, "{:?}", still.noise.centre);
        assert!(
            (centre.value - jitter).abs() < 4.0 * centre.error && centre.error < 0.1 * jitter,
            "{centre:?}"
        );
        let s = moved.noise.s;
        assert!((s.value - 1.0).abs() < 4.0 * s.error, "{s:?}");
    }
    // half of the scores are on the other side of 0
    assert!((1..6).contains(&zeros), "{zeros} of 6");
}
