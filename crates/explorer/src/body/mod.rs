//! The body of a session: its motion, and all requests about it, on a separate thread.

mod changes;
mod looks;
mod setting;
mod stage;

use crate::answers::{Answers, Gone};
use crate::branches::BranchService;
use crate::export::Exports;
use crate::map::Map;
use crate::motion::Naming;
use crate::protocol::Ask;
pub(crate) use looks::short;
use motiform_dynamics::InPlane;
pub(crate) use setting::Setting;
use stage::Stage;
use std::sync::mpsc::Receiver;

/// Computations of a session in addition to the motion.
pub(crate) struct Services {
    pub(crate) naming: Naming,
    pub(crate) map: Map,
    pub(crate) branches: BranchService,
    pub(crate) exports: Exports,
    pub(crate) answers: Answers,
}

impl Services {
    pub(crate) fn new(answers: &Answers) -> std::io::Result<Self> {
        Ok(Self {
            naming: Naming::new(answers.clone())?,
            map: Map::new(answers.clone())?,
            branches: BranchService::new(answers)?,
            exports: Exports::new(answers.clone())?,
            answers: answers.clone(),
        })
    }
}

/// Answers requests until the page disconnects.
pub(crate) fn run(asks: &Receiver<Ask>, services: &Services) {
    // The only failure is that nobody listens any more.
    let _ = live(asks, services);
}

fn live(asks: &Receiver<Ask>, services: &Services) -> Result<(), Gone> {
    let mut next = first(asks, services)?;
    while let Some(setting) = next {
        services.naming.name(setting.motion());
        let body = InPlane(setting.model());
        next = match Stage::new(&setting, &body, services) {
            Ok(mut stage) => play(&mut stage, asks)?,
            Err(error) => {
                services.answers.refused(None, &error.to_string())?;
                first(asks, services)?
            }
        };
    }
    Ok(())
}

/// Waits for the first body; `None` if the page disconnects.
fn first(asks: &Receiver<Ask>, services: &Services) -> Result<Option<Setting>, Gone> {
    while let Ok(ask) = asks.recv() {
        let Ask::Begin(begin) = &ask else {
            services.answers.refused(None, "there is no body yet: send begin first")?;
            continue;
        };
        match Setting::begin(begin, 1) {
            Ok(setting) => {
                services.answers.say(setting.begun())?;
                return Ok(Some(setting));
            }
            Err(error) => services.answers.refused(None, &error.to_string())?,
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
                stage.services().naming.stop();
                stage.services().answers.say(answer)?;
                return Ok(Some(setting));
            }
            Some(Err(error)) => stage.services().answers.refused(None, &error.to_string())?,
        }
    }
    Ok(None)
}
