//! A file of each text format gives the outlines that were written into it.

use crate::common::{Files, csv, notes, outlines, read, read_with, refusal};
use motiform_tracks::{Columns, Format, Options, Tracks, detect};

pub(crate) fn quimp_nodes(frames: i64) -> String {
    let mut text =
        String::from("#QuimP11 Node data\n#Node Position\tX-coord\tY-coord\tOrigin\tG-Origin\tSpeed\n#");
    for (frame, points) in outlines(frames).iter().enumerate() {
        text += &format!("\n#Frame {frame}\n{}", points.len());
        for (k, [x, y]) in points.iter().enumerate() {
            text += &format!("\n0.{k:06}\t{x}\t{y}\t0\t0\t0\t-2\t-2\t-2");
        }
    }
    text
}

pub(crate) fn quimp_table(frames: i64) -> String {
    let mut text = String::from("position\torigin\tspeed\tcurvature\tnode_x\tnode_y\n");
    for (frame, points) in outlines(frames).iter().enumerate() {
        text += &format!("#frame {frame}\n");
        for [x, y] in points {
            text += &format!("0.5\t0\t0\t0.1\t{x}\t{y}\n");
        }
    }
    text
}

pub(crate) fn amoepy(frames: i64) -> String {
    let mut text = String::from("# time_0 & X_0,0 & Y_0,0; Units: s, um\n");
    for (frame, points) in outlines(frames).iter().enumerate() {
        let values: Vec<String> = points.iter().flatten().map(f64::to_string).collect();
        text += &format!("{:.6} {}\n", 1.5 * frame as f64, values.join(" "));
    }
    text
}

pub(crate) fn polygon(points: &[[f64; 2]]) -> String {
    let closed = points.iter().chain(points.first()).map(|[x, y]| format!("{x} {y}"));
    format!("POLYGON (({}))", closed.collect::<Vec<_>>().join(", "))
}

pub(crate) fn wkt(frames: i64) -> String {
    let rows = outlines(frames);
    let rows = rows.iter().enumerate().map(|(frame, points)| format!("a,{frame},\"{}\"\n", polygon(points)));
    format!("cell,frame,wkt\n{}", rows.collect::<String>())
}

/// The outlines, whatever the unit.
pub(crate) fn same(tracks: &Tracks, frames: i64) {
    assert_eq!(tracks.cells.len(), 1);
    let found = &tracks.cells[0].frames;
    assert_eq!(
        found.iter().map(|outline| outline.frame).collect::<Vec<_>>(),
        (0..frames).collect::<Vec<_>>()
    );
    for (outline, points) in found.iter().zip(outlines(frames)) {
        assert_eq!(outline.points, points);
    }
}

#[test]
fn each_format_is_found_and_read() {
    let texts = [
        (Format::Csv, csv(5)),
        (Format::QuimpNodes, quimp_nodes(5)),
        (Format::QuimpTable, quimp_table(5)),
        (Format::AmoePy, amoepy(5)),
        (Format::Wkt, wkt(5)),
    ];
    for (format, text) in texts {
        let files = Files::new();
        let path = files.put("cell.dat", &text);
        assert_eq!(detect(&path, &Options::default()).unwrap(), format);
        same(&read(&text).unwrap(), 5);
        // ends of lines, a byte order mark, a missing last line end
        same(&read(text.replace('\n', "\r\n")).unwrap(), 5);
        same(&read(format!("\u{feff}{}", text.trim_end())).unwrap(), 5);
    }
}

#[test]
fn units_of_each_format() {
    let tracks = read(amoepy(4)).unwrap();
    assert_eq!((tracks.length_unit.as_str(), tracks.time_unit.as_str(), tracks.y_down), ("um", "s", None));
    assert_eq!(tracks.cells[0].frames[3].t, 4.5);
    let tracks = read(quimp_table(4)).unwrap();
    assert_eq!(
        (tracks.length_unit.as_str(), tracks.time_unit.as_str(), tracks.y_down),
        ("pixel", "frame", Some(true))
    );
    assert_eq!(tracks.cells[0].frames[3].t, 3.0);
}

