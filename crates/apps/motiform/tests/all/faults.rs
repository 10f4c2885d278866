//! Every call that changes the file system fails once, or is the last thing that the process does: nothing half done ever has a
//! name, and the next run cleans up.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(target_os = "linux")]

use crate::common;

use common::{Done, Folder, names};
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

const RUN: &str = "simulate tensor --preset fig5a --t-end 5 --dt-out 1 --transient 0";
const SCAN: &str = "scan tensor --preset fig1 --axis kappa2=0.1:0.2:3 --samples 1 --budget 300 --threads 1";

/// The shared library of faults/shim.c.
fn shim() -> &'static PathBuf {
    static SHIM: OnceLock<PathBuf> = OnceLock::new();
    SHIM.get_or_init(|| {
        let library = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("fault_shim.so");
        let source = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/all/faults/shim.c");
        let mut cc = Command::new("cc");
        cc.args(["-O1", "-shared", "-fPIC", "-o"]).arg(&library).arg(source).args(["-ldl", "-lpthread"]);
        assert!(cc.status().unwrap().success());
        library
    })
}

/// The number of calls from one that fails to the next.
pub(crate) fn every() -> usize {
    std::env::var("MOTIFORM_FAULTS").ok().and_then(|text| text.parse().ok()).unwrap_or(97)
}

/// The program in the shim, with a fault of this kind at a call (see faults/shim.c).
pub(crate) fn faulty(folder: &Folder, words: &str, kind: &str, at: usize) -> Command {
    let mut command = folder.command(words);
    command.env("LD_PRELOAD", shim()).env("FAULT_KIND", kind).env("FAULT_AT", at.to_string());
    command
}

/// Runs a program in the shim; whether the fault struck.
pub(crate) fn struck(mut command: Command) -> (Done, bool) {
    let done = Done::from(command.output().unwrap());
    let struck = done.stderr.contains("FAULT");
    (done, struck)
}

/// Fails each call in turn, with `prepare` before and `check` after each run; returns how many calls there are. A push tries every
/// eleventh one, others for each command and kind of fault.
fn each_call(words: &str, kind: &str, prepare: impl Fn(&Folder), check: impl Fn(&Folder, &Done)) -> usize {
    let step = every().min(11);
    for at in (1 + (words.len() + kind.len()) % step..).step_by(step) {
        let folder = Folder::new();
        prepare(&folder);
        let (done, struck) = struck(faulty(&folder, words, kind, at));
        if !struck {
            done.expect(0);
            println!("{words}: up to {} calls, {kind}", at - 1);
            return at - 1;
        }
        check(&folder, &done);
    }
    0
}

fn nothing(_: &Folder) {}

fn is_refused_in_words(done: &Done) {
    assert_eq!(done.code, Some(2), "{}", done.stderr);
    assert!(done.stderr.contains("error: "), "{}", done.stderr);
    for word in [".partial", ".new", "panicked", "RUST_BACKTRACE"] {
        assert!(!done.stderr.contains(word), "{word}: {}", done.stderr);
    }
}

/// A call that fails leaves no file behind, and the run says why.
#[test]
fn a_run_is_there_whole_or_not_at_all() {
    for kind in ["full", "error"] {
        for out in ["run", "run.csv", "run.parquet"] {
            let words = format!("{RUN} --out {out}");
            let calls = each_call(&words, kind, nothing, |folder, done| {
                is_refused_in_words(done);
                // After the last rename only the folder's own names can still be lost: the run is there, and whole.
                let names: Vec<String> =
                    folder.names().into_iter().filter(|name| *name != format!(".{out}.inventory")).collect();
                if names == [out] && out == "run" {
                    folder.run("figure run").expect(0);
                } else if names != [out] {
                    assert_eq!(folder.names(), [""; 0], "{}", done.stderr);
                }
            });
            assert!(calls >= 4, "{calls}");
        }
    }
}

