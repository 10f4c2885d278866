//! The long forms of tests of which every push has a sample.

use crate::{cargo_command, step};
use anyhow::{Context, Result};

/// A harness: its command, the variable that says how much, how much by default, and the tests.
struct Harness {
    name: &'static str,
    variable: &'static str,
    most: u64,
    filter: &'static str,
}

const ALL: [Harness; 5] = [
    Harness { name: "samples", variable: "MOTIFORM_SAMPLES", most: 1, filter: "" },
    Harness { name: "faults", variable: "MOTIFORM_FAULTS", most: 1, filter: "faults" },
    Harness { name: "kills", variable: "MOTIFORM_KILLS", most: 1000, filter: "kills" },
    Harness { name: "invariances", variable: "MOTIFORM_INVARIANCES", most: 1, filter: "invariances::" },
    Harness { name: "fuzz", variable: "MOTIFORM_FUZZ", most: 100_000, filter: "fuzz::" },
];

/// Runs the harness of this name, if there is one; the first argument says how much.
pub(crate) fn run(name: &str, arguments: &[String]) -> Option<Result<()>> {
    let harness = ALL.iter().find(|harness| harness.name == name)?;
    Some(harness.run(arguments))
}

impl Harness {
    fn run(&self, arguments: &[String]) -> Result<()> {
        let given = arguments.first().map(|text| text.parse::<u64>());
        let count = given.transpose().with_context(|| format!("{} needs a whole number", self.name))?;
        let mut test = cargo_command();
        test.args(["test", "--release", "--workspace", self.filter, "--", "--nocapture"]);
        step(self.name, test.env(self.variable, count.unwrap_or(self.most).to_string()))
    }
}
