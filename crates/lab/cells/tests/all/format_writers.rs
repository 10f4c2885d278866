//! One cell, written in every format that is read. Coordinates are pixels; the formats that have a scale say it.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_store::columns::{Column, Values, encode};
use std::fmt::Write;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Length of a pixel (um) and time between frames (s).
pub(crate) const SCALE: [f64; 2] = [0.1, 0.5];

pub(crate) type Outlines = [Vec<[f64; 2]>];

fn put(folder: &Path, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, content).unwrap();
    path
}

pub(crate) fn csv(folder: &Path, outlines: &Outlines) -> Vec<PathBuf> {
    let mut text = String::from("cell,frame,i,x,y\n");
    for (frame, points) in outlines.iter().enumerate() {
        for (i, [x, y]) in points.iter().enumerate() {
            _ = writeln!(text, "a,{frame},{i},{x},{y}");
        }
    }
    vec![put(folder, "a.csv", text)]
}

pub(crate) fn parquet(folder: &Path, outlines: &Outlines) -> Vec<PathBuf> {
    let rows = || {
        outlines
            .iter()
            .enumerate()
            .flat_map(|(frame, points)| points.iter().enumerate().map(move |(i, p)| (frame, i, p)))
    };
    let whole = |of: &dyn Fn(usize, usize) -> usize| {
        Values::Whole(rows().map(|(frame, i, _)| i64::try_from(of(frame, i)).unwrap()).collect())
    };
    let columns = [
        Column::new("cell", "cell", Values::Text(rows().map(|_| "a".to_owned()).collect())),
        Column::new("frame", "frame", whole(&|frame, _| frame)),
        Column::new("i", "vertex", whole(&|_, i| i)),
        Column::new("x", "x", Values::Number(rows().map(|(.., p)| p[0]).collect())),
        Column::new("y", "y", Values::Number(rows().map(|(.., p)| p[1]).collect())),
    ];
    vec![put(folder, "a.parquet", encode(&columns, Vec::new()).unwrap())]
}

/// Vertices relative to the spot, in um.
pub(crate) fn trackmate(folder: &Path, outlines: &Outlines) -> Vec<PathBuf> {
    let [pixel, interval] = SCALE;
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<TrackMate version=\"7\">\n<Model spatialunits=\"micron\" timeunits=\"sec\">\n<AllSpots>",
    );
    for (frame, points) in outlines.iter().enumerate() {
        let spot = [0, 1].map(|k| pixel * points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64);
        let relative: Vec<String> =
            points.iter().map(|p| format!("{} {}", pixel * p[0] - spot[0], pixel * p[1] - spot[1])).collect();
        _ = writeln!(
            text,
            "<Spot ID=\"{frame}\" FRAME=\"{frame}\" POSITION_T=\"{}\" POSITION_X=\"{}\" POSITION_Y=\"{}\" ROI_N_POINTS=\"{}\">{}</Spot>",
            interval * frame as f64,
            spot[0],
            spot[1],
            points.len(),
            relative.join(" ")
        );
    }
    text += "</AllSpots><AllTracks><Track TRACK_ID=\"0\">";
    for frame in 1..outlines.len() {
        _ = write!(text, "<Edge SPOT_SOURCE_ID=\"{}\" SPOT_TARGET_ID=\"{frame}\" />", frame - 1);
    }
    _ = write!(
        text,
        "</Track></AllTracks></Model><Settings><ImageData width=\"20000\" height=\"20000\" pixelwidth=\"{pixel}\" \
         timeinterval=\"{interval}\"/></Settings></TrackMate>"
    );
    vec![put(folder, "a.xml", text)]
}

pub(crate) fn quimp_table(folder: &Path, outlines: &Outlines) -> Vec<PathBuf> {
    let mut text = String::from("position\torigin\tspeed\tcurvature\tnode_x\tnode_y\n");
    for (frame, points) in outlines.iter().enumerate() {
        _ = writeln!(text, "#frame {frame}");
        points.iter().for_each(|[x, y]| _ = writeln!(text, "0.5\t0\t0\t0.1\t{x}\t{y}"));
    }
    vec![put(folder, "a_snake.csv", text)]
}

