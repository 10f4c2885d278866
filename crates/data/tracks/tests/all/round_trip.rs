//! Writers -> readers: every bit comes back.

use crate::common::{Files, cell, csv, normal, read};
use motiform_tracks::synthetic::blur;
use motiform_tracks::{Cell, Error, Options, Outline, Tracks, read as read_paths, write_amoepy, write_csv};

fn cells(names: &[&str]) -> Tracks {
    let mut noise = normal(9);
    let one = |name: &&str| {
        let mut frame = |frame: i64| {
            let mut points = cell(frame).vertices(30 + frame as usize, 0.0);
            blur(&mut points, 0.1, &mut noise);
            points.iter_mut().flatten().for_each(|x| *x *= 1e-3_f64.powi(frame as i32 % 3));
            Outline { frame, t: 1.5 * frame as f64, points, missing: 0 }
        };
        let frames = [0, 1, 2, 4, 5].map(&mut frame).to_vec();
        Cell { name: (*name).to_owned(), frames }
    };
    let cells = names.iter().map(one).collect();
    let unit = |name: &str| name.to_owned();
    Tracks {
        cells,
        files: vec![],
        length_unit: unit("um"),
        time_unit: unit("s"),
        y_down: None,
        image: None,
        notes: vec![],
    }
}

#[test]
fn csv_comes_back() {
    let files = Files::new();
    let tracks = cells(&["1", "two, with a comma", "a \"quoted\" one", " "]);
    write_csv(&tracks, &files.path("table")).unwrap();
    let options = Options { pixel_size: Some(1.0), interval: Some(1.5), ..Options::default() };
    let back = read_paths(&[files.path("table")], &options).unwrap();
    for (a, b) in tracks.cells.iter().zip(&back.cells) {
        assert_eq!((a.name.trim(), &a.frames), (b.name.as_str(), &b.frames));
    }
}

#[test]
fn amoepy_comes_back() {
    let files = Files::new();
    let tracks = cells(&["cell"]);
    write_amoepy(&tracks, &tracks.cells[0], &files.path("cell.txt")).unwrap();
    let back = read_paths(&[files.path("cell.txt")], &Options::default()).unwrap();
    assert_eq!(back.cells, tracks.cells);
    assert_eq!((back.length_unit, back.time_unit), (tracks.length_unit, tracks.time_unit));
}

#[test]
fn amoepy_needs_its_units() {
    let files = Files::new();
    let tracks = read(csv(2)).unwrap();
    let error = write_amoepy(&tracks, &tracks.cells[0], &files.path("x")).unwrap_err();
    assert!(
        matches!(&error, Error::Unwritable { .. }) && error.to_string().contains("give pixel size"),
        "{error}"
    );
}
