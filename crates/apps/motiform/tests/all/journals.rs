//! Long runs that are killed keep what is finished: branches, curves, orbits, bodies and chapters are not computed again, and the
//! result is, to the byte, that of a run that nobody disturbed.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(target_os = "linux")]

use crate::common;

use common::{Folder, names};
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// A busy machine may be slow.
const PATIENCE: Duration = Duration::from_secs(120);

/// Names and bytes of everything in a folder and its folders.
fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut all = Vec::new();
    for name in names(folder) {
        let path = folder.join(&name);
        if path.is_dir() {
            all.extend(contents(&path).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)));
        } else {
            all.push((name, std::fs::read(path).unwrap()));
        }
    }
    all
}

/// Starts a command and kills it as soon as `kept` says that something is kept; whether it was still running.
fn kill_when(folder: &Folder, words: &str, kept: impl Fn() -> bool) -> bool {
    let mut child = folder.command(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let begun = Instant::now();
    while !kept() && child.try_wait().unwrap().is_none() {
        assert!(begun.elapsed() < PATIENCE, "nothing is kept");
        std::thread::sleep(Duration::from_millis(1));
    }
    let running = child.try_wait().unwrap().is_none();
    child.kill().unwrap();
    child.wait().unwrap();
    running
}

/// The result of a command that is killed again and again once something more is kept is that of one that is not.
fn is_kept(command: &str, resume: &str, item: &dyn Fn(&Path) -> usize, rounds: usize) {
    let folder = Folder::new();
    let run = |words: &str| {
        let done = folder.run(words);
        assert!(matches!(done.code, Some(0 | 1)), "{words}: {}", done.stderr);
    };
    run(&format!("{command} --out whole"));
    let (out, mut there) = (folder.path("killed"), 0);
    for round in 0..rounds {
        let words = format!("{command} --out killed {}", if round == 0 { "" } else { resume });
        let killed = kill_when(&folder, &words, || item(&out) > there);
        if !killed {
            break; // too quick for a further kill
        }
        there = item(&out);
        assert!(there > 0, "{words}");
    }
    assert!(there > 0, "nothing was killed");
    run(&format!("{command} --out killed {resume}"));
    let (whole, killed) = (contents(&folder.path("whole")), contents(&out));
    let list = |all: &[(String, Vec<u8>)]| all.iter().map(|entry| entry.0.clone()).collect::<Vec<_>>();
    assert_eq!(list(&whole), list(&killed));
    for ((name, whole), (_, killed)) in whole.iter().zip(&killed) {
        assert!(whole == killed, "{name}");
    }
}

/// The size of a file that grows; 0 where there is none.
fn size(name: &'static str) -> impl Fn(&Path) -> usize {
    move |folder| std::fs::metadata(folder.join(name)).map_or(0, |meta| meta.len() as usize)
}

/// The number of items of unfinished work, without the plan.
fn items(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder.join("_work")).into_iter().flatten().flatten();
    entries.filter(|entry| !entry.file_name().to_string_lossy().contains("plan")).count()
}

#[test]
fn branches() {
    let command =
        "continue tensor --preset fig5a --along kappa2=0.7:1.6 --branches 4 --points 60 --no-figures";
    is_kept(command, "--resume", &size("branches.json"), 3);
}

/// Samples along the parameter are kept every second.
#[test]
fn sweeps() {
    let command = "continue tensor --preset fig5a --along kappa2=0.7:1.6 --branches 1 --points 5 --sweep 320 --no-figures";
    let sampled = |folder: &Path| {
        let entries = std::fs::read_dir(folder.join("_work")).into_iter().flatten().flatten();
        entries.filter_map(|entry| Some(entry.metadata().ok()?.len() as usize)).sum()
    };
    is_kept(command, "--resume", &sampled, 2);
}

#[test]
fn curves() {
    let command = "continue tensor --preset fig4 --set kappa3=0.1 --set kappa2=0.9 --along kappa2=0.7:1.2 --branches 2 --points 60 \
                   --curve symmetry-breaking --in kappa2,kappa3=0.09:0.2 --no-figures";
    is_kept(command, "--resume", &size("curves.json"), 4);
}

/// Cells are kept group by group, lines two by two.
#[test]
fn atlases() {
    let command = "atlas tensor --preset fig4 --axis kappa2=0.8:1.5:33 --axis kappa3=0.2:0.6:17 --samples 2 --lines 4 \
     --branches 2 --threads 2";
    is_kept(command, "--resume", &items, 3);
    let folder = Folder::new();
    assert!(kill_when(&folder, &format!("{command} --out killed"), || items(&folder.path("killed")) > 0));
    let said = folder.run("verify killed").expect(0).stdout;
    assert!(said.contains("not complete") && said.contains("verdict   intact"), "{said}");
}

/// Orbits are kept every five seconds.
#[test]
fn orbits() {
    let command = "lifetimes tensor --preset fig4 --set kappa3=0.1 --axis kappa2=0.36:0.46:6 --until 2e4 --samples 150 --threads 2";
    is_kept(command, "--resume", &size("orbits.json"), 1);
}

#[test]
fn bodies() {
    let command =
        "statistics tensor --preset fig5b --bodies 400 --t-end 2000 --dt-out 1 --transient 0 --threads 2";
    is_kept(command, "--resume", &items, 3);
    let cell = "statistics cell --preset fig6a --noise 0.001 --bodies 4 --t-end 40 --dt-out 0.5 --transient 0 --threads 1";
    is_kept(cell, "--resume", &items, 2);
}

/// The page is there from the first chapter on; chapters that are missing say so.
#[test]
fn chapters() {
    let folder = Folder::new();
    let command = "reproduce fig2 fig5 --quick --threads 2 --out killed";
    let out = folder.path("killed");
    assert!(kill_when(&folder, command, || items(&out) > 0 && out.join("report.html").exists()));
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("not rebuilt yet"));
    let kept = contents(&out.join("_work"));
    assert!(matches!(folder.run(command).code, Some(0 | 1)));
    assert!(!kept.is_empty() && items(&out) == 0);
    // figures have the numbers of the paper, whatever else is rebuilt
    assert!(out.join("figure-2.svg").exists() && !out.join("figure-1.svg").exists());
    let done = folder.run("reproduce fig2 fig5 --quick --threads 2 --out whole");
    assert!(matches!(done.code, Some(0 | 1)));
    assert!(contents(&out) == contents(&folder.path("whole")));
}

/// Another plan is refused before anything is changed.
#[test]
fn bodies_of_another_plan_are_refused() {
    let folder = Folder::new();
    let words = "statistics tensor --preset fig5b --bodies 3 --t-end 50 --transient 0 --out found";
    folder.run(words).expect(0);
    let before = contents(&folder.path("found"));
    let done = folder
        .run("statistics tensor --preset fig5b --bodies 4 --t-end 50 --transient 0 --out found --resume")
        .expect(2);
    assert!(done.stderr.contains("another plan (bodies: 3 there, 4 requested)"), "{}", done.stderr);
    assert!(contents(&folder.path("found")) == before);
    folder.run(&format!("{words} --resume")).expect(0);
    assert!(contents(&folder.path("found")) == before);
}
