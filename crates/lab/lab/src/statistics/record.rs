//! From states in a model's coordinates to the tracks of bodies.

use crate::statistics::Result;
use motiform_dynamics::Model;
use motiform_dynamics::model::velocity;
use motiform_statistics::{Settings, Statistics, Track, Tracks, statistics};
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
/// `s11, s12` is `s`; `c2, s2` is `mode2`; any other pair is joined: `a_b`.
#[must_use]
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
        _ => format!("{one}_{other}"),
    }
}

/// A track under construction.
pub(crate) struct Recorder<'m> {
    model: &'m dyn Model,
    shape: Vec<f64>,
    track: Track,
}

impl<'m> Recorder<'m> {
    pub(crate) fn new(model: &'m dyn Model) -> Self {
        let modes = vec![Vec::new(); mode_names(model).len()];
        Self { model, shape: vec![0.0; model.dim()], track: Track { modes, ..Track::default() } }
    }

    /// A state: the model's coordinates and the position.
    pub(crate) fn push(&mut self, coordinates: &[f64], position: [f64; 2]) {
        let velocities = self.model.velocities();
        let drift = if velocities == 2 {
            [coordinates[0], coordinates[1]]
        } else {
            self.model.encode(coordinates, &mut self.shape);
            velocity(self.model, &self.shape)
        };
        self.track.position.push(position);
        self.track.velocity.push(drift);
        for (mode, pair) in self.track.modes.iter_mut().zip(coordinates[velocities..].chunks_exact(2)) {
            mode.push([pair[0], pair[1]]);
        }
    }

    pub(crate) fn finish(self) -> Track {
        self.track
    }
}

/// The title of figures: that of the study, or the model.
pub(crate) fn title(plan: &Plan) -> String {
    let model = || format!("{} model", capital(plan.computation.model.as_str()));
    if plan.title.is_empty() { model() } else { plan.title.clone() }
}

/// The statistics of tracks of a plan's model.
pub(crate) fn measured(plan: &Plan, tracks: Vec<Track>, settings: &Settings) -> Result<Statistics> {
    let model = plan.body()?;
    let tracks = Tracks::new(plan.computation.dt_out, mode_names(model.as_ref()), tracks)?;
    Ok(statistics(&tracks, settings)?)
}

#[cfg(test)]
mod tests {
    use super::mode_name;

    #[test]
    fn modes_are_named_after_their_coordinates() {
        assert_eq!(mode_name("s11", "s12"), "s");
        assert_eq!(mode_name("c2", "s2"), "mode2");
        assert_eq!(mode_name("p", "q"), "p_q");
    }
}
