//! The properties of every figure: same bytes, no NaN, readable files, refusal of bad data.

use crate::drawing::drawing;
use crate::picture::Picture;
use motiform_figures::palette::{self, BLUE};
use motiform_figures::svg::Svg;
use motiform_figures::{
    Animation, Camera, Chart, Curve, FigureError, Frame, OutlineStamp, Panel, PathFigure, PathPoint,
    SectionLine, SeriesFigure, SpaceTimeFigure, SpectrumCurve, png,
};

fn wave(count: usize) -> Vec<PathPoint> {
    let point = |i: usize| {
        let t = 0.1 * i as f64;
        PathPoint { t, x: t, y: t.sin() }
    };
    (0..count).map(point).collect()
}

fn ellipse([x, y]: [f64; 2]) -> Vec<[f64; 2]> {
    (0..40).map(|i| (0.157 * f64::from(i)).sin_cos()).map(|(s, c)| [x + 0.8 * c, y + 0.5 * s]).collect()
}

fn path(points: Vec<PathPoint>) -> PathFigure {
    let stamps = points.iter().step_by(20).map(|p| OutlineStamp { t: p.t, points: ellipse([p.x, p.y]) });
    let section = SectionLine {
        from: [0.0, 0.5],
        to: [2.0, 0.5],
        label: "*y* = 0.5".into(),
        crossings: vec![[0.5, 0.5]],
    };
    PathFigure {
        title: "a < b & c".into(),
        caption: vec!["*κ*_2 = -0.1".into()],
        outlines: stamps.collect(),
        section: Some(section),
        segments: vec![points],
        ..PathFigure::default()
    }
}

fn series(values: Vec<Option<f64>>) -> SeriesFigure {
    let times = (0..values.len()).map(|i| i as f64).collect();
    let curve = Curve { label: "speed".into(), colour: BLUE, values };
    let panel = Panel { label: "speed".into(), curves: vec![curve], least: 0.0 };
    SeriesFigure { times, panels: vec![panel.clone(), panel], ..SeriesFigure::default() }
}

fn field(columns: usize, rows: usize, f: fn(f64, f64) -> f64) -> SpaceTimeFigure {
    let value = |i: usize| f((i % columns) as f64 / columns as f64, (i / columns) as f64 / rows as f64);
    let values = (0..columns * rows).map(value).collect();
    SpaceTimeFigure { columns, rows, values, ..SpaceTimeFigure::default() }
}

fn spectrum(power: &[f64]) -> Chart {
    let frequencies = (0..power.len()).map(|i| i as f64).collect();
    let curve = SpectrumCurve { label: "*x*".into(), colour: BLUE, power: power.to_vec() };
    Chart::spectra(frequencies, vec![curve.clone(), curve])
}

fn film(count: usize, camera: Camera) -> Animation {
    let frame = |p: &PathPoint| Frame { t: p.t, centre: [p.x, p.y], outline: ellipse([p.x, p.y]) };
    let frames = wave(count).iter().map(frame).collect();
    Animation { frames, size: 200, camera, ..Animation::default() }
}

