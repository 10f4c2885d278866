//! Answers do not depend on what cannot matter.
//!
//! A motion is asked for twice: as it is, and after a change that leaves the motion itself as it was (the seed, the tolerance, the
//! number of modes, a rotation, a reflection, units, silent modes, equations as text, another command). The names must be the same, and
//! the numbers within their stated errors. Every push runs a sample; `cargo xtask invariances` runs all and writes
//! docs/records/invariances.md.

mod atlas;
mod branches;
mod changes;
mod commands;
mod judge;
mod report;
mod request;
mod subjects;
mod texts;

use changes::changes;
use judge::{Judged, judge};
use report::report;
use request::{Answer, Request};
use std::sync::atomic::{AtomicUsize, Ordering};
use subjects::{Subject, subjects};

/// Subjects in every push. All of them with `MOTIFORM_INVARIANCES=1`, those whose name begins with its value otherwise.
const SAMPLE: usize = 5;

/// Motions that are asked for at a time. (The threads wait for the program.)
const WORKERS: usize = 8;

/// One comparison.
pub(crate) struct Case {
    pub(crate) subject: String,
    pub(crate) kind: &'static str,
    pub(crate) change: &'static str,
    /// The name of the subject's motion.
    pub(crate) regime: String,
    pub(crate) judged: Judged,
}

/// The first comparison of each subject.
const FIRST: &str = "a start on the motion";

fn all() -> bool {
    std::env::var("MOTIFORM_INVARIANCES").is_ok_and(|count| count != "0")
}

/// Keeps the study files of a contradiction, and the commands, in the folder for temporary files of the target folder.
fn keep(folder: &crate::common::Folder, subject: &str, requests: [&Request; 3]) {
    let to = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("invariances")
        .join(subject.replace([' ', ','], "-"));
    std::fs::create_dir_all(&to).expect("the folder is writable");
    for name in folder.names().iter().filter(|name| name.ends_with(".toml")) {
        std::fs::copy(folder.path(name), to.join(name)).expect("it can be copied");
    }
    let lines = requests.map(|request| format!("motiform classify {}", request.words()));
    std::fs::write(to.join("commands.txt"), lines.join("\n")).expect("the folder is writable");
}

/// All comparisons of one subject.
fn compare(subject: &Subject) -> Vec<Case> {
    let folder = crate::common::Folder::new();
    let request = Request::of(&folder, subject);
    let kind = subject.kind();
    let first = request.classify(&folder);
    let regime = first.regime().to_owned();
    let case =
        |change, judged| Case { subject: subject.name.clone(), kind, change, regime: regime.clone(), judged };
    let Some(settled) = request.settled(&folder) else {
        return vec![case(FIRST, judge(&first, &first, &request, &request))];
    };
    let base = settled.classify(&folder);
    let mut cases = vec![case(FIRST, judge(&first, &base, &request, &settled))];
    let few = if all() { usize::MAX } else { 3 };
    // a body that turns on turns against a mode that does not: its shape then changes, and the motion is another one
    let turns = ["circular", "quasi-periodic"].contains(&regime.as_str());
    let mut changed = changes(&folder, subject, &settled);
    changed.retain(|(change, _)| !(turns && *change == changes::FREE_PHASE));
    let step = changed.len().div_ceil(few.min(changed.len()).max(1));
    for (change, other) in changed.into_iter().step_by(step) {
        let judged = judge(&base, &other.classify(&folder), &settled, &other);
        if matches!(judged, Judged::Contradiction(_)) {
            keep(&folder, &subject.name, [&request, &settled, &other]);
        }
        cases.push(case(change, judged));
    }
    for (change, judged) in commands::compare(&folder, &settled, &base) {
        cases.push(case(change, judged));
    }
    cases
}

#[test]
fn answers_do_not_depend_on_what_cannot_matter() {
    let mut list = subjects();
    let given = std::env::var("MOTIFORM_INVARIANCES").unwrap_or_default();
    let named = list.iter().any(|subject| subject.name.starts_with(&given)) && !given.is_empty();
    if named {
        list.retain(|subject| subject.name.starts_with(&given));
    } else if !all() {
        let step = list.len().div_ceil(SAMPLE);
        list = list.into_iter().step_by(step).collect();
    }
    let next = AtomicUsize::new(0);
    let work = || {
        let mut cases = Vec::new();
        while let Some(subject) = list.get(next.fetch_add(1, Ordering::Relaxed)) {
            let found = compare(subject);
            for case in &found {
                println!("{:<34} {:<26} {}", case.subject, case.change, case.judged);
            }
            cases.extend(found);
        }
        cases
    };
    let cases: Vec<Case> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..WORKERS).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().expect("no comparison panics")).collect()
    });
    let text = report(&cases);
    println!("{text}");
    if all() && !named {
        std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../docs/records/invariances.md"), &text)
            .expect("it is writable");
    }
    let wrong = cases.iter().filter(|case| matches!(case.judged, Judged::Contradiction(_))).count();
    let undecided = cases.iter().filter(|case| case.judged == Judged::Undecided).count();
    assert_eq!(wrong, 0, "{text}");
    assert!(undecided as f64 <= (0.03 * cases.len() as f64).max(1.0), "{undecided} of {}", cases.len());
}

/// The judge itself: answers that differ are seen.
#[test]
fn a_different_name_or_number_is_a_contradiction() {
    let answer = |text: &str| Answer(serde_json::from_str(text).expect("it is JSON"));
    let one = |text: &str| {
        let base = answer(
            r#"{"regime":"zigzag","attractor":"periodic","speed":{"mean":0.9,"min":0.8,"max":1.0},
            "period":45.0,"exponents":[{"value":-0.1,"error":1e-6}]}"#,
        );
        judge::same(&base, &answer(text), 1.0, 1.0)
    };
    assert_eq!(one(r#"{"regime":"zigzag","attractor":"periodic","period":45.0000000001}"#), Judged::Same);
    assert_eq!(one(r#"{"regime":"undetermined"}"#), Judged::Undecided);
    for wrong in [
        r#"{"regime":"circular"}"#,
        r#"{"regime":"zigzag","attractor":"periodic","period":45.1}"#,
        r#"{"regime":"zigzag","attractor":"periodic","speed":{"mean":0.91,"min":0.8,"max":1.0}}"#,
        r#"{"regime":"zigzag","attractor":"periodic","exponents":[{"value":-0.11,"error":1e-6}]}"#,
    ] {
        assert!(matches!(one(wrong), Judged::Contradiction(_)), "{wrong}");
    }
}
