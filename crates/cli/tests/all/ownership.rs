//! What motiform did not write stays, under every option of every command that writes. The commands are those of the program's own list: a new one
//! must be given its place here.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(target_os = "linux")]

use crate::common;
use crate::faults::struck;
use crate::kills::{Random, kill, kills};

use common::{Done, Folder};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// A command that writes a folder, without `--out`.
pub(crate) struct Writer {
    words: &'static str,
    /// Its options for a folder that exists.
    options: &'static [&'static str],
}

const BOTH: &[&str] = &["", "--force", "--resume"];
const FORCE: &[&str] = &["", "--force"];

/// Short runs of every command that writes a folder; the first word is the command.
pub(crate) const WRITERS: [Writer; 11] = [
    Writer {
        words: "simulate tensor --preset fig5a --t-end 5 --dt-out 1 --transient 0 --no-animation",
        options: FORCE,
    },
    Writer {
        words: "simulate tensor --preset fig5a --t-end 5 --dt-out 1 --format csv --no-figures",
        options: FORCE,
    },
    Writer {
        words: "scan tensor --preset fig1 --axis kappa2=0.1:0.2:3 --samples 1 --budget 300 --threads 1",
        options: BOTH,
    },
    Writer { words: "merge s1 s2", options: FORCE },
    Writer {
        words: "continue tensor --preset fig5a --along kappa2=0.85:0.95 --branches 1 --points 5",
        options: BOTH,
    },
    Writer {
        words: "continue tensor --preset fig4 --set kappa2=0.5 --set kappa3=0.5 --along kappa2=0.4:0.6 --branches 1 --points 5 \
                --curve hopf --in kappa2=0.4:0.6,kappa3=0.4:0.6",
        options: BOTH,
    },
    Writer {
        words: "lifetimes tensor --preset fig5b --along kappa2=0.4:0.5:3 --samples 2 --until 50",
        options: BOTH,
    },
    Writer {
        words: "statistics tensor --bodies 3 --noise 0.01 --t-end 100 --transient 0 --dt-out 1",
        options: BOTH,
    },
    Writer { words: "observe cells.csv --no-report", options: FORCE },
    Writer {
        words: "fit cells.csv --interval 1 --pixel-size 1 --no-report --simulations 0 --draws 1",
        options: BOTH,
    },
    Writer { words: "reproduce fig2 --quick", options: &[""] },
];

/// Commands that write nothing, or, as `figure`, only into folders that are there.
const OTHERS: [&str; 11] = [
    "verify",
    "models",
    "classify",
    "lyapunov",
    "equilibria",
    "section",
    "explore",
    "check",
    "figure",
    "completions",
    "help",
];

/// The words of a file that is there before and after: all are the user's.
const MINE: &str = "mine\n";

impl Writer {
    fn command(&self) -> &str {
        self.words.split(' ').next().unwrap()
    }

    /// Runs it; what it reads is there.
    fn run(&self, folder: &Folder, more: &str) -> Done {
        folder.run(&format!("{} {more}", self.words))
    }

    /// A folder with its inputs.
    fn place(&self) -> Folder {
        let folder = Folder::new();
        self.prepare(&folder);
        folder
    }

    fn prepare(&self, folder: &Folder) {
        if self.words.contains("cells.csv") {
            folder.write("cells.csv", &crate::fits::outlines(1));
        }
        if self.command() == "merge" {
            for shard in 1..=2 {
                let scan = WRITERS[2].words;
                folder.run(&format!("{scan} --no-figures --shard {shard}/2 --out s{shard}"));
            }
        }
    }
}

/// Refused in words, before anything is computed; warnings may come before.
fn refused(done: Done) {
    let done = done.expect(2);
    assert!(done.stderr.contains("error: ") && !done.stderr.contains("panicked"), "{}", done.stderr);
    assert_eq!(done.stdout, "");
}

/// Everything below a folder: the contents of files, where links lead, and modes.
pub(crate) fn tree(folder: &Path) -> BTreeMap<PathBuf, (u32, Vec<u8>)> {
    let mut found = BTreeMap::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(&next).unwrap() {
            let path = entry.unwrap().path();
            let there = path.symlink_metadata().unwrap();
            let bytes = if there.is_symlink() {
                path.read_link().unwrap().into_os_string().into_encoded_bytes()
            } else if there.is_file() {
                fs::read(&path).unwrap()
            } else {
                Vec::new()
            };
            if there.is_dir() {
                open.push(path.clone());
            }
            found.insert(path.strip_prefix(folder).unwrap().to_owned(), (there.permissions().mode(), bytes));
        }
    }
    found
}

