//! Time limits of interactive computations: a body is shown while it moves, and no picture may take too long.
//!
//! A browser's worker gives its own clock (`set`): the standard library has none there.

use std::time::Duration;

/// A moment, to measure the time since.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Moment(Duration);

impl Moment {
    /// Now.
    pub fn now() -> Self {
        Self(system::now())
    }

    /// The time since.
    pub fn elapsed(self) -> Duration {
        system::now().saturating_sub(self.0)
    }
}

#[cfg(not(all(target_arch = "wasm32", target_os = "unknown")))]
mod system {
    use std::sync::LazyLock;
    use std::time::{Duration, Instant};

    static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);

    pub(super) fn now() -> Duration {
        BEGUN.elapsed()
    }
}

#[cfg(all(target_arch = "wasm32", target_os = "unknown"))]
mod system {
    use std::sync::OnceLock;
    use std::time::Duration;

    pub(super) static CLOCK: OnceLock<fn() -> Duration> = OnceLock::new();

    /// Without a clock, time stands still: no limit is reached.
    pub(super) fn now() -> Duration {
        CLOCK.get().map_or(Duration::ZERO, |now| now())
    }
}

/// The clock of this program; the first one that is given stays.
#[cfg(all(target_arch = "wasm32", target_os = "unknown"))]
pub fn set(now: fn() -> Duration) {
    let _ = system::CLOCK.set(now);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_passes() {
        let begun = Moment::now();
        let pause = Duration::from_millis(5);
        std::thread::sleep(pause);
        assert!(begun.elapsed() >= pause && Moment::now() > begun);
    }
}
