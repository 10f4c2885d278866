//! The budgets of `budgets.toml` that need no timing: the size of the program, its packages, its lane kernels.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use cargo_metadata::MetadataCommand;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    MetadataCommand::new().no_deps().exec().unwrap().workspace_root.into()
}

/// A number of the tables `[program]` and `[source]`.
fn budget(key: &str) -> u64 {
    let text = std::fs::read_to_string(root().join("budgets.toml")).unwrap();
    let budgets: toml::Table = text.parse().unwrap();
    let found = ["program", "source"].into_iter().find_map(|table| budgets[table].get(key));
    found.unwrap().as_integer().unwrap().try_into().unwrap()
}

fn check(key: &str, found: u64) {
    let allowed = budget(key);
    assert!(found <= allowed, "{key} is {found}, and budgets.toml allows {allowed}");
    // A budget far above what is needed limits nothing.
    assert!(found * 5 >= allowed * 4, "{key} is {found}: lower the budget of {allowed} in budgets.toml");
}

#[test]
fn the_program_is_built_from_no_more_packages() {
    let mut tree = Command::new(env!("CARGO"));
    tree.args(["tree", "--offline", "--locked", "-p", "motiform", "-e", "normal,build", "--prefix", "none"]);
    let output = tree.current_dir(root()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let name = |line: &str| line.split(" (").next().unwrap().to_owned();
    let external: BTreeSet<String> =
        text.lines().filter(|line| !line.contains("motiform") && !line.is_empty()).map(name).collect();
    check("packages", external.len() as u64);
}

/// The Rust sources below a folder, with their paths.
fn sources(folder: &Path, found: &mut Vec<(PathBuf, String)>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() && !["target", "node_modules"].iter().any(|name| path.ends_with(name)) {
            sources(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let text = std::fs::read_to_string(&path).unwrap();
            found.push((path, text));
        }
    }
}

/// Lines that do not fit beside another file, and doc comments that ask what an item is instead of naming it.
#[test]
fn no_more_lines_are_long_and_no_more_comments_ask() {
    let mut found = Vec::new();
    ["crates", "xtask"].iter().for_each(|folder| sources(&root().join(folder), &mut found));
    let lines = || found.iter().flat_map(|(_, text)| text.lines());
    check("long_lines", lines().filter(|line| line.chars().count() > 140).count() as u64);
    let asks = |line: &&str| {
        let text = line.trim_start();
        let text = text.strip_prefix("/// ").or_else(|| text.strip_prefix("//! "));
        text.is_some_and(|text| ["What ", "Whether ", "How "].iter().any(|word| text.starts_with(word)))
    };
    check("questions", lines().filter(asks).count() as u64);
}

/// Crates, and lines of code of the largest one: neither empty nor comments nor unit tests.
#[test]
fn crates_are_no_more_and_no_larger() {
    let packages = MetadataCommand::new().no_deps().exec().unwrap().packages;
    let folders: Vec<PathBuf> =
        packages.iter().map(|package| package.manifest_path.parent().unwrap().into()).collect();
    let crates = || folders.iter().filter(|folder| folder.starts_with(root().join("crates")));
    check("crates", crates().count() as u64);
    let is_code = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with("//");
    let lines = |folder: &PathBuf| {
        let mut found = Vec::new();
        sources(&folder.join("src"), &mut found);
        found.retain(|(path, _)| !path.file_stem().unwrap().to_str().unwrap().starts_with("tests"));
        let own = found.iter().filter_map(|(_, text)| text.split("\nmod tests {").next());
        own.flat_map(str::lines).filter(is_code).count()
    };
    check("crate_lines", crates().map(lines).max().unwrap() as u64);
}

/// Options and commands are words of the program (`remedy.rs`), not of the libraries, which Python and others use, too. Answers are
/// lines that it prints.
#[test]
fn libraries_name_no_option() {
    let mut found = Vec::new();
    ["engine", "data", "lab"]
        .iter()
        .for_each(|group| sources(&root().join("crates").join(group), &mut found));
    let ours = |path: &Path| path.components().any(|part| part.as_os_str() == "src");
    let option = |line: &str| {
        let begins = |part: &str| part.starts_with(|c: char| c.is_ascii_lowercase());
        line.contains("`motiform ") || line.match_indices("--").any(|(at, _)| begins(&line[at + 2..]))
    };
    for (path, text) in found.iter().filter(|(path, _)| ours(path)) {
        let line = text.lines().find(|line| !line.trim_start().starts_with("//") && option(line));
        assert_eq!(line, None, "{}", path.display());
    }
}

/// A crate whose `src/` has no tests is not compiled for them; a test there would never run.
#[test]
fn tests_are_where_they_are_run() {
    let mut found = Vec::new();
    sources(&root().join("crates"), &mut found);
    for (path, _) in found.iter().filter(|(_, text)| text.contains("#[test]")) {
        let crate_of = path.ancestors().find(|folder| folder.join("src").is_dir()).expect("a crate");
        let manifest = std::fs::read_to_string(crate_of.join("Cargo.toml")).expect("a manifest");
        let of_library = match manifest.contains("[[bin]]") {
            true => path.ends_with("src/lib.rs"),
            false => path.starts_with(crate_of.join("src")),
        };
        let tested = !manifest.contains("\ntest = false") || !of_library;
        assert!(tested, "{}: move it to tests/all", path.display());
    }
}

/// A file that no module names is not compiled: its tests do not run, and nothing says so.
#[test]
fn every_source_is_a_module() {
    let mut found = Vec::new();
    sources(&root().join("crates"), &mut found);
    let part = |path: &Path| {
        let parts = path.ancestors().skip(1);
        parts
            .filter(|above| above.ends_with("src") || above.ends_with("tests/all"))
            .last()
            .map(Path::to_owned)
    };
    let is_named = |path: &Path| {
        let stem = path.file_stem().unwrap().to_str().unwrap();
        let above = path.parent().unwrap().file_name().unwrap().to_str().unwrap();
        let (own, names) = (part(path), format!("mod {};", if stem == "mod" { above } else { stem }));
        let roots = own.is_none() || ["lib", "main"].contains(&stem);
        roots || found.iter().any(|(other, text)| part(other) == own && text.contains(&names))
    };
    let lost: Vec<&PathBuf> = found.iter().map(|one| &one.0).filter(|path| !is_named(path)).collect();
    assert!(lost.is_empty(), "not compiled: {lost:#?}");
}

#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod program {
    use super::check;

    /// A section of a 64-bit ELF file: its name's place, offset, size, and the section that it refers to.
    struct Section {
        name: usize,
        offset: usize,
        size: usize,
        link: usize,
    }

    /// A little-endian number.
    fn number(file: &[u8], at: usize, bytes: usize) -> usize {
        file[at..at + bytes].iter().rev().fold(0, |sum, byte| sum << 8 | usize::from(*byte))
    }

    fn sections(file: &[u8]) -> Vec<Section> {
        let (table, size, count) = (number(file, 0x28, 8), number(file, 0x3a, 2), number(file, 0x3c, 2));
        let section = |index| {
            let at = table + index * size;
            Section {
                name: number(file, at, 4),
                offset: number(file, at + 0x18, 8),
                size: number(file, at + 0x20, 8),
                link: number(file, at + 0x28, 4),
            }
        };
        (0..count).map(section).collect()
    }

    fn text_at(file: &[u8], at: usize) -> &str {
        let end = file[at..].iter().position(|byte| *byte == 0).unwrap();
        std::str::from_utf8(&file[at..at + end]).unwrap()
    }

    /// The section of this name.
    fn section(file: &[u8], name: &str) -> Section {
        let names = sections(file).swap_remove(number(file, 0x3e, 2)).offset;
        sections(file).into_iter().find(|section| text_at(file, names + section.name) == name).unwrap()
    }

    fn program() -> Vec<u8> {
        std::fs::read(env!("CARGO_BIN_EXE_motiform")).unwrap()
    }

    #[test]
    fn the_program_is_no_larger() {
        check("text_bytes", section(&program(), ".text").size as u64);
    }

    /// Each kernel is one instance of a function that enters vector instructions.
    #[test]
    fn there_are_no_more_lane_kernels() {
        let file = program();
        let symbols = section(&file, ".symtab");
        let names = sections(&file)[symbols.link].offset;
        let name = |entry| text_at(&file, names + number(&file, symbols.offset + 24 * entry, 4));
        let enters = |name: &str| name.contains("4simd3x864avx2") || name.contains("4simd3x866avx512");
        let kernels = (0..symbols.size / 24).filter(|entry| enters(name(*entry))).count();
        check("lane_kernels", kernels as u64);
    }
}