/// Puts things of others into a folder; their tree.
pub(crate) fn litter(folder: &Path) -> BTreeMap<PathBuf, (u32, Vec<u8>)> {
    let outside = folder.parent().unwrap().join("outside");
    fs::create_dir_all(&outside).unwrap();
    fs::write(outside.join("thesis.txt"), MINE).unwrap();
    let before = tree(folder);
    fs::create_dir_all(folder.join("plots/deep")).unwrap();
    fs::create_dir_all(folder.join("_cells")).unwrap();
    for name in [
        "notes.md",
        "plots/deep/x.png",
        ".hidden",
        "part-99999.parquet",
        "mine.svg",
        "_cells/mine.txt",
        "b\u{e9}.txt",
    ] {
        fs::write(folder.join(name), MINE).unwrap();
    }
    fs::set_permissions(folder.join("notes.md"), fs::Permissions::from_mode(0o400)).unwrap();
    symlink("../outside", folder.join("link")).unwrap();
    symlink("../outside/thesis.txt", folder.join("link.csv")).unwrap();
    symlink("nowhere", folder.join("dangling")).unwrap();
    let mut mine = tree(folder);
    mine.retain(|name, _| !before.contains_key(name));
    mine
}

/// That everything of others is as it was.
pub(crate) fn is_kept(folder: &Path, mine: &BTreeMap<PathBuf, (u32, Vec<u8>)>, after: &str) {
    let now = tree(folder);
    for (name, there) in mine {
        assert!(now.get(name) == Some(there), "{} after {after}: {:?}", name.display(), now.keys());
    }
    assert_eq!(
        fs::read_to_string(folder.parent().unwrap().join("outside/thesis.txt")).unwrap(),
        MINE,
        "{after}"
    );
}

/// Every command has its place in this test: one that has an option for its output is a writer.
#[test]
fn every_command_of_the_program_is_tried() {
    let folder = Folder::new();
    let help = folder.run("--help").expect(0).stdout;
    let commands = help.split("Commands:").nth(1).unwrap().split("\n\n").next().unwrap();
    let names = commands.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names: Vec<&str> = names.map(|line| line.split_whitespace().next().unwrap()).collect();
    assert!(names.len() > 15, "{names:?}");
    for name in names {
        let writer = WRITERS.iter().any(|writer| writer.command() == name);
        let other = OTHERS.contains(&name);
        assert!(writer != other, "{name}: give it a place in WRITERS or OTHERS");
        if name == "help" {
            continue;
        }
        let help = folder.run(&format!("{name} --help")).expect(0).stdout;
        let has = |option: &str| help.lines().any(|line| line.trim_start().starts_with(option));
        assert_eq!(has("--out <"), writer, "{name} --out");
        for option in ["--force", "--resume"].into_iter().filter(|_| writer) {
            let tried = WRITERS.iter().any(|it| it.command() == name && it.options.contains(&option));
            assert_eq!(has(option), tried, "{name} {option}");
        }
    }
}

/// Things of others in a result stay, whatever the options; edited figures too, and edited data.
#[test]
fn things_of_others_in_a_result_stay() {
    for writer in &WRITERS {
        let folder = writer.place();
        writer.run(&folder, "--out z");
        let z = folder.path("z");
        let mine = litter(&z);
        for option in
            writer.options.iter().chain(["--force --resume"].iter().filter(|_| writer.options == BOTH))
        {
            let done = writer.run(&folder, &format!("--out z {option}"));
            assert!(!done.stderr.contains("panicked"), "{}", done.stderr);
            is_kept(&z, &mine, &format!("{} {option}", writer.words));
            if done.code != Some(2) {
                assert!(
                    done.stderr.contains("notes.md"),
                    "it is named: {} {option}: {}",
                    writer.words,
                    done.stderr
                );
            }
        }
        for name in tree(&z)
            .into_keys()
            .filter(|name| !mine.contains_key(name) && !name.ends_with("_inventory.jsonl"))
        {
            fs::write(
                z.join(&name),
                [fs::read(z.join(&name)).unwrap_or_default(), b"mine".to_vec()].concat(),
            )
            .unwrap_or(());
        }
        let edited: Vec<Vec<u8>> =
            tree(&z).into_values().map(|it| it.1).filter(|it| it.ends_with(b"mine")).collect();
        for option in writer.options {
            writer.run(&folder, &format!("--out z {option}"));
            is_kept(&z, &mine, writer.words);
            let now: Vec<Vec<u8>> = tree(&z).into_values().map(|it| it.1).collect();
            for (place, bytes) in edited.iter().enumerate() {
                assert!(now.contains(bytes), "{place} of {}: edited, gone after {option}", writer.words);
            }
        }
    }
}

