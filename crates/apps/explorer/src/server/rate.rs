//! Rate limit of messages.

use std::time::Instant;

/// Messages per second in the long run, and how many may come at once. A page that draws 144 frames a second while sliders
/// and the map are dragged sends less than half of that.
const RATE: f64 = 600.0;
const BURST: f64 = 1200.0;

/// A bucket of messages that fills at a constant rate.
#[derive(Debug)]
pub(crate) struct Bucket {
    left: f64,
    last: Instant,
}

impl Bucket {
    pub(crate) fn new(now: Instant) -> Self {
        Self { left: BURST, last: now }
    }

    /// Takes one message out; `false` if there is none left.
    pub(crate) fn take(&mut self, now: Instant) -> bool {
        self.left = (self.left + RATE * (now - self.last).as_secs_f64()).min(BURST) - 1.0;
        self.last = now;
        self.left >= 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_flood_is_noticed_and_play_is_not() {
        let start = Instant::now();
        let mut bucket = Bucket::new(start);
        let at = |rate: u32, k: u32| start + k * Duration::from_secs(1) / rate;
        assert!((0..100_000).all(|k| bucket.take(at(300, k))));
        let mut bucket = Bucket::new(start);
        assert!(!(0..2000).all(|k| bucket.take(at(10_000, k))));
    }
}
