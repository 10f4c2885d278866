//! Flags: each where it belongs, and nowhere else.

use crate::common::{cell, normal};
use motiform_dynamics::Normal;
use motiform_tracks::modes::{Crossing, Flag, ModeOptions, Side, crossing, modes, outline_modes};
use motiform_tracks::synthetic::{Synthetic, blur, pixelated};
use motiform_tracks::{Cell, Image, Outline, Tracks, area};

fn tracks(frames: Vec<(i64, Vec<[f64; 2]>)>) -> Tracks {
    let outline = |(frame, points)| Outline { frame, t: frame as f64, points, missing: 0 };
    let cell = Cell { name: "a".to_owned(), frames: frames.into_iter().map(outline).collect() };
    let unit = |name: &str| name.to_owned();
    Tracks {
        cells: vec![cell],
        length_unit: unit("um"),
        time_unit: unit("s"),
        y_down: None,
        image: None,
        files: vec![],
        notes: vec![],
    }
}

/// A cell that wanders: noise of the vertices, a path that turns.
fn wandering(count: i64) -> Vec<(i64, Vec<[f64; 2]>)> {
    let mut noise = normal(11);
    let frame = |k: i64| {
        let t = 0.3 * k as f64;
        let shape = Synthetic { centre: [30.0 * (0.7 * t).sin(), 25.0 * (0.45 * t).cos()], ..cell(k) };
        let mut points = shape.vertices(50, t);
        blur(&mut points, 0.05, &mut noise);
        (k, points)
    };
    (0..count).map(frame).collect()
}

fn flags(tracks: &Tracks) -> Vec<(i64, &'static str)> {
    let all = modes(tracks, &ModeOptions::default());
    all[0].frames.iter().flat_map(|f| f.flags.iter().map(|flag| (f.frame, flag.name()))).collect()
}

#[test]
fn a_sound_cell_has_no_flag() {
    let tracks = tracks(wandering(150));
    assert_eq!(flags(&tracks), []);
    let all = modes(&tracks, &ModeOptions::default());
    assert_eq!((all[0].used().count(), all[0].left_out().count()), (150, 0));
    assert!((all[0].sigma.unwrap() / 0.05 - 1.0).abs() < 0.05);
}

#[test]
fn what_happens_in_time() {
    let mut frames = wandering(40);
    frames[10].1.iter_mut().flatten().for_each(|x| *x *= 1.4);
    frames[20].1 = frames[19].1.iter().copied().cycle().skip(9).take(50).collect();
    frames.drain(30..33);
    assert_eq!(flags(&tracks(frames)), [(10, "area jump"), (20, "repeated frame"), (33, "gap")]);
}

fn shifted(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().map(|[x, y]| [x + 60.0, y - 45.0]).collect()
}

fn reason(frames: Vec<(i64, Vec<[f64; 2]>)>) -> Option<String> {
    modes(&tracks(frames), &ModeOptions::default())[0].inconsistent()
}

/// A frame of another cell is left out; the record remains that of one cell.
#[test]
fn a_frame_elsewhere_is_left_out() {
    let mut frames = wandering(40);
    frames[10].1 = shifted(&frames[10].1);
    for frame in &mut frames[20..22] {
        frame.1 = shifted(&frame.1);
    }
    assert_eq!(
        flags(&tracks(frames.clone())),
        [(10, "position jump"), (20, "position jump"), (21, "position jump")]
    );
    assert_eq!(reason(frames), None);
}

/// Two cells under one name: in turns, in an irregular order, and one after the other.
#[test]
fn two_cells_under_one_name_are_noticed() {
    let mixed = |other: &dyn Fn(i64) -> bool| {
        let place = |(k, points): (i64, Vec<[f64; 2]>)| (k, if other(k) { shifted(&points) } else { points });
        wandering(60).into_iter().map(place).collect::<Vec<_>>()
    };
    for order in [&(|k: i64| k % 2 == 1) as &dyn Fn(i64) -> bool, &|k: i64| (k * k + k / 3) % 5_i64 < 2] {
        assert!(reason(mixed(order)).is_some_and(|why| why.contains("two cells have one name")));
    }
    // another cell has another shape
    let mut later = mixed(&|k| k >= 25);
    later[25..].iter_mut().for_each(|(_, points)| *points = squeezed(points));
    assert!(flags(&tracks(later.clone())).contains(&(25, "position step")));
    assert!(reason(later).is_some_and(|why| why.contains("frame 25")));
}

