//! The body of a session: its motion, and all requests about it.
//!
//! It lives in one asynchronous function, whose state between two requests the compiler writes: on a thread it waits for requests, without
//! threads it is left where it is until the next one ([`go_on`]).

mod changes;
mod looks;
mod pull;
mod returns;
mod setting;
mod stage;
mod swarm;

use crate::answers::{Answers, Gone};
use crate::branches::{BranchService, Following, Path};
use crate::catalogue::Catalogue;
use crate::export::Exports;
use crate::map::{Cells, Map};
use crate::motion::{Classification, Naming};
use crate::protocol::{Ask, Define, Defined, Mistake};
use crate::task::{self, Crew, Errand, Worker};
pub(crate) use looks::short;
use motiform_dynamics::InPlane;
use motiform_study::Error;
pub(crate) use setting::Setting;
use stage::Stage;
use std::cell::RefCell;
use std::pin::Pin;
use std::task::{Context, Poll, Waker};

/// Computations of a session in addition to the motion.
pub(crate) struct Services {
    pub(crate) naming: Naming,
    pub(crate) map: Map,
    pub(crate) branches: BranchService,
    pub(crate) exports: Exports,
    pub(crate) ahead: Worker<returns::Ahead>,
    pub(crate) swarms: swarm::Swarms,
    pub(crate) answers: Answers,
    /// The subjects that a body can begin with; the page can add its own equations.
    pub(crate) catalogue: RefCell<Catalogue>,
}

impl Services {
    pub(crate) fn new(answers: &Answers, crew: &Crew, catalogue: Catalogue) -> std::io::Result<Self> {
        Ok(Self {
            naming: Naming::new(answers.clone(), crew)?,
            map: Map::new(answers.clone(), crew)?,
            branches: BranchService::new(answers, crew)?,
            exports: Exports::new(answers.clone(), crew)?,
            ahead: Worker::telling(crew, answers)?,
            swarms: swarm::Swarms::new(answers, crew)?,
            answers: answers.clone(),
            catalogue: RefCell::new(catalogue),
        })
    }

    /// Takes what a helper found.
    pub(crate) fn report(&self, errand: &Errand<'_>) -> Result<(), Gone> {
        match errand.to {
            "naming" => self.naming.worker.report(errand),
            "branches" => self.branches.worker.report(errand),
            "orbit" => self.branches.orbits.report(errand),
            "returns" => self.ahead.report(errand),
            "swarm" => self.swarms.worker.report(errand),
            _ => self.map.report(errand),
        }
    }
}

/// Does the job of an errand, in a helper: each report is the text of an errand that goes back.
pub(crate) fn perform(errand: &Errand<'_>, back: &(dyn Fn(&str) + Sync)) {
    // The first that knows the task does it.
    let _ = task::perform::<Classification>(errand, back)
        || task::perform::<Cells>(errand, back)
        || task::perform::<Following>(errand, back)
        || task::perform::<Path>(errand, back)
        || task::perform::<returns::Ahead>(errand, back)
        || task::perform::<swarm::Classification>(errand, back);
}

/// The source of a page's requests.
pub(crate) trait Asks {
    /// The next request; `None` if the page has disconnected, pending if it has not asked anything yet.
    fn next(&self) -> Poll<Option<Ask>>;
}

/// Waits for a request.
async fn next(asks: &impl Asks) -> Option<Ask> {
    std::future::poll_fn(|_| asks.next()).await
}

/// Runs until there is no further request. It is called again after each new request, so no waker is needed.
pub(crate) fn go_on(life: Pin<&mut dyn Future<Output = ()>>) -> Poll<()> {
    life.poll(&mut Context::from_waker(Waker::noop()))
}

/// Answers requests until the page disconnects.
pub(crate) async fn live(asks: &impl Asks, services: &Services) {
    // The only failure is that nobody listens any more.
    let _ = answer_all(asks, services).await;
}

async fn answer_all(asks: &impl Asks, services: &Services) -> Result<(), Gone> {
    let mut next = first(asks, services).await?;
    while let Some(setting) = next {
        services.naming.name(setting.motion());
        let body = InPlane(setting.model());
        next = match Stage::new(&setting, &body, services) {
            Ok(mut stage) => play(&mut stage, asks).await?,
            Err(error) => {
                services.swarms.end(); // it was that of the body before
                services.answers.refused(None, &error.to_string())?;
                first(asks, services).await?
            }
        };
    }
    Ok(())
}

/// Waits for the first body; `None` if the page disconnects.
async fn first(asks: &impl Asks, services: &Services) -> Result<Option<Setting>, Gone> {
    while let Some(ask) = next(asks).await {
        let begin = match &ask {
            Ask::Begin(begin) => begin,
            Ask::Define(Define { text }) => {
                define(text, services)?;
                continue;
            }
            other => {
                // A file that was asked for is refused by its number: the page waits for it.
                let id = if let Ask::Export(export) = other { Some(export.id) } else { None };
                services.answers.refused(id, "there is no body yet: send begin first")?;
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
async fn play(stage: &mut Stage<'_>, asks: &impl Asks) -> Result<Option<Setting>, Gone> {
    while let Some(ask) = next(asks).await {
        match stage.answer(ask)? {
            None => {}
            Some(Ok((setting, answer))) => {
                stage.services().naming.stop();
                stage.services().ahead.clear();
                stage.leave();
                stage.services().answers.say(answer)?;
                return Ok(Some(setting));
            }
            Some(Err(error)) => stage.services().answers.refused(None, &error.to_string())?,
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use crate::answers::Answer;
    use std::sync::mpsc::channel;

    /// Members that are no numbers any more end their swarm, not the session: the body goes on, and the next one begins.
    #[test]
    fn a_swarm_that_cannot_go_on_ends_alone() {
        let (send, said) = channel();
        let answers = Answers::new(move |answer| send.send(answer).map_err(|_| Gone));
        let services = Services::new(&answers, &Crew::Threads, Catalogue::new(None).unwrap()).unwrap();
        services.swarms.hold(vec![vec![f64::NAN; 8]]);
        let setting = setting::tests::begin("tensor", "fig5a");
        let body = InPlane(setting.model());
        assert!(Stage::new(&setting, &body, &services).is_ok() && !services.swarms.goes_on());
        let Ok(Answer::Text(text)) = said.try_recv() else { unreachable!() };
        assert!(text.contains("the swarm ends here"), "{text}");
    }
}
