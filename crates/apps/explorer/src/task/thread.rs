//! One thread, and the latest job given to it. A new job immediately makes the previous one stale.

use super::lock;
use motiform_dynamics::Watch;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;

/// A thread that works on the latest job only.
pub(crate) struct Thread<J> {
    shared: Arc<Shared<J>>,
    thread: Option<JoinHandle<()>>,
}

struct Shared<J> {
    slot: Mutex<Slot<J>>,
    bell: Condvar,
    /// Number of the last order; a job of an earlier one is stale.
    order: AtomicU64,
}

struct Slot<J> {
    job: Option<J>,
    closed: bool,
}

/// The test that a job is still the latest. It is a [`Watch`], so every computation stops when it is not.
pub(crate) struct Current<'d> {
    order: &'d AtomicU64,
    mine: u64,
}

impl Watch for Current<'_> {
    fn stopped(&self) -> bool {
        self.order.load(Ordering::Relaxed) != self.mine
    }
}

impl<J: Send + 'static> Thread<J> {
    /// A thread that does `work`, at a lower priority (`nice` above 0) than the threads that draw.
    ///
    /// # Errors
    /// The system provides no thread.
    pub(crate) fn new(
        name: &str,
        nice: i32,
        mut work: impl FnMut(J, &Current<'_>) + Send + 'static,
    ) -> std::io::Result<Self> {
        let slot = Mutex::new(Slot { job: None, closed: false });
        let shared = Arc::new(Shared { slot, bell: Condvar::new(), order: AtomicU64::new(0) });
        let worker = Arc::clone(&shared);
        let run = move || {
            give_way(nice);
            while let Some((job, mine)) = worker.next() {
                work(job, &Current { order: &worker.order, mine });
            }
        };
        let thread = std::thread::Builder::new().name(name.to_owned()).spawn(run)?;
        Ok(Self { shared, thread: Some(thread) })
    }

    /// Gives the thread a job, replacing any job that is waiting or in progress.
    pub(crate) fn put(&self, job: J) {
        self.shared.order(Some(job), false);
    }

    /// Clears the thread.
    pub(crate) fn clear(&self) {
        self.shared.order(None, false);
    }
}

/// Lowers the priority of this thread and of the threads that it starts. A refusal by the system is ignored.
#[cfg(target_os = "linux")]
fn give_way(nice: i32) {
    // On Linux a thread has a priority of its own; elsewhere this would slow the whole program down.
    let _ = rustix::process::setpriority_process(None, nice);
}

#[cfg(not(target_os = "linux"))]
fn give_way(_nice: i32) {}

impl<J> Shared<J> {
    fn order(&self, job: Option<J>, closed: bool) {
        let mut slot = lock(&self.slot);
        self.order.fetch_add(1, Ordering::Relaxed);
        slot.job = job;
        slot.closed |= closed;
        self.bell.notify_one();
    }

    /// Waits for a job; `None` when the worker is closed.
    fn next(&self) -> Option<(J, u64)> {
        let mut slot = lock(&self.slot);
        loop {
            if slot.closed {
                return None;
            }
            if let Some(job) = slot.job.take() {
                return Some((job, self.order.load(Ordering::Relaxed)));
            }
            slot = self.bell.wait(slot).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl<J> Drop for Thread<J> {
    /// Stops the job in progress, and waits for it: no thread outlives its session.
    fn drop(&mut self) {
        self.shared.order(None, true);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join(); // its panic was reported by the thread itself
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use std::sync::mpsc;
    use std::time::Duration;

    #[test]
    fn the_last_job_is_the_only_one_that_is_finished() {
        let (told, hear) = mpsc::channel();
        let worker = Thread::new("test", 0, move |job: u32, current| {
            while job != 9 && !current.stopped() {
                std::thread::sleep(Duration::from_millis(1));
            }
            told.send((job, current.stopped())).unwrap();
        })
        .unwrap();
        worker.put(1);
        assert!(hear.recv_timeout(Duration::from_millis(20)).is_err(), "job 1 goes on");
        worker.put(9);
        assert_eq!(hear.recv().unwrap(), (1, true));
        assert_eq!(hear.recv().unwrap(), (9, false));
        worker.put(2);
        std::thread::sleep(Duration::from_millis(20));
        worker.clear();
        assert_eq!(hear.recv().unwrap(), (2, true));
        worker.put(3);
        drop(worker); // ends the job and the thread
        assert!(hear.iter().all(|(job, stopped)| job == 3 && stopped));
    }
}
