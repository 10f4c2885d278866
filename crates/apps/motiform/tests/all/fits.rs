//! `motiform fit` in a folder: killed, interrupted and resumed, the result has the same bytes.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]
#![cfg(target_os = "linux")]

use crate::common;

use common::{Folder, read_json};
use std::fmt::Write;
use std::fs;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

const PATIENCE: Duration = Duration::from_secs(120);

/// Ellipses that turn and drift, each with its own noise from a small generator: short cells, whose fits take some tenths of a second.
pub(crate) fn outlines(cells: usize) -> String {
    let mut text = "cell,frame,i,x,y\n".to_owned();
    let mut state = 1_u64;
    let mut noise = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1 << 30) - 1.0
    };
    for cell in 0..cells {
        let (mut axis, mut at, mut long) = (0.3 * cell as f64, [0.0, 0.0], 0.5);
        for frame in 0..10 {
            axis += 0.1 + 0.1 * noise();
            long = 0.9 * long + 0.05 + 0.05 * noise();
            at = [
                at[0] + 0.3 * libm::cos(axis) + 0.05 * noise(),
                at[1] + 0.3 * libm::sin(axis) + 0.05 * noise(),
            ];
            for i in 0..24 {
                let angle = f64::from(i) / 24.0 * std::f64::consts::TAU;
                let turned = angle - axis;
                let r = 2.0 + long * libm::cos(2.0 * turned) + 0.2 * libm::cos(3.0 * turned) + 0.01 * noise();
                let (x, y) = (at[0] + r * libm::cos(angle), at[1] + r * libm::sin(angle));
                _ = writeln!(text, "{cell},{frame},{i},{x},{y}");
            }
        }
    }
    text
}

/// All files of a folder of results, by name.
fn files(folder: &Folder, name: &str) -> Vec<(String, Vec<u8>)> {
    let names = common::names(&folder.path(name));
    names
        .into_iter()
        .map(|file| (file.clone(), fs::read(folder.path(&format!("{name}/{file}"))).unwrap()))
        .collect()
}

