//! The elapsed time of each part of a task, for the closing lines of its log.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A finished part: its name, and seconds on the clock and of processors.
type Part = (String, f64, Option<f64>);

static PARTS: Mutex<Vec<Part>> = Mutex::new(Vec::new());

/// Runs a part, and remembers how long it took.
pub(crate) fn timed<R>(name: &str, part: impl FnOnce() -> R) -> R {
    let (begun, before) = (Instant::now(), processors());
    let done = part();
    let used = before.zip(processors()).map(|(before, after)| (after - before).as_secs_f64());
    let mut parts = PARTS.lock().unwrap_or_else(PoisonError::into_inner);
    parts.push((name.to_owned(), begun.elapsed().as_secs_f64(), used));
    done
}

/// Prints the parts so far.
pub(crate) fn print() {
    eprint!("{}", table(&PARTS.lock().unwrap_or_else(PoisonError::into_inner)));
}

/// A line for each name, in the order in which they came first, and their sum.
fn table(parts: &[Part]) -> String {
    let mut lines: Vec<Part> = Vec::new();
    for (name, elapsed, used) in parts {
        match lines.iter_mut().find(|line| line.0 == *name) {
            Some(line) => *line = (name.clone(), line.1 + elapsed, add(line.2, *used)),
            None => lines.push((name.clone(), *elapsed, *used)),
        }
    }
    let sum = lines.iter().fold((0.0, Some(0.0)), |sum, line| (sum.0 + line.1, add(sum.1, line.2)));
    lines.push(("all parts".to_owned(), sum.0, sum.1));
    let mut text = format!("== {:<40}{:>12}{:>16}\n", "seconds", "elapsed", "of processors");
    for (name, elapsed, used) in lines {
        let used = used.map_or_else(|| "unknown".to_owned(), |used| format!("{used:.0}"));
        text += &format!("== {name:<40}{elapsed:>12.0}{used:>16}\n");
    }
    text
}

fn add(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    one.zip(other).map(|(one, other)| one + other)
}

/// The processor time of finished child processes, as Linux tells it.
fn processors() -> Option<Duration> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program, in brackets, may contain spaces; cutime and cstime are the 14th and 15th words after it, in hundredths.
    let words: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |word: usize| words.get(word)?.parse::<u64>().ok();
    Some(Duration::from_millis(10 * (ticks(13)? + ticks(14)?)))
}

#[cfg(test)]
mod tests {
    use super::{processors, table};

    #[test]
    fn parts_of_one_name_are_one_line() {
        let part = |name: &str, elapsed| (name.to_owned(), elapsed, Some(2.0 * elapsed));
        let text = table(&[part("tests", 1.0), part("page", 2.0), part("tests", 4.0)]);
        let words: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
        assert_eq!(words[1], ["==", "tests", "5", "10"]);
        assert_eq!(words[2], ["==", "page", "2", "4"]);
        assert_eq!(words[3], ["==", "all", "parts", "7", "14"]);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn the_time_of_processes_is_known() {
        let before = processors();
        let work = "i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done";
        assert!(std::process::Command::new("sh").args(["-c", work]).status().is_ok_and(|it| it.success()));
        assert!(processors() > before && before.is_some());
    }
}
