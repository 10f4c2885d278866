//! From states in a model's coordinates to the tracks of bodies.

use crate::accuracy::Accuracy;
use crate::statistics::Result;
use motiform_dynamics::model::{drift, velocity};
use motiform_dynamics::{Model, VectorField, Watch};
use motiform_statistics::{Settings, Statistics, Track, Tracks, statistics_watched};
use motiform_study::Plan;
use motiform_study::titles::capital;
use serde_json::Value;

/// Most modes of the shape that are looked at.
const MODES: usize = 4;

/// Statistics, and what they are of.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// Title of figures.
    pub title: String,
    /// The plan of the first body.
    pub plan: Plan,
    /// The source of the tracks: the plan and the number of bodies, or the folders.
    pub source: Value,
    /// The seeds of simulated bodies, in their order.
    pub seeds: Vec<u64>,
    /// Remarks on the bodies for the user, in sentences.
    pub notes: Vec<String>,
    /// `true` if all bodies that were asked for were computed.
    pub complete: bool,
    /// The numbers.
    pub statistics: Statistics,
}

/// The names of the first four modes of the shape: pairs of coordinates after the velocity.
///
/// `s11, s12` is `s`; `c2, s2` is `mode2`; `z2_re, z2_im` is `z2`; any other pair is joined: `a_b`.
pub fn mode_names(model: &dyn Model) -> Vec<String> {
    let names: Vec<&str> = model.coordinates()[model.velocities()..].iter().map(|c| c.name).collect();
    names.chunks_exact(2).take(MODES).map(|pair| mode_name(pair[0], pair[1])).collect()
}

fn mode_name(one: &str, other: &str) -> String {
    let split = |name: &str| {
        let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
        (letters.to_owned(), name[letters.len()..].to_owned())
    };
    match (split(one), split(other)) {
        ((a, _), (b, _)) if a == b && !a.is_empty() => a,
        ((_, a), (_, b)) if a == b && !a.is_empty() => format!("mode{a}"),
        _ => match (one.strip_suffix("_re"), other.strip_suffix("_im")) {
            (Some(a), Some(b)) if a == b => a.to_owned(),
            _ => format!("{one}_{other}"),
        },
    }
}

/// A track under construction.
pub(crate) struct Recorder<'m> {
    model: &'m dyn Model,
    /// The state, and its rate of change.
    shape: [Vec<f64>; 2],
    /// The rate in the model's coordinates.
    rates: Vec<f64>,
    track: Track,
    accuracy: Accuracy,
    /// `true` once it moves beyond the errors of its numbers.
    moves: bool,
}

impl<'m> Recorder<'m> {
    pub(crate) fn new(model: &'m dyn Model, accuracy: Accuracy) -> Self {
        let modes = mode_names(model).len();
        let track =
            Track { modes: vec![Vec::new(); modes], rates: vec![Vec::new(); modes + 1], ..Track::default() };
        let shape = [(); 2].map(|()| vec![0.0; model.dim()]);
        Self { model, shape, rates: vec![0.0; model.coordinates().len()], track, accuracy, moves: false }
    }

    /// A state: the model's coordinates and the position.
    pub(crate) fn push(&mut self, coordinates: &[f64], position: [f64; 2]) {
        let velocities = self.model.velocities();
        let [shape, rate] = &mut self.shape;
        self.model.encode(coordinates, shape);
        VectorField::<f64>::eval(self.model, 0.0, shape, rate);
        self.model.decode(rate, &mut self.rates);
        let (velocity, acceleration) = match velocities {
            2 => ([coordinates[0], coordinates[1]], [self.rates[0], self.rates[1]]),
            _ => (velocity(self.model, shape), drift(self.model, shape, rate).1),
        };
        self.moves |= libm::hypot(velocity[0], velocity[1]) > self.accuracy.least_speed(self.model, shape);
        let track = &mut self.track;
        track.position.push(position);
        track.velocity.push(velocity);
        let pairs = |values: &[f64]| -> Vec<[f64; 2]> {
            values[velocities..].chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect()
        };
        track.modes.iter_mut().zip(pairs(coordinates)).for_each(|(mode, pair)| mode.push(pair));
        let rates = std::iter::once(acceleration).chain(pairs(&self.rates));
        track.rates.iter_mut().zip(rates).for_each(|(series, pair)| series.push(pair));
    }

    /// The track; a body that moves nowhere beyond the errors of its numbers is at rest, and a mode that nowhere exceeds them is 0.
    pub(crate) fn finish(self) -> Track {
        let (mut track, least) = (self.track, self.accuracy.least(0.0));
        let clear = |series: &mut Vec<[f64; 2]>| series.fill([0.0; 2]);
        let (of_velocity, of_modes) = track.rates.split_at_mut(1);
        if !self.moves {
            let start = track.position.first().copied().unwrap_or_default();
            track.position.fill(start);
            clear(&mut track.velocity);
            of_velocity.iter_mut().for_each(clear);
        }
        for (mode, rates) in track.modes.iter_mut().zip(of_modes) {
            if mode.iter().all(|[a, b]| libm::hypot(*a, *b) < least) {
                clear(mode);
                clear(rates);
            }
        }
        track
    }
}

