//! The table of docs/records/invariances.md.

use super::Case;
use super::judge::Judged;
use std::collections::BTreeMap;
use std::fmt::Write;

/// All comparisons, counted by what was changed and by what moves, and each one that is not the same.
pub(crate) fn report(cases: &[Case]) -> String {
    let mut counts: BTreeMap<(&str, &str), [usize; 3]> = BTreeMap::new();
    let place = |judged: &Judged| match judged {
        Judged::Same => 0,
        Judged::Undecided => 1,
        Judged::Contradiction(_) => 2,
    };
    let mut all = [0; 3];
    for case in cases {
        counts.entry((case.change, case.kind)).or_default()[place(&case.judged)] += 1;
        all[place(&case.judged)] += 1;
    }
    let mut text = String::from(
        "# What answers do not depend on\n\nEach motion is asked for twice: as it is, and after a change that cannot \
         matter. The names must be the same and the numbers within their\nstated errors. `cargo xtask invariances` \
         computes this page; a sample runs in every push. The motions: the tensor model at 22 places of\nits two \
         planes, the cell at 16 lengths, 28 systems of random equations with 2 to 8 modes.\n\n| change | what moves | \
         same | undecided | contradictions |\n| --- | --- | ---: | ---: | ---: |\n",
    );
    for ((change, kind), [same, undecided, wrong]) in counts {
        let _ = writeln!(text, "| {change} | {kind} | {same} | {undecided} | {wrong} |");
    }
    let total: usize = all.iter().sum();
    let _ = writeln!(text, "| all | | {} | {} | {} |\n", all[0], all[1], all[2]);
    let _ = writeln!(text, "Motions among them: {}.\n", names(cases));
    let share = 100.0 * all[1] as f64 / total.max(1) as f64;
    let differ: Vec<&Case> = cases.iter().filter(|case| case.judged != Judged::Same).collect();
    let end = if differ.is_empty() { "All are the same." } else { "Not the same:\n" };
    let _ = writeln!(text, "{total} comparisons, {share:.1} % undecided. {end}");
    for case in differ {
        let _ = writeln!(text, "* {}, {}: {}", case.subject, case.change, case.judged);
    }
    text
}

/// Number of times that each name was given to a subject.
fn names(cases: &[Case]) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for case in cases.iter().filter(|case| case.change == super::FIRST) {
        *counts.entry(case.regime.as_str()).or_default() += 1;
    }
    let list: Vec<String> = counts.iter().map(|(name, count)| format!("{name} {count}")).collect();
    list.join(", ")
}
