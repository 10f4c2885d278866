//! Jobs that another instance of this program does, as texts.

use super::{Task, Tell};
use crate::answers::Gone;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::cell::Cell;
use std::marker::PhantomData;
use std::sync::Arc;

/// A job on its way to a helper, or a report on its way back.
///
/// As text: the helper's name, the number of the order, and JSON, each on a line. Without JSON an errand to a
/// helper says that what it does is stale, and one that comes back says that the helper is free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Errand<'e> {
    /// The helper: a task, such as `naming`, and a number for those of the map, such as `map0`.
    pub to: &'e str,
    /// Number of the job. Reports on earlier ones are ignored.
    pub order: u64,
    /// The job, or the report.
    pub json: &'e str,
}

impl<'e> Errand<'e> {
    /// Reads an errand; `None` if the text is none.
    pub fn parse(text: &'e str) -> Option<Self> {
        let mut lines = text.splitn(3, '\n');
        let (to, order) = (lines.next()?, lines.next()?.parse().ok()?);
        Some(Self { to, order, json: lines.next()? })
    }

    /// The text of an errand.
    pub fn text(&self) -> String {
        format!("{}\n{}\n{}", self.to, self.order, self.json)
    }

    /// Its report or job.
    pub(crate) fn read<T: DeserializeOwned>(&self) -> Option<T> {
        serde_json::from_str(self.json).ok()
    }
}

/// Sends errands to helpers.
#[derive(Clone)]
pub struct Post(Arc<dyn Fn(&Errand<'_>) + Send + Sync>);

impl Post {
    /// A post that `send` delivers.
    pub fn new(send: impl Fn(&Errand<'_>) + Send + Sync + 'static) -> Self {
        Self(Arc::new(send))
    }

    /// Sends a job.
    pub(crate) fn job(&self, to: &str, order: u64, job: &impl Serialize) {
        // Plans and states are finite numbers and texts: they are JSON.
        let json = serde_json::to_string(job).unwrap_or_default();
        (self.0)(&Errand { to, order, json: &json });
    }

    /// Says that what a helper does is stale.
    pub(crate) fn clear(&self, to: &str, order: u64) {
        (self.0)(&Errand { to, order, json: "" });
    }
}

/// The latest job of a task, at a helper.
pub(crate) struct Away<T> {
    task: PhantomData<fn() -> T>,
    post: Post,
    order: Cell<u64>,
    /// `true` if the helper may have work.
    busy: Cell<bool>,
}

impl<T: Task> Away<T> {
    pub(super) fn new(post: Post) -> Self {
        Self { task: PhantomData, post, order: Cell::new(0), busy: Cell::new(false) }
    }

    pub(super) fn put(&self, job: &T::Job) {
        self.order.set(self.order.get() + 1);
        self.busy.set(true);
        self.post.job(T::NAME, self.order.get(), job);
    }

    pub(super) fn clear(&self) {
        self.order.set(self.order.get() + 1);
        if self.busy.replace(false) {
            self.post.clear(T::NAME, self.order.get());
        }
    }

    pub(super) fn report(&self, errand: &Errand<'_>) -> Option<T::Report> {
        if errand.order != self.order.get() {
            return None;
        }
        if errand.json.is_empty() {
            self.busy.set(false);
        }
        errand.read()
    }
}

/// Does the job of an errand, in a helper, if it is one of this task: each report is the text of an errand that goes back.
pub(crate) fn perform<T: Task>(errand: &Errand<'_>, back: &(dyn Fn(&str) + Sync)) -> bool {
    if errand.to.trim_end_matches(|c: char| c.is_ascii_digit()) != T::NAME {
        return false;
    }
    let Some(job) = errand.read::<T::Job>() else { return true };
    let tell: Tell<'_, T::Report> = &|report| {
        let json = serde_json::to_string(&report).map_err(|_| Gone)?;
        back(&Errand { json: &json, ..*errand }.text());
        Ok(())
    };
    // The job cannot be stopped from inside: the page terminates the worker if the job is stale.
    let _ = T::run(job, &(), tell);
    true
}
