//! Kills at random moments.

use super::{Tree, WRITERS, Writer, is_kept, litter, tree};
use crate::common::Folder;
use crate::kills::{Random, kill, kills};
use std::time::{Duration, Instant};

/// Only what was made and not yet locked may stay, for a minute.
pub(super) fn is_tidy(folder: &Folder, words: &str) {
    let left: Vec<String> =
        folder.names().into_iter().filter(|name| name.contains("z.") && !name.ends_with(".new")).collect();
    assert!(left.is_empty(), "{left:?} after {words}");
}

/// The result has the bytes of one that nobody disturbed, and beside what is of others nothing else is there.
pub(super) fn is_whole(folder: &Folder, clean: &Tree, mine: &Tree, words: &str) {
    let mut now = tree(&folder.path("z"));
    now.retain(|name, _| !mine.contains_key(name));
    let names = |tree: &Tree| tree.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&now), names(clean), "{words}");
    for (name, there) in clean {
        let text =
            |tree: &Tree| String::from_utf8_lossy(&tree[name].1).chars().take(2000).collect::<String>();
        let shown = || format!("{}\nbefore {}", text(&now), text(clean));
        assert!(now[name].1 == there.1, "{} is another after {words}: {}", name.display(), shown());
    }
}

/// All writing commands, killed at random moments.
#[test]
fn things_of_others_survive_kills() {
    let mut random = Random(7);
    let writers: Vec<&Writer> = WRITERS.iter().filter(|it| it.options.len() > 1).collect();
    let rounds = kills().div_ceil(writers.len());
    let mut killed = 0;
    for writer in writers {
        let folder = writer.place();
        writer.run(&folder, "--out z");
        let clean = tree(&folder.path("z"));
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
        is_whole(&folder, &clean, &mine, &words);
    }
    println!("{killed} were still running");
}
