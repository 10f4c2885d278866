//! Work distributed over threads: jobs are numbered, each thread takes the next one, and answers come back in the order of the jobs.

use crate::clock::Moment;
use motiform_dynamics::{StopOnly, Watch};
use motiform_study::Error;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The remaining jobs, and the answers so far.
pub(crate) struct Jobs<'p, A> {
    /// The jobs that had no answer at the beginning.
    open: Vec<usize>,
    next: AtomicUsize,
    /// The answers, their number, and the first error.
    found: Mutex<(Vec<Option<A>>, usize, Option<Error>)>,
    keeping: Keeping<'p, A>,
    /// The moment when the answers were last kept.
    kept: Mutex<Moment>,
    watch: &'p dyn Watch,
}

/// Takes the answers so far.
type Keep<'k, A> = dyn Fn(&[Option<A>]) -> Result<(), Error> + Sync + 'k;

/// Keeps the answers so far, now and then.
#[derive(Clone, Copy)]
pub(crate) struct Keeping<'k, A> {
    /// At most as often as this.
    pub(crate) every: Duration,
    pub(crate) keep: &'k Keep<'k, A>,
}

impl<A> Keeping<'_, A> {
    /// Nothing is kept.
    fn never() -> Self {
        Self { every: Duration::MAX, keep: &|_| Ok(()) }
    }
}

impl<A> Jobs<'_, A> {
    /// The number of the next job; `None` if there is none, or if the work was stopped. A thread may hold several jobs at once.
    pub(crate) fn next(&self) -> Option<usize> {
        if self.watch.stopped() || held(&self.found).2.is_some() {
            return None;
        }
        self.open.get(self.next.fetch_add(1, Ordering::Relaxed)).copied()
    }

    /// The answer to a job; `None` if it was stopped. After an error no thread takes another job.
    pub(crate) fn done(&self, job: usize, answer: Result<Option<A>, Error>) {
        let mut found = held(&self.found);
        let (answers, count, failure) = &mut *found;
        match answer {
            Ok(answer) => {
                *count += usize::from(answer.is_some());
                answers[job] = answer;
            }
            Err(error) => {
                failure.get_or_insert(error);
            }
        }
        let part = *count as f64 / answers.len() as f64;
        let mut kept = held(&self.kept);
        if kept.elapsed() >= self.keeping.every {
            if let Err(error) = (self.keeping.keep)(answers) {
                failure.get_or_insert(error);
            }
            *kept = Moment::now();
        }
        drop((found, kept));
        self.watch.progress(part);
    }

    /// Jobs one after the other, until none is left.
    pub(crate) fn each(&self, answer: impl Fn(usize) -> Result<Option<A>, Error>) {
        while let Some(job) = self.next() {
            self.done(job, answer(job));
        }
    }
}

