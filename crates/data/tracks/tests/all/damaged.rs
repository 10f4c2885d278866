//! Tests of damaged data: an error with its place, or a note.

use crate::common::{cell, csv, notes, outlines, read, read_with, refusal};
use crate::formats::{quimp_nodes, quimp_table};
use motiform_tracks::{Limits, Options};

#[test]
fn places_are_named() {
    let text = csv(2).replacen("a,1,3,", "a,1,three,", 1);
    let error = refusal(text);
    assert!(error.contains("cell.dat, line 45") && error.contains("i is \"three\""), "{error}");
    let error = refusal(csv(1).replacen("a,0,5,", "a,0,5,1,", 1));
    assert!(error.contains("line 7") && error.contains("6 fields (decimal commas?)"), "{error}");
    let error = refusal(csv(1).replacen("a,0,5,", "a,0.5,5,", 1));
    assert!(error.contains("a whole number"), "{error}");
    let error = refusal(quimp_nodes(2).lines().take(20).collect::<Vec<_>>().join("\n"));
    assert!(error.contains("node 16 of 40") && error.contains("truncated"), "{error}");
    let error = refusal(quimp_table(1).replace("node_y", "other"));
    assert!(error.contains("no column for y") && error.contains("name it"), "{error}");
}

#[test]
fn unknown_content_says_what_it_looks_like() {
    for (content, part) in [
        ("", "empty"),
        (" \n\n", "blank"),
        ("\0\0\0", "binary"),
        ("hello world\n", "hello world"),
        ("1 2 3\n", "formats are csv"),
        ("#p2 - QuimP parameter file\n1\n", ".snQP"),
        ("II*\0", "the end of the file"), // an image without its tags
    ] {
        let error = refusal(content);
        assert!(error.contains(part), "{content:?}: {error}");
    }
    assert!(refusal([0xff, 0xfe, b'c', 0]).contains("UTF-16"));
    assert!(
        motiform_tracks::read::<&str>(&[], &Options::default())
            .unwrap_err()
            .to_string()
            .contains("at least one")
    );
    let error = motiform_tracks::read(&["/nonexistent"], &Options::default()).unwrap_err().to_string();
    assert!(error.contains("/nonexistent"), "{error}");
    let folder = tempfile::tempdir().unwrap();
    let error = motiform_tracks::read(&[folder.path()], &Options::default()).unwrap_err().to_string();
    assert!(error.contains("the folder has no image"), "{error}");
}

#[test]
fn vertices_that_are_not_finite() {
    let text = csv(2);
    let row = text.lines().find(|line| line.starts_with("a,1,3,")).unwrap().to_owned();
    for value in ["NaN", "", "inf", "-1e200"] {
        let tracks = read(text.replace(&row, &format!("a,1,3,{value},2.0"))).unwrap();
        let outline = &tracks.cells[0].frames[1];
        assert_eq!((outline.points.len(), outline.missing), (39, 1));
        assert!(notes(&tracks).contains("not finite in frame 1"));
    }
}

#[test]
fn positions_are_no_outlines() {
    let tracks = read("particle,frame,x,y\n1,0,3,4\n1,1,4,5\n1,2,4,5\n").unwrap();
    assert!(
        notes(&tracks).contains("1 cell with positions and no outlines")
            && tracks.size() == "1 cell, 3 positions"
    );
    let modes = &motiform_tracks::modes::modes(&tracks, &motiform_tracks::modes::ModeOptions::default())[0];
    let seen: Vec<_> =
        modes.frames.iter().filter(|frame| frame.is_seen()).map(|frame| frame.centroid).collect();
    assert_eq!((seen, modes.used().count()), (vec![[3.0, 4.0], [4.0, 5.0], [4.0, 5.0]], 0));
    let error = refusal("cell,frame,i,x,y\n1,0,0,3,4\n1,0,1,4,5\n");
    assert!(error.contains("more than 2 vertices") && error.contains("or one, the position"), "{error}");
    assert!(refusal("cell,frame,i,x,y\n").contains("no vertex"));
}

