//! Changes of the body that the page asks for: each makes another setting, or says why it is impossible.

use super::super::Services;
use super::super::setting::Setting;
use super::{Change, Stage};
use crate::answers::Gone;
use crate::branches::{OrbitJob, Spot};
use crate::protocol::{Begin, BranchPoint, Kick, Pull, Put, Said, Start};
use motiform_study::Error;
use std::collections::BTreeMap;

impl Stage<'_> {
    /// The body on a point of a branch; its orbit follows.
    pub(super) fn place(&self, point: BranchPoint) -> Result<Option<Change>, Gone> {
        let BranchPoint { epoch, branch, point } = point;
        let Some(spot) = self.services.branches.spot(epoch, branch, point) else {
            let why = "there is no such point of a branch any more: follow the branches again";
            return self.services.answers.refused(None, why).map(|()| None);
        };
        Ok(Some(self.placed(spot).map(told)))
    }

    fn placed(&self, spot: Spot) -> Result<Setting, Error> {
        let seen = self.seen();
        let setting = self.setting.placed(&spot, &seen)?;
        let position = seen.state.last_chunk().copied().unwrap_or_default();
        let (revision, parameters) = (setting.revision(), setting.told().parameters);
        self.services.branches.orbits.put(OrbitJob { revision, spot, parameters, t: seen.t, position });
        Ok(setting)
    }

    pub(super) fn begin(&self, begin: &Begin) -> Change {
        let setting = Setting::begin(
            begin,
            self.setting.revision().wrapping_add(1),
            &self.services.catalogue.borrow(),
        )?;
        self.services.map.stop();
        self.services.branches.forget();
        self.services.swarms.end();
        let answer = setting.begun().into();
        Ok((setting, answer))
    }

    pub(super) fn set(&self, parameters: &BTreeMap<String, f64>) -> Change {
        let setting = self.setting.with(parameters, &self.seen())?;
        self.forget(parameters);
        Ok(told(setting))
    }

    /// Stops what is computed for other values of these parameters.
    fn forget(&self, parameters: &BTreeMap<String, f64>) {
        let Services { map, branches, .. } = self.services;
        if parameters.keys().any(|name| !map.has_axis(name)) {
            map.stop();
        }
        if parameters.keys().any(|name| !map.has_axis(name) && !branches.along(name)) {
            branches.forget();
        }
    }

    pub(super) fn put(&self, put: &Put) -> Change {
        let setting = self.setting.put(put, &self.seen())?;
        let now = &self.setting.plan().computation.parameters;
        let moved = put.parameters.iter().filter(|(name, value)| now.get(name) != Some(**value));
        self.forget(&moved.map(|(name, value)| (name.clone(), *value)).collect());
        Ok(told(setting))
    }

    pub(super) fn pull(&self, pull: &Pull) -> Change {
        Ok(told(self.setting.pulled(pull, &self.seen())?))
    }

    pub(super) fn noise(&self, amplitude: f64) -> Change {
        Ok(told(self.setting.with_noise(amplitude, &self.seen())?))
    }

    pub(super) fn kick(&self, Kick { strength }: Kick) -> Change {
        Ok(told(self.setting.kicked(strength, &self.seen())?))
    }

    pub(super) fn restart(&self) -> Change {
        Ok(told(self.setting.started(&BTreeMap::new(), self.radius)?))
    }

    pub(super) fn start(&self, start: &Start) -> Change {
        Ok(told(self.setting.started(&start.coordinates, self.radius)?))
    }
}

fn told(setting: Setting) -> (Setting, Said) {
    let answer = setting.told().into();
    (setting, answer)
}
