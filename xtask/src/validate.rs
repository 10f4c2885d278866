//! Science runs of minutes to hours: what every push samples, measured whole. Each writes its result to `validation/`.

use crate::{cargo_command, parts, root};
use anyhow::{Context, Result, bail};
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};

/// A run: its name, the time it takes on two cores, and its command.
struct Run {
    name: &'static str,
    takes: &'static str,
    program: Program,
}

enum Program {
    /// An ignored test that prints its result: the package and the test.
    Test(&'static str, &'static str),
    /// A program of Python: its arguments.
    Python(&'static [&'static str]),
}

const RUNS: [Run; 9] = [
    Run {
        name: "statistics",
        takes: "5 minutes",
        program: Program::Test("motiform-lab", "statistics::coverage::table"),
    },
    Run { name: "matrix", takes: "hours", program: Program::Test("motiform-cells", "matrix::table") },
    Run {
        name: "regimes",
        takes: "an hour",
        program: Program::Test("motiform-cells", "rates::true_regimes"),
    },
    Run {
        name: "short-cells",
        takes: "an hour",
        program: Program::Test("motiform-cells", "rates::short_and_noisy_cells_have_no_wrong_name"),
    },
    Run {
        name: "handed-cells",
        takes: "an hour",
        program: Program::Test("motiform-cells", "rates::handed_cells_are_found_handed"),
    },
    Run {
        name: "chaotic-fits",
        takes: "a minute",
        program: Program::Test("motiform-inference", "fit::chaotic"),
    },
    Run {
        name: "zigzag-fits",
        takes: "a minute",
        program: Program::Test("motiform-inference", "fit::zigzag"),
    },
    Run {
        name: "false-alarms",
        takes: "half an hour",
        program: Program::Test("motiform-inference", "handed::rates_of_false_alarms"),
    },
    Run {
        name: "verdicts",
        takes: "40 minutes",
        program: Program::Python(&["bench/verdicts/verdicts.py", "--out", "bench/verdicts/results"]),
    },
];

/// Runs those that are named, or all, in order; a list of them with `--list`.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    if arguments.iter().any(|argument| argument == "--list") {
        RUNS.iter().for_each(|run| println!("{:13} {}", run.name, run.takes));
        return Ok(());
    }
    if let Some(unknown) = arguments.iter().find(|name| RUNS.iter().all(|run| run.name != **name)) {
        let known = RUNS.map(|run| run.name).join(", ");
        bail!("no validation run has the name {unknown:?}: choose of {known}");
    }
    let wanted = |run: &&Run| arguments.is_empty() || arguments.iter().any(|name| name == run.name);
    let failed: Vec<&str> =
        RUNS.iter().filter(wanted).filter_map(|run| run.result().err().map(|_| run.name)).collect();
    if failed.is_empty() { Ok(()) } else { bail!("not as it must be: {}", failed.join(", ")) }
}

impl Run {
    /// Runs it, and writes what it prints to its file, also if it fails.
    fn result(&self) -> Result<()> {
        let (root, mut command) = (root()?, self.command());
        eprintln!("== {} ({})", self.name, self.takes);
        let mut child = command.current_dir(&root).stdout(Stdio::piped()).spawn().context(self.name)?;
        let output = child.stdout.take().context("no output")?;
        let mut lines = Vec::new();
        for line in BufReader::new(output).lines() {
            let line = line.context(self.name)?;
            println!("{line}");
            if !is_of_the_harness(&line) {
                lines.push(line);
            }
        }
        let passed = parts::timed(self.name, || child.wait()).context(self.name)?.success();
        write(&root.join("validation").join(format!("{}.txt", self.name)), &lines, passed)?;
        if passed { Ok(()) } else { bail!("{} failed", self.name) }
    }

    fn command(&self) -> Command {
        match self.program {
            Program::Test(package, test) => {
                let mut command = cargo_command();
                command.args([
                    "test",
                    "--release",
                    "-p",
                    package,
                    "--test",
                    "all",
                    test,
                    "--",
                    "--ignored",
                    "--nocapture",
                ]);
                command
            }
            Program::Python(arguments) => {
                let mut command = Command::new("python3");
                command.args(arguments);
                command
            }
        }
    }
}

/// Lines of the test runner, with times that differ from run to run.
fn is_of_the_harness(line: &str) -> bool {
    line.trim().is_empty() || ["running ", "test ", "test result"].iter().any(|start| line.starts_with(start))
}

fn write(path: &Path, lines: &[String], passed: bool) -> Result<()> {
    let mut file = fs::File::create(path).with_context(|| path.display().to_string())?;
    writeln!(
        file,
        "motiform {}: {}",
        env!("CARGO_PKG_VERSION"),
        if passed { "as it must be" } else { "NOT as it must be" }
    )?;
    lines.iter().try_for_each(|line| writeln!(file, "{line}"))?;
    Ok(())
}