#[test]
fn no_figure_holds_a_number_that_is_none() {
    let map = |points| Chart::return_map(["x", "y"].map(str::to_owned), points);
    let far = vec![PathPoint { t: 0.0, x: 1e9, y: 1e9 }, PathPoint { t: 1.0, x: 1e9 + 1e-6, y: 1e9 }];
    let lone = PathFigure { segments: vec![vec![], wave(1), vec![]], ..PathFigure::default() };
    let still = PathFigure { segments: vec![vec![wave(1)[0]; 9]], ..PathFigure::default() };
    let all = [
        path(wave(300)).svg(),
        path(wave(1)).svg(),
        PathFigure { section: None, ..path(far) }.svg(),
        lone.svg(),
        still.svg(),
        series(vec![Some(1.0), None, Some(1.0), Some(2.0), None]).svg(),
        series(vec![None]).svg(),
        series(vec![Some(0.0); 5]).svg(),
        map(vec![[0.0, 0.0]]).svg(),
        map(vec![[1e-30, 2e-30], [-3e-30, 0.0]]).svg(),
        map(vec![[1e90, -1e90]]).svg(),
        field(1, 1, |_, _| 0.0).svg(),
        SpaceTimeFigure { times: (3.0, 3.0), ..field(5, 3, |t, s| 1e99 * (t - s)) }.svg(),
        spectrum(&[0.0, 1.0]).svg(),
        spectrum(&[1e-320, 1e-320, 0.0, 1e99, -1.0, 2.0, 3.0]).svg(),
    ];
    for svg in all {
        let svg = svg.expect("a figure");
        assert!(!drawing(&svg).contains("NaN") && !drawing(&svg).contains("inf"), "{}", drawing(&svg));
        assert!(!drawing(&svg).contains("9223372"), "a saturated number");
    }
}

#[test]
fn bad_data_are_refused_with_the_place() {
    let mut points = wave(5);
    points[3].y = f64::NAN;
    let error = PathFigure { segments: vec![points], ..PathFigure::default() }.svg().expect_err("NaN");
    assert_eq!(
        error.to_string(),
        "path value (t, x, y in turn) number 11 is NaN; leave undefined values out (or `None`) instead"
    );
    assert!(matches!(PathFigure::default().svg(), Err(FigureError::Empty { .. })));
    assert!(matches!(
        Chart::return_map(["x", "y"].map(str::to_owned), Vec::new()).svg(),
        Err(FigureError::Empty { .. })
    ));
    assert!(matches!(SeriesFigure::default().svg(), Err(FigureError::Empty { .. })));
    assert!(matches!(Animation::default().apng(), Err(FigureError::Empty { .. })));
    assert!(matches!(series(vec![Some(f64::INFINITY)]).svg(), Err(FigureError::NotFinite { .. })));
    let mut short = series(vec![Some(1.0); 4]);
    short.times.pop();
    assert!(matches!(short.svg(), Err(FigureError::Shape { expected: 3, got: 4, .. })));
    assert!(matches!(
        Animation { fps: 0.0, ..film(3, Camera::Auto) }.apng(),
        Err(FigureError::OutOfRange { .. })
    ));
    assert!(matches!(SpaceTimeFigure::default().svg(), Err(FigureError::Empty { .. })));
    assert!(matches!(
        SpaceTimeFigure { rows: 3, ..field(5, 4, |_, _| 1.0) }.svg(),
        Err(FigureError::Cells { columns: 5, rows: 3, got: 20 })
    ));
    assert!(matches!(field(2, 2, |t, _| 1.0 / t).svg(), Err(FigureError::NotFinite { index: 0, .. })));
    assert!(matches!(spectrum(&[1.0]).svg(), Err(FigureError::Empty { .. })));
    assert!(matches!(spectrum(&[1.0, 0.0, -1.0]).svg(), Err(FigureError::Empty { .. })));
    let long = SpectrumCurve { label: "*x*".into(), colour: BLUE, power: vec![1.0; 5] };
    let long = Chart::spectra(vec![1.0; 4], vec![long]);
    assert!(matches!(long.svg(), Err(FigureError::Powers { expected: 4, got: 5, .. })));
    let mut backwards = film(3, Camera::Auto);
    backwards.frames.reverse();
    assert!(matches!(backwards.apng(), Err(FigureError::Unsorted { index: 1, .. })));
}

#[test]
fn same_data_give_same_bytes() {
    let svg = || path(wave(300)).svg().expect("a figure");
    assert_eq!(svg(), svg());
    assert_eq!(png(&svg(), 1.0, &[]).expect("a png"), png(&svg(), 1.0, &[]).expect("a png"));
    assert_eq!(
        film(5, Camera::Fixed).apng().expect("a film"),
        film(5, Camera::Fixed).apng().expect("a film")
    );
}

