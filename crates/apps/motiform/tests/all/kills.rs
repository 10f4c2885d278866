//! Processes that are killed at random moments: no cell is lost or doubled, no dataset is half there, nothing stays behind.
//! `MOTIFORM_KILLS=1000 cargo test --test all kills::` kills more often.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(target_os = "linux")]

use crate::common;

use common::{Folder, names};
use std::process::Stdio;
use std::time::{Duration, Instant};

/// A deterministic random number from 0 to 1.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

pub(crate) fn kills() -> usize {
    std::env::var("MOTIFORM_KILLS").ok().and_then(|text| text.parse().ok()).unwrap_or(24)
}

/// Runs a command to its end. (What is undetermined within a short budget gives the exit code 1.)
fn whole(folder: &Folder, words: &str) {
    let done = folder.run(words);
    assert!(matches!(done.code, Some(0 | 1)), "{words}: {}", done.stderr);
}

/// Duration of a command that nobody disturbs.
fn usual(folder: &Folder, words: &str) -> Duration {
    let begun = Instant::now();
    whole(folder, words);
    begun.elapsed()
}

/// Starts a command and kills it at a random moment; whether it was still running.
pub(crate) fn kill(folder: &Folder, words: &str, within: Duration, random: &mut Random) -> bool {
    let mut command = folder.command(words);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    std::thread::sleep(within.mul_f64(random.next()));
    let running = child.try_wait().unwrap().is_none();
    child.kill().unwrap();
    child.wait().unwrap();
    running
}

/// A folder that is not yet locked stays for a minute; nothing else may.
fn is_tidy(folder: &Folder, known: &[&str]) {
    let stray: Vec<String> = folder.names();
    let stray: Vec<&String> =
        stray.iter().filter(|name| !known.contains(&name.as_str()) && !name.ends_with(".new")).collect();
    assert!(stray.is_empty(), "{stray:?}");
}

#[test]
fn datasets() {
    let (folder, mut random) = (Folder::new(), Random(1));
    let words = "simulate tensor --preset fig5a --t-end 400 --dt-out 0.05 --transient 0 --out run --force";
    let time = usual(&folder, words);
    let count = kills() / 3;
    let killed = (0..count).filter(|_| {
        let killed = kill(&folder, words, time, &mut random);
        // one whole dataset is there at every moment: the old one or the new one
        assert_eq!(names(&folder.path("run")).iter().filter(|name| *name == "manifest.json").count(), 1);
        killed
    });
    let killed = killed.count();
    whole(&folder, "figure run");
    whole(&folder, words);
    is_tidy(&folder, &["run"]);
    println!("{killed} of {count} were still running");
    assert!(killed > 0); // how many depends on what else the machine does
}

#[test]
fn scans() {
    let (folder, mut random) = (Folder::new(), Random(2));
    let scan = "scan tensor --preset fig1 --axis kappa2=-0.2:0.2:30 --axis gamma=0.02:0.1:10 --samples 1 --budget 30 --no-figures \
                --threads 2 --out";
    let time = usual(&folder, &format!("{scan} whole"));
    let bytes = |name: &str| {
        let folder = folder.path(name);
        names(&folder)
            .iter()
            .map(|name| (name.clone(), std::fs::read(folder.join(name)).unwrap()))
            .collect::<Vec<_>>()
    };
    let (want, count) = (bytes("whole"), kills() / 3);
    let mut killed = 0;
    for round in 0..count {
        let opening = if round % 8 == 0 { "--force" } else { "--resume" };
        killed += usize::from(kill(&folder, &format!("{scan} run {opening}"), time, &mut random));
    }
    whole(&folder, &format!("{scan} run --resume"));
    assert!(bytes("run") == want, "{:?}", names(&folder.path("run")));
    is_tidy(&folder, &["run", "whole"]);
    println!("{killed} of {count} were still running");
}

#[test]
fn merges() {
    let (folder, mut random) = (Folder::new(), Random(3));
    let scan = "scan tensor --preset fig1 --axis kappa2=-0.2:0.2:30 --axis gamma=0.02:0.1:10 --samples 1 --budget 30 --no-figures";
    for shard in 1..=2 {
        whole(&folder, &format!("{scan} --shard {shard}/2 --out s{shard}"));
    }
    let words = "merge s1 s2 --out all --force";
    let time = usual(&folder, words);
    let count = kills() / 3;
    let killed = (0..count).filter(|_| {
        let killed = kill(&folder, words, time, &mut random);
        assert_eq!(
            names(&folder.path("all")).len(),
            names(&folder.path("s1")).len() + names(&folder.path("s2")).len() - 2
        );
        killed
    });
    let killed = killed.count();
    whole(&folder, words);
    is_tidy(&folder, &["all", "s1", "s2"]);
    println!("{killed} of {count} were still running");
}
