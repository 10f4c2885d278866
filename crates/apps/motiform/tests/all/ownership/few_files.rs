//! Processes that may open few files (`ulimit -n`): what they cannot read is not taken for changed or damaged, and the next run works.

use super::interrupted::{is_tidy, is_whole};
use super::{WRITERS, Writer, is_kept, litter, tree};
use crate::faults::every;

/// With one less the program is not loaded.
const FEWEST: usize = 4;

/// With so many every command works.
const ENOUGH: usize = 14;

/// One limit of each command and option in every push, all of them with `MOTIFORM_FAULTS=1`.
#[test]
fn want_of_open_files_is_among_the_faults() {
    let all = every() == 1;
    let cases = WRITERS.iter().flat_map(|writer| writer.options.iter().map(move |option| (writer, *option)));
    let cases = cases.filter(|(writer, _)| all || !["fit", "reproduce"].contains(&writer.command())); // seconds each
    for (number, (writer, option)) in cases.enumerate() {
        for files in FEWEST..=ENOUGH {
            if all || files == FEWEST + number % 6 {
                with_few_files(writer, option, files);
            }
        }
    }
}

fn with_few_files(writer: &Writer, option: &str, files: usize) {
    let words = format!("{} --out z {option}", writer.words);
    let (folder, shown) = (writer.place(), format!("{words}, {files} open files"));
    let run = || folder.bash(&format!("ulimit -n {files}; exec $motiform {words}"));
    if option.is_empty() {
        let before = folder.names();
        let done = run();
        assert!(folder.path("z").exists() || folder.names() == before, "{shown}: {}", done.stderr);
        return;
    }
    writer.run(&folder, "--out z");
    let clean = tree(&folder.path("z"));
    let mine = litter(&folder.path("z"));
    let done = run();
    is_kept(&folder.path("z"), &mine, &shown);
    for wrong in ["was changed", "_damaged", "writable", "panicked"] {
        assert!(!done.stderr.contains(wrong), "{shown}: {}", done.stderr);
    }
    let again = folder.run(&words);
    assert!(matches!(again.code, Some(0 | 1)), "{shown}: {}", again.stderr);
    is_tidy(&folder, &shown);
    is_whole(&folder, &clean, &mine, &shown);
}
