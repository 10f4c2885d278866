//! Files for export, created beside the body if there are threads.

use crate::answers::{Answers, Gone};
use crate::task::Crew;
use motiform_figures::{DEFAULT_SCALE, RASTER, png};
use motiform_lab::draw::undrawable;
use motiform_study::Error;

/// The created file.
pub(crate) enum Made {
    /// A drawing; it is converted to PNG if requested.
    Svg(String),
    /// A file as it is.
    Bytes(Vec<u8>),
}

/// Makes a file from a snapshot; `None` if there are not enough data yet.
pub(crate) type Maker = Box<dyn FnOnce() -> Result<Option<Made>, Error> + Send>;

/// A requested file.
pub(crate) struct Order {
    pub(crate) id: u32,
    /// The preset or the model.
    pub(crate) subject: String,
    pub(crate) what: String,
    pub(crate) make: Maker,
}

/// The maker of files: a thread, while the body moves on, or this session itself.
pub(crate) struct Exports {
    answers: Answers,
    #[cfg(feature = "threads")]
    thread: Option<queue::Thread>,
}

impl Exports {
    #[cfg_attr(
        not(feature = "threads"),
        allow(clippy::unnecessary_wraps, unused_variables, reason = "only threads can be missing")
    )]
    pub(crate) fn new(answers: Answers, crew: &Crew) -> std::io::Result<Self> {
        Ok(Self {
            #[cfg(feature = "threads")]
            thread: match crew {
                Crew::Threads => Some(queue::Thread::new(answers.clone())?),
                Crew::Away { .. } => None,
            },
            answers,
        })
    }

    pub(crate) fn put(&self, order: Order) -> Result<(), Gone> {
        #[cfg(feature = "threads")]
        if let Some(thread) = &self.thread {
            return thread.put(order, &self.answers);
        }
        deliver(order, &self.answers)
    }
}

/// A thread that makes files in turn.
#[cfg(feature = "threads")]
mod queue {
    use super::{Order, deliver};
    use crate::answers::{Answers, Gone};
    use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
    use std::thread::JoinHandle;

    /// Length of the queue of requests: there are about twice as many buttons.
    const WAITING: usize = 8;

    pub(super) struct Thread {
        orders: Option<SyncSender<Order>>,
        thread: Option<JoinHandle<()>>,
    }

    impl Thread {
        pub(super) fn new(back: Answers) -> std::io::Result<Self> {
            let (orders, taken) = sync_channel::<Order>(WAITING);
            let run = move || {
                // Until the session ends, or nobody listens any more.
                while let Ok(order) = taken.recv() {
                    if deliver(order, &back).is_err() {
                        return;
                    }
                }
            };
            let thread = std::thread::Builder::new().name("files".to_owned()).spawn(run)?;
            Ok(Self { orders: Some(orders), thread: Some(thread) })
        }

        pub(super) fn put(&self, order: Order, answers: &Answers) -> Result<(), Gone> {
            let Some(orders) = &self.orders else { return Err(Gone) };
            match orders.try_send(order) {
                Ok(()) => Ok(()),
                Err(TrySendError::Full(order)) => {
                    answers.refused(Some(order.id), "other files are being created: wait for them")
                }
                Err(TrySendError::Disconnected(_)) => Err(Gone),
            }
        }
    }

    impl Drop for Thread {
        fn drop(&mut self) {
            self.orders = None; // ends the thread after the file it is making
            if let Some(thread) = self.thread.take() {
                let _ = thread.join(); // its panic was reported by the thread itself
            }
        }
    }
}

fn deliver(order: Order, answers: &Answers) -> Result<(), Gone> {
    let Order { id, subject, what, make } = order;
    let ending = what.rsplit('.').next().unwrap_or_default();
    let content = make().and_then(|made| match made {
        Some(Made::Svg(svg)) if ending == "png" && RASTER => {
            Ok(Some(("image/png", png(&svg, DEFAULT_SCALE, &[]).map_err(undrawable)?)))
        }
        // Of a PNG that was requested: the page draws it, since it can.
        Some(Made::Svg(svg)) => Ok(Some(("image/svg+xml", svg.into_bytes()))),
        Some(Made::Bytes(bytes)) => Ok(Some((type_of(ending), bytes))),
        None => Ok(None),
    });
    match content {
        Ok(Some((mime, content))) => answers.file(id, &format!("motiform-{subject}-{what}"), mime, &content),
        Ok(None) => {
            answers.refused(Some(id), "there are not enough data for this file yet: let the body move on")
        }
        Err(error) => answers.refused(Some(id), &error.to_string()),
    }
}

/// The type of a file that is no drawing, by the ending of its name.
fn type_of(ending: &str) -> &'static str {
    match ending {
        "apng" => "image/apng",
        "csv" => "text/csv",
        _ => "application/toml",
    }
}
