//! Tables as other programs and other countries write them.

use super::common::{outlines, read, read_with, refusal};
use motiform_tracks::{Options, Tracks};

/// The same outlines as a table: header, separator, how a number is written, and what stands for the frame.
fn table(
    header: &str,
    separator: char,
    number: impl Fn(f64) -> String,
    frame: impl Fn(usize) -> String,
) -> String {
    let mut text = format!("{header}\n");
    for (k, points) in outlines(6).iter().enumerate() {
        for [x, y] in points {
            text += &format!("a{separator}{}{separator}{}{separator}{}\n", frame(k), number(*x), number(*y));
        }
    }
    text
}

fn plain() -> Tracks {
    read(table("cell,frame,x,y", ',', |x| x.to_string(), |k| k.to_string())).expect("a plain table")
}

fn times(tracks: &Tracks) -> Vec<f64> {
    tracks.cells[0].frames.iter().map(|outline| outline.t).collect()
}

fn frames(tracks: &Tracks) -> Vec<i64> {
    tracks.cells[0].frames.iter().map(|outline| outline.frame).collect()
}

#[test]
fn semicolons_and_decimal_commas() {
    let comma = |x: f64| x.to_string().replace('.', ",");
    for (separator, header) in [(';', "cell;frame;x;y"), ('\t', "cell\tframe\tx\ty")] {
        let found = read(table(header, separator, comma, |k| k.to_string())).expect("European");
        assert_eq!(found.cells, plain().cells);
    }
    // where commas separate, a decimal one is refused: it cannot be told from a column
    assert!(refusal(table("cell,frame,x,y", ',', comma, |k| k.to_string())).contains("decimal commas?"));
}

#[test]
fn units_in_the_header_are_those_of_the_values() {
    for header in [
        "cell,frame,x [um],y [um]",
        "cell,frame,X (µm),Y (µm)",
        "cell_id,frame,x_um,y_um",
        "id,frame,POSITION_X_um,POSITION_Y_µm",
    ] {
        let found = read(table(header, ',', |x| x.to_string(), |k| k.to_string())).expect("units");
        assert_eq!((found.length_unit.as_str(), &found.cells), ("um", &plain().cells), "{header}");
    }
    // the smallest x of a cell is no x in minutes, and a column x goes before one with a unit
    for header in ["cell,frame,x_min,x,y_min,y", "cell,frame,x_um,x,y_um,y"] {
        let mut text = format!("{header}\n");
        for (k, points) in outlines(6).iter().enumerate() {
            points.iter().for_each(|[x, y]| text += &format!("a,{k},7.5,{x},8.5,{y}\n"));
        }
        let found = read(text).expect("bounding boxes beside vertices");
        assert_eq!((found.length_unit.as_str(), &found.cells), ("pixel", &plain().cells), "{header}");
    }
    // a last word that is no unit belongs to the name
    let none =
        ["cell,frame,x [px],y [px]", "cell,frame,x_px,y px", "cell,frame,x_,y_", "cell,frame,pos_x,pos_y"];
    for header in none {
        let pixels = read(table(header, ',', |x| x.to_string(), |k| k.to_string())).expect("pixels");
        assert_eq!((pixels.length_unit.as_str(), &pixels.cells), ("pixel", &plain().cells), "{header}");
    }
    // a table in um is read with a pixel of 1; another one contradicts it
    let um = table("cell,frame,x [um],y [um]", ',', |x| x.to_string(), |k| k.to_string());
    let with = |size| read_with(&um, &Options { pixel_size: Some(size), ..Options::default() });
    assert_eq!(with(1.0).expect("the same").cells, plain().cells);
    assert!(with(0.2).expect_err("another").to_string().contains("already in um"));
}