/// A folder without an inventory stays as it is, whatever names are in it.
#[test]
fn folders_of_others_stay() {
    for writer in &WRITERS {
        let folder = writer.place();
        let z = folder.path("z");
        fs::create_dir(&z).unwrap();
        litter(&z);
        for name in [
            "manifest.json",
            "_manifest.json",
            "_fit.json",
            "statistics.json",
            "lifetimes.json",
            "orbits.json",
            "branches.json",
            "curves.json",
            "summary.json",
            "modes.parquet",
            "report.html",
            "figure-1.1.svg",
            "path.svg",
        ] {
            fs::write(z.join(name), "{}").unwrap();
        }
        let before = tree(&z);
        for option in writer.options {
            let done = writer.run(&folder, &format!("--out z {option}"));
            assert!(tree(&z) == before, "{} {option}: {}", writer.words, done.stderr);
            refused(done);
        }
    }
}

/// A result of another command stays.
#[test]
fn results_of_other_commands_stay() {
    let folder = Folder::new();
    WRITERS.iter().for_each(|writer| writer.prepare(&folder));
    let place = |number: usize| format!("r{number}");
    for (number, writer) in WRITERS.iter().enumerate() {
        writer.run(&folder, &format!("--out {}", place(number)));
    }
    let kind = |number: usize| {
        let inventory = fs::read_to_string(folder.path(&place(number)).join("_inventory.jsonl")).unwrap();
        serde_json::from_str::<serde_json::Value>(inventory.lines().next().unwrap()).unwrap()["kind"].clone()
    };
    for number in 0..WRITERS.len() {
        let z = folder.path(&place(number));
        let before = tree(&z);
        for (other, writer) in WRITERS.iter().enumerate().filter(|(other, _)| kind(*other) != kind(number)) {
            for option in writer.options {
                let done = writer.run(&folder, &format!("--out {} {option}", place(number)));
                assert!(tree(&z) == before, "{} over {other}: {}", writer.words, done.stderr);
                refused(done);
            }
        }
    }
}

/// Outputs of every shape: links are followed, folders above are made, files of others stay.
#[test]
fn outputs_of_every_shape() {
    for writer in &WRITERS {
        let folder = writer.place();
        fs::create_dir_all(folder.path("disk/free")).unwrap();
        symlink("disk/run", folder.path("link")).unwrap();
        for shape in ["a/b/c", "./d/", "link", "e/.", "f/../g"] {
            if shape == "f/../g" {
                fs::create_dir(folder.path("f")).unwrap();
            }
            writer.run(&folder, &format!("--out {shape}"));
            let there = folder.path(shape.trim_end_matches('.')).join("_inventory.jsonl");
            assert!(there.is_file(), "{} {shape}", writer.words);
            for option in writer.options {
                writer.run(&folder, &format!("--out {shape} {option}"));
                assert!(there.is_file(), "{} {shape} {option}", writer.words);
            }
        }
        assert!(folder.path("link").symlink_metadata().unwrap().is_symlink());
        assert!(folder.path("disk/run/_inventory.jsonl").is_file());
        for name in ["file", "notes.txt", "data.dat"] {
            folder.write(name, MINE);
            for option in writer.options {
                let done = writer.run(&folder, &format!("--out {name} {option}"));
                assert_eq!(fs::read_to_string(folder.path(name)).unwrap(), MINE, "{} {option}", writer.words);
                refused(done);
            }
        }
        refused(writer.run(&folder, "--out run.txt"));
        assert!(!folder.path("run.txt").exists());
    }
}

/// Inputs are not outputs.
#[test]
fn inputs_stay() {
    let folder = Folder::new();
    folder.write("cells.csv", &crate::fits::outlines(1));
    folder.write("study.toml", "[model.tensor]\npreset = \"fig5a\"\n");
    folder.run(&format!("{} --out data", WRITERS[0].words)).expect(0);
    let before = tree(&folder.path("."));
    for words in [
        "observe cells.csv --outlines cells.csv --force",
        "observe cells.csv --out cells.csv --force",
        "fit cells.csv --out cells.csv --force --draws 1",
        "simulate study.toml --t-end 5 --out study.toml --force",
        "scan study.toml --axis kappa2=0.1:0.2:2 --out study.toml --force",
        "simulate tensor --t-end 5 --out cells.csv --force",
        "statistics data --out data --force",
    ] {
        refused(folder.run(words));
        assert!(tree(&folder.path(".")) == before, "{words}");
    }
}

