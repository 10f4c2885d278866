//! Changes of a body. Each keeps everything that it does not change, in particular the state.

use super::setting::{Seen, Setting, decode, state_of};
use crate::branches::Spot;
use crate::map::FARTHEST;
use crate::protocol::Put;
use motiform_dynamics::Normal;
use motiform_lab::live::start;
use motiform_study::plan::check;
use motiform_study::{Error, Random, RunPlan};
use std::collections::BTreeMap;

/// The strongest kick, relative to the shape.
const STRONGEST: f64 = 3.0;

/// A body placed on an unstable motion deviates from it by this part of its shape, so that it soon leaves it.
const DEVIATION: f64 = 1e-3;

impl Setting {
    /// The body with these parameters.
    pub(super) fn with(&self, parameters: &BTreeMap<String, f64>, seen: &Seen<'_>) -> Result<Self, Error> {
        let mut study = self.study().clone();
        study.set_all(parameters.iter().map(|(name, value)| (name.as_str(), *value)))?;
        let model = study.body()?;
        let state = if model.dim() == self.model().dim() {
            seen.state.to_vec()
        } else {
            // Fewer or more modes: those that there are stay.
            let (shape, position) = seen.state.split_at(self.model().dim());
            let old = decode(self.model(), shape);
            let named =
                |name| self.model().coordinates().iter().position(|coordinate| coordinate.name == name);
            let kept = |name| named(name).map_or(0.0, |place| old[place]);
            let new: Vec<f64> = model.coordinates().iter().map(|coordinate| kept(coordinate.name)).collect();
            state_of(model.as_ref(), &new, [position[0], position[1]])?
        };
        self.changed(study, seen.t, state, seen.radius)
    }

    /// The body with this noise.
    pub(super) fn with_noise(&self, amplitude: f64, seen: &Seen<'_>) -> Result<Self, Error> {
        let mut study = self.study().clone();
        self.origin().set_noise(&mut study, amplitude)?;
        self.changed(study, seen.t, seen.state.to_vec(), seen.radius)
    }

    /// The body after a random kick: every entry of the shape changes by a fraction of the size of it and its neighbours.
    pub(super) fn kicked(&self, strength: f64, seen: &Seen<'_>) -> Result<Self, Error> {
        let remedy = "a kick is a part of the size of the shape, from 0 to 3";
        check("strength", strength, (0.0..=STRONGEST).contains(&strength), remedy)?;
        let kicked = self.disturbed(seen.state, strength);
        self.changed(self.study().clone(), seen.t, kicked, seen.radius)
    }

    /// The body with everything that is given changed at once.
    pub(super) fn put(&self, put: &Put, seen: &Seen<'_>) -> Result<Self, Error> {
        let next = self.with(&put.parameters, seen)?;
        let model = next.model();
        let (shape, position) = next.start().state.split_at(model.dim());
        let mut coordinates = put.state.clone().unwrap_or_else(|| decode(model, shape));
        let names = ["v1", "v2"];
        for (name, value) in names.iter().zip(put.velocity.unwrap_or_default()) {
            let place = model.coordinates().iter().position(|coordinate| coordinate.name == *name);
            // The velocity of a cell follows from its shape.
            if let Some(entry) = place.filter(|_| put.velocity.is_some()).and_then(|k| coordinates.get_mut(k))
            {
                *entry = value;
            }
        }
        let state = state_of(model, &coordinates, put.position.unwrap_or([position[0], position[1]]))?;
        let mut study = next.study().clone();
        if let Some(noise) = put.noise {
            self.origin().set_noise(&mut study, noise)?;
        }
        self.changed(study, put.t.unwrap_or(seen.t), state, seen.radius)
    }

    /// The body on a point of a branch: with its parameters and its shape, where it is now. If the motion is unstable, the shape is
    /// disturbed a little.
    pub(super) fn placed(&self, spot: &Spot, seen: &Seen<'_>) -> Result<Self, Error> {
        let mut study = self.study().clone();
        let values = spot.plan.parameters_at(spot.sample.point.parameter);
        let names = spot.plan.computation.start.parameters.0.iter().map(|(name, _)| name.as_str());
        study.set_all(names.zip(values))?;
        let model = study.body()?;
        let position = seen.state.last_chunk().copied().unwrap_or_default();
        let mut state = state_of(model.as_ref(), &spot.sample.reading.state, position)?;
        if spot.sample.point.unstable > 0 {
            state = self.disturbed(&state, DEVIATION);
        }
        self.changed(study, seen.t, state, seen.radius)
    }

    /// A state whose shape is changed at random by a part of its size.
    fn disturbed(&self, state: &[f64], part: f64) -> Vec<f64> {
        let dim = state.len() - 2;
        let mut normal = Normal::new(self.study().run.seed, (1 << 40) + u64::from(self.revision()));
        let mut disturbed = state.to_vec();
        for (place, entry) in disturbed[..dim].iter_mut().enumerate() {
            // Entries of a mode come in pairs; high modes of a cell are tiny, and must stay so.
            let near = &state[place.saturating_sub(3)..(place + 4).min(dim)];
            let size = near
                .iter()
                .map(|x| x * x)
                .sum::<f64>()
                .sqrt()
                .max(1e-3 * self.study().random.unwrap_or(Random::SMALL).largest());
            *entry += part * size * normal.next();
        }
        disturbed
    }

    /// The body at its initial state, without the transient, but with these coordinates of the shape.
    pub(super) fn started(&self, coordinates: &BTreeMap<String, f64>, radius: f64) -> Result<Self, Error> {
        let plan = RunPlan::new(self.study())?;
        let mut state = start(&plan, self.model());
        if !coordinates.is_empty() {
            state = self.with_coordinates(&plan, &state, coordinates)?;
        }
        self.changed(self.study().clone(), 0.0, state, radius)
    }

