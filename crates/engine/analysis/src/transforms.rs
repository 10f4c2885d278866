//! Plans of Fourier transforms.

use realfft::RealFftPlanner;
use std::cell::RefCell;

thread_local! {
    /// Plans that were made on this thread: one has as many sines as its series has samples.
    static PLANNER: RefCell<RealFftPlanner<f64>> = RefCell::new(RealFftPlanner::new());
}

/// The result of `of` with the plans of this thread.
pub(crate) fn planned<T>(of: impl FnOnce(&mut RealFftPlanner<f64>) -> T) -> T {
    PLANNER.with_borrow_mut(of)
}