/// Figures that others drew or edited are not drawn over; `--force` keeps the edited ones under another name.
#[test]
fn figures_of_others_stay() {
    for writer in [&WRITERS[0], &WRITERS[2], &WRITERS[4]] {
        let folder = writer.place();
        writer.run(&folder, "--out z");
        let z = folder.path("z");
        let mine = litter(&z);
        let figure = tree(&z)
            .into_keys()
            .find(|name| name.extension().is_some_and(|end| end == "svg") && !mine.contains_key(name));
        let figure = figure.unwrap();
        fs::write(z.join(&figure), MINE).unwrap();
        let done = folder.run("figure z").expect(1);
        assert!(done.stderr.contains("was edited"), "{}", done.stderr);
        assert_eq!(fs::read_to_string(z.join(&figure)).unwrap(), MINE);
        folder.run("figure z --force").expect(0);
        let aside = figure.with_extension("edited.svg");
        assert_eq!(fs::read_to_string(z.join(&aside)).unwrap(), MINE);
        is_kept(&z, &mine, "figure");
        folder.run("figure z").expect(0);
    }
}

/// Things with the names of unfinished output stay, and do not stop the program.
#[test]
fn what_only_looks_unfinished_stays() {
    let folder = Folder::new();
    fs::create_dir(folder.path(".z.0123456789abcdef.partial")).unwrap();
    folder.write(".z.0123456789abcdef.partial/thesis.txt", MINE);
    folder.write(".z.0123456789abcdee.partial", MINE);
    fs::create_dir(folder.path("z.replaced")).unwrap();
    folder.write("z.replaced/thesis.txt", MINE);
    let pipe = folder.path(".z.0123456789abcde0.partial");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let before = tree(&folder.path("."));
    for option in ["", "--force"] {
        WRITERS[0].run(&folder, &format!("--out z {option}")).expect(0);
    }
    WRITERS[2].run(&folder, "--out z2");
    let now = tree(&folder.path("."));
    assert!(before.iter().all(|(name, there)| now.get(name) == Some(there)));
}

/// Every n-th call that changes the file system fails, or is the last one: what is of others is there at once, and the next run works.
#[test]
fn things_of_others_survive_faults() {
    let every: usize = std::env::var("MOTIFORM_FAULTS").ok().and_then(|text| text.parse().ok()).unwrap_or(23);
    for (number, writer) in WRITERS.iter().enumerate() {
        if writer.command() == "reproduce" && every > 1 {
            continue; // three seconds for each call
        }
        let option = if writer.options.contains(&"--force") { "--force" } else { "" };
        let words = format!("{} --out z {option}", writer.words);
        for kind in ["error", "kill"] {
            for at in (1 + number % every..).step_by(every) {
                let folder = writer.place();
                writer.run(&folder, "--out z");
                let mine = litter(&folder.path("z"));
                let (done, struck) = struck(&folder, &words, kind, at);
                is_kept(&folder.path("z"), &mine, &format!("{kind} at {at} of {words}"));
                if !struck {
                    break;
                }
                assert!(!done.stderr.contains("panicked"), "{}", done.stderr);
                let again = folder.run(&words);
                assert!(matches!(again.code, Some(0 | 1)), "{kind} at {at} of {words}: {}", again.stderr);
                is_kept(&folder.path("z"), &mine, &format!("{kind} at {at} of {words}, then again"));
                is_tidy(&folder, &words);
            }
        }
    }
}

/// Only what was made and not yet locked may stay, for a minute.
fn is_tidy(folder: &Folder, words: &str) {
    let left: Vec<String> =
        folder.names().into_iter().filter(|name| name.contains("z.") && !name.ends_with(".new")).collect();
    assert!(left.is_empty(), "{left:?} after {words}");
}

/// All writing commands, killed at random moments.
#[test]
fn things_of_others_survive_kills() {
    let mut random = Random(7);
    let writers: Vec<&Writer> = WRITERS.iter().filter(|it| it.options.len() > 1).collect();
    let rounds = (kills() / (2 * writers.len())).max(2);
    let mut killed = 0;
    for writer in writers {
        let folder = writer.place();
        writer.run(&folder, "--out z");
        let begun = Instant::now();
        writer.run(&folder, "--out z --force");
        let time: Duration = begun.elapsed();
        let mine = litter(&folder.path("z"));
        for round in 0..rounds {
            let option = if round % 3 == 1 { writer.options.last().unwrap() } else { &"--force" };
            let words = format!("{} --out z {option}", writer.words);
            killed += usize::from(kill(&folder, &words, time, &mut random));
            is_kept(&folder.path("z"), &mine, &words);
        }
        let words = format!("{} --out z --force", writer.words);
        let done = folder.run(&words);
        assert!(matches!(done.code, Some(0 | 1)), "{words}: {}", done.stderr);
        is_kept(&folder.path("z"), &mine, &words);
        is_tidy(&folder, &words);
    }
    println!("{killed} were still running");
}
