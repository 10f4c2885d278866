//! The allowance of work on orbits.

use std::sync::atomic::{AtomicU64, Ordering};

/// Steps of the flow along orbits that may be spent on branches or curves ([`super::Family::allowance`]): on one after the other, so that
/// what they lead to is the same each time.
///
/// The count is of steps, not of seconds: the same work has the same result on every machine. What is begun is finished: an allowance is
/// exceeded by the work of one step along a branch at most.
#[derive(Debug)]
pub struct Allowance {
    left: AtomicU64,
}

impl Allowance {
    /// So many steps.
    pub const fn of(steps: u64) -> Self {
        Self { left: AtomicU64::new(steps) }
    }

    /// Takes steps away.
    pub fn spend(&self, steps: u64) {
        self.left.store(self.left().saturating_sub(steps), Ordering::Relaxed);
    }

    /// The rest of it.
    pub fn left(&self) -> u64 {
        self.left.load(Ordering::Relaxed)
    }

    /// Returns `true` if nothing is left.
    pub fn is_spent(&self) -> bool {
        self.left() == 0
    }
}
