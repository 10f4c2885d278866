//! The body of a session: its motion, and all requests about it, on a separate thread.

mod changes;
mod looks;
mod setting;
mod stage;

use crate::answers::{Answers, Gone};
use crate::export::Exports;
use crate::map::Map;
use crate::motion::Naming;
use crate::protocol::Ask;
use motiform_dynamics::InPlane;
pub(crate) use setting::Setting;
use stage::Stage;
use std::sync::mpsc::Receiver;

/// Computations of a session in addition to the motion.
pub(crate) struct Desks {
    pub(crate) naming: Naming,
    pub(crate) map: Map,
    pub(crate) exports: Exports,
    pub(crate) answers: Answers,
}

impl Desks {
    pub(crate) fn new(answers: &Answers) -> std::io::Result<Self> {
        Ok(Self {
            naming: Naming::new(answers.clone())?,
            map: Map::new(answers.clone())?,
            exports: Exports::new(answers.clone())?,
            answers: answers.clone(),
        })
    }
}

/// Answers requests until the page disconnects.
pub(crate) fn run(asks: &Receiver<Ask>, desks: &Desks) {
    // The only failure is that nobody listens any more.
    let _ = live(asks, desks);
}

fn live(asks: &Receiver<Ask>, desks: &Desks) -> Result<(), Gone> {
    let mut next = first(asks, desks)?;
    while let Some(setting) = next {
        desks.naming.name(setting.motion());
        let body = InPlane(setting.model());
        next = match Stage::new(&setting, &body, desks) {
            Ok(mut stage) => play(&mut stage, asks)?,
            Err(error) => {
                desks.answers.refused(None, &error.to_string())?;
                first(asks, desks)?
            }
        };
    }
    Ok(())
}

/// Waits for the first body; `None` if the page disconnects.
fn first(asks: &Receiver<Ask>, desks: &Desks) -> Result<Option<Setting>, Gone> {
    while let Ok(ask) = asks.recv() {
        let Ask::Begin(begin) = &ask else {
            desks.answers.refused(None, "there is no body yet: send begin first")?;
            continue;
        };
        match Setting::begin(begin, 1) {
            Ok(setting) => {
                desks.answers.say(setting.begun())?;
                return Ok(Some(setting));
            }
            Err(error) => desks.answers.refused(None, &error.to_string())?,
        }
    }
    Ok(None)
}

/// Answers until the body changes (returns the new one), or the page disconnects (`None`).
fn play(stage: &mut Stage<'_>, asks: &Receiver<Ask>) -> Result<Option<Setting>, Gone> {
    while let Ok(ask) = asks.recv() {
        match stage.answer(ask)? {
            None => {}
            Some(Ok((setting, answer))) => {
                stage.desks().naming.stop();
                stage.desks().answers.say(answer)?;
                return Ok(Some(setting));
            }
            Some(Err(error)) => stage.desks().answers.refused(None, &error.to_string())?,
        }
    }
    Ok(None)
}
