//! A body between two changes: model, parameters, initial state.

use crate::catalogue::{Catalogue, Subject};
use crate::motion::Motion;
use crate::protocol::{Begin, Begun, Changed, Observable};
use motiform_dynamics::{InPlane, Model};
use motiform_lab::draw::radius_for;
use motiform_lab::live::{Record, Stretch, settled};
use motiform_study::plan::check;
use motiform_study::study::{DisplaySettings, ReturnMapSettings};
use motiform_study::{Error, RunPlan, Study};
use std::rc::Rc;
use std::time::Duration;

/// A transient that takes longer is truncated, because the page waits.
const SETTLING: Duration = Duration::from_millis(300);

/// A short integration ahead, to draw the body from the start with a radius that suits its deformation: samples, and time limit.
const AHEAD: (usize, Duration) = (600, Duration::from_millis(30));

/// No entry of a shape is larger, and no body is farther away or later: sums of squares and steps of time stay numbers.
const LARGEST: (f64, f64) = (1e9, 1e12);

/// The data of a body that stay the same until the next change.
pub(crate) struct Setting {
    /// Model and preset as the page names them.
    model_name: String,
    preset: Option<String>,
    /// The subject that it began with.
    origin: Rc<Subject>,
    /// The study as started: a restart uses its initial state.
    study: Study,
    /// From the state below, with the noise and without.
    plan: RunPlan,
    quiet: RunPlan,
    model: Box<dyn Model>,
    revision: u32,
    t: f64,
    /// The shape as the model computes with it, then x and y.
    state: Vec<f64>,
    /// Undeformed radius used for drawing.
    radius: f64,
}

/// The state of a body, and the undeformed radius used for drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen<'s> {
    pub(super) t: f64,
    /// The shape as the model computes with it, then x and y.
    pub(super) state: &'s [f64],
    pub(super) radius: f64,
}

impl Setting {
    /// The body that a page requests.
    pub(crate) fn begin(begin: &Begin, revision: u32, catalogue: &Catalogue) -> Result<Self, Error> {
        let origin = catalogue.subject(&begin.model, begin.preset.as_deref())?;
        let mut study = origin.study.clone();
        study.set_all(begin.parameters.iter().map(|(name, value)| (name.as_str(), *value)))?;
        study.run.seed = begin.seed;
        if let Some(noise) = begin.noise {
            origin.set_noise(&mut study, noise)?;
        }
        let plan = RunPlan::new(&study)?;
        let model = plan.body()?;
        let state = match &begin.state {
            Some(coordinates) => state_of(model.as_ref(), coordinates, begin.position.unwrap_or_default())?,
            None => settled(&plan, model.as_ref(), SETTLING)?,
        };
        let (name, preset) = (begin.model.clone(), begin.preset.clone());
        let mut setting = Self::new(study, name, preset, Rc::new(origin), revision, begin.t, state)?;
        setting.radius = setting.fitting_radius()?;
        Ok(setting)
    }

    fn new(
        study: Study,
        model_name: String,
        preset: Option<String>,
        origin: Rc<Subject>,
        revision: u32,
        t: f64,
        state: Vec<f64>,
    ) -> Result<Self, Error> {
        let model = study.body()?;
        within(t, &state, model.dim())?;
        let mut now = at(&study, model.as_ref(), &state);
        let plan = RunPlan::new(&now)?;
        now.run.silence();
        let quiet = RunPlan::new(&now)?;
        Ok(Self { model_name, preset, origin, study, plan, quiet, model, revision, t, state, radius: 0.0 })
    }

    /// The same body with another study, from another state.
    pub(super) fn changed(&self, study: Study, t: f64, state: Vec<f64>, radius: f64) -> Result<Self, Error> {
        let (name, preset) = (self.model_name.clone(), self.preset.clone());
        let (origin, revision) = (Rc::clone(&self.origin), self.revision.wrapping_add(1));
        let next = Self::new(study, name, preset, origin, revision, t, state)?;
        Ok(Self { radius, ..next })
    }

    /// Returns `true` if the model or the study gives the radius of the undeformed body; otherwise it is
    /// drawn at a size that suits its deformations.
    pub(super) fn has_own_radius(&self) -> bool {
        self.model.radius().is_some() || self.study.figure.radius > 0.0
    }

    /// The largest radius required by the deformation in the near future.
    fn fitting_radius(&self) -> Result<f64, Error> {
        if let Some(fixed) = self.model.radius() {
            return Ok(fixed);
        }
        if self.study.figure.radius > 0.0 {
            return Ok(self.study.figure.radius);
        }
        let body = InPlane(self.model());
        let mut record = Record::new(self.model(), &self.quiet.computation, AHEAD.0);
        let mut stretch = Stretch::new(&self.quiet, &body, self.t, &self.state, 0)?;
        let end = self.t + AHEAD.0 as f64 * self.study.display.sample;
        stretch.advance(end, AHEAD.1, &mut record, self.model());
        let dim = self.model.dim();
        let deformations = record.rows().map(|row| self.model.deformation(&row.state[..dim]));
        Ok(radius_for(deformations.filter(|deformation| deformation.is_finite()).fold(0.0, f64::max)))
    }

    pub(crate) fn display(&self) -> &DisplaySettings {
        &self.study.display
    }

    /// The subject that the body began with.
    pub(crate) fn origin(&self) -> &Subject {
        &self.origin
    }

