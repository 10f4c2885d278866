//! The steady motions of the cell: both kinds of branches where a shape with several axes loses them.

use crate::common::Folder;
use serde_json::Value;

/// A three-fold shape loses its rotations towards a corner and towards a side, a four-fold one along two kinds of axes.
#[test]
fn both_kinds_of_branches_leave_a_shape_with_several_axes() {
    for (arguments, length) in [
        ("--set length=22.6 --motion motionless --along length=22.3:22.7", 22.415_619),
        ("--set length=31 --motion motionless --along length=29.8:31.2", 29.933_754),
    ] {
        let folder = Folder::new();
        let json = folder.run(&format!("continue cell {arguments} --steady --json")).expect(0).json();
        let own = json["branches"][0]["special"].as_array().expect("a list");
        let off = |entry: &&Value| (entry["length"].as_f64().expect("a length") - length).abs() < 2e-6;
        let fork = own.iter().find(off).unwrap_or_else(|| panic!("{json}"));
        assert_eq!(fork["kind"], "pitchfork");
        assert!(
            fork["branch"].is_u64() && fork["others"].as_array().is_some_and(|all| all.len() == 1),
            "{fork}"
        );
    }
}

/// A plane with one motion: no boundary, no line, no curve. The page says so, and has no empty table, field or count of nothing.
#[test]
fn a_plane_with_one_motion_has_a_page_without_blanks() {
    let folder = Folder::new();
    folder.run("atlas fig4 --axis kappa2=0.1:0.2:5 --axis kappa3=0.8:1:5 --out one").expect(0);
    let page = std::fs::read_to_string(folder.path("one/report.html")).expect("a page");
    for bad in ["<tbody>\n</tbody>", "\"></td>", "\">-</td>", "0 curves", "0 regions"] {
        assert!(!page.contains(bad), "{bad}");
    }
    for words in ["all cells have the same motions", "No line was followed", "steady", "circular"] {
        assert!(page.contains(words), "{words}");
    }
    let manifest = std::fs::read_to_string(folder.path("one/manifest.json")).expect("a manifest");
    folder.write("one/manifest.json", &manifest.replace("\"complete\": true", "\"complete\": false"));
    let refused = folder.run("figure one --out figures").expect(2).stderr;
    assert!(
        refused.contains("one contains an atlas that is not finished: the `motiform atlas` that began it goes on with --resume"),
        "{refused}"
    );
}
