//! Scale and interval: from the file, from the options, never assumed.

use crate::common::{Files, cell, csv, notes, read, read_with};
use crate::formats::{amoepy, quimp_nodes};
use crate::trackmate::xml;
use motiform_tracks::{FRAME, Options, PIXEL, Tracks, area};

fn options(pixel_size: Option<f64>, interval: Option<f64>) -> Options {
    Options { pixel_size, interval, ..Options::default() }
}

fn units(tracks: &Tracks) -> (&str, &str) {
    (&tracks.length_unit, &tracks.time_unit)
}

#[test]
fn unknown_stays_pixel_and_frame() {
    let tracks = read(csv(3)).unwrap();
    assert_eq!(units(&tracks), (PIXEL, FRAME));
    let notes = notes(&tracks);
    assert!(notes.contains("(pixel_size)") && notes.contains("(interval)"), "{notes}");
}

#[test]
fn options_multiply() {
    let (plain, scaled) = (read(csv(3)).unwrap(), read_with(csv(3), &options(Some(0.5), Some(4.0))).unwrap());
    assert_eq!(units(&scaled), ("um", "s"));
    let (a, b) = (&plain.cells[0].frames[2], &scaled.cells[0].frames[2]);
    assert_eq!((area(&b.points), b.t), (0.25 * area(&a.points), 8.0));
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = read_with(csv(1), &options(Some(wrong), None)).unwrap_err().to_string();
        assert!(error.contains("pixel_size") && error.contains("above 0"), "{error}");
    }
}

/// Times whose unit nobody states are in frames, whatever their numbers, with a note that names the remedy; with a unit, from wherever,
/// they are themselves. The cell is the same.
#[test]
fn a_unit_that_nobody_states_is_none() {
    let table = |header: &str, every: i64, framed: bool| {
        let mut text = format!("{}{header},i,x,y\n", if framed { "frame," } else { "" });
        for (k, (i, [x, y])) in
            (0..6).flat_map(|k| (0..).zip(cell(k).vertices(20, 0.0)).map(move |one| (k, one)))
        {
            let frame = if framed { format!("{k},") } else { String::new() };
            text += &format!("{frame}{},{i},{x},{y}\n", every * k);
        }
        text
    };
    let times = |tracks: &Tracks| tracks.cells[0].frames.iter().map(|frame| frame.t).collect::<Vec<_>>();
    let minutes = Options { time_unit: Some("min".to_owned()), ..Options::default() };
    for framed in [false, true] {
        let bare = read(table("t", 3, framed)).unwrap();
        assert_eq!((bare.time_unit.as_str(), times(&bare)), (FRAME, vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0]));
        assert!(
            notes(&bare).contains("times, 3 from frame to frame, have no unit")
                && notes(&bare).contains("(time_unit)")
        );
        let own = vec![0.0, 3.0, 6.0, 9.0, 12.0, 15.0];
        let header = read(table("t (min)", 3, framed)).unwrap();
        let option = read_with(table("t", 3, framed), &minutes).unwrap();
        for told in [header, option] {
            assert_eq!((told.time_unit.as_str(), times(&told)), ("min", own.clone()));
            assert!(!notes(&told).contains("no unit"));
        }
        let both = read_with(table("t", 3, framed), &options(None, Some(3.0))).unwrap();
        assert_eq!((both.time_unit.as_str(), times(&both)), ("s", own));
    }
}

fn quimp(parameters: Option<&str>, options: &Options) -> Result<Tracks, motiform_tracks::Error> {
    let files = Files::new();
    let path = files.put("cell_0.snQP", quimp_nodes(3));
    if let Some(text) = parameters {
        files.put("cell_0.paQP", text);
    }
    motiform_tracks::read(&[path], options)
}

fn parameters(scale: &str, interval: &str) -> String {
    format!(
        "#p2 - QuimP parameter file\n123\nimage.tif\n/cell_0.snQP\n#Image calibration\n{scale}\n{interval}\n#more\n"
    )
}

