//! The tests of lanes on emulated processors: the portable path and AVX2, with qemu's user mode.

use crate::{cargo_command, step};
use anyhow::{Result, bail};
use std::process::{Command, Stdio};

/// Emulated processors: one with SSE3 at most, one with 256-bit registers and fused operations, no wider ones.
const PROCESSORS: [&str; 2] = ["qemu64", "Haswell"];

/// Operations lane by lane, exponents in lanes against single runs, and the digest of a scan.
const TESTS: [&[&str]; 2] =
    [&["--test", "all", "--", "lanes::"], &["--test", "all", "--", "numbers_change_only_with_the_format"]];

pub(crate) fn run() -> Result<()> {
    let emulator = format!("qemu-{}", std::env::consts::ARCH);
    let there = Command::new(&emulator).arg("--version").stdout(Stdio::null()).status();
    if !there.is_ok_and(|status| status.success()) {
        bail!("{emulator} does not start: install it (Debian: apt-get install qemu-user)");
    }
    let runner =
        format!("CARGO_TARGET_{}_UNKNOWN_LINUX_GNU_RUNNER", std::env::consts::ARCH.to_ascii_uppercase());
    for processor in PROCESSORS {
        for tests in TESTS {
            let mut command = cargo_command();
            command.args(["test", "--release", "--workspace"]).args(tests);
            step(processor, command.env(&runner, format!("{emulator} -cpu {processor}")))?;
        }
    }
    Ok(())
}
