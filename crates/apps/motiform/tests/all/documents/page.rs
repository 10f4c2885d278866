//! A page of the documents as steps.

use super::root;
use std::fs;
use std::path::{Path, PathBuf};

pub(super) struct Page {
    pub(super) name: String,
    pub(super) path: PathBuf,
    pub(super) text: String,
    pub(super) steps: Vec<Step>,
}

pub(super) enum Step {
    /// A file that the reader is told to write.
    File {
        name: String,
        text: String,
    },
    Command(Command),
}

pub(super) struct Command {
    pub(super) text: String,
    /// Seconds, as the comment says.
    pub(super) slow: Option<f64>,
}

/// Lines of shell blocks that are not carried out, with the reason.
const OTHERS: [(&str, &str); 11] = [
    ("cargo xtask", "would run this test again"),
    ("cargo install", "installs"),
    ("cargo test", "a test"),
    ("cargo add", "changes another project"),
    ("cargo build", "this program"),
    ("pip install", "installs; the tests of the package do it"),
    ("jupyter ", "a server; the tests of the package run the notebooks"),
    ("python ", "the tests of the package run it"),
    ("mpirun ", "needs MPI; the tests of the package have the executor"),
    ("ssh ", "another machine"),
    ("sbatch ", "a cluster"),
];

/// README.md and the pages of `docs/`.
pub(super) fn all() -> Vec<Page> {
    let mut paths = vec![root().join("README.md")];
    for folder in ["docs", "docs/records"] {
        let Ok(entries) = fs::read_dir(root().join(folder)) else { continue };
        paths.extend(entries.map(|entry| entry.unwrap().path()));
    }
    paths.retain(|path| path.extension().is_some_and(|end| end == "md"));
    paths.sort();
    paths.iter().map(|path| Page::read(path)).collect()
}

impl Page {
    fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap();
        let name = path.strip_prefix(root()).unwrap().to_string_lossy().into_owned();
        let steps = blocks(&text).iter().flat_map(|block| block.steps(&name)).collect();
        Self { name, path: path.to_owned(), text, steps }
    }

    /// Its commands, also the slow ones if they are wanted.
    pub(super) fn commands(&self, slow: bool) -> impl Iterator<Item = &Command> {
        self.steps.iter().filter_map(move |step| match step {
            Step::Command(command) if slow || command.slow.is_none() => Some(command),
            _ => None,
        })
    }
}

/// A block of code, and the line of text before it.
struct Block {
    before: String,
    language: Option<String>,
    lines: Vec<String>,
}

/// Fenced and indented blocks, in their order.
fn blocks(text: &str) -> Vec<Block> {
    let (mut found, mut open): (Vec<Block>, Option<Block>) = (Vec::new(), None);
    let mut before = String::new();
    for line in text.lines() {
        let fence = line.strip_prefix("```");
        match (&mut open, fence) {
            (Some(block), Some(_)) if block.language.is_some() => found.extend(open.take()),
            (Some(block), _) if block.language.is_some() => block.lines.push(line.to_owned()),
            (Some(block), None) if line.starts_with("    ") => block.lines.push(line[4..].to_owned()),
            _ => {
                found.extend(open.take());
                let language = fence.map(|language| language.trim().to_owned());
                let indented = line.strip_prefix("    ").map(|line| vec![line.to_owned()]);
                match (language, indented) {
                    (Some(language), _) => {
                        open =
                            Some(Block { before: before.clone(), language: Some(language), lines: vec![] });
                    }
                    (None, Some(lines)) => {
                        open = Some(Block { before: before.clone(), language: None, lines });
                    }
                    (None, None) if !line.trim().is_empty() => before = line.to_owned(),
                    (None, None) => {}
                }
            }
        }
    }
    found.extend(open);
    found
}

impl Block {
    fn steps(&self, page: &str) -> Vec<Step> {
        let first = self.lines.first().map_or("", String::as_str);
        let shell = match self.language.as_deref() {
            Some(language) => language == "sh",
            None => first.starts_with("motiform ") || first.starts_with("cargo "),
        };
        if shell {
            return commands(&self.lines, page);
        }
        let name = self.before.strip_suffix("`:").and_then(|start| start.rsplit('`').next());
        match (self.language.as_deref(), name) {
            (Some("toml"), Some(name)) => {
                vec![Step::File { name: name.to_owned(), text: self.lines.join("\n") + "\n" }]
            }
            _ => Vec::new(),
        }
    }
}

/// The commands of a shell block, continued lines joined; `cargo run` builds and starts what is tested here.
fn commands(lines: &[String], page: &str) -> Vec<Step> {
    let joined = lines.join("\n").replace("\\\n", " ");
    let mut steps = Vec::new();
    for line in joined.lines() {
        let (text, comment) = line.split_once(" #").map_or((line, ""), |(text, comment)| (text, comment));
        let text = text.trim().replacen("cargo run --release -- ", "motiform ", 1);
        let skipped = |(start, _): &(&str, &str)| text.starts_with(start);
        if text.starts_with("motiform ") {
            steps.push(Step::Command(Command { text, slow: time(comment) }));
        } else if !(text.is_empty() || text.starts_with('#') || OTHERS.iter().any(skipped)) {
            panic!("{page}: a line of a shell block that nothing tries: {line}");
        }
    }
    steps
}

/// Seconds at the end of a comment: `40 s`, `2 min`.
fn time(comment: &str) -> Option<f64> {
    let mut words = comment.trim().rsplit(' ');
    let unit = match words.next()? {
        "s" => 1.0,
        "min" => 60.0,
        _ => return None,
    };
    Some(unit * words.next()?.parse::<f64>().ok()?)
}

#[test]
fn blocks_and_times_are_seen() {
    let text = "Put this into `a.toml`:\n\n```toml\nx = 1\n```\n\n    motiform check a.toml   # quick\n    motiform \
     scan \\\n      a.toml   # all of it, 2 min\n\nText\n";
    let steps: Vec<Step> = blocks(text).iter().flat_map(|block| block.steps("a page")).collect();
    assert!(matches!(&steps[0], Step::File { name, text } if name == "a.toml" && text == "x = 1\n"));
    assert!(
        matches!(&steps[1], Step::Command(Command { text, slow: None }) if text == "motiform check a.toml")
    );
    assert!(matches!(&steps[2], Step::Command(Command { slow: Some(120.0), .. })));
    assert_eq!(steps.len(), 3);
}
