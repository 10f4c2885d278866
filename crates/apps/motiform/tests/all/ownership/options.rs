//! Files that every option leaves alone.

use super::{BOTH, OTHERS, WRITERS, is_kept, litter, refused, tree};
use crate::common::Folder;
use std::fs;

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
            "figure-1.svg",
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
