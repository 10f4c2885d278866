//! The moving body, as shown on the page.

mod change;

use super::Services;
use super::looks::{self, Look};
use super::returns;
use super::setting::{Seen, Setting, decode};
use super::swarm::Swimmers;
use crate::answers::Gone;
use crate::export::Order;
use crate::frames::Frame;
use crate::map::{Job, MapFile};
use crate::protocol::{
    Advance, Ask, Cell, Define, Ended, Export, Follow, MapWindow, Noise, ReturnsAhead, Said, Section, Set,
    Share, Source, Swarm,
};
use crate::share;
use motiform_dynamics::{InPlane, Model, Outcome, Outline};
use motiform_lab::draw::radius_for;
use motiform_lab::live::{Record, Stretch};
use motiform_study::Error;
use std::time::Duration;

/// Number of samples that are kept for spectra and return maps.
const KEPT: usize = 20_000;

/// Maximum number of samples in a frame, and maximum computing time of one: 60 frames per second leave 16 ms.
const PICTURE: (f64, Duration) = (512.0, Duration::from_millis(12));

/// Points of the outline.
const POINTS: usize = 96;

/// A setting in motion.
pub(super) struct Stage<'s> {
    setting: &'s Setting,
    body: &'s InPlane<&'s dyn Model>,
    stretch: Stretch<'s>,
    swarm: Option<Swimmers<'s>>,
    record: Record,
    /// Samples up to this time have been sent to the page.
    told: f64,
    radius: f64,
    ended: bool,
    /// The motion was classified at this time; this is repeated when the body has moved on this many times longer than finding
    /// the name took.
    named: (f64, f64),
    services: &'s Services,
}

/// The body after a change, and the message about it.
pub(super) type Change = Result<(Setting, Said), Error>;

impl<'s> Stage<'s> {
    pub(super) fn new(
        setting: &'s Setting,
        body: &'s InPlane<&'s dyn Model>,
        services: &'s Services,
    ) -> Result<Self, Error> {
        let Seen { t, state, radius } = setting.start();
        let stretch = Stretch::new(setting.plan(), body, t, state, u64::from(setting.revision()))?;
        let record = Record::new(setting.model(), &setting.plan().computation, KEPT);
        let swarm = Swimmers::again(setting, body, t, &services.swarms).unwrap_or_else(|error| {
            services.swarms.end();
            // A page that has gone is noticed at its next request.
            let _ = services.answers.refused(None, &format!("the swarm ends here: {error}"));
            None
        });
        Ok(Self {
            setting,
            body,
            stretch,
            swarm,
            record,
            told: f64::NEG_INFINITY,
            radius,
            ended: false,
            named: (t, 1.0),
            services,
        })
    }

    /// The body changes: its swarm goes on with the next one.
    pub(super) fn leave(&self) {
        if let Some(swarm) = self.swarm.as_ref().filter(|_| self.services.swarms.goes_on()) {
            swarm.keep(&self.services.swarms);
        }
    }