#[test]
fn a_column_of_times_stands_for_frames() {
    let seconds = |k: usize| format!("{}", 2.5 * k as f64 - 5.0);
    let found = read(table("cell,time [s],x,y", ',', |x| x.to_string(), seconds)).expect("times");
    assert_eq!((found.time_unit.as_str(), times(&found)), ("s", vec![-5.0, -2.5, 0.0, 2.5, 5.0, 7.5]));
    assert_eq!(frames(&found), [-2, -1, 0, 1, 2, 3], "frames before a stimulus at 0 are kept");
    let word = read(table("cell,time_s,x,y", ',', |x| x.to_string(), seconds)).expect("times");
    assert_eq!((word.time_unit.as_str(), times(&word)), ("s", times(&found)));
    // a gap in time is a gap of frames
    let gap = |k: usize| format!("{}", 10 * if k < 3 { k } else { k + 2 });
    let found = read(table("cell,t (min),x,y", ',', |x| x.to_string(), gap)).expect("a gap");
    assert_eq!((found.time_unit.as_str(), frames(&found)), ("min", vec![0, 1, 2, 5, 6, 7]));
    // an interval that the times do not have is refused
    let options = Options { interval: Some(3.0), ..Options::default() };
    let wrong = read_with(table("cell,time [s],x,y", ',', |x| x.to_string(), seconds), &options);
    assert!(wrong.expect_err("contradiction").to_string().contains("frame interval"));
    // whole numbers in steps of one and without a unit are counts
    let counts = read(table("cell,t,x,y", ',', |x| x.to_string(), |k| k.to_string())).expect("counts");
    assert_eq!((counts.time_unit.as_str(), &counts.cells), ("frame", &plain().cells));
}

#[test]
fn fractional_frames_are_times_in_frames() {
    let found = read(table("cell,frame,x,y", ',', |x| x.to_string(), |k| format!("{}", 0.5 * k as f64)))
        .expect("halves");
    assert_eq!(frames(&found), [0, 1, 2, 3, 4, 5]);
    assert_eq!((found.time_unit.as_str(), times(&found)[5]), ("frame", 2.5));
    let options = Options { interval: Some(4.0), ..Options::default() };
    let found = read_with(
        table("cell,frame,x,y", ',', |x| x.to_string(), |k| format!("{}", 0.5 * k as f64)),
        &options,
    );
    assert_eq!(times(&found.expect("halves"))[5], 10.0);
    assert!(
        refusal(table("cell,frame,x,y", ',', |x| x.to_string(), |_| "x".to_owned()))
            .contains("frame is \"x\"")
    );
}

#[test]
fn negative_frames_before_a_stimulus_are_frames_and_a_single_one_is_none() {
    let from = |first: i64| {
        read(table(
            "cell,frame,x,y",
            ',',
            |x| x.to_string(),
            |k| (first + i64::try_from(k).expect("few")).to_string(),
        ))
        .expect("frames")
    };
    assert_eq!(frames(&from(-3)), [-3, -2, -1, 0, 1, 2]);
    assert_eq!(frames(&from(-1)), [0, 1, 2, 3, 4], "-1 alone stands for none");
    let of = |all: [i64; 6]| {
        read(table("cell,frame,x,y", ',', |x| x.to_string(), |k| all[k].to_string())).expect("frames")
    };
    assert_eq!(frames(&of([-999, -998, 0, 1, 2, 3])), [0, 1, 2, 3]);
    let gap = [-9, -8, -7, -2, -1, 0];
    assert_eq!(frames(&of(gap)), gap, "a record before a stimulus may have a gap");
}

#[test]
fn names_in_latin_1_are_read() {
    let text = table("cell,frame,x [µm],y [µm]", ',', |x| x.to_string(), |k| k.to_string())
        .replace("\na,", "\nZürich,");
    let latin: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).expect("Latin-1")).collect();
    let found = read(latin).expect("Latin-1");
    assert_eq!((found.cells[0].name.as_str(), found.length_unit.as_str()), ("Zürich", "um"));
    assert_eq!(found.cells[0].frames, plain().cells[0].frames);
}

