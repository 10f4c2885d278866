//! A task of this program that runs beside another one, and speaks when it is done.

use crate::{parts, root};
use anyhow::{Context, Result, bail};
use std::fs::{self, File};
use std::path::PathBuf;
use std::process::{Child, Command};

/// Tasks under way, one after the other in a process of their own.
pub(crate) struct Beside {
    name: &'static str,
    child: Child,
    said: PathBuf,
}

impl Beside {
    /// Begins a task of this program. What it prints goes to a file.
    pub(crate) fn begin(name: &'static str) -> Result<Self> {
        Self::start(name, Command::new(std::env::current_exe()?))
    }

    /// Begins one that takes what processor time others leave, where the system can do that.
    pub(crate) fn begin_idly(name: &'static str) -> Result<Self> {
        if !cfg!(unix) {
            return Self::begin(name);
        }
        let mut nice = Command::new("nice");
        nice.args(["-n", "19"]).arg(std::env::current_exe()?);
        Self::start(name, nice)
    }

    fn start(name: &'static str, mut command: Command) -> Result<Self> {
        let said = root()?.canonicalize()?.join(format!("target/xtask-{name}.txt"));
        let file = File::create(&said).with_context(|| said.display().to_string())?;
        eprintln!("== {name}: begins beside the next parts; its lines come at its end");
        command.arg(name).stdout(file.try_clone()?).stderr(file);
        Ok(Self { name, child: command.spawn().context(name)?, said })
    }

    /// Waits for its end, and prints what it said.
    pub(crate) fn end(mut self) -> Result<()> {
        let status = parts::timed(&format!("{} (the rest)", self.name), || self.child.wait())?;
        eprint!("{}", fs::read_to_string(&self.said).with_context(|| self.said.display().to_string())?);
        if status.success() { Ok(()) } else { bail!("{} failed", self.name) }
    }
}