    pub(super) fn services(&self) -> &'s Services {
        self.services
    }

    /// Answers a message; one that changes the body returns the new body, or the reason why it is impossible.
    pub(super) fn answer(&mut self, ask: Ask) -> Result<Option<Change>, Gone> {
        match ask {
            Ask::Advance(Advance { dt }) => self.advance(dt)?,
            Ask::Strips(section) => self.strips(section)?,
            Ask::Returns(ahead) => self.returns_ahead(ahead),
            Ask::Swarm(swarm) => self.begin_swarm(swarm)?,
            Ask::Share(_) => self.share()?,
            Ask::Source(_) => self.source()?,
            Ask::Define(Define { text }) => super::define(&text, self.services)?,
            Ask::Map(window) => self.map(window)?,
            Ask::Unmap(_) => self.services.map.stop(),
            Ask::Follow(follow) => self.follow(&follow)?,
            Ask::Unfollow(_) => self.services.branches.stop(),
            Ask::Place(point) => return self.place(point),
            Ask::Evidence(Cell { epoch, cell }) => self.evidence(epoch, cell)?,
            Ask::Export(export) => self.export(&export)?,
            Ask::Begin(begin) => return Ok(Some(self.begin(&begin))),
            Ask::Set(Set { parameters }) => return Ok(Some(self.set(&parameters))),
            Ask::Noise(Noise { amplitude }) => return Ok(Some(self.noise(amplitude))),
            Ask::Kick(kick) => return Ok(Some(self.kick(kick))),
            Ask::Put(put) => return Ok(Some(self.put(&put))),
            Ask::Pull(pull) => return Ok(Some(self.pull(&pull))),
            Ask::Restart(_) => return Ok(Some(self.restart())),
            Ask::Start(start) => return Ok(Some(self.start(&start))),
        }
        Ok(None)
    }

    /// Advances the body and sends a frame.
    fn advance(&mut self, dt: f64) -> Result<(), Gone> {
        if dt < 0.0 {
            return self
                .services
                .answers
                .refused(None, "the body moves forward in time only: give a dt of at least 0");
        }
        let most = PICTURE.0 * self.setting.display().sample;
        let to = self.stretch.t() + dt.min(most);
        let there = self.stretch.advance(to, PICTURE.1, &mut self.record, self.setting.model());
        let frame = self.frame(!there || dt > most);
        self.services.answers.binary(frame.encode())?;
        self.advance_swarm()?;
        self.name_again();
        match self.stretch.outcome() {
            Some(outcome) if !self.ended => {
                self.ended = true;
                self.services.answers.say(ended(self.setting.revision(), &outcome))
            }
            _ => Ok(()),
        }
    }

    /// The swarm follows the body.
    fn advance_swarm(&mut self) -> Result<(), Gone> {
        let Some(swarm) = &mut self.swarm else { return Ok(()) };
        let t = self.stretch.t();
        swarm.advance(t, self.setting.model());
        let message = swarm.encode(self.setting, t, self.stretch.state(), self.radius);
        self.services.answers.binary(message)
    }

    fn begin_swarm(&mut self, wish: Swarm) -> Result<(), Gone> {
        let now = (self.stretch.t(), self.stretch.state());
        match Swimmers::begin(wish, self.setting, self.body, now, &self.services.swarms) {
            Ok(swarm) => self.swarm = swarm,
            Err(error) => return self.services.answers.refused(None, &error.to_string()),
        }
        self.advance_swarm()
    }

    /// A long transient may end on a different motion than the one found first: classifies again, at increasing intervals.
    fn name_again(&mut self) {
        let (asked, times) = self.named;
        let Some(took) = self.services.naming.took(self.setting.revision()) else { return };
        if self.ended || self.stretch.t() - asked < times * took.max(1.0) {
            return;
        }
        self.named = (self.stretch.t(), 2.0 * times);
        // A state that makes no plan is no body: the motion itself says so.
        if let Ok(motion) = self.setting.motion_at(self.stretch.state()) {
            self.services.naming.name(motion);
        }
    }

    fn frame(&mut self, behind: bool) -> Frame {
        let model = self.setting.model();
        let (shape, position) = self.stretch.state().split_at(model.dim());
        if !self.setting.has_own_radius() {
            let deformation = model.deformation(shape);
            self.radius =
                self.radius.max(if deformation.is_finite() { radius_for(deformation) } else { 0.0 });
        }
        let outline = match model.outline(shape, self.radius, POINTS) {
            Outline::Curve(points) if points.iter().flatten().all(|x| x.is_finite()) => Some(points),
            _ => None,
        };
        let rows: Vec<_> = self.record.rows().rev().take_while(|row| row.t > self.told).collect();
        let mut samples = Vec::new();
        for row in rows.iter().rev() {
            samples.push(row.t);
            samples.extend(row.position());
            samples.extend(row.read);
        }
        let frame = Frame {
            revision: self.setting.revision(),
            behind,
            t: self.stretch.t(),
            position: [position[0], position[1]],
            radius: self.radius,
            coordinates: decode(model, shape),
            samples,
            columns: 5 + model.observables().len(),
            outline,
        };
        self.told = rows.first().map_or(self.told, |row| row.t);
        frame
    }

    fn seen(&self) -> Seen<'_> {
        Seen { t: self.stretch.t(), state: self.stretch.state(), radius: self.radius }
    }

    fn look(&self) -> Look<'_> {
        Look { setting: self.setting, record: &self.record, outcome: self.stretch.outcome() }
    }

    fn strips(&self, section: Section) -> Result<(), Gone> {
        self.services.answers.say(looks::strips(&self.look(), section))
    }

    /// Computes returns of the motion from here on.
    fn returns_ahead(&self, ReturnsAhead { section, y, count }: ReturnsAhead) {
        self.services.ahead.put(returns::Job {
            revision: self.setting.revision(),
            plan: self.setting.plan().clone(),
            t: self.stretch.t(),
            state: self.stretch.state().to_vec(),
            preset: self.setting.return_map().cloned(),
            section: Section { section, y },
            count,
        });
    }

    fn share(&self) -> Result<(), Gone> {
        let study = self.setting.study_at(self.stretch.state());
        let start = self.setting.origin();
        let texts =
            share::command(start, &study).and_then(|command| Ok((command, share::python(start, &study)?)));
        match texts {
            Ok((command, python)) => self.services.answers.say(Share { command, python }),
            Err(error) => self.services.answers.refused(None, &error.to_string()),
        }
    }

    /// The present study as text whose equations can be changed.
    fn source(&self) -> Result<(), Gone> {
        match share::source(self.setting.origin(), self.setting.study()) {
            Ok(text) => self.services.answers.say(Source { text }),
            Err(error) => self.services.answers.refused(None, &error.to_string()),
        }
    }

    fn map(&self, window: MapWindow) -> Result<(), Gone> {
        self.services.map.show(Job { window, study: self.setting.study().clone() })
    }

    /// Follows the motion that the body settles on from where it is.
    fn follow(&self, follow: &Follow) -> Result<(), Gone> {
        self.services.branches.follow(follow, &self.setting.study_at(self.stretch.state()))
    }

    fn evidence(&self, epoch: u32, cell: [u16; 2]) -> Result<(), Gone> {
        match self.services.map.evidence(epoch, cell) {
            Some(evidence) => self.services.answers.say(evidence),
            None => Ok(()), // of an earlier map
        }
    }

    fn export(&self, export: &Export) -> Result<(), Gone> {
        let make = match export.what.as_str() {
            "map.csv" => Some(self.services.map.maker(MapFile::Csv)),
            "map.svg" | "map.png" => Some(self.services.map.maker(MapFile::Diagram)),
            "map-exponents.svg" | "map-exponents.png" if self.services.map.axes() == 2 => {
                let why =
                    "exponents are drawn along one axis, and the map has two: choose none for one of them";
                return self.services.answers.refused(Some(export.id), why);
            }
            "map-exponents.svg" | "map-exponents.png" => Some(self.services.map.maker(MapFile::Exponents)),
            "exponent.svg" | "exponent.png" => {
                Some(looks::exponents(&self.look(), self.services.naming.history()))
            }
            "study.toml" => Some(looks::study(self.setting.study_at(self.stretch.state()))),
            _ => looks::maker(&self.look(), export),
        };
        let Some(make) = make else {
            let why = format!("there is no file {:?}", export.what);
            return self.services.answers.refused(Some(export.id), &why);
        };
        let subject = self.setting.name().to_owned();
        self.services.exports.put(Order { id: export.id, subject, what: export.what.clone(), make })
    }
}

fn ended(revision: u32, outcome: &Outcome) -> Ended {
    let kind = match outcome {
        Outcome::Escaped { .. } => "blow-up",
        Outcome::ClosureFailed { .. } => "closure-failed",
        _ => "step-underflow",
    };
    Ended { revision, outcome: kind, text: outcome.to_string() }
}
