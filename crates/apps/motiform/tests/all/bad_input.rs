//! Bad input gets one clear text that names key, value and remedy, exit code 2, and leaves nothing
//! behind.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::Folder;
use std::fmt::Write;

/// Runs each line and checks what all refusals have in common; returns what people read, for a snapshot.
fn refused(folder: &Folder, lines: &[&str]) -> String {
    let before = folder.names();
    let mut read = String::new();
    for line in lines {
        let done = folder.run(line).expect_error(2);
        assert_eq!(folder.names(), before, "{line}");
        writeln!(read, "$ motiform {line}\n{}\n", done.stderr.trim_end()).unwrap();
    }
    read
}

#[test]
fn names_that_do_not_exist() {
    let read = refused(
        &Folder::new(),
        &[
            "simulate tenser",
            "simulate fig5",
            "models tenser",
            "simulate tensor --preset fig5c",
            "simulate tensor --set kapa2=1",
            "simulate tensor --set viscosity=1",
            "simulate tensor --initial v3=1",
            "simulate tensor --stepper rk5",
            "simulate tensor --t-ned 5",
            "simulat tensor",
            "completions bsh",
            "simulate tensor --format xml",
        ],
    );
    insta::assert_snapshot!("names", read);
}

#[test]
fn numbers_that_are_none() {
    let read = refused(
        &Folder::new(),
        &[
            "simulate tensor --set kappa2=abc",
            "simulate tensor --set kappa2=0,5",
            "simulate tensor --set kappa2",
            "simulate tensor --set kappa2=",
            "simulate tensor --set kappa2=nan",
            "simulate tensor --set kappa2=1e999",
            "simulate tensor --initial v1=-inf",
            "simulate tensor --t-end inf",
            "simulate tensor --t-end ten",
            "simulate tensor --rtol NaN",
            "simulate tensor --seed 1.5",
            "simulate tensor --seed -1",
            "simulate tensor --max-steps many",
            "simulate tensor --t-end --json",
        ],
    );
    insta::assert_snapshot!("numbers", read);
}

#[test]
fn numbers_out_of_range() {
    let read = refused(
        &Folder::new(),
        &[
            "simulate tensor --t-end -5",
            "simulate tensor --t-end 0",
            "simulate tensor --transient -1",
            "simulate tensor --dt-out 0",
            "simulate tensor --dt-out -0.1",
            "simulate tensor --dt-out 1e-300",
            "simulate tensor --rtol 0",
            "simulate tensor --rtol 1",
            "simulate tensor --rtol -1e-2",
            "simulate tensor --atol -1",
            "simulate tensor --stepper rk4 --step 0",
            "simulate tensor --stepper rk4 --step -0.1",
            "simulate tensor --max-steps 0",
            "simulate tensor --rtol 1e-3",
            "simulate tensor --set gamma=2e6",
            "simulate tensor --radius -1",
            "simulate tensor --scale -2",
            "simulate tensor --outlines 5000",
            "simulate tensor --from 5 --to 3",
        ],
    );
    insta::assert_snapshot!("ranges", read);
    // How the smallest numbers are written is the numerics' choice.
    let done = Folder::new().run("simulate tensor --rtol 1e-20").expect_error(2);
    assert!(done.stderr.contains("rtol = ") && done.stderr.contains("1e-14 to 1e-4"), "{}", done.stderr);
}

#[test]
fn study_files() {
    let folder = Folder::new();
    folder.write("open.toml", "title = \"swim\n[model.tensor]\n");
    folder.write("name.toml", "[model.tensor]\nkapa2 = 1\n");
    folder.write("key.toml", "[model.tensor]\n\n[run]\n  t_ned = 1\n");
    folder.write("type.toml", "[model.tensor]\nkappa2 = \"high\"\n");
    folder.write("nan.toml", "[model.tensor]\ngamma = nan\n");
    folder.write("time.toml", "[model.tensor]\n[run]\nt_end = -1\n");
    folder.write("good.toml", "preset = \"fig5a\"\n");
    std::fs::write(folder.path("bytes.toml"), [0xff, 0xfe, 0]).unwrap();
    let read = refused(
        &folder,
        &[
            "check open.toml",
            "check name.toml",
            "check key.toml",
            "check type.toml",
            "check nan.toml",
            "check time.toml",
            "check bytes.toml",
            "simulate key.toml",
            "simulate missing.toml",
            "simulate good.toml --preset fig1",
            "check missing/study.toml",
            "check",
        ],
    );
    insta::assert_snapshot!("studies", read);
}

#[test]
fn places_that_cannot_be_written() {
    let folder = Folder::new();
    folder.write("file", "mine");
    // Permission bits do not stop root; a path below a file, or in /proc, stops everyone.
    let read = refused(
        &folder,
        &[
            "simulate tensor --t-end 1 --out file/run",
            "simulate tensor --t-end 1 --out /proc/run",
            "simulate tensor --t-end 1 --out /proc/run.csv",
            "simulate tensor --t-end 1 --out /",
            "simulate tensor --t-end 1 --out ..",
            "figure missing",
            "figure file",
        ],
    );
    insta::assert_snapshot!("places", read);
}

