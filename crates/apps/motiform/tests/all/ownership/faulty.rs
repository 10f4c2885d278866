//! Every call that changes the file system fails, or is one before which the process ends.
//!
//! One run of a command gives what a kill before any of its calls leaves: the shim copies the folder there. What the next run does
//! depends on nothing but these files, so it is tried once for each state; states that differ in random numbers alone are one. The same
//! holds for what failing calls leave.

use super::interrupted::{is_tidy, is_whole};
use super::{BOTH, Tree, WRITERS, Writer, is_kept, litter, tree};
use crate::common::Folder;
use crate::faults::{every, faulty, struck};
use std::collections::hash_map::DefaultHasher;
use std::collections::{BTreeMap, BTreeSet};
use std::hash::{Hash, Hasher};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A command and the folder that it is run in.
struct Case<'w> {
    words: &'static str,
    option: &'static str,
    /// The options of the runs that follow.
    then: &'static [&'static str],
    before: Folder,
    /// The result of a run that nobody disturbed.
    clean: &'w Tree,
    mine: Tree,
    /// States that were tried.
    seen: Mutex<BTreeSet<u64>>,
    failed: &'w Failed,
}

/// List of failures: one failure does not end the others.
#[derive(Default)]
struct Failed(Mutex<Vec<String>>);

impl Failed {
    fn unless(&self, what: &str, check: impl FnOnce()) {
        if catch_unwind(AssertUnwindSafe(check)).is_err() {
            self.0.lock().unwrap().push(what.to_owned());
        }
    }
}

/// The outcome of a case.
#[derive(Default)]
struct Count {
    calls: usize,
    faults: usize,
    states: usize,
}

/// All calls with `MOTIFORM_FAULTS=1`, every 194th in a push: what is of others is there at once, and the next run works.
#[test]
fn things_of_others_survive_faults() {
    // Those that take seconds come first, and in a push `reproduce` not at all.
    let writers: Vec<&Writer> =
        WRITERS.iter().rev().filter(|writer| writer.command() != "reproduce" || every() == 1).collect();
    let failed = Failed::default();
    in_parallel(writers.len(), |number, cpu| {
        failed.unless(writers[number].words, || faults_of(writers[number], number, cpu, &failed));
    });
    let failed = failed.0.into_inner().unwrap();
    assert!(failed.is_empty(), "{} failures, after {failed:#?}", failed.len());
}

/// Into nothing, over a result with things of others in it, and on with work that is half done.
fn faults_of(writer: &Writer, number: usize, cpu: usize, failed: &Failed) {
    let whole = writer.place();
    writer.run(&whole, "--out z");
    let clean = tree(&whole.path("z"));
    let fresh = Case::new(writer, "", writer.place(), Tree::new(), &clean, failed);
    let half_done = fresh.try_all(number, cpu);
    let again = if writer.options.contains(&"--force") { "--force" } else { "" };
    let mine = litter(&whole.path("z"));
    Case::new(writer, again, whole, mine, &clean, failed).try_all(number, cpu);
    if let Some(half_done) = half_done.filter(|_| writer.options == BOTH) {
        let mine = litter(&half_done.path("z"));
        Case::new(writer, "--resume", half_done, mine, &clean, failed).try_all(number, cpu);
    }
}

