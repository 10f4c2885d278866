//! `motiform completions`.

use crate::args::{Arguments, CompletionsOptions};
use crate::output::{End, print};
use clap::CommandFactory;

pub(crate) fn run(options: &CompletionsOptions) -> anyhow::Result<End> {
    let mut script = Vec::new();
    clap_complete::generate(options.shell, &mut Arguments::command(), "motiform", &mut script);
    print(String::from_utf8_lossy(&script).trim_end())?;
    Ok(End::Done)
}
