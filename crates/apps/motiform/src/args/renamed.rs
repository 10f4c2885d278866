//! Options that had another name in the version before. The old name works for one version, with a word.

use std::ffi::OsString;

/// Command, old name, new name.
pub(crate) const RENAMED: [(&str, &str, &str); 8] = [
    ("continue", "from", "motion"),
    ("continue", "samples", "sweep"),
    ("lifetimes", "along", "axis"),
    ("section", "direction", "crossings"),
    ("statistics", "radius", "disc"),
    ("observe", "outlines", "write-outlines"),
    ("observe", "format", "input-format"),
    ("fit", "format", "input-format"),
];

/// A sentence for each old name on a command line, whose first word is the program.
pub(crate) fn old_names(line: &[OsString]) -> Vec<String> {
    let words: Vec<&str> = line.iter().skip(1).filter_map(|word| word.to_str()).collect();
    let Some((command, options)) = words.split_first() else { return Vec::new() };
    let options: Vec<&str> = options.iter().copied().take_while(|word| *word != "--").collect();
    let is_given = |name: &str| {
        options.iter().any(|word| {
            let rest = word.strip_prefix("--").and_then(|word| word.strip_prefix(name));
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('='))
        })
    };
    let old = RENAMED.iter().filter(|(of, old, _)| of == command && is_given(old));
    old.map(|(_, old, new)| format!("--{old} is called --{new} now; the old name goes with the next version"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::Arguments;
    use super::*;
    use clap::CommandFactory;

    fn line(text: &str) -> Vec<OsString> {
        text.split(' ').map(OsString::from).collect()
    }

    #[test]
    fn an_old_name_is_named_with_the_new_one() {
        let said = old_names(&line("motiform continue tensor --from zigzag --samples=3"));
        assert_eq!(said.len(), 2);
        assert!(said[0].contains("--motion") && said[1].contains("--sweep"), "{said:?}");
        for other in [
            "motiform continue tensor --motion zigzag",
            "motiform scan tensor --samples 3",
            "motiform continue -- --from",
        ] {
            assert!(old_names(&line(other)).is_empty(), "{other}");
        }
    }

    /// Both names are one option of the command.
    #[test]
    fn old_names_are_understood() {
        let program = Arguments::command();
        for (command, old, new) in RENAMED {
            let command = program.find_subcommand(command).expect(command);
            let option = command.get_arguments().find(|option| option.get_long() == Some(new)).expect(new);
            let aliases = option.get_all_aliases().unwrap_or_default();
            assert!(aliases.contains(&old), "{old}");
            assert!(option.get_visible_aliases().is_none_or(|names| names.is_empty()), "{old}");
        }
    }
}
