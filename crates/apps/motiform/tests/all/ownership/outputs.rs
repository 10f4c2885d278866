//! Outputs of every shape, inputs, and edited figures.

use super::{MINE, WRITERS, is_kept, litter, refused, tree};
use crate::common::Folder;
use crate::faults::every;
use std::fs;
use std::os::unix::fs::symlink;

/// Shapes of outputs beside a link.
const SHAPES: [&str; 4] = ["a/b/c", "./d/", "e/.", "f/../g"];

/// Outputs of every shape: links are followed, folders above are made, files of others stay. In a push each command has one shape and a
/// link; all of them with `MOTIFORM_FAULTS=1`.
#[test]
fn outputs_of_every_shape() {
    for (place, writer) in WRITERS.iter().enumerate() {
        let folder = writer.place();
        fs::create_dir_all(folder.path("disk/free")).unwrap();
        symlink("disk/run", folder.path("link")).unwrap();
        let own = if every() == 1 { &SHAPES[..] } else { &SHAPES[place % SHAPES.len()..][..1] };
        for (number, shape) in std::iter::once("link").chain(own.iter().copied()).enumerate() {
            if shape == "f/../g" {
                fs::create_dir(folder.path("f")).unwrap();
            }
            writer.run(&folder, &format!("--out {shape}"));
            let there = folder.path(shape.trim_end_matches('.')).join("_inventory.jsonl");
            assert!(there.is_file(), "{} {shape}", writer.words);
            let option = writer.options[(place + number) % writer.options.len()]; // each with some shape
            writer.run(&folder, &format!("--out {shape} {option}"));
            assert!(there.is_file(), "{} {shape} {option}", writer.words);
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
        "observe cells.csv --write-outlines cells.csv --force",
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
        let name = figure.display().to_string();
        assert!(!done.stdout.split_whitespace().any(|word| word == name), "{}", done.stdout);
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
