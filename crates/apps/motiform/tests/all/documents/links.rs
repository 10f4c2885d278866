//! Links of the documents, and mentions of pages in sources and help texts.

use super::root;
use std::collections::{BTreeSet, HashMap};
use std::fs;
use std::path::{Path, PathBuf};

/// Texts of these kinds mention pages.
const SOURCES: [&str; 5] = ["rs", "py", "toml", "ts", "md"];

/// Folders without sources.
const LEFT_OUT: [&str; 5] = ["target", "node_modules", "site", ".git", ".venv"];

/// Files of the checkout with one of these endings.
fn files(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() {
            if !LEFT_OUT.contains(&name.as_str()) {
                found.extend(files(&path, endings));
            }
        } else if path.extension().is_some_and(|end| endings.iter().any(|one| end == *one)) {
            found.push(path);
        }
    }
    found
}

/// The text without code, in blocks or in a line.
fn prose(text: &str) -> String {
    let mut fenced = false;
    let mut kept = String::new();
    for line in text.lines() {
        fenced ^= line.starts_with("```");
        if !(fenced || line.starts_with("```")) {
            kept.extend(line.split('`').step_by(2));
            kept.push('\n');
        }
    }
    kept
}

/// The anchors of a page's headings: small letters, hyphens for blanks, no punctuation; the second of a name ends in `-1`.
fn anchors(text: &str) -> BTreeSet<String> {
    let mut times: HashMap<String, usize> = HashMap::new();
    let mut found = BTreeSet::new();
    for line in prose(text).lines().filter(|line| line.starts_with('#')) {
        let title = line.trim_start_matches('#').trim().to_lowercase();
        let letters = title.chars().filter(|letter| letter.is_alphanumeric() || " -_".contains(*letter));
        let name: String = letters.map(|letter| if letter == ' ' { '-' } else { letter }).collect();
        let before = times.entry(name.clone()).or_default();
        found.insert(if *before == 0 { name } else { format!("{name}-{before}") });
        *before += 1;
    }
    found
}

/// The targets of a page's links.
fn targets(text: &str) -> Vec<String> {
    let links = text.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    links.map(|(target, _)| target.split(' ').next().unwrap_or_default().to_owned()).collect()
}

#[test]
fn links_lead_somewhere() {
    let (mut wrong, mut count) = (Vec::new(), 0);
    for page in files(&root(), &["md"]) {
        let text = fs::read_to_string(&page).unwrap();
        for target in targets(&prose(&text)) {
            if target.contains("://") || target.starts_with("mailto:") {
                continue;
            }
            count += 1;
            let (file, anchor) = target.split_once('#').unwrap_or((&target, ""));
            let path = if file.is_empty() { page.clone() } else { page.parent().unwrap().join(file) };
            let known = || fs::read_to_string(&path).is_ok_and(|text| anchors(&text).contains(anchor));
            if !path.exists() || (!anchor.is_empty() && !known()) {
                wrong.push(format!("{}: {target}", page.display()));
            }
        }
    }
    assert!(count > 60, "{count} links");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A page of `docs/` that a source, a help text or a template names is there.
#[test]
fn pages_that_are_mentioned_exist() {
    let mut wrong = Vec::new();
    for source in files(&root(), &SOURCES) {
        if source.ends_with("CHANGELOG.md") {
            continue; // of every version
        }
        let text = fs::read_to_string(&source).unwrap();
        for rest in text.split("docs/").skip(1) {
            let letter = |c: char| c.is_ascii_alphanumeric() || "-_/.".contains(c);
            let name: String = rest.chars().take_while(|c| letter(*c)).collect();
            let name = name.trim_end_matches('.');
            if name.ends_with(".md") && !root().join("docs").join(name).exists() {
                wrong.push(format!("{}: docs/{name}", source.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn anchors_are_those_of_headings() {
    let found = anchors("# A compiled field\n```\n# no heading\n```\n## What, then?\n## What, then?\n");
    assert_eq!(Vec::from_iter(found), ["a-compiled-field", "what-then", "what-then-1"]);
}