    /// A state with other values of these coordinates of the shape.
    fn with_coordinates(
        &self,
        plan: &RunPlan,
        state: &[f64],
        coordinates: &BTreeMap<String, f64>,
    ) -> Result<Vec<f64>, Error> {
        let (info, model) = (plan.info()?, self.model());
        let parameters = plan.computation.parameters.values();
        let (shape, position) = state.split_at(model.dim());
        let mut values = decode(model, shape);
        for (name, value) in coordinates {
            let remedy =
                "coordinates of the start lie within those of maps: give a number of at most 1e9 in size";
            check("start", *value, value.abs() <= FARTHEST, remedy)?;
            if let Some(entry) = values.get_mut(info.coordinate(&parameters, name)?) {
                *entry = *value;
            }
        }
        state_of(model, &values, [position[0], position[1]])
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::super::setting::tests::begin;
    use super::*;
    use crate::catalogue::Catalogue;
    use crate::protocol::Begin;

    #[test]
    fn a_change_keeps_the_state() {
        let setting = begin("tensor", "fig5a");
        let seen = setting.start();
        let next = setting.with(&BTreeMap::from([("kappa2".to_owned(), 0.5)]), &seen).unwrap();
        assert_eq!((next.start(), next.revision()), (setting.start(), 2));
        assert_eq!(next.told().parameters.get("kappa2"), Some(0.5));
        assert_eq!(next.motion().plan.computation.parameters.get("kappa2"), Some(0.5));
        assert!(setting.with(&BTreeMap::from([("kapa2".to_owned(), 0.5)]), &seen).is_err());
        let noisy = setting.with_noise(0.1, &seen).unwrap();
        assert!(noisy.plan().computation.noise.is_some() && noisy.motion().plan.computation.noise.is_none());
    }

    /// One amplitude for both: the larger one; velocity and shape keep the ratio of the study.
    #[test]
    fn noise_keeps_the_ratio_of_its_study() {
        let catalogue = Catalogue::new(None).unwrap();
        let begin = |noise| Begin { model: "noisy-heading".to_owned(), noise, ..Begin::default() };
        let setting = Setting::begin(&begin(None), 1, &catalogue).unwrap();
        assert!(setting.begun().noise == 0.2 && setting.motion().noisy);
        let amplitudes = |setting: &Setting| (setting.study().run.noise, setting.study().run.noise_velocity);
        let less = setting.with_noise(0.1, &setting.start()).unwrap();
        assert_eq!((amplitudes(&less), less.told().noise), ((0.0, Some(0.1)), 0.1));
        assert_eq!(amplitudes(&Setting::begin(&begin(Some(0.1)), 1, &catalogue).unwrap()), (0.0, Some(0.1)));
        let none = less.with_noise(0.0, &setting.start()).unwrap();
        assert!(!none.motion().noisy);
        assert_eq!(amplitudes(&none.with_noise(0.2, &none.start()).unwrap()), (0.0, Some(0.2)));
    }

    #[test]
    fn the_modes_of_a_cell_that_stay_keep_their_values() {
        let setting = begin("cell", "fig6a");
        let seen = setting.start();
        let fewer = setting.with(&BTreeMap::from([("modes".to_owned(), 16.0)]), &seen).unwrap();
        let (old, new) =
            (decode(setting.model(), &seen.state[..42]), decode(fewer.model(), &fewer.start().state[..32]));
        assert_eq!(old[..32], new[..]);
    }

    #[test]
    fn a_kick_is_a_kick() {
        for (model, preset) in [("tensor", "fig5a"), ("tensor", "fig2"), ("cell", "fig6a")] {
            let setting = begin(model, preset);
            let seen = setting.start();
            let dim = setting.model().dim();
            let kicked = setting.kicked(0.2, &seen).unwrap();
            let size = |u: &[f64]| u.iter().map(|x| x * x).sum::<f64>().sqrt();
            let difference: Vec<f64> =
                kicked.start().state[..dim].iter().zip(seen.state).map(|(a, b)| a - b).collect();
            let part = size(&difference) / size(&seen.state[..dim]);
            assert!((0.02..2.0).contains(&part), "{preset}: {part}");
            assert_eq!(kicked.start().state[dim..], seen.state[dim..]);
            assert!(setting.kicked(3.1, &seen).is_err() && setting.kicked(-0.1, &seen).is_err());
        }
    }

    #[test]
    fn whatever_is_given_is_put() {
        let setting = begin("tensor", "fig5a");
        let seen = setting.start();
        let put = Put {
            parameters: BTreeMap::from([("kappa2".to_owned(), 0.5)]),
            position: Some([7.0, -3.0]),
            velocity: Some([0.25, 0.5]),
            ..Put::default()
        };
        let next = setting.put(&put, &seen).unwrap();
        let (shape, position) = next.start().state.split_at(6);
        let coordinates = decode(next.model(), shape);
        assert_eq!((coordinates[0], coordinates[1], position), (0.25, 0.5, [7.0, -3.0].as_slice()));
        assert_eq!(coordinates[2..], decode(setting.model(), &seen.state[..6])[2..], "the shape stays");
        assert_eq!((next.told().parameters.get("kappa2"), next.start().t), (Some(0.5), seen.t));
        let noisy = Put { noise: Some(1.5), ..Put::default() };
        assert!(setting.put(&noisy, &seen).is_err());
        let short = Put { state: Some(vec![1.0]), ..Put::default() };
        assert!(setting.put(&short, &seen).is_err());
        assert!(setting.with_noise(1.0, &seen).is_ok() && setting.with_noise(1.1, &seen).is_err());
    }
}
