//! TrackMate's XML.

use crate::common::{cell, notes, read, read_with, refusal};
use motiform_tracks::{Image, Limits, Options};

/// A file with spots (ID, frame, with outline or not), links and the scale.
pub(crate) fn xml(spots: &[(i64, i64)], tracks: &[&[(i64, i64)]], pixel: f64, unit: &str) -> String {
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<TrackMate version=\"7\">\n<Model spatialunits=\"{unit}\" timeunits=\"min\">\n<AllSpots>"
    );
    for (id, frame) in spots {
        let shape = cell(*frame + 100 * (id % 10));
        let [x, y] = shape.centre;
        let points: Vec<String> =
            shape.vertices(40, 0.0).iter().map(|p| format!("{} {}", p[0] - x, p[1] - y)).collect();
        text += &format!(
            "<Spot ID=\"{id}\" FRAME=\"{frame}\" POSITION_T=\"{}\" POSITION_X=\"{x}\" POSITION_Y=\"{y}\" ROI_N_POINTS=\"40\">{}</Spot>\n",
            2.5 * *frame as f64,
            points.join(" ")
        );
    }
    text += "</AllSpots><AllTracks>";
    for (k, links) in tracks.iter().enumerate() {
        text += &format!("<Track TRACK_ID=\"{k}\">");
        for (a, b) in *links {
            text += &format!("<Edge SPOT_SOURCE_ID=\"{a}\" SPOT_TARGET_ID=\"{b}\" />");
        }
        text += "</Track>";
    }
    text += &format!(
        "</AllTracks></Model><Settings><ImageData width=\"100\" height=\"50\" pixelwidth=\"{pixel}\" \
        timeinterval=\"2.5\"/></Settings></TrackMate>"
    );
    text
}

/// A cell that divides after frame 1, with links in no order.
pub(crate) fn dividing() -> String {
    let spots = [(1, 0), (11, 1), (21, 2), (22, 2), (31, 3), (32, 3), (99, 3)];
    xml(&spots, &[&[(31, 21), (11, 22), (1, 11), (22, 32), (11, 21)]], 0.25, "micron")
}

#[test]
fn links_are_followed_and_cut_at_splits() {
    let tracks = read(dividing()).unwrap();
    let found: Vec<(&str, Vec<i64>)> =
        tracks.cells.iter().map(|c| (c.name.as_str(), c.frames.iter().map(|o| o.frame).collect())).collect();
    assert_eq!(found, [("0.1", vec![0, 1]), ("0.2", vec![2, 3]), ("0.3", vec![2, 3])]);
    assert_eq!((tracks.length_unit.as_str(), tracks.time_unit.as_str()), ("um", "min"));
    assert_eq!((tracks.image, tracks.y_down), (Some(Image { size: [25.0, 12.5], pixel: 0.25 }), Some(true)));
    assert_eq!(tracks.cells[1].frames[1].t, 7.5);
    let notes = notes(&tracks);
    assert!(
        notes.contains("track 0 splits into 2 after frame 1") && notes.contains("1 outline in no track"),
        "{notes}"
    );
}

/// The table that TrackMate exports has places alone: the reason is said at once, not one column after the other.
#[test]
fn its_table_of_spots_has_no_outlines() {
    let header =
        "LABEL,ID,TRACK_ID,QUALITY,POSITION_X,POSITION_Y,POSITION_Z,POSITION_T,FRAME,RADIUS,VISIBILITY";
    let found = refusal(format!("{header}\nID1,1,0,5.2,10.0,12.0,0.0,0.0,0,4.5,1\n"));
    assert!(found.contains("no outlines") && found.contains("XML"), "{found}");
}

#[test]
fn vertices_are_relative_to_their_spot() {
    let tracks = read(xml(&[(10, 0), (20, 1)], &[&[(10, 20)]], 0.5, "um")).unwrap();
    let [x, y] = cell(0).vertices(40, 0.0)[3];
    let [u, v] = tracks.cells[0].frames[0].points[3];
    assert!((x - u).abs() < 1e-12 && (y - v).abs() < 1e-12);
    assert_eq!(tracks.cells[0].name, "0");
}

#[test]
fn merges_and_bad_links_are_said() {
    let tracks = read(xml(
        &[(1, 0), (2, 0), (11, 1), (21, 2)],
        &[&[(1, 11), (2, 11), (11, 21), (1, 2), (21, 77)]],
        0.5,
        "um",
    ))
    .unwrap();
    assert_eq!(tracks.cells.len(), 3);
    let notes = notes(&tracks);
    assert!(
        notes.contains("2 branches of track 0 merge in frame 1") && notes.contains("2 links to nothing"),
        "{notes}"
    );
}

#[test]
fn tracks_that_the_file_filtered_out_are_left_out() {
    let text = xml(&[(1, 0), (11, 1), (2, 0), (12, 1)], &[&[(1, 11)], &[(2, 12)]], 0.5, "um");
    let text = text
        .replace("</AllTracks>", "</AllTracks><FilteredTracks><TrackID TRACK_ID=\"1\"/></FilteredTracks>");
    let tracks = read(text).unwrap();
    assert_eq!(tracks.cells.iter().map(|c| c.name.as_str()).collect::<Vec<_>>(), ["1"]);
    assert!(notes(&tracks).contains("1 track that the file has filtered out"));
}

#[test]
fn a_truncated_file_is_an_error_at_every_place() {
    let text = dividing();
    for end in (20..text.len() - 12).step_by(61) {
        let error = refusal(&text[..end]);
        assert!(error.contains("cell.dat"), "{end}: {error}");
    }
    let error = refusal(&text[..2000]);
    assert!(error.contains("truncated") && error.contains("byte"), "{error}");
}

#[test]
fn wrong_files_are_refused_with_the_reason() {
    assert!(refusal("<svg></svg>").contains("XML, but not of TrackMate"));
    let points = dividing().replace(" ROI_N_POINTS=\"40\"", "");
    assert!(refusal(points).contains("spots are points"));
    let twice = dividing().replace("ID=\"99\"", "ID=\"31\"");
    assert!(refusal(twice).contains("two spots with the ID 31"));
    let short = dividing().replacen("ROI_N_POINTS=\"40\"", "ROI_N_POINTS=\"39\"", 1);
    assert!(refusal(short).contains("two for each of 39 vertices"));
    let word = dividing().replacen(">8", ">eight", 1);
    assert!(word == dividing() || refusal(word).contains("eight"));
}

#[test]
fn long_elements_are_bounded() {
    let text =
        dividing().replace("<AllSpots>", &format!("<AllSpots><Spot name=\"{}\"/>", "x".repeat(300_000)));
    let limits = Limits { piece: 1 << 16, ..Limits::default() };
    let error = read_with(text, &Options { limits, ..Options::default() }).unwrap_err().to_string();
    assert!(error.contains("limits.piece"), "{error}");
}
