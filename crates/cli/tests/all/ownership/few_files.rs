//! Processes that may open few files (`ulimit -n`): what they cannot read is not taken for changed or damaged, and the next run works.

use super::interrupted::{is_tidy, is_whole};
use super::{WRITERS, is_kept, litter, tree};
use crate::faults::every;

/// With one less the program is not loaded.
const FEWEST: usize = 4;

/// With so many every command works.
const ENOUGH: usize = 14;

#[test]
fn what_cannot_be_read_for_want_of_open_files_is_not_changed() {
    let step = every().min(5);
    for (number, writer) in WRITERS.iter().enumerate().filter(|(_, writer)| writer.command() != "reproduce") {
        for option in writer.options {
            for files in (FEWEST + number % step..=ENOUGH).step_by(step) {
                let words = format!("{} --out z {option}", writer.words);
                let (folder, shown) = (writer.place(), format!("{words}, {files} open files"));
                let before = folder.names();
                if option.is_empty() {
                    let done = folder.bash(&format!("ulimit -n {files}; exec $motiform {words}"));
                    assert!(
                        folder.path("z").exists() || folder.names() == before,
                        "{shown}: {}",
                        done.stderr
                    );
                    continue;
                }
                writer.run(&folder, "--out z");
                let clean = tree(&folder.path("z"));
                let mine = litter(&folder.path("z"));
                let done = folder.bash(&format!("ulimit -n {files}; exec $motiform {words}"));
                is_kept(&folder.path("z"), &mine, &shown);
                for wrong in ["was changed", "_damaged", "writable", "panicked"] {
                    assert!(!done.stderr.contains(wrong), "{shown}: {}", done.stderr);
                }
                let again = folder.run(&words);
                assert!(matches!(again.code, Some(0 | 1)), "{shown}: {}", again.stderr);
                is_tidy(&folder, &shown);
                is_whole(&folder, &clean, &mine, &shown);
            }
        }
    }
}
