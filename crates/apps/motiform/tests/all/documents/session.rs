//! The commands of a page, one after the other in one folder.

use super::page::{Page, Step};
use super::root;
use crate::common::{Folder, PROGRAM};
use std::io::{BufRead, BufReader};
use std::os::unix::fs::symlink;
use std::process::{Command, Stdio};
use std::time::Instant;

pub(super) struct Session {
    pub(super) folder: Folder,
    pub(super) faults: Vec<String>,
    /// `true` if nothing was left out.
    pub(super) complete: bool,
}

impl Session {
    pub(super) fn run(page: &Page, slow: bool) -> Self {
        let folder = Folder::new();
        symlink(root().join("examples"), folder.path("examples")).unwrap();
        std::fs::create_dir(folder.path(".bin")).unwrap();
        symlink(PROGRAM, folder.path(".bin/motiform")).unwrap();
        let mut session = Self { folder, faults: Vec::new(), complete: true };
        for step in &page.steps {
            match step {
                Step::File { name, text } => session.folder.write(name, text),
                Step::Command(command) if slow || command.slow.is_none() => {
                    let began = Instant::now();
                    session.faults.extend(session.command(&command.text));
                    let stated = command.slow.map_or_else(String::new, |time| format!(" (stated: {time} s)"));
                    println!(
                        "{:6.1} s{stated} {}: {}",
                        began.elapsed().as_secs_f64(),
                        page.name,
                        command.text
                    );
                }
                Step::Command(command) => {
                    session.complete = false;
                    println!("left to `cargo xtask documents`: {}: {}", page.name, command.text);
                }
            }
        }
        session
    }

    /// The fault of a command, if it has one. 1 is no fault: some result is not as asked for, such as a motion that is undecided.
    fn command(&self, line: &str) -> Option<String> {
        if line.starts_with("motiform explore") {
            return self.explore(line);
        }
        if line.contains("--film") && Command::new("ffmpeg").arg("-version").output().is_err() {
            println!("not run without ffmpeg: {line}");
            return None;
        }
        if line.contains("$SLURM") {
            return (1..=4)
                .find_map(|task| self.bash(&line.replace("$SLURM_ARRAY_TASK_ID", &task.to_string())));
        }
        self.bash(line)
    }

    fn bash(&self, line: &str) -> Option<String> {
        let path = format!("{}:{}", self.folder.path(".bin").display(), std::env::var("PATH").unwrap());
        let mut bash = Command::new("bash");
        bash.args(["-c", &format!("set -o pipefail; {line}")]).current_dir(self.folder.path(""));
        bash.env("PATH", path).env("SLURM_CPUS_PER_TASK", "1").env_remove("COLUMNS").stdin(Stdio::null());
        let output = bash.output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        let code = output.status.code();
        (!matches!(code, Some(0 | 1))).then(|| format!("{line}\nended with {code:?}: {said}"))
    }

    /// A server runs until it is ended: it must tell its address.
    fn explore(&self, line: &str) -> Option<String> {
        let mut words: Vec<&str> = line.split_whitespace().skip(1).collect();
        if !words.contains(&"--no-open") {
            words.push("--no-open");
        }
        let mut command = Command::new(PROGRAM);
        command.args(&words).current_dir(self.folder.path("")).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        let told = BufReader::new(child.stdout.take().unwrap()).lines().map_while(Result::ok).take(2);
        let address = told.filter(|line| line.trim().starts_with("http://127.0.0.1:")).count();
        child.kill().unwrap();
        child.wait().unwrap();
        (address != 1).then(|| format!("{line}\ntells no address"))
    }
}
