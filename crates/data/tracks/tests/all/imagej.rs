//! ImageJ's regions, one by one and in archives.

use crate::common::{Files, notes, read, refusal, zip};
use motiform_tracks::{Options, read as read_paths};

/// A region: kind, position, integer coordinates, and floats where they are finer.
pub(crate) fn roi(kind: u8, position: u32, points: &[[f64; 2]], fine: bool) -> Vec<u8> {
    let low = [0, 1].map(|k| points.iter().map(|p| p[k].floor() as i16).min().unwrap_or(0));
    let mut bytes = vec![0_u8; 64];
    bytes[..4].copy_from_slice(b"Iout");
    bytes[4..6].copy_from_slice(&227_u16.to_be_bytes());
    bytes[6] = kind;
    bytes[8..10].copy_from_slice(&low[1].to_be_bytes());
    bytes[10..12].copy_from_slice(&low[0].to_be_bytes());
    bytes[16..18].copy_from_slice(&(points.len() as u16).to_be_bytes());
    bytes[50..52].copy_from_slice(&(if fine { 128_u16 } else { 0 }).to_be_bytes());
    bytes[56..60].copy_from_slice(&position.to_be_bytes());
    for k in 0..2 {
        bytes.extend(points.iter().flat_map(|p| (p[k].floor() as i16 - low[k]).to_be_bytes()));
    }
    for k in 0..if fine { 2 } else { 0 } {
        bytes.extend(points.iter().flat_map(|p| (p[k] as f32).to_be_bytes()));
    }
    bytes
}

const SQUARE: [[f64; 2]; 4] = [[10.0, -3.0], [14.0, -3.0], [14.0, 5.0], [10.0, 5.0]];

#[test]
fn whole_and_fine_coordinates() {
    let tracks = read(roi(0, 7, &SQUARE, false)).unwrap();
    assert_eq!(tracks.cells[0].frames[0].points, SQUARE);
    assert_eq!((tracks.cells[0].frames[0].frame, tracks.y_down), (7, Some(true)));
    let fine = SQUARE.map(|p| p.map(|x| x + 0.25));
    assert_eq!(read(roi(7, 1, &fine, true)).unwrap().cells[0].frames[0].points, fine);
}

#[test]
fn archives_of_cells_and_frames() {
    let moved = |k: f64| SQUARE.map(|[x, y]| [x + k, y]);
    let entries: Vec<(String, Vec<u8>)> = [(3, 1), (4, 1), (3, 2)]
        .map(|(frame, cell)| {
            (format!("{frame}-{cell}.roi"), roi(0, 0, &moved(f64::from(frame + 9 * cell)), false))
        })
        .to_vec();
    let entries: Vec<(&str, &[u8])> =
        entries.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())).collect();
    let tracks = read(zip(&entries)).unwrap();
    let found: Vec<(&str, usize)> =
        tracks.cells.iter().map(|cell| (cell.name.as_str(), cell.frames.len())).collect();
    assert_eq!(found, [("1", 2), ("2", 1)]);
    assert_eq!(tracks.cells[0].frames[1].frame, 4);
}

/// Names count frames from 0, positions from 1.
#[test]
fn positions_count_from_one() {
    let moved = SQUARE.map(|[x, y]| [x + 50.0, y]);
    let archive = zip(&[("4-7.roi", &roi(0, 5, &SQUARE, false)), ("4-8.roi", &roi(0, 5, &moved, false))]);
    let tracks = read(archive).unwrap();
    assert_eq!(
        tracks.cells.iter().map(|cell| (cell.name.as_str(), cell.frames[0].frame)).collect::<Vec<_>>(),
        [("7", 5), ("8", 5)]
    );
}

/// ImageJ's own names have the slice first and no cell.
#[test]
fn names_of_imagej() {
    let one = read(zip(&[("0003-0100-0200.roi", &roi(0, 0, &SQUARE, false))])).unwrap();
    assert_eq!(one.cells[0].frames[0].frame, 3);
    let none = refusal(zip(&[("0100-0200.roi", &roi(0, 0, &SQUARE, false))]));
    assert!(none.contains("entry 0100-0200.roi") && none.contains("FRAME-CELL"), "{none}");
    let named = read(zip(&[("0100-0200.roi", &roi(0, 5, &SQUARE, false))])).unwrap();
    assert_eq!(named.cells[0].frames[0].frame, 5);
}

#[test]
fn a_file_without_a_frame_is_an_error() {
    let error = refusal(roi(0, 0, &SQUARE, false));
    assert!(error.contains("no frame number") && error.contains("FRAME-CELL"), "{error}");
}

#[test]
fn several_files_are_one_cell() {
    let files = Files::new();
    let paths = [9, 8].map(|frame| {
        let moved = SQUARE.map(|[x, y]| [x, y + f64::from(frame)]);
        files.put(&format!("{frame}-31.roi"), roi(0, 0, &moved, false))
    });
    let tracks = read_paths(&paths, &Options::default()).unwrap();
    assert_eq!((tracks.cells.len(), tracks.notes.len()), (1, 2));
    assert_eq!(tracks.cells[0].frames.iter().map(|o| o.frame).collect::<Vec<_>>(), [8, 9]);
}

#[test]
fn mixed_cells_are_an_error() {
    let moved = SQUARE.map(|[x, y]| [x + 50.0, y]);
    let error = refusal(zip(&[("a.roi", &roi(0, 1, &SQUARE, false)), ("b.roi", &roi(0, 1, &moved, false))]));
    assert!(error.contains("several cells have one name") && error.contains("FRAME-CELL"), "{error}");
    let twice =
        read(zip(&[("a.roi", &roi(0, 1, &SQUARE, false)), ("b.roi", &roi(0, 1, &SQUARE, false))])).unwrap();
    assert!(notes(&twice).contains("the same outline several times in frame 1"));
}

#[test]
fn other_regions_and_damage() {
    assert!(refusal(roi(1, 1, &SQUARE, false)).contains("a rectangle"));
    assert!(refusal(zip(&[])).contains("the archive is empty"), "{}", refusal(zip(&[])));
    assert!(refusal(zip(&[("notes.txt", b"hello")])).contains("entry notes.txt"));
    let whole = roi(0, 1, &SQUARE, false);
    for length in 5..whole.len() {
        assert!(refusal(&whole[..length]).contains("truncated"), "{length}");
    }
    let archive = zip(&[("1-1.roi", &whole)]);
    for length in (5..archive.len()).step_by(7) {
        assert!(refusal(&archive[..length]).contains("cell.dat"), "{length}");
    }
}

/// An entry that unpacks to far more than the archive is not unpacked.
#[test]
fn a_zip_bomb_is_bounded() {
    let mut large = roi(0, 1, &SQUARE, false);
    large.resize(40 << 20, 0);
    let archive = zip(&[("1-1.roi", &large)]);
    assert!(archive.len() < 1 << 17);
    let error = refusal(archive);
    assert!(error.contains("entry 1-1.roi") && error.contains("limits.piece"), "{error}");
}