/// Longer by 8 % along x, and shorter by as much along y.
fn squeezed(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().map(|[x, y]| [1.08 * x, y / 1.08]).collect()
}

/// The stage jumps: the outline is at another place from there on, and its shape goes on. The record is that of one cell.
#[test]
fn a_stage_that_jumps_ends_no_cell() {
    let mut frames = wandering(60);
    frames[25..].iter_mut().for_each(|(_, points)| *points = shifted(points));
    assert_eq!(flags(&tracks(frames.clone())), [(25, "stage jump")]);
    assert_eq!(reason(frames), None);
}

/// A cell with two flat flanks that glides: along an axis, where its flanks lie at the extreme of all outlines, and at an angle.
#[test]
fn flat_flanks_along_an_axis_are_not_clipped() {
    let frame = |k: i64, angle: f64| {
        let place = 0.4 * k as f64;
        let flank = |side: f64| (0..=20).map(move |j| [side * 0.6 * (f64::from(j) - 10.0), -side * 5.0]);
        let cap = |side: f64| {
            (1..12).map(move |j| {
                let (sin, cos) = (std::f64::consts::PI * f64::from(j) / 12.0).sin_cos();
                [side * (6.0 + 5.0 * sin), -side * 5.0 * cos]
            })
        };
        let body = flank(1.0).chain(cap(1.0)).chain(flank(-1.0)).chain(cap(-1.0));
        let (sin, cos) = angle.sin_cos();
        let moved = body.map(|[x, y]| [x + place, y]);
        moved.map(|[x, y]| [cos * x - sin * y, sin * x + cos * y]).collect::<Vec<_>>()
    };
    for angle in [0.0, 0.5, std::f64::consts::FRAC_PI_2] {
        let frames = (0..40).map(|k| (k, frame(k, angle))).collect();
        assert_eq!(flags(&tracks(frames)), [], "{angle}");
    }
}

/// Pixels up to frame 24, micrometres from there on: no frame of either part is an outlier.
#[test]
fn a_unit_that_changes_is_noticed() {
    let mut frames = wandering(60);
    for (_, points) in &mut frames[25..] {
        points.iter_mut().flatten().for_each(|x| *x *= 0.65);
    }
    let found = flags(&tracks(frames.clone()));
    assert_eq!(found.first(), Some(&(25, "area step")));
    assert!(found.iter().all(|(_, name)| *name != "area jump"), "{found:?}");
    assert!(reason(frames).is_some_and(|why| why.contains("frame 25: another unit")));
}

/// A cell that circles about a point outside of it, sampled a few times in a turn, is no other cell.
#[test]
fn coarse_sampling_is_no_jump() {
    let frame = |k: i64| {
        let angle = 0.8 * k as f64;
        let shape = Synthetic { centre: [40.0 * angle.cos(), 40.0 * angle.sin()], ..cell(k) };
        (k, shape.vertices(50, 0.0))
    };
    assert_eq!(reason((0..60).map(frame).collect()), None);
}

#[test]
fn every_second_frame_is_no_gap() {
    let frames = wandering(20).into_iter().map(|(k, points)| (2 * k, points)).collect();
    assert_eq!(flags(&tracks(frames)), []);
}

#[test]
fn what_is_seen_in_one_frame() {
    let flag = |points: &[[f64; 2]]| outline_modes(points, &ModeOptions::default()).flags[0].clone();
    let round = cell(0).vertices(40, 0.0);
    assert_eq!(flag(&round[..12]), Flag::TooFewVertices { vertices: 12, least: 16 });
    assert_eq!(flag(&[round[0]; 60]), Flag::TooFewVertices { vertices: 1, least: 16 });
    let line: Vec<[f64; 2]> = (0..40).map(|k| [f64::from(k), 2.0 * f64::from(k)]).collect();
    assert_eq!(flag(&line), Flag::NoArea);
    let mut crossed = round;
    crossed.swap(10, 11);
    assert_eq!(flag(&crossed), Flag::SelfCrossing { edges: [9, 11] });
}