impl<'w> Case<'w> {
    fn new(
        writer: &Writer,
        option: &'static str,
        before: Folder,
        mine: Tree,
        clean: &'w Tree,
        failed: &'w Failed,
    ) -> Self {
        let then: &[&'static str] =
            match (writer.options == BOTH, writer.options.contains(&"--force"), option) {
                (true, _, "--resume") => &["--resume"],
                (true, ..) => &["--resume", "--force"],
                (_, true, _) => &["--force"],
                _ => &[""],
            };
        Self { words: writer.words, option, then, before, clean, mine, seen: Mutex::default(), failed }
    }

    fn words(&self) -> String {
        format!("{} --out z {}", self.words, self.option)
    }

    /// Kills and failures at every n-th call; a state in the middle, from which the work can be resumed.
    fn try_all(&self, number: usize, cpu: usize) -> Option<Folder> {
        let step = if every() == 1 { 1 } else { 2 * every() };
        let first = 1 + number % step;
        let states = self.states(first, step, cpu);
        let mut count = Count { calls: *states.keys().last().unwrap_or(&0), ..Count::default() };
        for (at, state) in &states {
            let after = format!("a kill before call {at} of {}", self.words());
            self.failed.unless(&after, || self.goes_on(state, &after, &mut count));
        }
        for at in (first..).step_by(step) {
            let folder = copy(&self.before);
            let mut command = faulty(&folder, &self.words(), "error", at);
            command.env("FAULT_ALL", "1").env("FAULT_CPU", cpu.to_string());
            let (done, struck) = struck(command);
            if !struck {
                break;
            }
            count.calls = count.calls.max(at);
            let after = format!("an error of call {at} of {}", self.words());
            self.failed.unless(&after, || {
                assert!(!done.stderr.contains("panicked"), "{}", done.stderr);
                self.goes_on(&folder, &after, &mut count);
            });
        }
        println!("{}: {} calls, {} faults, {} states", self.words(), count.calls, count.faults, count.states);
        let of_work = |state: &&Folder| state.path("z/_inventory.jsonl").is_file();
        let half = states.values().filter(of_work).count() / 2;
        states.values().filter(of_work).nth(half).map(copy)
    }

    /// Files that kills before every n-th call leave.
    fn states(&self, first: usize, step: usize, cpu: usize) -> BTreeMap<usize, Folder> {
        let (folder, into) = (copy(&self.before), Folder::new());
        let mut command = faulty(&folder, &self.words(), "states", first);
        command.env("FAULT_ALL", "1").env("FAULT_CPU", cpu.to_string()).env("FAULT_STEP", step.to_string());
        command.env("FAULT_OF", folder.path("")).env("FAULT_STATES", into.path(""));
        let (done, _) = struck(command);
        assert!(matches!(done.code, Some(0 | 1)), "{}: {}", self.words(), done.stderr);
        is_whole(&folder, self.clean, &self.mine, &self.words());
        let state = |name: String| {
            let own = Folder::new();
            std::fs::remove_dir(own.path("")).unwrap();
            std::fs::rename(into.path(&name), own.path("")).unwrap();
            (name.parse().unwrap(), own)
        };
        into.names().into_iter().map(state).collect()
    }

    /// Files of others are there, and the next run makes the result.
    fn goes_on(&self, state: &Folder, after: &str, count: &mut Count) {
        count.faults += 1;
        self.is_kept(state, after);
        if !self.seen.lock().unwrap().insert(without_numbers(state)) {
            return;
        }
        count.states += 1;
        for (place, option) in self.then.iter().enumerate() {
            let last = place + 1 == self.then.len();
            let copied = (!last).then(|| copy(state));
            let folder = copied.as_ref().unwrap_or(state);
            let option = if folder.path("z").exists() { *option } else { "" };
            let words = format!("{} --out z {option}", self.words);
            let done = folder.run(&words);
            let after = format!("{after}, then {words}");
            assert!(matches!(done.code, Some(0 | 1)), "{after}: {}", done.stderr);
            self.is_kept(folder, &after);
            is_tidy(folder, &after);
            is_whole(folder, self.clean, &self.mine, &after);
        }
    }

    fn is_kept(&self, folder: &Folder, after: &str) {
        if !self.mine.is_empty() {
            is_kept(&folder.path("z"), &self.mine, after);
        }
    }
}

/// A copy of a folder with everything in it.
fn copy(folder: &Folder) -> Folder {
    let copy = Folder::new();
    let mut cp = Command::new("cp");
    cp.arg("-a").arg(folder.path(".")).arg(copy.path(""));
    assert!(cp.status().unwrap().success());
    copy
}

/// A digest of everything in a folder in which the random numbers of the program, 16 hexadecimal digits, are replaced by their order.
fn without_numbers(folder: &Folder) -> u64 {
    let mut known = Vec::new();
    let mut hasher = DefaultHasher::new();
    let mut replaced = |bytes: &[u8]| {
        for word in bytes.chunk_by(|a, b| a.is_ascii_hexdigit() == b.is_ascii_hexdigit()) {
            if word.len() == 16 && word[0].is_ascii_hexdigit() {
                let place = known.iter().position(|it| it == word).unwrap_or_else(|| {
                    known.push(word.to_vec());
                    known.len() - 1
                });
                place.hash(&mut hasher);
            } else {
                word.hash(&mut hasher);
            }
        }
    };
    let all = tree(&folder.path("."));
    for (name, (mode, bytes)) in all {
        replaced(name.as_os_str().as_encoded_bytes());
        replaced(&mode.to_le_bytes());
        replaced(&bytes);
    }
    hasher.finish()
}

/// Does `work` for every number below `count`, on all processors; `work` is told which one is its own.
fn in_parallel(count: usize, work: impl Fn(usize, usize) + Sync) {
    let next = AtomicUsize::new(0);
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for cpu in 0..processors {
            let (next, work) = (&next, &work);
            scope.spawn(move || {
                while let Some(number) = Some(next.fetch_add(1, Ordering::Relaxed)).filter(|it| *it < count) {
                    work(number, cpu);
                }
            });
        }
    });
}

#[test]
fn states_that_differ_in_random_numbers_are_one() {
    let state = |name: &str, text: &str| {
        let folder = Folder::new();
        folder.write(name, text);
        without_numbers(&folder)
    };
    let one = state(".z.0123456789abcdef.partial", "{\"moving\":\"0123456789abcdef\"}");
    assert_eq!(one, state(".z.ffff456789abcdef.partial", "{\"moving\":\"ffff456789abcdef\"}"));
    assert_ne!(one, state(".z.ffff456789abcdef.partial", "{\"moving\":\"0123456789abcdef\"}"));
    assert_ne!(one, state(".z.0123456789abcdef.partial", "{\"moving\":\"0123456789abcdef\"} "));
}