#[test]
fn a_long_path_is_decimated() {
    let long: Vec<_> =
        (0..100_000).map(|i| 1e-4 * f64::from(i)).map(|t| PathPoint { t, x: t, y: t.sin() }).collect();
    let svg = PathFigure { segments: vec![long], ..PathFigure::default() }.svg().expect("a figure");
    assert!(drawing(&svg).len() < 20_000, "{}", drawing(&svg).len());
}

#[test]
fn large_data_give_small_drawings() {
    let noise = |t: f64, s: f64| (1e4 * (12.9898 * t + 78.233 * s).sin()).fract();
    let svg = field(5000, 300, noise).svg().expect("a figure");
    assert!(drawing(&svg).len() < 250_000, "{}", drawing(&svg).len());
    let svg = spectrum(&(0..200_000).map(|i| 1.0 + noise(f64::from(i), 0.0)).collect::<Vec<_>>()).svg();
    let svg = svg.expect("a figure");
    assert!(drawing(&svg).len() < 150_000, "{}", drawing(&svg).len());
}

#[test]
fn the_heat_map_is_drawn_with_its_first_row_and_column_at_the_lower_left() {
    // one positive cell at the origin, one negative cell at the opposite corner
    let corner = |t: f64, s: f64| {
        if t == 0.0 && s == 0.0 {
            1.0
        } else if t * s > 0.2 {
            -1.0
        } else {
            0.0
        }
    };
    let svg = field(2, 2, corner).svg().expect("a figure");
    let picture = Picture::of(&svg);
    let seen = |c: palette::Colour| {
        let places = picture.places(c);
        let n = places.len();
        assert!(n > 29_000, "{n} of 300 x 100 pixels have the colour {c}");
        (places.iter().map(|p| p.0).sum::<usize>() / n, places.iter().map(|p| p.1).sum::<usize>() / n)
    };
    let (plus, minus) = (seen(palette::signed_colour(1.0)), seen(palette::signed_colour(-1.0)));
    assert!((295..=305).contains(&(minus.0 - plus.0)) && (95..=105).contains(&(plus.1 - minus.1)));
}

#[test]
fn png_has_the_size_and_text_asked_for() {
    let svg = Svg::new(60.0, 40.0).finish();
    let bytes = png(&svg, 2.5, &[("Software", "motiform")]).expect("a png");
    let mut reader = ::png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a header");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let frame = reader.next_frame(&mut pixels).expect("an image");
    assert_eq!((frame.width, frame.height), (150, 100));
    assert!(pixels.iter().all(|p| *p == 255));
    assert_eq!(reader.info().utf8_text[0].keyword, "Software");
    assert!(
        png("no svg", 1.0, &[]).is_err() && png(&svg, 0.0, &[]).is_err() && png(&svg, f64::NAN, &[]).is_err()
    );
}

#[test]
fn films_decode_frame_by_frame() {
    for (camera, count) in [(Camera::Fixed, 12), (Camera::Follow, 12), (Camera::Auto, 1)] {
        let bytes = film(count, camera).apng().expect("a film");
        let mut reader = ::png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a header");
        let (width, height) = reader.info().size();
        assert!(width.max(height) <= 200 && width.min(height) >= 90, "{width} x {height}");
        let control = reader.info().animation_control.expect("an animation");
        assert_eq!((control.num_frames as usize, control.num_plays), (count, 0));
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        for _ in 0..count {
            reader.next_frame(&mut pixels).expect("a frame");
            let frame = reader.info().frame_control.expect("a frame control");
            assert!(frame.x_offset + frame.width <= width && frame.y_offset + frame.height <= height);
            assert_eq!(u32::from(frame.delay_den), 25 * u32::from(frame.delay_num));
        }
    }
}
