//! `motiform completions`.

use crate::args::{Arguments, CompletionsOptions};
use crate::output::{End, print};
use clap::builder::PossibleValuesParser;
use clap::{Command, CommandFactory};
use motiform_models::{MODELS, ModelInfo};
use motiform_study::presets::PRESETS;

pub(crate) fn run(options: &CompletionsOptions) -> anyhow::Result<End> {
    let mut script = Vec::new();
    clap_complete::generate(options.shell, &mut known_names(Arguments::command()), "motiform", &mut script);
    print(String::from_utf8_lossy(&script).trim_end())?;
    Ok(End::Done)
}

/// The command with all known names: models, presets, parameters. (When a command line is parsed, a wrong name gets a
/// better answer than a list.)
fn known_names(command: Command) -> Command {
    let presets: Vec<&str> = PRESETS.iter().map(|preset| preset.name).collect();
    let models: Vec<&str> = MODELS.iter().map(|model| model.name).collect();
    let specs = MODELS.iter().flat_map(ModelInfo::parameters);
    let mut parameters: Vec<&str> = specs.map(|spec| spec.name).collect();
    parameters.sort_unstable();
    parameters.dedup();
    let complete = |command: Command| {
        command.mut_args(|arg| match arg.get_id().as_str() {
            "preset" => arg.value_parser(PossibleValuesParser::new(presets.clone())),
            "subject" | "model" => arg.value_parser(PossibleValuesParser::new(models.clone())),
            "set" | "axes" => arg.value_parser(PossibleValuesParser::new(parameters.clone())),
            _ => arg,
        })
    };
    command.mut_subcommands(complete)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn completions_know_models_presets_and_parameters() {
        let mut script = Vec::new();
        let mut command = known_names(Arguments::command());
        clap_complete::generate(clap_complete::Shell::Bash, &mut command, "motiform", &mut script);
        let script = String::from_utf8(script).unwrap();
        for word in ["tensor cell", "fig5a", "kappa2"] {
            assert!(script.contains(word), "{word}");
        }
    }
}
