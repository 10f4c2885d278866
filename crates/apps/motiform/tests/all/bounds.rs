//! Requests that would never end, or name no file, are refused at once and in words.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(target_os = "linux")]

use crate::common;

use common::{Done, Folder};
use std::time::{Duration, Instant};

/// Refused, soon, with all these words.
fn refused(folder: &Folder, words: &str, said: &[&str]) -> Done {
    let begun = Instant::now();
    let done = folder.run(words);
    assert!(begun.elapsed() < Duration::from_secs(20), "{words}: {:?}", begun.elapsed());
    assert_eq!(done.code, Some(2), "{words}: {}", done.stdout);
    for word in said {
        assert!(done.stderr.contains(word), "{words}: {word}: {}", done.stderr);
    }
    assert!(done.stderr.len() < 3000 && !done.stderr.contains("000000000000"), "{words}: {}", done.stderr);
    done
}

#[test]
fn times_and_steps_without_end() {
    let folder = Folder::new();
    refused(&folder, "simulate tensor --t-end 1e300", &["t_end = 1e300", "at most 1e9"]);
    refused(&folder, "simulate tensor --transient 1e300", &["transient = 1e300", "1e9"]);
    refused(&folder, "simulate tensor --step 1e-300", &["step = 1e-300", "give a larger step"]);
    refused(&folder, "simulate cell --step 1e-300", &["step = 1e-300"]);
    refused(&folder, "lyapunov tensor --preset fig5b --t-end 1e300", &["t_end = 1e300"]);
    refused(&folder, "classify tensor --budget 1e300", &["budget = 1e300"]);
    let stiff = ["fastest rate", "krogstad4"];
    refused(&folder, "simulate tensor --set gamma=-1e6 --t-end 1e6", &stiff);
    refused(&folder, "scan tensor --axis gamma=-1e6:-1e5:2 --axis kappa2=0:1:2 --samples 1", &stiff);
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

/// Sizes that no memory holds, and lengths that no number of modes resolves.
#[test]
fn bodies_without_bounds() {
    let folder = Folder::new();
    for command in ["simulate", "classify", "lyapunov", "equilibria"] {
        refused(&folder, &format!("{command} cell --set modes=1e9"), &["modes = 1000000000", "1 to 128"]);
        refused(&folder, &format!("{command} cell --set length=1e6"), &["length = 1000000", "0.01 to 200"]);
        refused(&folder, &format!("{command} cell --set length=200"), &["modes = 21", "at least 96"]);
    }
    refused(&folder, "scan cell --axis modes=100,1000", &["modes = 1000"]);
    refused(&folder, "scan cell --axis length=10:1e6:3", &["length = 500005"]);
    let text = |modes: &str| format!("[model.amplitudes]\nmodes = [{modes}]\n[model.amplitudes.equations]\n");
    let seventeen: Vec<String> = (1..=17).map(|n| n.to_string()).collect();
    folder.write("many.toml", &text(&seventeen.join(", ")));
    refused(&folder, "classify many.toml", &["modes has 17 entries", "1 to 16"]);
    folder.write("high.toml", &text("1, 1000000"));
    refused(&folder, "classify high.toml", &["mode 1000000", "1 to 64"]);
    assert_eq!(folder.names(), ["high.toml", "many.toml"]);
}

/// The largest text model, 32 unknowns: a velocity of size sqrt(.3) that drives a cascade of damped modes. Its exponents are exact.
#[test]
fn sixteen_modes_are_classified() {
    let folder = Folder::new();
    let modes: Vec<String> = (1..=16).map(|n| n.to_string()).collect();
    let mut text = format!(
        "[model.amplitudes]\nmodes = [{}]\n[model.amplitudes.equations]\nz1 = \"(0.3 - |z1|^2)*z1\"\n",
        modes.join(", ")
    );
    for mode in 2..=16 {
        let rate = 0.1 * f64::from(mode);
        text += &format!("z{mode} = \"-{rate:.1}*z{mode} + 0.2*z1*z{}\"\n", mode - 1);
    }
    folder.write("sixteen.toml", &text);
    let json = folder.run("classify sixteen.toml --json").expect(0).json();
    assert_eq!(json["regime"], "straight", "{json}");
    assert!((json["speed"]["mean"].as_f64().unwrap() - 0.3_f64.sqrt()).abs() < 1e-9, "{json}");
    let exponents = json["exponents"].as_array().unwrap();
    let leading: Vec<f64> = exponents.iter().take(4).map(|one| one["value"].as_f64().unwrap()).collect();
    for (found, exact) in leading.iter().zip([0.0, -0.2, -0.2, -0.3]) {
        assert!((found - exact).abs() < 1e-9, "{json}");
    }
}

#[test]
fn devices_pipes_and_folders_are_no_files() {
    let folder = Folder::new();
    refused(&folder, "check /dev/zero", &["more than 1048576 bytes"]);
    refused(&folder, "figure /dev/zero", &["error"]);
    let scan = "scan tensor --preset fig1 --axis kappa2=0.1:0.2:3 --samples 1 --budget 300 --threads 1 --no-figures --out scan";
    folder.run(scan).expect(0);
    for place in ["mkfifo scan/part-00001.parquet", "mkdir scan/part-00001.parquet"] {
        folder.bash(&format!("rm -rf scan/part-00001.parquet; {place}")).expect(0);
        refused(&folder, &format!("{scan} --resume"), &["part-00001.parquet is not a file", "remove it"]);
    }
    folder.bash("rmdir scan/part-00001.parquet").expect(0);
    folder.run(&format!("{scan} --resume")).expect(0);
    folder.bash("rm scan/_manifest.json && mkfifo scan/_manifest.json").expect(0);
    refused(&folder, &format!("{scan} --resume"), &["_manifest.json", "not a file"]);
}

#[test]
fn lines_of_any_length_are_quoted_in_part() {
    let folder = Folder::new();
    folder.write("long.toml", &format!("[model.tensor]\nkappa2 = {}\n", "x".repeat(70_000)));
    refused(&folder, "check long.toml", &["long.toml:2:10"]);
    folder.write("name.toml", &format!("[model.tensor]\n{} = 1\n", "k".repeat(70_000)));
    refused(&folder, "check name.toml", &["name.toml:2:1"]);
}

/// A limit on the size of files is an error like a full disk; nothing stays.
#[test]
fn a_limit_on_files_is_said() {
    let folder = Folder::new();
    let run = "$motiform simulate tensor --preset fig5a --t-end 400 --dt-out 0.01 --transient 0 --no-figures --out run";
    let done = folder.bash(&format!("ulimit -f 8; {run}"));
    assert_eq!(done.code, Some(2), "{}", done.stderr);
    assert!(done.stderr.contains("File too large") && !done.stderr.contains(".partial"), "{}", done.stderr);
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

/// Files that only have the name of unfinished output, or that an earlier version left, block nobody and stay.
#[test]
fn a_leftover_of_the_same_process_number_blocks_nobody() {
    let folder = Folder::new();
    folder.bash("for n in $(seq 1 200); do mkdir .run.$n.partial; done").expect(0);
    let words = "simulate tensor --preset fig5a --t-end 5 --transient 0 --no-figures --out run";
    let done = folder.run(words).expect(0);
    assert_eq!((folder.names().len(), folder.path("run").is_dir()), (201, true));
    assert!(!done.stderr.contains("left by a killed run"), "{}", done.stderr);
}

/// Two processes that resume one scan: one computes, the other says who does.
#[test]
fn racing_for_a_scan() {
    let folder = Folder::new();
    let scan = "$motiform scan tensor --preset fig1 --axis kappa2=0.1:0.2:40 --samples 8 --threads 1 --no-figures --out scan";
    folder.bash(&format!("{scan} --budget 300 >/dev/null 2>&1; rm -f scan/part-000*")).expect(0);
    let race = folder.bash(&format!(
        "for n in 1 2 3 4; do ({scan} --budget 300 --resume >out$n 2>err$n; echo $? >code$n) & done; wait; cat code? err?"
    ));
    // Cells that are undetermined within the short budget give the exit code 1, the lock of another process 2.
    let codes: String =
        (1..=4).map(|n| std::fs::read_to_string(folder.path(&format!("code{n}"))).unwrap()).collect();
    let (locked, said) =
        (codes.matches('2').count(), race.stdout.matches("another motiform process computes").count());
    assert!(locked < 4 && locked == said, "{}", race.stdout);
    let done = folder.bash(&format!("{scan} --budget 300 --resume"));
    assert!(matches!(done.code, Some(0 | 1)), "{}", done.stderr);
}

/// Stiff equations with an explicit stepper are allowed, and it is said that they take long.
#[test]
fn an_explicit_stepper_on_stiff_equations_is_named() {
    let folder = Folder::new();
    let check = |preset: &str, stepper: &str| {
        folder.write("study.toml", &format!("preset = \"{preset}\"\n[run]\nstepper = \"{stepper}\"\n"));
        folder.run("check study.toml").expect(0).stderr
    };
    let says = "the equations of cell are stiff, and dop853 is an explicit method";
    assert!(check("fig6b", "dop853").contains(says), "{}", check("fig6b", "dop853"));
    assert_eq!((check("fig6b", "krogstad4"), check("fig4", "dop853")), (String::new(), String::new()));
}