/// Nodes, and the parameter file beside them, which has the scale.
pub(crate) fn quimp_nodes(folder: &Path, outlines: &Outlines) -> Vec<PathBuf> {
    let mut text =
        String::from("#QuimP11 Node data\n#Node Position\tX-coord\tY-coord\tOrigin\tG-Origin\tSpeed\n#");
    for (frame, points) in outlines.iter().enumerate() {
        _ = write!(text, "\n#Frame {frame}\n{}", points.len());
        for (k, [x, y]) in points.iter().enumerate() {
            _ = write!(text, "\n0.{k:06}\t{x}\t{y}\t0\t0\t0\t-2\t-2\t-2");
        }
    }
    let [pixel, interval] = SCALE;
    put(
        folder,
        "a.paQP",
        format!("#p2 - QuimP parameter file (QuimP11)\n\n#File directory\nx\n#Scale\n{pixel}\n{interval}\n"),
    );
    vec![put(folder, "a.snQP", text)]
}

/// Seconds and um.
pub(crate) fn amoepy(folder: &Path, outlines: &Outlines) -> Vec<PathBuf> {
    let mut text = String::from("# time_0 & X_0,0 & Y_0,0; Units: s, um\n");
    for (frame, points) in outlines.iter().enumerate() {
        let values: Vec<String> = points.iter().flatten().map(|x| (SCALE[0] * x).to_string()).collect();
        _ = writeln!(text, "{:.6} {}", SCALE[1] * frame as f64, values.join(" "));
    }
    vec![put(folder, "a.txt", text)]
}

/// A polygon as ImageJ has it: whole pixels, or `f32` beside them.
fn region(position: u32, points: &[[f64; 2]], fine: bool) -> Vec<u8> {
    let whole = |x: f64| if fine { x.floor() as i16 } else { x.round() as i16 };
    let low = [0, 1].map(|k| points.iter().map(|p| whole(p[k])).min().unwrap());
    let mut bytes = vec![0_u8; 64];
    bytes[..4].copy_from_slice(b"Iout");
    bytes[4..6].copy_from_slice(&227_u16.to_be_bytes());
    bytes[8..10].copy_from_slice(&low[1].to_be_bytes());
    bytes[10..12].copy_from_slice(&low[0].to_be_bytes());
    bytes[16..18].copy_from_slice(&u16::try_from(points.len()).unwrap().to_be_bytes());
    bytes[50..52].copy_from_slice(&(if fine { 128_u16 } else { 0 }).to_be_bytes());
    bytes[56..60].copy_from_slice(&position.to_be_bytes());
    for k in 0..2 {
        bytes.extend(points.iter().flat_map(|p| (whole(p[k]) - low[k]).to_be_bytes()));
    }
    for k in 0..if fine { 2 } else { 0 } {
        bytes.extend(points.iter().flat_map(|p| (p[k] as f32).to_be_bytes()));
    }
    bytes
}

/// A file for each frame, named `FRAME-CELL.roi`.
pub(crate) fn regions(folder: &Path, outlines: &Outlines) -> Vec<PathBuf> {
    let file = |(frame, points): (usize, &Vec<[f64; 2]>)| {
        put(folder, &format!("{frame}-1.roi"), region(0, points, true))
    };
    outlines.iter().enumerate().map(file).collect()
}

fn zipped(folder: &Path, outlines: &Outlines, fine: bool) -> Vec<PathBuf> {
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (frame, points) in outlines.iter().enumerate() {
        archive.start_file(format!("{frame}-1.roi"), zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(&region(0, points, fine)).unwrap();
    }
    vec![put(folder, "a.zip", archive.finish().unwrap().into_inner())]
}

pub(crate) fn archive(folder: &Path, outlines: &Outlines) -> Vec<PathBuf> {
    zipped(folder, outlines, true)
}

/// Whole pixels alone.
pub(crate) fn pixelated(folder: &Path, outlines: &Outlines) -> Vec<PathBuf> {
    zipped(folder, outlines, false)
}

pub(crate) fn wkt(folder: &Path, outlines: &Outlines) -> Vec<PathBuf> {
    let mut text = String::from("cell,frame,wkt\n");
    for (frame, points) in outlines.iter().enumerate() {
        let closed: Vec<String> =
            points.iter().chain(points.first()).map(|[x, y]| format!("{x} {y}")).collect();
        _ = writeln!(text, "a,{frame},\"POLYGON (({}))\"", closed.join(", "));
    }
    vec![put(folder, "a.wkt", text)]
}
