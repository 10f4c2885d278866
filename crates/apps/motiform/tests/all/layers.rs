//! Dependencies between the crates of the workspace point down only: a file that knows too much does not compile.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use cargo_metadata::{DependencyKind, MetadataCommand, Package};
use std::process::Command;

/// Each folder of `crates/`, and those below it whose crates it may use. A new crate must be given its place here.
const LAYERS: [(&str, &str); 19] = [
    ("dynamics", ""),
    ("figures", ""),
    ("store", ""),
    ("models", "dynamics"),
    ("analysis", "dynamics"),
    ("continuation", "analysis dynamics"),
    ("statistics", "analysis"),
    ("inference", "dynamics models"),
    ("kernels", "analysis dynamics models"),
    ("study", "analysis dynamics models store"),
    ("tracks", "store"),
    ("lab", "analysis dynamics figures kernels models statistics store study"),
    ("diagrams", "analysis continuation dynamics figures lab models store study"),
    ("cells", "analysis diagrams dynamics figures inference lab models statistics store study tracks"),
    ("paper", "analysis continuation diagrams dynamics figures lab models store study"),
    ("explorer", "analysis diagrams dynamics figures lab models store study"),
    ("web", "explorer lab"),
    (
        "cli",
        "analysis cells continuation diagrams dynamics explorer figures inference lab models paper statistics store study tracks",
    ),
    ("python", "analysis cells diagrams dynamics figures lab models statistics store study tracks"),
];

#[test]
fn dependencies_point_down() {
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../Cargo.toml");
    let metadata = MetadataCommand::new().manifest_path(manifest).no_deps().exec().unwrap();
    let packages = metadata.workspace_packages();
    let folders: Vec<(&str, &str)> =
        packages.iter().filter_map(|package| Some((folder(package)?, package.name.as_str()))).collect();
    assert_eq!(folders.len(), LAYERS.len(), "every crate has its place in LAYERS");
    for package in &packages {
        let Some(name) = folder(package) else { continue };
        let Some((_, below)) = LAYERS.iter().find(|layer| layer.0 == name) else {
            panic!("{name} has no place in LAYERS")
        };
        for dependency in &package.dependencies {
            let ours = folders.iter().find(|other| other.1 == dependency.name);
            let counts = dependency.kind != DependencyKind::Development; // a test may look up
            let allowed = ours.is_none_or(|ours| below.split(' ').any(|known| known == ours.0));
            assert!(!counts || allowed, "{name} must not depend on {}", dependency.name);
        }
    }
}

/// The folder of a package in `crates/`; development tasks have none.
fn folder(package: &Package) -> Option<&str> {
    let folder = package.manifest_path.parent()?;
    (folder.parent()?.file_name()? == "crates").then(|| folder.file_name())?
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
