//! The program starts. Its time is printed, for people to watch (aim: under 20 ms); timings decide no test.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::Folder;
use std::time::Instant;

#[test]
fn version_and_models_run() {
    let folder = Folder::new();
    for words in ["--version", "models"] {
        let mut times: Vec<f64> = (0..10)
            .map(|_| {
                let start = Instant::now();
                folder.run(words).expect(0);
                1e3 * start.elapsed().as_secs_f64()
            })
            .collect();
        times.sort_by(f64::total_cmp);
        println!("motiform {words}: median of 10 runs {:.1} ms", 0.5 * (times[4] + times[5]));
    }
    let version = folder.run("--version").expect(0).stdout;
    assert_eq!(version, format!("motiform {}\n", env!("CARGO_PKG_VERSION")));
}
