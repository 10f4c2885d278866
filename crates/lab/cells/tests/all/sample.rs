//! The sample recordings in `examples/`: synthetic cells in TrackMate's format, and one as a table. `MOTIFORM_UPDATE=1 cargo test
//! --release -p motiform-cells sample::` writes them.

use super::bodies::{RADIUS, outlines, preset};
use super::recordings::{Shape, Walker};
use motiform_analysis::regime::Regime;
use motiform_cells::{Sample, observe};
use motiform_tracks::modes::ModeOptions;
use motiform_tracks::{Options, Outline, centroid};
use std::fmt::Write;
use std::path::PathBuf;

const FRAMES: usize = 100;

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../examples").join(name)
}

/// Compares a recording with that of its generator, or writes it.
fn kept(name: &str, made: &str) {
    if std::env::var_os("MOTIFORM_UPDATE").is_some() {
        std::fs::write(path(name), made).expect("examples can be written");
    }
    let stored = std::fs::read_to_string(path(name)).expect("an example");
    assert!(stored == made, "examples/{name} is not that of this test: MOTIFORM_UPDATE=1 writes it");
}

/// A chaotic cell (preset fig5b with noise) as a table: 5 um for the unit of length, 10 s for that of time, a frame every 5 s.
fn crawling() -> String {
    let study = preset("fig5b", 0.01, (0.5, 300));
    let mut text = "cell,frame,time [s],x [um],y [um]\n".to_owned();
    for outline in outlines(&study, RADIUS, 0.01) {
        for [x, y] in outline.points.iter().step_by(2).map(|point| point.map(|x| 5.0 * x + 100.0)) {
            _ = writeln!(text, "1,{},{},{x:.2},{y:.2}", outline.frame, 5 * outline.frame);
        }
    }
    text
}

/// The recording that the documents fit is that of its generator, and is read with its units.
#[test]
fn the_recording_for_fits_is_read_with_its_units() {
    kept("crawling.csv", &crawling());
    let sample = Sample::read(&[path("crawling.csv")], &Options::default(), &ModeOptions::default())
        .expect("a sound file");
    assert_eq!((sample.tracks.length_unit.as_str(), sample.tracks.time_unit.as_str()), ("um", "s"));
    let [cell] = &sample.tracks.cells[..] else { panic!("{} cells", sample.tracks.cells.len()) };
    assert_eq!((cell.frames.len(), cell.frames[1].t), (300, 5.0));
}

/// A cell that circles by the equations, a random walker whose shape fluctuates by itself and of which every tenth frame is missing,
/// and a rod.
fn cells() -> [Vec<Outline>; 3] {
    let mut study = preset("fig4", 0.01, (1.0, FRAMES));
    for name in ["kappa2", "kappa3"] {
        study.set(name, 0.5).expect("a parameter");
    }
    let circling = outlines(&study, 0.6, 0.01).into_iter();
    let circling = circling.map(|mut outline| {
        outline.points =
            outline.points.into_iter().step_by(2).map(|point| point.map(|x| 10.0 * x + 100.0)).collect();
        outline
    });
    let walker = Walker { speed: 0.8, persistence: 6.0, shape: Shape::Passive, frames: FRAMES, noise: 0.01 };
    let mut walking = walker.outlines(3);
    walking.retain(|outline| outline.frame % 10 != 7);
    walking.iter_mut().for_each(|outline| {
        outline.points =
            outline.points.iter().step_by(2).map(|p| [4.0 * p[0] + 300.0, 4.0 * p[1] + 250.0]).collect();
    });
    let rod = Walker { speed: 0.3, shape: Shape::Rod, noise: 0.005, ..walker };
    let mut rods = rod.outlines(5);
    let points = rods.iter_mut().flat_map(|outline| &mut outline.points);
    points.for_each(|point| *point = [point[0] + 100.0, point[1] + 350.0]);
    [circling.collect(), walking, rods]
}

/// TrackMate's XML: vertices relative to their spot, in um; a frame every 5 s.
fn trackmate(cells: &[Vec<Outline>]) -> String {
    let (mut spots, mut tracks) = (String::new(), String::new());
    let mut id = 0;
    for (number, cell) in cells.iter().enumerate() {
        _ = write!(tracks, "<Track TRACK_ID=\"{number}\">");
        for (k, outline) in cell.iter().enumerate() {
            let [x, y] = centroid(&outline.points).map(|value| (100.0 * value).round() / 100.0);
            let relative: Vec<String> =
                outline.points.iter().map(|p| format!("{:.2} {:.2}", p[0] - x, p[1] - y)).collect();
            _ = writeln!(
                spots,
                "<Spot ID=\"{id}\" FRAME=\"{}\" POSITION_T=\"{}\" POSITION_X=\"{x}\" POSITION_Y=\"{y}\" ROI_N_POINTS=\"{}\">{}</Spot>",
                outline.frame,
                5 * outline.frame,
                outline.points.len(),
                relative.join(" ")
            );
            if k > 0 {
                _ = write!(tracks, "<Edge SPOT_SOURCE_ID=\"{}\" SPOT_TARGET_ID=\"{id}\" />", id - 1);
            }
            id += 1;
        }
        tracks += "</Track>\n";
    }
    format!(
        "<?xml version=\"1.0\"?>\n<TrackMate version=\"7\">\n<Model spatialunits=\"micron\" timeunits=\"sec\">\n\
         <AllSpots>\n{spots}</AllSpots>\n<AllTracks>\n{tracks}</AllTracks>\n</Model>\n\
         <Settings><ImageData width=\"2500\" height=\"2500\" pixelwidth=\"0.2\" timeinterval=\"5.0\"/></Settings>\n</TrackMate>\n"
    )
}

/// The file is that of the generator, and its cells are what they were made as.
#[test]
fn the_sample_recording_is_observed() {
    let made = trackmate(&cells());
    kept("cells.xml", &made);
    let sample = Sample::read(&[path("cells.xml")], &Options::default(), &ModeOptions::default())
        .expect("a sound file");
    assert_eq!((sample.tracks.length_unit.as_str(), sample.tracks.time_unit.as_str()), ("um", "s"));
    let found: Vec<_> = sample.cells.iter().map(observe).collect();
    assert_eq!(found.len(), 3);
    assert_eq!(found[0].motion.regime, Some(Regime::Circular), "{}", found[0].motion.why);
    for one in &found {
        let known = |key: &str| {
            one.numbers
                .rows()
                .into_iter()
                .find(|row| row.quantity.name == key)
                .and_then(|row| row.value.known())
        };
        for key in ["speed", "path", "area", "aspect_ratio", "solidity"] {
            assert!(known(key).is_some(), "{}: {key}", one.cell);
        }
    }
    let walk = found[1].numbers.walk.as_ref().expect("it walks");
    assert!(walk.describes());
    // P = 6 frames of 5 s
    let (low, high) =
        (walk.persistence.low.expect("bounded"), walk.persistence.high.unwrap_or(f64::INFINITY));
    assert!(low < 30.0 && 30.0 < high, "{walk:?}");
}