/// Runs a command until `written`, then kills it.
fn killed_once(folder: &Folder, words: &str, written: impl Fn() -> bool) {
    let mut child = folder.command(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let start = Instant::now();
    while !written() && child.try_wait().unwrap().is_none() {
        assert!(start.elapsed() < PATIENCE, "nothing was written");
        sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn killed_and_resumed_fits_have_the_bytes_of_uninterrupted_ones() {
    let folder = Folder::new();
    fs::write(folder.path("cells.csv"), outlines(4)).unwrap();
    let words = "fit cells.csv --interval 1 --pixel-size 1 --draws 3 --modes 2 --threads 2 --json";
    let whole = folder.run(&format!("{words} --out whole"));
    assert!([Some(0), Some(1)].contains(&whole.code), "{}", whole.stderr);
    // killed again and again, after at least one more cell each time
    let mut done = 0;
    for round in 0..2 {
        let more = if round == 0 { "--out parts" } else { "--out parts --resume" };
        let cells = folder.path("parts/_cells");
        let written = || {
            fs::read_dir(&cells).map_or(0, |all| {
                all.filter(|file| {
                    file.as_ref().is_ok_and(|file| file.path().extension().is_some_and(|e| e == "gz"))
                })
                .count()
            })
        };
        killed_once(&folder, &format!("{words} {more}"), || written() > done);
        done = written();
    }
    assert!((1..4).contains(&done), "{done} cells were done at the last kill");
    // one of the finished cells is damaged: it is fitted again
    let some = fs::read_dir(folder.path("parts/_cells")).unwrap().next().unwrap().unwrap().path();
    fs::write(some, b"damaged").unwrap();
    let again = folder.run(&format!("{words} --out parts --resume"));
    assert_eq!((again.code, &again.stdout), (whole.code, &whole.stdout));
    let aside = common::names(&folder.path("parts")).into_iter().find(|name| name.starts_with("_damaged-"));
    let aside = folder.path("parts").join(aside.unwrap());
    assert_eq!(fs::read(&aside).unwrap(), b"damaged");
    fs::remove_file(aside).unwrap();
    assert_eq!(files(&folder, "parts"), files(&folder, "whole"));
    // complete: nothing is computed, and the same is printed
    let start = Instant::now();
    let complete = folder.run(&format!("{words} --out parts --resume"));
    assert_eq!((complete.code, complete.json()), (whole.code, whole.json()));
    println!("a complete folder: {:.2} s", start.elapsed().as_secs_f64());
}

/// Pages that were left out are drawn afterwards, from the same fits.
#[test]
fn pages_left_out_are_drawn_by_resume() {
    let folder = Folder::new();
    fs::write(folder.path("cells.csv"), outlines(2)).unwrap();
    let words = "fit cells.csv --interval 1 --pixel-size 1 --draws 3 --modes 2 --json";
    folder.run(&format!("{words} --out whole"));
    let first = folder.run(&format!("{words} --out later --no-report"));
    assert!(!folder.path("later/report.html").exists());
    let same = folder.run(&format!("{words} --out later --no-report --resume"));
    assert_eq!((same.code, same.json()), (first.code, first.json()));
    folder.run(&format!("{words} --out later --resume"));
    assert_eq!(files(&folder, "later"), files(&folder, "whole"));
}

/// One law for all cells: killed after each of its first stages, and resumed.
#[test]
fn a_killed_fit_of_all_cells_together_goes_on_from_its_last_stage() {
    let folder = Folder::new();
    fs::write(folder.path("cells.csv"), outlines(2)).unwrap();
    let words = "fit cells.csv --interval 1 --pixel-size 1 --draws 3 --modes 2 --together --json";
    let whole = folder.run(&format!("{words} --out whole"));
    assert!([Some(0), Some(1)].contains(&whole.code), "{}", whole.stderr);
    let page = fs::read_to_string(folder.path("whole/report.html")).unwrap();
    assert!(page.contains("One law for all cells") && page.contains("error between cells"));
    for (round, stage) in ["whole", "selection"].iter().enumerate() {
        let more = if round == 0 { "--out parts" } else { "--out parts --resume" };
        let stage = folder.path(&format!("parts/_cells/{stage}.json.gz"));
        killed_once(&folder, &format!("{words} {more}"), || stage.exists());
    }
    assert!(!folder.path("parts/summary.json").exists(), "it was killed before its end");
    let again = folder.run(&format!("{words} --out parts --resume"));
    assert_eq!((again.code, &again.stdout), (whole.code, &whole.stdout));
    assert_eq!(files(&folder, "parts"), files(&folder, "whole"));
    let refused = folder
        .run("fit cells.csv --interval 1 --pixel-size 1 --draws 3 --modes 2 --out parts --resume")
        .expect(2);
    assert!(refused.stderr.contains("together: true there, false requested"), "{}", refused.stderr);
}

#[test]
fn an_interruption_keeps_the_cells_that_are_done() {
    let folder = Folder::new();
    fs::write(folder.path("cells.csv"), outlines(200)).unwrap();
    let words = "fit cells.csv --interval 1 --pixel-size 1 --draws 3 --threads 2 --out parts";
    let child = folder.command(words).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let start = Instant::now();
    while fs::read_dir(folder.path("parts/_cells")).map_or(0, Iterator::count) == 0 {
        assert!(start.elapsed() < PATIENCE, "no cell was written");
        sleep(Duration::from_millis(5));
    }
    let signal =
        std::process::Command::new("bash").args(["-c", &format!("kill -INT {}", child.id())]).status();
    assert!(signal.unwrap().success());
    let start = Instant::now();
    let done: common::Done = child.wait_with_output().unwrap().into();
    let took = start.elapsed();
    let done = done.expect(130);
    assert!(took < Duration::from_secs(5), "it ended {took:?} after Ctrl-C");
    assert!(done.stderr.contains("with --resume continues"), "{}", done.stderr);
    let cells = read_json(&folder.path("parts/summary.json"))["cells"].as_array().unwrap().len();
    assert!((1..200).contains(&cells), "{cells}");
    // what is asked for must be what is there
    for (change, reason) in [
        ("--order 4", "order: 3 there, 4 requested"),
        ("--seed 9", "seed: 1 there, 9 requested"),
        ("--cell 3", "200 cells there, 1 requested"),
    ] {
        let refused = folder.run(&format!("{words} --resume {change}")).expect(2);
        assert!(refused.stderr.contains(reason), "{}", refused.stderr);
    }
    let refused =
        folder.run("fit cells.csv --interval 2 --pixel-size 1 --draws 3 --out parts --resume").expect(2);
    assert!(refused.stderr.contains("frame interval 1 there, 2 requested"), "{}", refused.stderr);
    let mut other = outlines(200);
    other.truncate(other.len() - 3);
    other.push_str("9\n");
    fs::write(folder.path("cells.csv"), other).unwrap();
    let refused = folder.run(&format!("{words} --resume")).expect(2);
    assert!(refused.stderr.contains("cell 199: other frames"), "{}", refused.stderr);
    let refused = folder.run("fit cells.csv --out parts").expect(2);
    assert!(refused.stderr.contains("--force"), "{}", refused.stderr);
    let refused = folder.run("fit cells.csv --resume").expect(2);
    assert!(refused.stderr.contains("--out"), "{}", refused.stderr);
}
