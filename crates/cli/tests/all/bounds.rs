//! What would never end, or is no file, is refused at once and in words.

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

/// What only has the name of unfinished output, or an earlier version left, blocks nobody and stays.
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
