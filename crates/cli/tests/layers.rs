//! Dependencies between the crates of the workspace point down only: a file that knows too much does not compile.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use cargo_metadata::{DependencyKind, MetadataCommand};

/// Each crate, and the crates below it that it may use. A new crate must be given its place here.
const LAYERS: [(&str, &[&str]); 9] = [
    ("motiform-dynamics", &[]),
    ("motiform-models", &["motiform-dynamics"]),
    ("motiform-analysis", &["motiform-dynamics"]),
    ("motiform-kernels", &["motiform-analysis", "motiform-dynamics", "motiform-models"]),
    ("motiform-study", &["motiform-analysis", "motiform-dynamics", "motiform-kernels", "motiform-models"]),
    ("motiform-explorer", &["motiform-analysis", "motiform-dynamics", "motiform-models", "motiform-study"]),
    (
        "motiform",
        &["motiform-analysis", "motiform-dynamics", "motiform-explorer", "motiform-models", "motiform-study"],
    ),
    ("motiform-py", &["motiform-analysis", "motiform-dynamics", "motiform-models", "motiform-study"]),
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