#[test]
fn nothing_is_overwritten_without_force_and_only_datasets_with_it() {
    let folder = Folder::new();
    folder.run("simulate tensor --t-end 1 --no-figures --out run").expect(0);
    folder.run("simulate tensor --t-end 1 --out run.csv").expect(0);
    folder.write("notes.txt", "mine");
    std::fs::create_dir(folder.path("thesis")).unwrap();
    folder.write("thesis/chapter1.tex", "years of work");
    std::fs::create_dir(folder.path("app")).unwrap();
    folder.write("app/manifest.json", "{\"name\": \"an app, not a dataset\", \"version\": \"1\"}");
    let contents = |name: &str| std::fs::read(folder.path(name)).unwrap();
    let kept = ["run/manifest.json", "run.csv", "notes.txt", "thesis/chapter1.tex", "app/manifest.json"];
    let before = kept.map(contents);
    let read = refused(
        &folder,
        &[
            "simulate tensor --t-end 2 --out run",
            "simulate tensor --t-end 2 --out run.csv",
            "simulate tensor --t-end 2 --out notes.txt",
            "simulate tensor --t-end 2 --out notes.txt --force",
            "simulate tensor --t-end 2 --out thesis --force",
            "simulate tensor --t-end 2 --out app --force",
        ],
    );
    insta::assert_snapshot!("existing", read);
    assert_eq!(kept.map(contents), before);

    folder.run("simulate tensor --t-end 2 --no-figures --out run --force").expect(0);
    folder.run("simulate tensor --t-end 2 --out run.csv --force").expect(0);
    assert!(contents("run/manifest.json") != before[0] && contents("run.csv") != before[1]);
    assert_eq!(folder.names(), [".run.csv.inventory", "app", "notes.txt", "run", "run.csv", "thesis"]);
}

#[test]
fn scans() {
    let folder = Folder::new();
    folder.write("study.toml", "preset = \"fig1\"\n[scan]\naxes = [\"kapa2=0.1:1:5\"]\n");
    folder.write("file", "mine");
    std::fs::create_dir(folder.path("thesis")).unwrap();
    let small = "scan tensor --preset fig1 --axis gamma=-1,-0.5";
    folder.run(&format!("{small} --out run")).expect(0);
    folder.run(&format!("{small} --out other --seed 2")).expect(0);
    let read = refused(
        &folder,
        &[
            "scan tensor",
            "scan tensor --preset fig1",
            "scan tensor --axis kapa2=0.1:1:5",
            "scan tensor --axis kappa2",
            "scan tensor --axis kappa2=0.1:1:0",
            "scan tensor --axis kappa2=0.1:1",
            "scan tensor --axis kappa2=0.1:1:2.5",
            "scan tensor --axis kappa2=0.1:nan:5",
            "scan tensor --axis kappa2=0.1,,0.2",
            "scan tensor --axis kappa2=0.1,0.1",
            "scan tensor --axis kappa2=1:1:5",
            "scan tensor --axis kappa2=0:1:1000000",
            "scan tensor --axis kappa2=0:1:3 --axis kappa2=1:2:3",
            "scan tensor --axis kappa2=0:1:3 --axis kappa3=1:2:3 --axis gamma=1",
            "scan tensor --axis kappa2=0:1:100000 --axis kappa3=1:2:100000",
            "scan tensor --axis kappa2=0:2e6:3",
            "scan cell --axis modes=20,20.5",
            "scan tensor --axis kappa2=0:1:3 --samples 0",
            "scan tensor --axis kappa2=0:1:3 --samples 1000000",
            "scan tensor --axis kappa2=0:1:3 --budget -1",
            "scan tensor --axis kappa2=0:1:3 --shard 4/3",
            "scan tensor --axis kappa2=0:1:3 --threads 0",
            "scan tensor --axis kappa2=0:1:3 --resume --force",
            "scan study.toml",
            "check study.toml",
            "scan tensor --axis kappa2=0:1:3 --out file",
            "scan tensor --axis kappa2=0:1:3 --out thesis --force",
            "scan tensor --axis kappa2=0:1:3 --out thesis --resume",
            "scan tensor --preset fig1 --axis gamma=-1,-0.5 --out run",
            "scan tensor --preset fig1 --axis gamma=-1,-0.6 --set a1=2 --seed 3 --out run --resume",
            "simulate tensor --t-end 1 --out run --force",
            "merge run",
            "merge run missing --out all",
            "merge run thesis --out all",
            "merge run other --out all",
            "merge run --out other",
        ],
    );
    insta::assert_snapshot!("scans", read);
}