#[test]
fn crossings() {
    let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
    assert_eq!(crossing(&square), Crossing::None);
    let bow = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
    assert!(matches!(crossing(&bow), Crossing::At(_)));
    // two squares of pixels that touch at a corner
    let touching =
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [1.0, 1.0], [0.0, 1.0]];
    assert_eq!(crossing(&touching), Crossing::None);
    // long outlines end too: all edges overlap in x
    let comb: Vec<[f64; 2]> = (0..20_000).map(|k| [f64::from(k % 2), f64::from(k)]).collect();
    assert!(matches!(crossing(&comb), Crossing::Unknown | Crossing::At(_)));
}

/// The cell moves into a wall at x = 30, as in an image that ends there.
#[test]
fn clipped_outlines() {
    let mut frames = wandering(150);
    let clip = |x: &mut f64| *x = x.min(30.0);
    frames.iter_mut().flat_map(|frame| &mut frame.1).for_each(|point| clip(&mut point[0]));
    let touched: Vec<i64> = frames.iter().filter(|f| f.1.iter().any(|p| p[0] == 30.0)).map(|f| f.0).collect();
    let tracks = tracks(frames);
    let all = modes(&tracks, &ModeOptions::default());
    let clipped = |flag: &Flag| matches!(flag, Flag::Clipped { side: Side::Right, at, .. } if *at == 30.0);
    let found: Vec<i64> =
        all[0].frames.iter().filter(|f| f.flags.iter().any(clipped)).map(|f| f.frame).collect();
    assert!(touched.len() > 30);
    assert_eq!(found, touched);
    assert!(all[0].left_out().count() >= found.len());
}

/// A cell that glides into the border of the images, of which a half is left for the second half of the record: its area is cut off, and
/// steps to no other level. The same halved in size steps.
#[test]
fn clipped_areas_do_not_step() {
    let record = |clipped: bool| {
        let mut frames = wandering(120);
        for (k, points) in &mut frames {
            let centre =
                [0, 1].map(|c| points.iter().map(|point| point[c]).sum::<f64>() / points.len() as f64);
            // up to x = 0, from frame 60 on with the centre there
            let by = if clipped && *k >= 60 { centre[0] } else { centre[0] + 40.0 };
            let size = if !clipped && *k >= 60 { 0.7 } else { 1.0 };
            for point in points.iter_mut() {
                *point = [0, 1].map(|c| centre[c] + size * (point[c] - centre[c]));
                point[0] = (point[0] - by).min(if clipped { 0.0 } else { f64::INFINITY });
            }
        }
        modes(&tracks(frames), &ModeOptions::default()).remove(0)
    };
    let steps = |clipped: bool| {
        let found = record(clipped);
        let is = |test: fn(&Flag) -> bool| found.frames.iter().filter(|f| f.flags.iter().any(test)).count();
        (is(|flag| matches!(flag, Flag::AreaStep { .. })), is(|flag| matches!(flag, Flag::Clipped { .. })))
    };
    let (cut, clipped) = steps(true);
    assert!(cut == 0 && clipped >= 55, "{cut} {clipped}");
    assert_eq!(steps(false).0, 1);
}

/// Whole outlines that come back to the same places, with noise of the vertices: a circle of 10 or 15 frames a turn, from any phase, and a
/// cell that goes for 20 frames and rests for 20. There is no border.
#[test]
fn places_to_which_a_cell_comes_back_are_no_border() {
    let mut normal = Normal::new(15, 0);
    let mut outline = |centre: [f64; 2], heading: f64| {
        let mode = |size: f64, n: f64| [size * (n * heading).cos(), -size * (n * heading).sin()];
        let body = Synthetic { centre, r0: 8.0, z: vec![mode(0.4, 2.0), mode(0.15, 3.0)] };
        let mut points = body.vertices(40, 0.0);
        points.iter_mut().flatten().for_each(|x| *x += 0.03 * normal.next());
        points
    };
    for (turn, phase) in
        [10.0, 15.0].into_iter().flat_map(|turn| (0..12).map(move |k| (turn, 0.52 * f64::from(k))))
    {
        let at = |k: i64| phase + std::f64::consts::TAU * k as f64 / turn;
        let frame = |k: i64| (k, outline([6.0 * at(k).sin(), -6.0 * at(k).cos()], at(k)));
        assert_eq!(flags(&tracks((0..100).map(frame).collect())), [], "{turn} {phase}");
    }
    for seed in 0..8 {
        let (mut at, mut heading, mut random) = ([0.0, 0.0], 0.0, Normal::new(seed, 1));
        let mut stop_and_go = Vec::new();
        for k in 0..400 {
            heading += if k % 40 == 0 { 2.0 * random.next() } else { 0.1 * random.next() };
            let step = if k % 40 < 20 { 0.6 } else { 0.0 };
            at = [at[0] + step * heading.cos(), at[1] + step * heading.sin()];
            stop_and_go.push((k, outline(at, if step > 0.0 { heading } else { heading.round() })));
        }
        assert_eq!(flags(&tracks(stop_and_go)), [], "{seed}");
    }
}