#[test]
fn gzip_is_unpacked() {
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    std::io::Write::write_all(&mut packed, csv(3).as_bytes()).unwrap();
    same(&read(packed.finish().unwrap()).unwrap(), 3);
}

#[test]
fn rows_in_any_order() {
    let text = csv(3);
    let mut rows: Vec<&str> = text.lines().skip(1).collect();
    rows.sort_by_key(|row| {
        row.bytes().map(u64::from).fold(0, |sum: u64, b| sum.wrapping_mul(31).wrapping_add(b))
    });
    same(&read(format!("cell,frame,i,x,y\n{}\n", rows.join("\n"))).unwrap(), 3);
}

#[test]
fn columns_by_name() {
    let text = csv(2).replacen("cell,frame,i,x,y", "who;when;k;east;north", 1).replace(',', ";");
    let columns = ["who", "when", "k", "east", "north"].map(|name| Some(name.to_owned()));
    let [cell, frame, i, x, y] = columns;
    let columns = Columns { cell, frame, i, x, y, wkt: None };
    same(&read_with(&text, &Options { columns, ..Options::default() }).unwrap(), 2);
    let wrong = Columns { x: Some("west".to_owned()), ..Columns::default() };
    let error =
        read_with(csv(1), &Options { format: Some(Format::Csv), columns: wrong, ..Options::default() });
    let error = error.unwrap_err().to_string();
    assert!(
        error.contains("\"west\"") && error.contains("name it") && error.contains("cell, frame, i, x, y"),
        "{error}"
    );
    same(&read(csv(2).replacen("cell,frame", "\"cell\",\"frame\"", 1)).unwrap(), 2);
    let two = refusal("track_id,particle,frame,x,y\n1,1,0,0,0\n");
    assert!(two.contains("several columns") && two.contains("name it"), "{two}");
}

#[test]
fn ambiguous_content_is_a_question() {
    let text = "cell,frame,x,y,wkt\na,0,1,2,\"POLYGON ((0 0, 1 0, 1 1))\"\n";
    let error = refusal(text);
    assert!(error.contains("csv and wkt") && error.contains("option format"), "{error}");
    let options = Options { format: Some(Format::Wkt), ..Options::default() };
    assert_eq!(read_with(text, &options).unwrap().cells[0].frames[0].points.len(), 3);
}

#[test]
fn bare_polygons() {
    let text: String = outlines(3).iter().map(|points| format!("{}\n", polygon(points))).collect();
    same(&read(text).unwrap(), 3);
    let z = read("7 MULTIPOLYGON Z (((0 0 1, 2 0 1, 2 2 1, 0 2 1, 0 0 1)))").unwrap();
    assert_eq!((z.cells[0].frames[0].frame, z.cells[0].frames[0].points.len()), (7, 4));
    assert!(refusal("0 POLYGON ((0 0, 4 0, 4 4), (1 1, 2 1, 2 2))").contains("several rings"));
    assert!(refusal("0 POLYGON ((0 0, 4 0, 4 north))").contains("north"));
    assert!(refusal("0 POLYGON ((0 0, 4 0, 4 4").contains("truncated"));
}

#[test]
fn uneven_times_are_said() {
    let text: String = [0.0, 1.0, 2.0, 3.4, 4.0].iter().map(|t| format!("{t} 0 0 4 0 4 4 0 4\n")).collect();
    let tracks = read(text).unwrap();
    assert!(notes(&tracks).contains("not multiples"));
    assert_eq!(tracks.cells[0].frames[3].t, 3.4);
    let gap: String = [0.0, 1.0, 2.0, 4.0].iter().map(|t| format!("{t} 0 0 4 0 4 4 0 4\n")).collect();
    assert_eq!(read(gap).unwrap().cells[0].frames[3].frame, 4);
    let hole = "0 0 0 4 0 4 4 0 4\n1 0 0 4 0 4 4 0 4\n2 0 0 4 0 4 4 0 4\n4 0 0 4 0 4 4 nan 4\n";
    assert!(notes(&read(hole).unwrap()).contains("not finite in frame 4"));
    assert!(refusal("1 0 0 4 0 4 4\n1 0 0 4 0 4 4\n").contains("time after that of the line before"));
}
