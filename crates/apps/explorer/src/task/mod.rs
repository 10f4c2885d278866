//! Computations beside the motion. Each does the latest job only: on a thread of this program, or in another instance of it.

mod away;
#[cfg(feature = "threads")]
pub(crate) mod thread;

use crate::answers::{Answers, Gone};
use away::Away;
pub(crate) use away::perform;
pub use away::{Errand, Post};
use motiform_dynamics::Watch;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::sync::{Mutex, MutexGuard, PoisonError};
#[cfg(feature = "threads")]
use thread::Thread;

/// A kind of computation. It knows nothing of its session: what it needs is in the job, what it finds is in the reports.
pub(crate) trait Task: 'static {
    /// The description of a computation.
    type Job: Serialize + DeserializeOwned + Send + 'static;
    /// A partial result.
    type Report: Serialize + DeserializeOwned + 'static;

    /// Its name, among all tasks.
    const NAME: &'static str;
    /// Its priority: frames go first (0).
    #[cfg_attr(not(feature = "threads"), allow(dead_code, reason = "only threads have one"))]
    const NICE: i32;

    /// Does a job until it is complete, or `watch` stops it.
    ///
    /// # Errors
    /// Nobody listens any more.
    fn run(job: Self::Job, watch: &dyn Watch, tell: Tell<'_, Self::Report>) -> Result<(), Gone>;
}

/// The receiver of the reports of a job.
pub(crate) type Tell<'t, R> = &'t (dyn Fn(R) -> Result<(), Gone> + Sync);

/// The threads or helpers that do the computations of a session.
pub(crate) enum Crew {
    /// Threads of this program.
    #[cfg(feature = "threads")]
    Threads,
    /// Other instances of this program, to which errands are posted; so many of them share the cells of a map.
    Away { post: Post, mappers: usize },
}

/// The receiver of the reports of all jobs, with the watch on theirs.
type Heard<T> = Box<dyn Fn(<T as Task>::Report, &dyn Watch) -> Result<(), Gone> + Send + Sync>;

/// The latest job of a task. A new one immediately makes the previous one stale.
pub(crate) enum Worker<T: Task> {
    #[cfg(feature = "threads")]
    Thread(Thread<T::Job>),
    Away(Away<T>, Heard<T>),
}

impl<T: Task<Report = String>> Worker<T> {
    /// A worker whose reports are messages to the page.
    ///
    /// # Errors
    /// The system provides no thread.
    pub(crate) fn telling(crew: &Crew, answers: &Answers) -> std::io::Result<Self> {
        let answers = answers.clone();
        Self::new(crew, move |text, _: &dyn Watch| answers.text(text))
    }
}

impl<T: Task> Worker<T> {
    /// A worker whose reports are `heard`, with the watch on their job.
    ///
    /// # Errors
    /// The system provides no thread.
    pub(crate) fn new(
        crew: &Crew,
        heard: impl Fn(T::Report, &dyn Watch) -> Result<(), Gone> + Send + Sync + 'static,
    ) -> std::io::Result<Self> {
        match crew {
            #[cfg(feature = "threads")]
            Crew::Threads => {
                let work = move |job: T::Job, current: &thread::Current<'_>| {
                    let tell = |report| if current.stopped() { Ok(()) } else { heard(report, current) };
                    // A page that has gone takes its session along.
                    let _ = T::run(job, current, &tell);
                };
                Ok(Self::Thread(Thread::new(T::NAME, T::NICE, work)?))
            }
            Crew::Away { post, .. } => Ok(Self::Away(Away::new(post.clone()), Box::new(heard))),
        }
    }

    /// Gives the worker a job, replacing any job that is waiting or in progress.
    #[cfg_attr(not(feature = "threads"), allow(clippy::needless_pass_by_value, reason = "a thread takes it"))]
    pub(crate) fn put(&self, job: T::Job) {
        match self {
            #[cfg(feature = "threads")]
            Self::Thread(thread) => thread.put(job),
            Self::Away(away, _) => away.put(&job),
        }
    }

    /// Clears the worker.
    pub(crate) fn clear(&self) {
        match self {
            #[cfg(feature = "threads")]
            Self::Thread(thread) => thread.clear(),
            Self::Away(away, _) => away.clear(),
        }
    }

    /// Takes an errand that came back: its report is heard, unless its job is stale, or done.
    pub(crate) fn report(&self, errand: &Errand<'_>) -> Result<(), Gone> {
        match self {
            #[cfg(feature = "threads")]
            Self::Thread(_) => Ok(()),
            Self::Away(away, heard) => away.report(errand).map_or(Ok(()), |report| heard(report, &())),
        }
    }
}

/// The data of a mutex, even after a panic of another thread: every job leaves them consistent.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
