//! Files that motiform did not write stay, under every option of every command that writes. The commands are those of the program's own
//! list: a new one must be given its place here.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(target_os = "linux")]

mod faulty;
mod few_files;
mod interrupted;
mod options;
mod outputs;

use crate::common::{Done, Folder};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};

/// A command that writes a folder, without `--out`.
pub(crate) struct Writer {
    words: &'static str,
    /// Its options for a folder that exists.
    options: &'static [&'static str],
}

const BOTH: &[&str] = &["", "--force", "--resume"];
const FORCE: &[&str] = &["", "--force"];

/// Short runs of every command that writes a folder; the first word is the command.
pub(crate) const WRITERS: [Writer; 13] = [
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
        words: "atlas tensor --preset fig1 --axis kappa2=0.02:0.06:5 --axis gamma=0.02:0.1:5 --samples 2 --budget 300 \
         --lines 1 --branches 2 --threads 1",
        options: BOTH,
    },
    Writer {
        words: "lifetimes tensor --preset fig5b --axis kappa2=0.4:0.5:3 --samples 2 --until 50",
        options: BOTH,
    },
    Writer {
        words: "statistics tensor --bodies 3 --noise 0.01 --t-end 100 --transient 0 --dt-out 1",
        options: BOTH,
    },
    Writer { words: "observe cells.csv --no-report", options: FORCE },
    Writer {
        words: "fit cells.csv --interval 1 --pixel-size 1 --modes 2 --no-report --simulations 0 --draws 1",
        options: BOTH,
    },
    Writer { words: "reproduce fig3 --quick", options: &[""] },
    Writer { words: "figure drawn --width 86mm --no-animation", options: FORCE },
];

/// Commands that write nothing, or, as `new`, only a file that was not there.
const OTHERS: [&str; 12] = [
    "new",
    "doctor",
    "verify",
    "models",
    "classify",
    "lyapunov",
    "equilibria",
    "section",
    "explore",
    "check",
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
        if self.command() == "figure" {
            folder.run(&format!("{} --out drawn", WRITERS[0].words));
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

/// Everything below a folder: modes, and the contents of files or where links lead.
pub(crate) type Tree = BTreeMap<PathBuf, (u32, Vec<u8>)>;

pub(crate) fn tree(folder: &Path) -> Tree {
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
pub(crate) fn litter(folder: &Path) -> Tree {
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
pub(crate) fn is_kept(folder: &Path, mine: &Tree, after: &str) {
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