#[test]
fn parameters_beside_the_nodes() {
    let tracks = quimp(Some(&parameters("0.25", "1.5")), &Options::default()).unwrap();
    assert_eq!(units(&tracks), ("um", "s"));
    assert_eq!(tracks.cells[0].frames[2].t, 3.0);
    assert_eq!(units(&quimp(None, &Options::default()).unwrap()), (PIXEL, FRAME));
    let damaged = quimp(Some("#p2 - QuimP\n1\n"), &Options::default()).unwrap_err().to_string();
    assert!(damaged.contains("cell_0.paQP, line 2") && damaged.contains("scale"), "{damaged}");
    let zero = quimp(Some(&parameters("0", "1")), &Options::default()).unwrap_err().to_string();
    assert!(zero.contains("line 6"), "{zero}");
}

#[test]
fn file_and_option_must_agree() {
    let said = parameters("0.25", "1.5");
    assert!(quimp(Some(&said), &options(Some(0.25), Some(1.5))).is_ok());
    let minutes = |interval| Options { time_unit: Some("min".to_owned()), ..options(None, Some(interval)) };
    assert!(quimp(Some(&said), &minutes(0.025)).is_ok_and(|tracks| tracks.cells[0].frames[2].t == 3.0));
    assert!(quimp(Some(&said), &minutes(1.5)).is_err());
    let error = quimp(Some(&said), &options(Some(0.3), None)).unwrap_err().to_string();
    assert!(error.contains("0.25 um") && error.contains("pixel_size says 0.3 um"), "{error}");
    let error = quimp(Some(&said), &options(None, Some(90.0))).unwrap_err().to_string();
    assert!(error.contains("1.5 s") && error.contains("interval says 90 s"), "{error}");
    let error = read_with(amoepy(3), &options(Some(0.3), None)).unwrap_err().to_string();
    assert!(error.contains("already in um"), "{error}");
    let minutes = Options { time_unit: Some("min".to_owned()), ..options(None, Some(1.5)) };
    assert!(read_with(amoepy(3), &minutes).unwrap_err().to_string().contains("1.5 min"));
}

#[test]
fn a_scale_of_one_stands_for_unknown() {
    let one = xml(&[(10, 0), (20, 1)], &[&[(10, 20)]], 1.0, "micron");
    let tracks = read(&one).unwrap();
    assert_eq!(tracks.length_unit, PIXEL);
    assert!(notes(&tracks).contains("often stands for unknown"));
    let told = read_with(&one, &options(Some(1.0), None)).unwrap();
    assert_eq!(told.length_unit, "um");
    let both = quimp(Some(&parameters("1.000000", "1.000")), &Options::default()).unwrap();
    assert_eq!(units(&both), (PIXEL, FRAME));
    let interval = quimp(Some(&parameters("0.2", "1.000")), &Options::default()).unwrap();
    assert_eq!(units(&interval), ("um", "s"));
}

#[test]
fn areas_that_no_cell_has_are_said() {
    let tracks = read_with(csv(3), &options(Some(1000.0), None)).unwrap();
    assert!(notes(&tracks).contains("check the scale") && notes(&tracks).contains("a pixel of 1000 um"));
    // a disc of 8 pixels: 200 pixels, that of an amoeba at 0.5 um and not at 3 um
    let said = |size: f64| notes(&read_with(csv(3), &options(Some(size), None)).unwrap());
    assert!(!said(0.5).contains("median area") && !said(0.5).contains("a pixel of"));
    assert!(said(3.0).contains("the median area of the cells is 1") && !said(3.0).contains("a pixel of"));
}

#[test]
fn files_in_different_units_are_refused() {
    let files = Files::new();
    let paths = [files.put("a", csv(2)), files.put("b", amoepy(2))];
    let error = motiform_tracks::read(&paths, &Options::default()).unwrap_err().to_string();
    assert!(error.contains("unit of length is um") && error.contains("before it pixel"), "{error}");
    let same = [files.put("a", csv(2)), files.put("b", csv(2))];
    let names: Vec<String> = motiform_tracks::read(&same, &Options::default())
        .unwrap()
        .cells
        .into_iter()
        .map(|cell| cell.name)
        .collect();
    assert_eq!(names, ["a: a", "b: a"]);
}