/// A limit on the size of files stands in for a full disk: writing fails in the middle, as it does there.
#[test]
fn a_full_disk() {
    let folder = Folder::new();
    let full = "trap '' XFSZ; ulimit -f 8; exec $motiform";
    for words in [
        "simulate tensor --preset fig5a",
        "simulate tensor --preset fig5a --out run --json",
        "simulate tensor --preset fig5a --out run --format csv",
        "simulate tensor --preset fig5a --out run.csv",
        "simulate tensor --preset fig5a --out run.parquet",
        "simulate tensor --preset fig5a --out run --dt-out 40", // the table fits, a figure does not
    ] {
        let done = folder.bash(&format!("{full} {words}")).expect_error(2);
        assert!(
            done.stderr.starts_with("error: writing ") && done.stderr.contains("File too large"),
            "{}",
            done.stderr
        );
        assert!(done.stderr.contains("free some space and run again"), "{}", done.stderr);
        assert_eq!(folder.names(), [""; 0], "{words}");
    }
}

#[test]
fn a_full_disk_leaves_old_figures_and_datasets_whole() {
    let folder = Folder::new();
    folder.run("simulate tensor --preset fig5a --transient 0 --out run").expect(0);
    let names = common::names(&folder.path("run"));
    // the inventory may have a further line, which lists nothing
    let files: Vec<&String> = names.iter().filter(|name| *name != "_inventory.jsonl").collect();
    let contents = || files.iter().map(|name| std::fs::read(folder.path("run").join(name)).unwrap());
    let before: Vec<_> = contents().collect();
    for words in ["figure run", "simulate tensor --preset fig5a --out run --force"] {
        folder.bash(&format!("trap '' XFSZ; ulimit -f 8; exec $motiform {words}")).expect_error(2);
        assert_eq!(common::names(&folder.path("run")), names, "{words}");
        assert!(contents().eq(before.iter().cloned()), "{words}");
        assert_eq!(folder.names(), ["run"], "{words}");
    }
}

#[test]
fn standard_output_that_cannot_be_written() {
    let folder = Folder::new();
    let done = folder.bash("exec $motiform simulate tensor --t-end 1 --json > /dev/full").expect_error(2);
    assert!(done.stderr.contains("writing standard output failed: No space left"), "{}", done.stderr);
    // A reader that went away (`| head`) has what it wanted: silence, and the exit code of the work.
    for words in ["models tensor", "completions bash", "simulate tensor --t-end 1 --json"] {
        let line = format!("{{ sleep 0.1; $motiform {words}; echo code $? >&2; }} | true");
        assert_eq!(folder.bash(&line).stderr, "code 0\n", "{words}");
        assert_eq!(folder.bash(&format!("$motiform {words} | head -c 10")).stderr, "", "{words}");
    }
}

/// The words that are wrong are named, with what is right.
#[test]
fn misspelt_keys_and_missing_places_are_named() {
    let folder = Folder::new();
    folder.write("key.toml", "title = \"t\"\npresett = \"fig5a\"\n");
    folder.write("empty.toml", "");
    for (words, told) in [
        ("check key.toml", "key.toml:2:1: unknown key presett (did you mean preset?)"),
        ("check empty.toml", "a study needs preset = \"NAME\", or a table [model.NAME]"),
        ("check nofile.toml", "give the name of a file that exists"),
        ("verify nowhere", "there is no folder nowhere: give one that motiform wrote"),
        ("simulate tensor --preset fig5a --t-end 60 --from 1000", "from = 1000"),
        ("simulate tensor --preset fig5a --t-end 60 --from 60", "give a smaller --from, or a longer --t-end"),
    ] {
        let done = folder.run(words).expect_error(2);
        assert!(done.stderr.contains(told), "{words}: {}", done.stderr);
    }
    folder.run("simulate tensor --preset fig5a --t-end 60 --from 59 --dt-out 0.1 --out run").expect(0);
}

/// Words that the library leaves to those who call it: which option names columns, which reads masks.
#[test]
fn tables_of_cells() {
    let folder = Folder::new();
    folder.write("words.txt", "a cell moved\nand stopped\n");
    folder.write("binary.dat", "\u{1}\u{2}\u{3}");
    let rows = |frame: usize, shift: f64| -> String {
        let row = |i: i32| {
            let (sin, cos) = (0.6 * f64::from(i)).sin_cos();
            format!("{frame},{i},{},{sin}\n", cos + shift)
        };
        (0..10).map(row).collect()
    };
    let both: String = (0..6).map(|frame| rows(frame, 0.0) + &rows(frame, 9.0)).collect();
    folder.write("two.csv", &format!("frame,i,x,y\n{both}"));
    std::fs::create_dir(folder.path("masks")).unwrap();
    let lines = ["observe words.txt", "observe binary.dat", "observe two.csv", "observe masks"];
    insta::assert_snapshot!("tables_of_cells", refused(&folder, &lines));
}
