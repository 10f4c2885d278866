//! Outlines in memory.

use motiform_tracks::synthetic::Synthetic;
use motiform_tracks::{Cell, Error, Given, Note, Outline, given};

fn about() -> Given {
    Given { length_unit: "um".to_owned(), time_unit: "s".to_owned(), y_down: None }
}

fn cell(times: &[f64]) -> Cell {
    let outline = |&t: &f64| {
        let shape = Synthetic { centre: [t, 0.0], r0: 5.0, z: vec![[0.2, 0.1]] };
        Outline { frame: 0, t, points: shape.vertices(40, 0.0), missing: 0 }
    };
    Cell { name: "a".to_owned(), frames: times.iter().map(outline).collect() }
}

fn frames(cell: &Cell) -> Vec<i64> {
    cell.frames.iter().map(|outline| outline.frame).collect()
}

#[test]
fn frames_are_counted_in_intervals() {
    let tracks = given(vec![cell(&[1.0, 0.0, 0.5, 2.5])], about()).unwrap();
    assert_eq!(frames(&tracks.cells[0]), [0, 1, 2, 5]);
    assert!(tracks.notes.is_empty());
    let uneven = given(vec![cell(&[0.0, 1.0, 2.3, 3.0])], about()).unwrap();
    assert_eq!(frames(&uneven.cells[0]), [0, 1, 2, 3]);
    assert_eq!(uneven.notes, [Note::UnevenTimes { cell: "a".to_owned() }]);
}

#[test]
fn outlines_are_closed_once_and_without_lost_vertices() {
    let mut one = cell(&[0.0, 1.0]);
    let first = one.frames[0].points[0];
    one.frames[0].points.push(first);
    one.frames[1].points[7][1] = f64::NAN;
    let tracks = given(vec![one], about()).unwrap();
    let found: Vec<_> =
        tracks.cells[0].frames.iter().map(|outline| (outline.points.len(), outline.missing)).collect();
    assert_eq!(found, [(40, 0), (39, 1)]);
    assert_eq!(tracks.notes, [Note::MissingVertices { cell: "a".to_owned(), frames: vec![1] }]);
}

#[test]
fn nothing_is_refused() {
    assert!(matches!(given(Vec::new(), about()), Err(Error::NoOutlines { .. })));
}
