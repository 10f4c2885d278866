//! Data sets of bodies for the coverage of intervals: three motions of the tensor model, two processes with closed forms.

use super::common::active_brownian;
use motiform_dynamics::Normal;
use motiform_lab::ensemble::{Member, tracks};
use motiform_lab::noisy::noisy_tracks;
use motiform_statistics::{Settings, Statistics, Track, Tracks, statistics};
use motiform_study::{RunPlan, Study};

/// The source of the bodies of a motion.
#[derive(Clone, Copy)]
pub(crate) enum Source {
    /// A study of the tensor model; bodies are cut from longer runs, with a gap between them.
    Tensor(&'static str),
    /// Rotational diffusion, rate of turning, translational diffusion.
    Active(f64, f64, f64),
}

/// A motion and the size of its data sets.
#[derive(Clone, Copy)]
pub(crate) struct Motion {
    pub(crate) name: &'static str,
    pub(crate) source: Source,
    /// The finest time between samples.
    pub(crate) dt: f64,
    pub(crate) bodies: usize,
    /// Samples of a body at that interval.
    pub(crate) samples: usize,
    /// Radii of discs.
    pub(crate) radii: [f64; 2],
    /// A threshold of the speed.
    pub(crate) threshold: f64,
}

/// Bodies cut from one run, and the part of a body's time between them.
const CUT: (usize, f64) = (4, 0.2);

impl Motion {
    /// All motions.
    pub(crate) fn all() -> [Self; 6] {
        let tensor = |name, source, samples, radii, threshold| Self {
            name,
            source: Source::Tensor(source),
            dt: 0.5,
            bodies: 24,
            samples,
            radii,
            threshold,
        };
        let active = |name, source, dt, samples, radii| Self {
            name,
            source,
            dt,
            bodies: 24,
            samples,
            radii,
            threshold: 0.5,
        };
        [
            tensor(
                "zigzag",
                "kappa2=0.9\nkappa3=0.1\n[run]\nnoise=0.05\ntransient=500",
                1200,
                [3.0, 12.0],
                0.9,
            ),
            tensor(
                "chaos",
                "kappa2=0.5\nkappa3=0.1\na2=0.2\nb3=0.3\nd3=0.05\n[run]\ntransient=500",
                4000,
                [3.0, 12.0],
                0.877,
            ),
            tensor(
                "circles",
                "kappa2=0.5\nkappa3=0.6\n[run]\nnoise=0.1\ntransient=100",
                800,
                [2.0, 6.0],
                0.9,
            ),
            active("chiral", Source::Active(0.1, 0.3, 0.0), 0.5, 600, [2.0, 5.0]),
            active("active Brownian", Source::Active(0.5, 0.0, 0.0), 0.25, 400, [1.0, 4.0]),
            active("noisy active Brownian", Source::Active(0.5, 0.0, 0.05), 0.25, 400, [1.0, 4.0]),
        ]
    }

    /// The bodies of some data sets, one after the other.
    pub(crate) fn sets(&self, first: usize, count: usize) -> Vec<Vec<Track>> {
        let all: Vec<Track> = match self.source {
            Source::Active(d_r, omega, d) => (first * self.bodies..(first + count) * self.bodies)
                .map(|body| {
                    active_brownian((d_r, omega, d), self.dt, self.samples, &mut Normal::new(77, body as u64))
                })
                .collect(),
            Source::Tensor(text) => {
                let stride = (self.samples as f64 * (1.0 + CUT.1)) as usize;
                let t_end = self.dt * (CUT.0 * stride) as f64;
                let base = "[model.tensor]\na1=-1\nb1=-0.5\nb2=0.3\nd1=0.1\nd2=0.8\ngamma=1\n";
                let text = format!("{base}{text}\nt_end={t_end}\ndt_out={}", self.dt);
                let runs = count * self.bodies / CUT.0;
                let runs = bodies(&text, runs, 1 + (first * self.bodies / CUT.0) as u64);
                let cut = |run: &Track| {
                    (0..CUT.0).map(|k| Self::part(run, k * stride, self.samples)).collect::<Vec<_>>()
                };
                runs.iter().flat_map(cut).collect()
            }
        };
        all.chunks(self.bodies).map(<[Track]>::to_vec).collect()
    }
}

impl Motion {
    /// A part of a track.
    pub(crate) fn part(track: &Track, from: usize, count: usize) -> Track {
        each(track, |series| series[from..from + count].to_vec())
    }
}

/// The statistics of every `step`-th sample.
pub(crate) fn measured(motion: &Motion, bodies: &[Track], step: usize) -> Statistics {
    let thin = |series: &[[f64; 2]]| series.iter().step_by(step).copied().collect();
    let bodies: Vec<Track> = bodies.iter().map(|track| each(track, thin)).collect();
    let names = ["s", "u"].iter().take(bodies[0].modes.len()).map(|name| (*name).to_owned()).collect();
    let tracks = Tracks::new(motion.dt * step as f64, names, bodies).expect("tracks");
    let threshold = Some(("speed".to_owned(), Some(motion.threshold)));
    statistics(&tracks, &Settings { radii: motion.radii.to_vec(), threshold }).expect("statistics")
}

/// Bodies of one study, with the seeds `first`, `first + 1`, ...
fn bodies(text: &str, count: usize, first: u64) -> Vec<Track> {
    let mut study = Study::parse(text, "text", "test").expect("a study");
    let plan = |body: u64| {
        study.run.seed = first + body;
        RunPlan::new(&study).expect("a plan")
    };
    let plans: Vec<RunPlan> = (0..count as u64).map(plan).collect();
    let c = &plans[0].computation;
    let found = if c.noise.is_some() {
        noisy_tracks(&plans, 1, &())
    } else {
        let rows = (c.t_end / c.dt_out * (1.0 + 1e-12)).floor() as usize;
        let times: Vec<f64> = (0..=rows).map(|k| c.transient + k as f64 * c.dt_out).collect();
        let member = |plan: &RunPlan| Member {
            parameters: plan.computation.parameters.values(),
            start: plan.computation.initial.values(),
        };
        tracks(&plans[0], &plans.iter().map(member).collect::<Vec<_>>(), &times, 1, &())
    };
    let found = found.expect("orbits").expect("not stopped");
    found.iter().map(|body| track(&body.states)).collect()
}

/// A track of the tensor model: velocity, ellipse, triangle, position.
fn track(states: &[Vec<f64>]) -> Track {
    let pair = |at: usize| states.iter().map(|u| [u[at], u[at + 1]]).collect::<Vec<_>>();
    Track { position: pair(6), velocity: pair(0), modes: vec![pair(2), pair(4)], rates: Vec::new() }
}

fn each(track: &Track, of: impl Fn(&[[f64; 2]]) -> Vec<[f64; 2]>) -> Track {
    Track {
        position: of(&track.position),
        velocity: of(&track.velocity),
        modes: track.modes.iter().map(|mode| of(mode)).collect(),
        rates: track.rates.iter().map(|rate| of(rate)).collect(),
    }
}
