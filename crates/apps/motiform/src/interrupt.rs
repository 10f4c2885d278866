//! Ctrl-C, and requests of the system to end the process.

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, OnceLock};

/// The exit code of a command that was interrupted.
const INTERRUPTED: i32 = 130;

/// The signals that ask for an end: Ctrl-C, `kill`, and a terminal that is closed.
#[cfg(unix)]
const SIGNALS: [i32; 3] = [SIGINT, SIGTERM, signal_hook::consts::SIGHUP];
#[cfg(not(unix))]
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// True from the first signal on; the second one ends the process with exit code 130. Until the first call signals end the process, as
/// usual.
pub(crate) fn interrupted() -> Arc<AtomicBool> {
    static FLAG: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    let flag = FLAG.get_or_init(|| {
        let flag = Arc::new(AtomicBool::new(false));
        for signal in SIGNALS {
            // In this order: the first signal finds the flag false, sets it, and goes on. Where a signal cannot be caught it ends the
            // process, and nothing is lost.
            let _ = register_conditional_shutdown(signal, INTERRUPTED, Arc::clone(&flag));
            let _ = register(signal, Arc::clone(&flag));
        }
        flag
    });
    Arc::clone(flag)
}

/// Calls `stop`, on a thread, at the first signal; the flag is read every 20 ms.
#[cfg(feature = "explorer")]
pub(crate) fn on_interrupt(stop: impl FnOnce() + Send + 'static) {
    let flag = interrupted();
    std::thread::spawn(move || {
        while !flag.load(std::sync::atomic::Ordering::Relaxed) {
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        stop();
    });
}