/// With --force there is always one whole run: the old one or the new one.
#[test]
fn what_is_replaced_stays_until_the_new_one_is_there() {
    let prepare = |folder: &Folder| drop(folder.run(&format!("{RUN} --no-figures --out run")).expect(0));
    for kind in ["full", "error", "kill"] {
        each_call(
            &format!("{} --no-figures --out run --force", RUN.replace("--t-end 5", "--t-end 6")),
            kind,
            prepare,
            |folder, done| {
                folder.run("figure run").expect(0);
                if kind == "kill" {
                    assert_eq!(done.code, None);
                    folder.run(&format!("{RUN} --no-figures --out run --force")).expect(0);
                } else {
                    is_refused_in_words(done);
                }
                // What was made and not yet locked stays for a minute: it may belong to a run that begins just now.
                let names = folder.names();
                let left: Vec<&String> = names.iter().filter(|name| !name.ends_with(".new")).collect();
                assert_eq!(left, ["run"]);
            },
        );
    }
}

/// A process that ends before any call blocks no later one, and what it leaves goes with the next run.
#[test]
fn a_killed_run_is_swept_by_the_next() {
    each_call(&format!("{RUN} --out run"), "kill", nothing, |folder, done| {
        assert_eq!(done.code, None);
        if folder.path("run").exists() {
            folder.run("figure run").expect(0);
        }
        let again = folder.run(&format!("{RUN} --out run --force")).expect(0);
        let left: Vec<String> = folder.names().into_iter().filter(|name| name != "run").collect();
        assert!(left.iter().all(|name| name.ends_with(".new")), "{left:?}: {}", again.stderr);
    });
}

/// Half of a write is no error: the rest is written.
#[test]
fn short_writes_are_finished() {
    let whole = Folder::new();
    whole.run(&format!("{RUN} --no-figures --out run")).expect(0);
    let bytes = |folder: &Folder| {
        let table = |name: &str| std::fs::read(folder.path(&format!("run/{name}"))).unwrap();
        ["manifest.json", "trajectory.parquet"].map(table)
    };
    let want = bytes(&whole);
    each_call(&format!("{RUN} --no-figures --out run"), "short", nothing, |folder, done| {
        assert_eq!(done.code, Some(0), "{}", done.stderr);
        assert!(bytes(folder) == want);
    });
}

/// A scan keeps its whole parts whatever fails, and --resume computes the others to the same bytes.
#[test]
fn a_scan_goes_on_after_every_fault() {
    let whole = Folder::new();
    whole.run(&format!("{SCAN} --no-figures --out scan")).expect(0);
    let parts = |folder: &Folder| {
        let mut names = names(&folder.path("scan"));
        names.retain(|name| name != ".lock");
        let read = |name: &String| std::fs::read(folder.path("scan").join(name)).unwrap();
        names.iter().map(|name| (name.clone(), read(name))).collect::<Vec<_>>()
    };
    let want = parts(&whole);
    assert_eq!(want.len(), 5, "{:?}", names(&whole.path("scan")));
    for kind in ["full", "error", "kill"] {
        each_call(&format!("{SCAN} --no-figures --out scan"), kind, nothing, |folder, done| {
            if kind == "kill" {
                assert_eq!(done.code, None);
            } else {
                is_refused_in_words(done);
            }
            folder.run(&format!("{SCAN} --no-figures --out scan --resume")).expect(0);
            assert!(parts(folder) == want, "{:?}: {}", names(&folder.path("scan")), done.stderr);
        });
    }
}

/// A merge too.
#[test]
fn a_merge_is_there_whole_or_not_at_all() {
    let prepare = |folder: &Folder| {
        for shard in 1..=2 {
            folder.run(&format!("{SCAN} --no-figures --shard {shard}/2 --out s{shard}")).expect(0);
        }
    };
    for kind in ["full", "kill"] {
        each_call("merge s1 s2 --out all", kind, prepare, |folder, done| {
            if kind == "full" {
                is_refused_in_words(done);
            }
            let there = folder.path("all").exists();
            let again =
                folder.run(if there { "merge s1 s2 --out all --force" } else { "merge s1 s2 --out all" });
            again.expect(0);
        });
    }
}