/// A column of times beside one of frames, and an interval: they agree, or the file is refused; times that only repeat the frames are none.
#[test]
fn times_beside_frames_agree_with_the_interval() {
    let both = |header: &str, per_frame: f64| {
        table(header, ',', |x| x.to_string(), |k| format!("{},{}", k + 3, per_frame * k as f64))
    };
    let with = |text: String, interval: f64| {
        read_with(text, &Options { interval: Some(interval), ..Options::default() })
    };
    let minutes = "cell,frame,time [min],x,y";
    let found = with(both(minutes, 0.5), 30.0).expect("half a minute");
    assert_eq!((found.time_unit.as_str(), times(&found)[5]), ("min", 2.5));
    let error = with(both(minutes, 0.5), 10.0).expect_err("contradiction").to_string();
    assert!(error.contains("frame interval = 0.5 min") && error.contains("interval says 10 s"), "{error}");
    // without a unit the times are in that of the option
    assert!(with(both("cell,frame,t,x,y", 2.0), 2.0).is_ok_and(|found| times(&found)[5] == 10.0));
    assert!(with(both("cell,frame,t,x,y", 2.0), 3.0).is_err());
    let repeated = table("cell,frame,t,x,y", ',', |x| x.to_string(), |k| format!("{k},{k}"));
    assert_eq!(times(&with(repeated, 4.0).expect("counts"))[5], 20.0);
}

#[test]
fn units_of_a_header_that_are_not_known_or_differ_are_refused() {
    let seen = |header: &str| table(header, ',', |x| x.to_string(), |k| k.to_string());
    for (header, found) in [
        ("cell,frame,x [um],y [mm]", "different units, um and mm"),
        ("cell,frame,x [um],y [px]", "different units, um and pixel"),
        ("cell,frame,x [um],y", "different units, um and none"),
        ("cell,frame,x [\u{c5}],y [\u{c5}]", "the unit \"\u{c5}\" of the column"),
        ("cell,time [fortnights],x,y", "the unit \"fortnights\" of the column"),
        ("cell,time [um],x,y", "is not one of ms, s, min, h, d"),
        ("cell,frame [s],x,y", "a unit of time, s"),
    ] {
        let error = refusal(seen(header));
        assert!(error.contains(found) && error.contains("; "), "{header}: {error}");
    }
    let days = read(seen("cell,time [days],x [cm],y (cm)")).expect("days");
    assert_eq!((days.time_unit.as_str(), days.length_unit.as_str()), ("d", "cm"));
    assert!(read(seen("cell,frame [frames],x [],y")).is_ok());
}

/// Times in parts are those in seconds; rows of separators alone, as spreadsheets write them, are none.
#[test]
fn times_in_hours_minutes_and_seconds() {
    let with = |header: &str, time: &dyn Fn(usize) -> String| {
        read(table(&format!("cell;{header};x;y"), ';', |x| x.to_string(), |k| time(20 * k + 3590)) + ";;;\n")
    };
    let seconds = with("time [s]", &|t: usize| t.to_string()).expect("seconds");
    assert_eq!(times(&seconds)[..2], [3590.0, 3610.0]);
    let clock = |t: usize| format!("{}:{:02}:{:02}", t / 3600, t / 60 % 60, t % 60);
    for (header, time) in [
        ("time", &clock as &dyn Fn(usize) -> String),
        ("Time (hh:mm:ss)", &|t: usize| clock(t) + ",0"),
        ("t [min:s]", &|t: usize| format!("{}:{:02}", t / 60, t % 60)),
    ] {
        let found = with(header, time).expect(header);
        assert_eq!((found.time_unit.as_str(), &found.cells), ("s", &seconds.cells), "{header}");
    }
    // two parts may be minutes and seconds, or hours and minutes
    for (header, time) in [
        ("time", &(|t: usize| format!("{}:{:02}", t / 60, t % 60)) as &dyn Fn(usize) -> String),
        ("time [s]", &clock),
        ("time", &|t: usize| if t < 3600 { t.to_string() } else { clock(t) }),
        ("time [h:m:s]", &|t: usize| t.to_string()),
        ("time [h:m:s]", &|t: usize| format!("0:{}:{}", t / 60, t % 60)),
    ] {
        let error = with(header, time).expect_err("no common clock").to_string();
        assert!(error.contains("time [mm:ss]"), "{header}: {error}");
    }
}
