//! The steady motions of the cell: the same list of special points from everywhere.

use crate::common::Folder;

/// The special points of all branches (kind, length), each once; every origin was followed.
fn atlas(arguments: &str) -> Vec<(String, f64)> {
    let folder = Folder::new();
    let json =
        folder.run(&format!("continue cell {arguments} --steady --branches 60 --json")).expect(0).json();
    assert_eq!(json["origins_left"], 0, "{arguments}");
    let branches = json["branches"].as_array().expect("branches");
    let special = branches.iter().flat_map(|branch| branch["special"].as_array().expect("a list"));
    let mut all: Vec<(String, f64)> = special
        .map(|entry| (entry["kind"].to_string(), entry["length"].as_f64().expect("a length")))
        .collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    all.dedup_by(|a, b| a.0 == b.0 && (a.1 - b.1).abs() < 1e-6);
    all
}

/// From the circle, from circular motion, and from a two-fold shape, in steps of different lengths, with other seeds, and over longer
/// ranges. Every push follows the first and the last of the others.
#[test]
fn the_atlas_of_the_cell_is_the_same_from_everywhere() {
    let first = atlas("--set length=6 --along length=6:15");
    let lengths: Vec<f64> = first.iter().map(|one| one.1).collect();
    let expected =
        [std::f64::consts::TAU, 12.278_498, 2.0 * std::f64::consts::TAU, 12.621_172, 12.973_310, 14.920_437];
    assert_eq!(lengths.len(), expected.len(), "{first:?}");
    assert!(lengths.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{first:?}");
    let others = [
        "--set length=12.6 --motion circular --along length=6:15",
        "--set length=14.95 --seed 3 --along length=6:15 --branch-step 0.01",
        "--set length=6.1 --along length=5.9:15.3 --branch-step 0.035",
        "--set length=9 --motion straight --along length=6:15.1 --first-step 0.002 --seed 5",
    ];
    for arguments in others.into_iter().step_by(if super::all() { 1 } else { 3 }) {
        let other = atlas(arguments);
        let same = |(a, b): (&(String, f64), &(String, f64))| a.0 == b.0 && (a.1 - b.1).abs() < 1e-6;
        assert!(other.len() == first.len() && first.iter().zip(&other).all(same), "{arguments}: {other:?}");
    }
}
