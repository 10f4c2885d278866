//! Standard output that is closed (`>&-`) is an error before anything is computed; one that leads nowhere is what was asked for.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(unix)]

use crate::common;

use common::Folder;
use std::process::Stdio;

const COMMANDS: [&str; 6] = [
    "--version",
    "models",
    "classify tensor --preset fig5a --json",
    "simulate tensor --t-end 1 --no-animation --out run",
    "scan tensor --axis kappa2=0.7:1.6:3 --out scan",
    "completions bash",
];

#[test]
fn closed_output_is_refused() {
    let folder = Folder::new();
    for words in COMMANDS {
        for others in ["", "<&-"] {
            let done = folder.bash(&format!("$motiform {words} {others} >&-"));
            done.expect_error(2).stderr.find("standard output is closed").expect(words);
        }
        // nobody can be told, but the exit code says it
        folder.bash(&format!("$motiform {words} >&- 2>&-")).expect(2);
    }
    assert_eq!(folder.names(), [""; 0]);
}

#[test]
fn output_that_leads_nowhere_is_accepted() {
    let folder = Folder::new();
    for words in ["--version", "models", "simulate tensor --t-end 1 --json"] {
        folder.bash(&format!("$motiform {words} > /dev/null")).expect(0);
        folder.bash(&format!("$motiform {words} <> /dev/null >&0")).expect(0);
        folder.bash(&format!("$motiform {words} <&- 2>&-")).expect(0);
        let mut command = folder.command(words);
        assert_eq!(command.stdout(Stdio::null()).status().unwrap().code(), Some(0), "{words}");
    }
}
