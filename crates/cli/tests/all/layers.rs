//! Dependencies between the crates of the workspace point down only: a file that knows too much does not compile.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use cargo_metadata::{DependencyKind, MetadataCommand};
use std::process::Command;

/// Each crate, and the crates below it that it may use. A new crate must be given its place here.
const LAYERS: [(&str, &[&str]); 27] = [
    ("motiform-store", &[]),
    ("motiform-dynamics", &[]),
    ("motiform-models", &["motiform-dynamics"]),
    ("motiform-analysis", &["motiform-dynamics"]),
    ("motiform-continuation", &["motiform-analysis", "motiform-dynamics"]),
    ("motiform-statistics", &["motiform-analysis"]),
    ("motiform-inference", &["motiform-dynamics", "motiform-models"]),
    ("motiform-kernels", &["motiform-analysis", "motiform-dynamics", "motiform-models"]),
    ("motiform-study", &["motiform-analysis", "motiform-dynamics", "motiform-models", "motiform-store"]),
    ("motiform-files", &["motiform-dynamics", "motiform-models", "motiform-store", "motiform-study"]),
    ("motiform-tracks", &["motiform-files"]),
    ("motiform-figures", &[]),
    ("motiform-report", &["motiform-figures"]),
    (
        "motiform-lab",
        &[
            "motiform-analysis",
            "motiform-dynamics",
            "motiform-figures",
            "motiform-files",
            "motiform-kernels",
            "motiform-models",
            "motiform-study",
        ],
    ),
    (
        "motiform-measure",
        &[
            "motiform-dynamics",
            "motiform-figures",
            "motiform-files",
            "motiform-lab",
            "motiform-models",
            "motiform-statistics",
            "motiform-study",
        ],
    ),
    (
        "motiform-cells",
        &[
            "motiform-analysis",
            "motiform-branching",
            "motiform-dynamics",
            "motiform-files",
            "motiform-inference",
            "motiform-lab",
            "motiform-models",
            "motiform-statistics",
            "motiform-study",
            "motiform-tracks",
        ],
    ),
    (
        "motiform-cell-report",
        &[
            "motiform-analysis",
            "motiform-cells",
            "motiform-dynamics",
            "motiform-figures",
            "motiform-inference",
            "motiform-lab",
            "motiform-report",
            "motiform-statistics",
            "motiform-study",
            "motiform-tracks",
        ],
    ),
    (
        "motiform-branching",
        &[
            "motiform-analysis",
            "motiform-continuation",
            "motiform-dynamics",
            "motiform-figures",
            "motiform-files",
            "motiform-lab",
            "motiform-models",
            "motiform-study",
        ],
    ),
    (
        "motiform-atlas",
        &[
            "motiform-analysis",
            "motiform-branching",
            "motiform-continuation",
            "motiform-dynamics",
            "motiform-figures",
            "motiform-files",
            "motiform-lab",
            "motiform-models",
            "motiform-report",
            "motiform-study",
        ],
    ),
    (
        "motiform-chapter",
        &[
            "motiform-analysis",
            "motiform-branching",
            "motiform-continuation",
            "motiform-dynamics",
            "motiform-figures",
            "motiform-lab",
            "motiform-models",
            "motiform-report",
            "motiform-study",
        ],
    ),
    (
        "motiform-paper",
        &[
            "motiform-analysis",
            "motiform-branching",
            "motiform-chapter",
            "motiform-dynamics",
            "motiform-figures",
            "motiform-files",
            "motiform-lab",
            "motiform-models",
            "motiform-report",
            "motiform-study",
        ],
    ),
    (
        "motiform-session",
        &[
            "motiform-analysis",
            "motiform-branching",
            "motiform-dynamics",
            "motiform-figures",
            "motiform-files",
            "motiform-lab",
            "motiform-models",
            "motiform-study",
        ],
    ),
    ("motiform-explorer", &["motiform-session", "motiform-study"]),
    ("motiform-web", &["motiform-lab", "motiform-session"]),
    (
        "motiform",
        &[
            "motiform-analysis",
            "motiform-atlas",
            "motiform-branching",
            "motiform-cell-report",
            "motiform-cells",
            "motiform-dynamics",
            "motiform-explorer",
            "motiform-figures",
            "motiform-files",
            "motiform-inference",
            "motiform-lab",
            "motiform-measure",
            "motiform-models",
            "motiform-paper",
            "motiform-statistics",
            "motiform-report",
            "motiform-study",
            "motiform-tracks",
        ],
    ),
    (
        "motiform-py",
        &[
            "motiform-analysis",
            "motiform-atlas",
            "motiform-branching",
            "motiform-cells",
            "motiform-dynamics",
            "motiform-figures",
            "motiform-files",
            "motiform-lab",
            "motiform-measure",
            "motiform-models",
            "motiform-statistics",
            "motiform-study",
            "motiform-tracks",
        ],
    ),
    ("xtask", &[]),
];

#[test]
fn dependencies_point_down() {
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/../../Cargo.toml");
    let metadata = MetadataCommand::new().manifest_path(manifest).no_deps().exec().unwrap();
    let packages = metadata.workspace_packages();
    assert_eq!(packages.len(), LAYERS.len(), "every crate has its place in LAYERS");
    for package in &packages {
        let name = package.name.as_str();
        let Some((_, below)) = LAYERS.iter().find(|layer| layer.0 == name) else {
            panic!("{name} has no place in LAYERS")
        };
        for dependency in &package.dependencies {
            let ours = packages.iter().any(|other| other.name.as_str() == dependency.name);
            let counts = dependency.kind != DependencyKind::Development; // a test may look up
            assert!(
                !ours || !counts || below.contains(&dependency.name.as_str()),
                "{name} must not depend on {}",
                dependency.name
            );
        }
    }
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
    let output = command.current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}