/// Answers to `count` jobs, in their order, by `work` on each of `threads` threads; `None` if the watch stopped it.
///
/// # Errors
/// The first error of a job.
pub(crate) fn spread<A: Send>(
    count: usize,
    threads: usize,
    watch: &dyn Watch,
    work: impl Fn(&Jobs<'_, A>) + Sync,
) -> Result<Option<Vec<A>>, Error> {
    let answers = complete((0..count).map(|_| None).collect(), threads, Keeping::never(), watch, work)?;
    Ok(answers.into_iter().collect())
}

/// The answers with those that were missing, as [`spread`]; where the watch stopped it, they are still missing.
///
/// # Errors
/// The first error of a job.
pub(crate) fn complete<A: Send>(
    answers: Vec<Option<A>>,
    threads: usize,
    keeping: Keeping<'_, A>,
    watch: &dyn Watch,
    work: impl Fn(&Jobs<'_, A>) + Sync,
) -> Result<Vec<Option<A>>, Error> {
    let open: Vec<usize> = (0..answers.len()).filter(|&job| answers[job].is_none()).collect();
    let (count, done) = (open.len(), answers.len() - open.len());
    let found = Mutex::new((answers, done, None));
    let kept = Mutex::new(Moment::now());
    let jobs = Jobs { open, next: AtomicUsize::new(0), found, keeping, kept, watch };
    on_threads(threads.min(count), || work(&jobs));
    let (answers, _, failure) = jobs.found.into_inner().unwrap_or_else(PoisonError::into_inner);
    match failure {
        Some(error) => Err(error),
        None => Ok(answers),
    }
}

/// Does the same work on so many threads, of which this one is the first, or on as many as the system gives.
pub fn on_threads(threads: usize, work: impl Fn() + Sync) {
    std::thread::scope(|scope| {
        for _ in 1..threads {
            if std::thread::Builder::new().spawn_scoped(scope, &work).is_err() {
                break;
            }
        }
        work();
    });
}

/// Threads of the machine.
pub fn all_cores() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

/// The answer to each item, on `threads` threads, in the order of the items. The watch only stops the work:
/// it receives no progress.
///
/// # Errors
/// The first error of an item; [`Error::Interrupted`] if the watch stopped the work.
pub fn each<I: Sync, A: Send>(
    items: &[I],
    threads: usize,
    watch: &dyn Watch,
    answer: impl Fn(&I) -> Result<A, Error> + Sync,
) -> Result<Vec<A>, Error> {
    let found = spread(items.len(), threads, &StopOnly(watch), |jobs| {
        jobs.each(|job| answer(&items[job]).map(Some));
    })?;
    found.ok_or(Error::Interrupted)
}

/// The answers to the items as far as the work came, in their order, with progress; `None` for those that the watch left out.
///
/// # Errors
/// The first error of an item.
pub fn as_far_as<I: Sync, A: Send>(
    items: &[I],
    threads: usize,
    watch: &dyn Watch,
    answer: impl Fn(&I) -> Result<Option<A>, Error> + Sync,
) -> Result<Vec<Option<A>>, Error> {
    let open = (0..items.len()).map(|_| None).collect();
    complete(open, threads, Keeping::never(), watch, |jobs| jobs.each(|job| answer(&items[job])))
}

/// The lock, even if another thread panicked while holding it: the guarded data are consistent at every point.
pub(crate) fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn answers_come_in_the_order_of_the_jobs() {
        for threads in [1, 3, 100] {
            let squares = spread(50, threads, &(), |jobs| jobs.each(|job| Ok(Some(job * job)))).unwrap();
            assert_eq!(squares, Some((0..50).map(|job| job * job).collect()));
        }
        assert_eq!(spread(0, 2, &(), |jobs: &Jobs<'_, u8>| jobs.each(|_| Ok(None))).unwrap(), Some(vec![]));
    }

    #[test]
    fn answers_are_kept_while_others_are_missing() {
        let seen = Mutex::new(Vec::new());
        let keep = |answers: &[Option<usize>]| {
            held(&seen).push(answers.iter().flatten().count());
            if answers.len() == 3 { Err(Error::Interrupted) } else { Ok(()) }
        };
        let keeping = Keeping { every: Duration::ZERO, keep: &keep };
        complete(vec![Some(7), None, None, None], 1, keeping, &(), |jobs| jobs.each(|job| Ok(Some(job))))
            .unwrap();
        assert_eq!(*held(&seen), [2, 3, 4]);
        let failed = complete(vec![None; 3], 1, keeping, &(), |jobs| jobs.each(|job| Ok(Some(job))));
        assert!(failed.is_err(), "what cannot be kept ends the work");
        assert_eq!(held(&seen).len(), 4);
    }

    #[test]
    fn an_error_ends_it_and_a_stop_leaves_nothing() {
        let count = AtomicUsize::new(0);
        let fail = |job| {
            count.fetch_add(1, Ordering::Relaxed);
            if job == 3 { Err(Error::Interrupted) } else { Ok(Some(job)) }
        };
        assert!(spread(1000, 1, &(), |jobs| jobs.each(fail)).is_err());
        assert_eq!(count.into_inner(), 4);
        let stop = AtomicBool::new(true);
        assert_eq!(spread(5, 2, &stop, |jobs| jobs.each(|job| Ok(Some(job)))).unwrap(), None);
    }
}