/// A unit that nobody knows is an error, and the known ones are named.
#[test]
fn unknown_units_of_options_are_refused() {
    for (time, length) in [(Some("fortnight"), None), (None, Some("ell"))] {
        let unit = |name: Option<&str>| name.map(str::to_owned);
        let options = Options {
            interval: Some(1.0),
            pixel_size: Some(1.0),
            time_unit: unit(time),
            length_unit: unit(length),
            ..Options::default()
        };
        let error = read_with(csv(3), &options).unwrap_err().to_string();
        assert!(error.contains("is not known") && error.contains(time.or(length).unwrap()), "{error}");
    }
    for unit in ["min", "h", "Frames", "s"] {
        let options = Options { interval: Some(1.0), time_unit: Some(unit.to_owned()), ..Options::default() };
        assert!(read_with(csv(3), &options).is_ok(), "{unit}");
    }
}

/// Times of an even clock of a sixth of a minute, rounded to a tenth: the times are those of the clock, and a note says so.
#[test]
fn rounded_times_are_those_of_their_clock() {
    for start in [0.0, 12.34] {
        let mut table = "cell,time (min),i,x (um),y (um)\n".to_owned();
        for k in 0..30 {
            let t = start + f64::from(k) / 6.0;
            for i in 0..20 {
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(i) / 20.0);
                table += &format!("a,{t:.1},{i},{},{}\n", f64::from(k) + 5.0 * cos, 5.0 * sin);
            }
        }
        let tracks = read(table).unwrap();
        let times: Vec<f64> = tracks.cells[0].frames.iter().map(|outline| outline.t).collect();
        assert!(times.windows(2).all(|pair| (pair[1] - pair[0] - 1.0 / 6.0).abs() < 0.003), "{times:?}");
        let even = times.windows(2).map(|pair| pair[1] - pair[0]);
        assert!(even.clone().fold(0.0, f64::max) - even.fold(1.0, f64::min) < 1e-9, "{times:?}");
        assert!(notes(&tracks).contains("even clock"), "{}", notes(&tracks));
    }
}

/// Cells of several positions of the stage are seen in turn: the interval is that of each cell, not that between cells.
#[test]
fn cells_with_times_of_their_own_have_their_own_interval() {
    let missing = |cell: i32, frame: i32| (7 * frame + cell) % 9 == 4;
    for late in [0.7, 0.0013, 1.0] {
        let mut text = "cell,t,x,y\n".to_owned();
        for (cell, frame) in (0..8).flat_map(|cell| (0..40).map(move |frame| (cell, frame))) {
            if !missing(cell, frame) {
                let t = 10.0 * f64::from(frame) + late * f64::from(cell);
                text += &format!("{cell},{t},{},{}\n", 3 * frame, cell + frame * frame);
            }
        }
        let bare = read(&text).unwrap();
        assert!(notes(&bare).contains("times, 10 from frame to frame"), "{late}: {}", notes(&bare));
        let told = read_with(&text, &options(Some(1.0), Some(10.0))).unwrap();
        for (k, cell) in (0..).zip(&told.cells) {
            let frames: Vec<i64> = cell.frames.iter().map(|outline| outline.frame).collect();
            let seen: Vec<i32> = (0..40).filter(|frame| !missing(k, *frame)).collect();
            let expected: Vec<i64> = seen.iter().map(|frame| i64::from(*frame)).collect();
            assert_eq!(frames, expected, "{late}");
            let times =
                cell.frames.iter().zip(seen).map(|(outline, frame)| outline.t - 10.0 * f64::from(frame));
            assert!(times.into_iter().all(|off| (off - late * f64::from(k)).abs() < 1e-9), "{late}");
        }
    }
}
