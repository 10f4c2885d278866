//! The body of a session: its motion, and all requests about it, on a separate thread.

mod changes;
mod looks;
mod setting;
mod stage;

use crate::answers::{Answers, Gone};
use crate::branches::BranchService;
use crate::catalogue::Catalogue;
use crate::export::Exports;
use crate::map::Map;
use crate::motion::Naming;
use crate::protocol::{Ask, Define, Defined, Mistake};
pub(crate) use looks::short;
use motiform_dynamics::InPlane;
use motiform_study::Error;
pub(crate) use setting::Setting;
use stage::Stage;
use std::cell::RefCell;
use std::sync::mpsc::Receiver;

/// Computations of a session in addition to the motion.
pub(crate) struct Services {
    pub(crate) naming: Naming,
    pub(crate) map: Map,
    pub(crate) branches: BranchService,
    pub(crate) exports: Exports,
    pub(crate) answers: Answers,
    /// What a body can begin with; the page can add its own equations.
    pub(crate) catalogue: RefCell<Catalogue>,
}

impl Services {
    pub(crate) fn new(answers: &Answers, catalogue: Catalogue) -> std::io::Result<Self> {
        Ok(Self {
            naming: Naming::new(answers.clone())?,
            map: Map::new(answers.clone())?,
            branches: BranchService::new(answers)?,
            exports: Exports::new(answers.clone())?,
            answers: answers.clone(),
            catalogue: RefCell::new(catalogue),
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
        let begin = match &ask {
            Ask::Begin(begin) => begin,
            Ask::Define(Define { text }) => {
                define(text, services)?;
                continue;
            }
            _ => {
                services.answers.refused(None, "there is no body yet: send begin first")?;
                continue;
            }
        };
        let begun = Setting::begin(begin, 1, &services.catalogue.borrow());
        match begun {
            Ok(setting) => {
                services.answers.say(setting.begun())?;
                return Ok(Some(setting));
            }
            Err(error) => services.answers.refused(None, &error.to_string())?,
        }
    }
    Ok(None)
}

/// Reads a study that the page wrote.
fn define(text: &str, services: &Services) -> Result<(), Gone> {
    let defined = services.catalogue.borrow_mut().define(text);
    match defined {
        Ok(model) => services.answers.say(Defined { model }),
        Err(Error::Study { line, column, problem, excerpt, .. }) => {
            let marks = excerpt.lines().last().unwrap_or_default();
            let length = marks.matches('^').count().max(1);
            services.answers.say(Mistake { line, column, length, problem })
        }
        Err(error) => {
            services.answers.say(Mistake { line: 1, column: 1, length: 1, problem: error.to_string() })
        }
    }
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