#[test]
fn too_many_vertices_end_with_the_limit() {
    let limits = Limits { vertices: 100, ..Limits::default() };
    let error = read_with(csv(5), &Options { limits, ..Options::default() }).unwrap_err().to_string();
    assert!(error.contains("line 102") && error.contains("limits.vertices"), "{error}");
    let limits = Limits { outlines: 3, ..Limits::default() };
    let error = read_with(csv(5), &Options { limits, ..Options::default() }).unwrap_err().to_string();
    assert!(error.contains("limits.outlines"), "{error}");
    // a count of nodes is not believed
    let error = refusal("#QuimP11 Node data\n#Frame 1\n1000000000\n0.0\t1\t2\n");
    assert!(error.contains("node 2 of 1000000000"), "{error}");
    let limits = Limits { piece: 1000, ..Limits::default() };
    let long = format!("x,y,frame{}\n", ",z".repeat(1000));
    assert!(
        read_with(long, &Options { limits, ..Options::default() })
            .unwrap_err()
            .to_string()
            .contains("limits.piece")
    );
}

#[test]
fn one_frame_twice() {
    let text = csv(4);
    let again: String =
        text.lines().filter(|line| line.starts_with("a,2,")).map(|line| format!("{line}\n")).collect();
    let tracks = read(format!("{text}{again}")).unwrap();
    assert!(notes(&tracks).contains("the same outline several times in frame 2"));
    assert_eq!(tracks.cells[0].frames.len(), 4);
    let other = again.replace("a,2,0,", "a,2,0,9");
    let tracks = read(format!("{text}{other}")).unwrap();
    assert!(notes(&tracks).contains("different outlines in frame 2; left out"));
    assert_eq!(tracks.cells[0].frames.iter().map(|o| o.frame).collect::<Vec<_>>(), [0, 1, 3]);
}

#[test]
fn two_cells_under_one_name() {
    let mut text = csv(6);
    for frame in 0..6 {
        for (i, [x, y]) in cell(frame + 50).vertices(30, 0.0).iter().enumerate() {
            text += &format!("a,{frame},{i},{x},{y}\n");
        }
    }
    let error = refusal(text);
    assert!(
        error.contains("6 of its 6 frames") && error.contains("a name of its own in a column"),
        "{error}"
    );
}

#[test]
fn cells_filed_twice() {
    let text = csv(4);
    let again: String =
        text.lines().skip(1).map(|line| format!("{}\n", line.replacen('a', "b", 1))).collect();
    let tracks = read(format!("{text}{again}")).unwrap();
    assert!(notes(&tracks).contains("cells a and b have the same outlines in 4 frames"));
    // with another first vertex as well
    let shifted: String = again
        .lines()
        .map(|line| {
            let fields: Vec<&str> = line.split(',').collect();
            let i = (fields[2].parse::<u32>().unwrap() + 7) % 40;
            format!("b,{},{i},{},{}\n", fields[1], fields[3], fields[4])
        })
        .collect();
    assert!(notes(&read(format!("{text}{shifted}")).unwrap()).contains("cells a and b have the same"));
}

#[test]
fn sentinel_frames() {
    let text = csv(8);
    for (frame, out) in [("-1", -1), ("65535", 65535)] {
        let tracks = read(text.replace("a,7,", &format!("a,{frame},"))).unwrap();
        assert_eq!(tracks.cells[0].frames.len(), 7, "{out}");
        assert!(notes(&tracks).contains(&format!("frame {out} far from all others")), "{}", notes(&tracks));
    }
    // a pause is no sentinel
    assert_eq!(read(text.replace("a,7,", "a,60,")).unwrap().cells[0].frames.len(), 8);
}

#[test]
fn closed_polygons_lose_their_last_vertex() {
    let points = &outlines(1)[0];
    let mut text = csv(1);
    text += &format!("a,0,40,{},{}\n", points[0][0], points[0][1]);
    assert_eq!(&read(text).unwrap().cells[0].frames[0].points, points);
}
