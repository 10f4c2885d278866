//! Dependencies between the crates of the workspace point down only: a file that knows too much does not compile.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use cargo_metadata::camino::Utf8Path;
use cargo_metadata::{DependencyKind, MetadataCommand, Package};
use std::process::Command;

/// Each crate by its group and name, its folder in `crates/`, and the crates that it may use. A new crate must be given its place here.
const LAYERS: [(&str, &str); 18] = [
    ("engine/dynamics", ""),
    ("show/figures", ""),
    ("lab/store", ""),
    ("engine/models", "dynamics"),
    ("engine/analysis", "dynamics"),
    ("engine/continuation", "analysis dynamics"),
    ("data/statistics", "analysis dynamics"),
    ("data/inference", "dynamics models"),
    ("engine/kernels", "analysis dynamics models"),
    ("lab/study", "analysis dynamics models store"),
    ("data/tracks", "dynamics store"),
    ("lab/lab", "analysis dynamics figures kernels models statistics store study"),
    ("lab/diagrams", "analysis continuation dynamics figures lab models store study"),
    ("lab/cells", "analysis diagrams dynamics figures inference lab models statistics store study tracks"),
    ("show/paper", "analysis continuation diagrams dynamics figures lab models store study"),
    ("apps/explorer", "analysis diagrams dynamics figures lab models store study"),
    (
        "apps/motiform",
        "analysis cells continuation diagrams dynamics explorer figures inference lab models paper statistics store study tracks",
    ),
    ("apps/python", "analysis cells diagrams dynamics figures lab models statistics store study tracks"),
];

/// Each group, and what its crates may use: groups, and single crates of groups above it that use no other crate themselves.
const GROUPS: [(&str, &str); 5] = [
    ("engine", "engine"),
    ("data", "engine data lab/store"),
    ("lab", "engine data lab show/figures"),
    ("show", "engine lab show"),
    ("apps", "engine data lab show apps"),
];

#[test]
fn groups_use_what_is_below_them() {
    let place = |name: &str| LAYERS.iter().find(|layer| layer.0.ends_with(&format!("/{name}"))).unwrap();
    for (name, below) in LAYERS {
        let group = name.split('/').next().unwrap();
        let (_, allowed) = GROUPS.iter().find(|known| known.0 == group).unwrap();
        for used in below.split_whitespace().map(place) {
            let whole = allowed.split(' ').any(|known| used.0.starts_with(&format!("{known}/")));
            let single = allowed.split(' ').any(|known| known == used.0) && used.1.is_empty();
            assert!(whole || single, "{name} must not depend on {}, which its group may not use", used.0);
        }
    }
}

#[test]
fn dependencies_point_down() {
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../Cargo.toml");
    let metadata = MetadataCommand::new().manifest_path(manifest).no_deps().exec().unwrap();
    let packages = metadata.workspace_packages();
    let crates = metadata.workspace_root.join("crates");
    let folders: Vec<(&str, &str)> = packages
        .iter()
        .filter_map(|package| Some((folder(package, &crates)?, package.name.as_str())))
        .collect();
    assert_eq!(folders.len(), LAYERS.len(), "every crate has its place in LAYERS");
    for package in &packages {
        let Some(name) = folder(package, &crates) else { continue };
        let Some((_, below)) = LAYERS.iter().find(|layer| layer.0 == name) else {
            panic!("{name} has no place in LAYERS")
        };
        for dependency in &package.dependencies {
            let ours = folders.iter().find(|other| other.1 == dependency.name);
            let counts = dependency.kind != DependencyKind::Development; // a test may look up
            let allowed =
                ours.is_none_or(|ours| below.split(' ').any(|known| ours.0.split('/').nth(1) == Some(known)));
            assert!(!counts || allowed, "{name} must not depend on {}", dependency.name);
        }
    }
}

/// The folder of a package in `crates/`; development tasks have none.
fn folder<'a>(package: &'a Package, crates: &Utf8Path) -> Option<&'a str> {
    package.manifest_path.parent()?.strip_prefix(crates).ok().map(Utf8Path::as_str)
}

/// The explorer brings a server along; a program built without it must not carry one.
#[test]
fn without_the_explorer_there_is_no_server() {
    for (arguments, there) in [(&["--no-default-features"][..], false), (&[], true)] {
        let tree = tree(arguments);
        let found = tree.lines().any(|line| line.split(' ').next() == Some("tungstenite"));
        assert_eq!(found, there, "tungstenite with {arguments:?}");
    }
}

/// The crates that the program is built from, one a line.
fn tree(arguments: &[&str]) -> String {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["tree", "-p", "motiform", "-e", "normal", "--prefix", "none", "--offline"]).args(arguments);
    let output = command.current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../../..")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}