/// Says that bodies rest, if they do.
pub(crate) fn at_rest(found: &Statistics) -> Option<String> {
    let rest = found.rms_speed.value == 0.0;
    rest.then(|| {
        "the bodies rest: their speeds are 0 within the errors of the runs, so there are no figures of speeds, displacements and headings"
            .to_owned()
    })
}

/// The title of figures: that of the study, or the model.
pub(crate) fn title(plan: &Plan) -> String {
    let model = || format!("{} model", capital(plan.computation.model.as_str()));
    if plan.title.is_empty() { model() } else { plan.title.clone() }
}

/// The statistics of tracks of a plan's model.
pub(crate) fn measured(
    plan: &Plan,
    tracks: Vec<Track>,
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<Statistics> {
    let model = plan.body()?;
    let tracks = Tracks::new(plan.computation.dt_out, mode_names(model.as_ref()), tracks)?;
    let tracks = tracks.with_noise(plan.computation.noise.is_some());
    Ok(statistics_watched(&tracks, settings, watch)?)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::{Accuracy, Recorder, mode_name};
    use crate::statistics::datasets::track;
    use motiform_study::{RunPlan, Study};

    /// Rates of velocity and modes are the derivatives of their series: of an unknown velocity, of one read off the shape, of text.
    #[test]
    fn rates_are_derivatives_of_the_series() {
        let equations = "[model.amplitudes]\nmodes = [1, 2]\n[model.amplitudes.equations]\nz1 = \"(1 - |z1|^2)*z1 + conj(z1)*z2\"\n\
                         z2 = \"-(0.5 + i)*z2 + z1^2\"\n";
        for text in ["preset = \"fig5b\"\n", "preset = \"fig6a\"\n", equations] {
            let dt = 1e-3;
            let text = format!("{text}[run]\ntransient = 5\nt_end = 0.05\ndt_out = {dt}");
            let plan = RunPlan::new(&Study::parse(&text, "text", "test").unwrap()).unwrap();
            let run = crate::simulate::simulate(&plan, &()).unwrap().trajectory;
            let accuracy = Accuracy::with(plan.computation.control, None);
            let track = track(&run, plan.body().unwrap().as_ref(), accuracy, 0.0);
            let all = std::iter::once(&track.velocity).chain(&track.modes).zip(&track.rates);
            for (series, rates) in all {
                let largest = rates.iter().flatten().fold(1e-12, |most: f64, rate| most.max(rate.abs()));
                for k in 1..series.len() - 1 {
                    for c in 0..2 {
                        let slope = (series[k + 1][c] - series[k - 1][c]) / (2.0 * dt);
                        assert!(
                            (slope - rates[k][c]).abs() < 1e-3 * largest,
                            "{text}: {slope} {:?}",
                            rates[k]
                        );
                    }
                }
            }
        }
    }

    /// A body whose velocity and modes are errors alone rests; another one keeps all of its numbers.
    #[test]
    fn errors_are_no_motion() {
        let plan = RunPlan::new(&Study::parse("preset = \"fig1\"\n", "text", "test").unwrap()).unwrap();
        let model = plan.body().unwrap();
        let finished = |speed: f64| {
            let mut recorder = Recorder::new(model.as_ref(), Accuracy::with(plan.computation.control, None));
            let state = |scale: f64| [speed * scale, 0.0, 1e-11, 0.0, 0.3, 0.0];
            recorder.push(&state(1.0), [0.0; 2]);
            recorder.push(&state(0.5), [1e-20, 0.0]);
            recorder.finish()
        };
        let (rests, moves) = (finished(1e-25), finished(1e-3));
        assert_eq!((rests.velocity, rests.position), (vec![[0.0; 2]; 2], vec![[0.0; 2]; 2]));
        assert_eq!((moves.velocity[1], moves.position[1]), ([5e-4, 0.0], [1e-20, 0.0]));
        assert_eq!((moves.modes[0][0], moves.modes[1][0]), ([0.0; 2], [0.3, 0.0]));
    }

    #[test]
    fn modes_are_named_after_their_coordinates() {
        assert_eq!(mode_name("s11", "s12"), "s");
        assert_eq!(mode_name("c2", "s2"), "mode2");
        assert_eq!(mode_name("p", "q"), "p_q");
        assert_eq!(mode_name("z2_re", "z2_im"), "z2");
    }
}
