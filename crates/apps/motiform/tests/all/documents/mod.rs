//! The documents, carried out: every command of every page runs as it is printed, every picture is what the commands of its page write,
//! every link leads somewhere.
//!
//! A page is a session in a folder of its own, in which `examples/` is that of the repository. A block of TOML below a line that ends with
//! `` `NAME.toml`: `` becomes that file. A command whose comment ends with a time (`# ..., 40 s`) is slow: `cargo xtask documents` runs
//! it, each push does not. A picture with a title, `![what](images/zigzag.png "zigzag/path.png")`, is the file of that name which the
//! commands of the page write; `cargo xtask pictures` renews it.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]
#![cfg(unix)]

mod links;
mod page;
mod pictures;
mod session;

use page::Page;
use session::Session;
use std::path::PathBuf;
use std::sync::Mutex;

/// The checkout.
fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../..").canonicalize().unwrap()
}

/// `true` if slow commands run, too.
fn all() -> bool {
    std::env::var_os("MOTIFORM_DOCUMENTS").is_some()
}

/// Pages that are left, the longest first; two are carried out at a time.
fn carry_out(pages: &[Page]) -> Vec<String> {
    let (left, faults) = (Mutex::new(pages.iter()), Mutex::new(Vec::new()));
    let next = || left.lock().unwrap().next();
    let work = || {
        while let Some(page) = next() {
            let session = Session::run(page, all());
            let mut found = session.faults.clone();
            found.extend(pictures::compare(page, &session));
            faults.lock().unwrap().extend(found.into_iter().map(|fault| format!("{}: {fault}", page.name)));
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(work);
        scope.spawn(work);
    });
    faults.into_inner().unwrap()
}

#[test]
fn the_commands_of_the_documents_run() {
    let mut pages = page::all();
    pages.sort_by_key(|page| std::cmp::Reverse(page.commands(all()).count()));
    assert!(pages.iter().map(|page| page.commands(false).count()).sum::<usize>() > 60);
    let faults = carry_out(&pages);
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
}

/// A sample that no page uses is not tried by anybody.
#[test]
fn every_example_is_used_by_a_command() {
    let pages = page::all();
    let commands: Vec<&str> =
        pages.iter().flat_map(|page| page.commands(true)).map(|one| one.text.as_str()).collect();
    for entry in std::fs::read_dir(root().join("examples")).unwrap() {
        let name = format!("examples/{}", entry.unwrap().file_name().to_string_lossy());
        let used = name.ends_with("README.md") || commands.iter().any(|command| command.contains(&name));
        assert!(used, "{name} is in no command of the documents");
    }
}