    /// Name for files: the preset, or the model.
    pub(crate) fn name(&self) -> &str {
        let name = self.preset.as_deref().unwrap_or(&self.model_name);
        name.strip_suffix(".toml").unwrap_or(name)
    }

    pub(crate) fn model(&self) -> &dyn Model {
        self.model.as_ref()
    }

    pub(crate) fn plan(&self) -> &RunPlan {
        &self.plan
    }

    pub(crate) fn study(&self) -> &Study {
        &self.study
    }

    pub(crate) fn revision(&self) -> u32 {
        self.revision
    }

    /// Its initial state.
    pub(super) fn start(&self) -> Seen<'_> {
        Seen { t: self.t, state: &self.state, radius: self.radius }
    }

    /// The return map of the preset, if it has one.
    pub(crate) fn return_map(&self) -> Option<&ReturnMapSettings> {
        self.study.return_map.as_ref()
    }

    /// Returns `true` if the body has noise.
    fn noisy(&self) -> bool {
        self.plan.computation.noise.is_some()
    }

    /// The motion to be classified.
    pub(crate) fn motion(&self) -> Motion {
        let (revision, plan) = (self.revision, self.quiet.clone());
        Motion { revision, plan, noisy: self.noisy(), again: false, before: None }
    }

    /// The same motion, from a later state.
    pub(crate) fn motion_at(&self, state: &[f64]) -> Result<Motion, Error> {
        let mut study = self.study_at(state);
        study.run.silence();
        let (revision, plan) = (self.revision, RunPlan::new(&study)?);
        Ok(Motion { revision, plan, noisy: self.noisy(), again: true, before: None })
    }

    /// The study that continues from a state.
    pub(crate) fn study_at(&self, state: &[f64]) -> Study {
        at(&self.study, self.model.as_ref(), state)
    }

    pub(crate) fn begun(&self) -> Begun {
        let display = self.display();
        let observables = self.model.observables().iter();
        let text = str::to_owned;
        Begun {
            revision: self.revision,
            model: self.model_name.clone(),
            preset: self.preset.clone(),
            title: self.study.title.clone(),
            about: self.study.about.clone(),
            parameters: self.plan.computation.parameters.clone(),
            noise: self.study.run.largest_noise(),
            sample: display.sample,
            speed: display.speed,
            speeds: display.speeds(),
            observables: observables
                .map(|o| Observable { name: text(o.name), symbol: text(o.symbol), meaning: text(o.meaning) })
                .collect(),
        }
    }

    pub(crate) fn told(&self) -> Changed {
        Changed {
            revision: self.revision,
            parameters: self.plan.computation.parameters.clone(),
            noise: self.study.run.largest_noise(),
        }
    }
}

/// The coordinates of a shape.
pub(crate) fn decode(model: &dyn Model, shape: &[f64]) -> Vec<f64> {
    model.decoded(shape)
}

/// The state with these coordinates.
pub(super) fn state_of(
    model: &dyn Model,
    coordinates: &[f64],
    position: [f64; 2],
) -> Result<Vec<f64>, Error> {
    let (dim, got) = (model.dim(), coordinates.len());
    if got != dim {
        return Err(motiform_dynamics::Error::Shape { what: "the state", expected: dim, got }.into());
    }
    let mut state = model.encoded(coordinates);
    state.extend(position);
    Ok(state)
}

/// Rejects a state that is no shape any more, or lies beyond any distance and time that can be shown.
fn within(t: f64, state: &[f64], dim: usize) -> Result<(), Error> {
    let far = "the explorer takes times and positions up to 1e12";
    check("t", t, t.abs() <= LARGEST.1, far)?;
    let (shape, position) = state.split_at(dim);
    for &entry in shape {
        check("state", entry, entry.abs() <= LARGEST.0, "the explorer takes shapes up to 1e9")?;
    }
    position.iter().try_for_each(|&entry| check("position", entry, entry.abs() <= LARGEST.1, far))
}

/// A study that starts from a state, without transient.
fn at(study: &Study, model: &dyn Model, state: &[f64]) -> Study {
    let (shape, position) = state.split_at(model.dim());
    let names = model.coordinates().iter().map(|coordinate| coordinate.name).chain(["x", "y"]);
    let values = decode(model, shape).into_iter().chain(position.iter().copied());
    let mut study = study.clone();
    study.initial = names.map(str::to_owned).zip(values).collect();
    study.run.transient = 0.0;
    study
}

#[cfg(test)]
pub(super) mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use motiform_models::MODELS;
    use motiform_study::presets::PRESETS;

    pub(in super::super) fn begin(model: &str, preset: &str) -> Setting {
        let begin =
            Begin { model: model.to_owned(), preset: Some(preset.to_owned()), seed: 1, ..Begin::default() };
        Setting::begin(&begin, 1, &Catalogue::new(None).unwrap()).unwrap()
    }

    #[test]
    fn every_preset_begins() {
        for preset in PRESETS {
            let setting = begin(preset.model, preset.name);
            assert_eq!(setting.begun().preset.as_deref(), Some(preset.name));
            assert!(setting.start().radius > 0.0);
        }
        for info in MODELS {
            let begin = Begin { model: info.name.to_owned(), ..Begin::default() };
            assert_eq!(
                Setting::begin(&begin, 1, &Catalogue::new(None).unwrap()).unwrap().begun().model,
                info.name
            );
        }
    }
}