/// A disc that comes to a border again and again, and half a unit beyond it: its rounded outline has no straight run that is long enough,
/// but its extreme stays where it is while its centroid moves.
#[test]
fn rounded_outlines_at_a_border_are_clipped() {
    let top = |k: i64| 22.0 + 6.5 * (0.12 * k as f64).sin();
    let frame = |k: i64| {
        let disc = Synthetic { centre: [0.4 * k as f64, top(k) - 8.0], r0: 8.0, z: vec![[0.0; 2]; 2] };
        let mut points = disc.vertices(80, 0.0);
        for point in points.iter_mut().filter(|point| point[1] > 28.0) {
            point[1] = 28.0 + 0.2 * (1.0 - (-10.0 * (point[1] - 28.0)).exp());
        }
        (k, points)
    };
    let found = flags(&tracks((0..220).map(frame).collect()));
    let clipped: Vec<i64> = found.iter().filter(|flag| flag.1 == "clipped").map(|flag| flag.0).collect();
    assert!(clipped.len() > 20 && clipped.iter().all(|&k| top(k) > 28.0), "{clipped:?}");
}

#[test]
fn known_images_have_known_borders() {
    let mut frames = wandering(3);
    frames.truncate(2);
    let mut tracks = tracks(frames);
    assert_eq!(flags(&tracks), []);
    let least =
        |k: usize| tracks.cells[0].frames[0].points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
    let shift = [-least(0), -least(1) + 30.0];
    for point in tracks.cells[0].frames.iter_mut().flat_map(|outline| &mut outline.points) {
        *point = [point[0] + shift[0], point[1] + shift[1]];
    }
    tracks.image = Some(Image { size: [500.0, 500.0], pixel: 1.0 });
    assert_eq!(flags(&tracks), [(0, "clipped")]);
}

#[test]
fn missing_vertices_leave_the_frame_out_from_a_tenth_on() {
    let mut tracks = tracks((0..5).map(|k| (k, cell(k).vertices(50, 0.0))).collect());
    let whole = modes(&tracks, &ModeOptions::default());
    let vertices = tracks.cells[0].frames[2].points.len();
    let limit = vertices / 10;
    for missing in [1, limit, limit + 1] {
        let outline = &mut tracks.cells[0].frames[2];
        outline.points.truncate(vertices - missing);
        outline.missing = missing;
        let found = modes(&tracks, &ModeOptions::default());
        let frame = &found[0].frames[2];
        assert_eq!(frame.flags.iter().map(Flag::name).collect::<Vec<_>>(), ["missing vertices"]);
        assert_eq!(frame.is_left_out(), 10 * missing > vertices);
        // the outline is exact: the vertices that are left give the same modes
        let (own, other) = (frame.radius.as_ref().unwrap(), whole[0].frames[2].radius.as_ref().unwrap());
        let off = own.z.iter().zip(&other.z).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
        assert!(off.fold(0.0, f64::max) < 1e-9 * other.r0, "{missing}");
    }
}

/// Outlines of pixels, as segmentations give them: star-shaped, areas to the pixel, modes to a fraction of it.
#[test]
fn pixels_are_no_folds() {
    for k in 0..20 {
        let truth = cell(k);
        let smooth = truth.vertices(400, 0.0);
        let points = pixelated(&smooth, 0.5);
        assert!((area(&points) / area(&smooth) - 1.0).abs() < 0.02 && area(&points) > 0.0);
        let modes = outline_modes(&points, &ModeOptions::default());
        let fit = modes.radius.unwrap_or_else(|| panic!("{k}: {:?}", modes.flags));
        assert!((fit.z[0][0] - truth.z[0][0]).abs() < 0.1 && modes.flags.is_empty());
    }
}
