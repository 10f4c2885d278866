//! Every command that the documents show is one that the command line takes.

use super::Arguments;
use clap::{CommandFactory, Parser};
use std::fs;
use std::path::{Path, PathBuf};

/// The pages of the repository that show commands.
fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let entries = |folder| fs::read_dir(root.join(folder)).expect("documents");
    let docs = entries("docs").chain(entries("docs/records")).map(|entry| entry.expect("an entry").path());
    docs.filter(|path| path.extension().is_some_and(|end| end == "md"))
        .chain([root.join("README.md")])
        .collect()
}

/// The commands of a page: lines of code that begin with the program's name, continued lines joined, comments removed.
fn commands(text: &str) -> Vec<String> {
    // a variable of the shell stands for a number
    let joined =
        text.replace("\\\n", " ").replace("$SLURM_ARRAY_TASK_ID", "1").replace("$SLURM_CPUS_PER_TASK", "1");
    let mut fenced = false;
    let mut found = Vec::new();
    for line in joined.lines() {
        fenced ^= line.starts_with("```");
        let code = if fenced { Some(line) } else { line.strip_prefix("    ") };
        let command = code.and_then(|code| code.trim_start().strip_prefix("motiform "));
        // "..." stands for what a reader fills in, and a pipe for another program
        found.extend(command.filter(|command| !command.contains("...")).map(without_comment));
    }
    found
}

fn without_comment(line: &str) -> String {
    line.split(" #").next().unwrap_or(line).split(['|', '>', '&']).next().unwrap_or(line).trim().to_owned()
}

/// The words of a line, as a shell would split it.
fn words(line: &str) -> Vec<String> {
    let (mut all, mut word, mut quote) = (vec!["motiform".to_owned()], String::new(), None);
    for letter in line.chars() {
        match (quote, letter) {
            (Some(mark), _) if mark == letter => quote = None,
            (None, '"' | '\'') => quote = Some(letter),
            (None, ' ') => all.extend((!word.is_empty()).then(|| std::mem::take(&mut word))),
            _ => word.push(letter),
        }
    }
    all.extend((!word.is_empty()).then_some(word));
    all
}

#[test]
fn the_commands_of_the_documents_are_understood() {
    let (mut count, mut wrong) = (0, Vec::new());
    for page in pages() {
        let text = fs::read_to_string(&page).expect("a page");
        for command in commands(&text) {
            count += 1;
            if let Err(error) = Arguments::try_parse_from(words(&command)) {
                let page = page.file_name().unwrap_or_default().to_string_lossy().into_owned();
                wrong.push(format!("{page}: motiform {command}\n{error}"));
            }
        }
    }
    assert!(count > 60, "{count} commands found");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Where a help text ends, a page goes on. (That the pages are there is tested with the links of the documents.)
#[test]
fn every_help_text_names_a_page() {
    for mut command in Arguments::command().get_subcommands().cloned() {
        let help = command.render_long_help().to_string();
        assert!(help.contains("docs/"), "motiform {} --help", command.get_name());
    }
}
