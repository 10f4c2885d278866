//! Simulated bodies as cells in a file.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_cells::Sample;
use motiform_dynamics::Normal;
use motiform_lab::simulate::simulate;
use motiform_models::amplitudes::NAME;
use motiform_study::presets::find_any;
use motiform_study::{RunPlan, Study};
use motiform_tracks::modes::ModeOptions;
use motiform_tracks::synthetic::Synthetic;
use motiform_tracks::{Options, Outline, write_csv};

/// Undeformed radius of a body whose largest deformation is of order 1.
pub(crate) const RADIUS: f64 = 2.0;

/// The study of a preset with noise, sampled every `dt`.
pub(crate) fn preset(name: &str, noise: f64, (dt, frames): (f64, usize)) -> Study {
    let mut study = find_any(name, NAME).unwrap();
    sampled(&mut study, noise, (dt, frames));
    study
}

pub(crate) fn sampled(study: &mut Study, noise: f64, (dt, frames): (f64, usize)) {
    study.run.transient = 2000.0;
    study.run.dt_out = dt;
    study.run.t_end = dt * (frames - 1) as f64;
    study.run.noise = noise;
    study.run.seed = 3;
}

/// The columns of a trajectory that are the modes z2, z3, ...
fn modes(columns: &dyn Fn(&str) -> Option<Vec<f64>>, row: usize) -> Vec<[f64; 2]> {
    let value = |name: &str| columns(name).map_or(0.0, |column| column[row]);
    if columns("s11").is_some() {
        return vec![[0.5 * value("s11"), -0.5 * value("s12")], [0.5 * value("u111"), 0.5 * value("u222")]];
    }
    let mode = |n: usize| {
        columns(&format!("z{n}_re")).map(|_| [value(&format!("z{n}_re")), value(&format!("z{n}_im"))])
    };
    (2..).map_while(mode).collect()
}

/// The body as outlines about a circle of this radius, with noisy vertices; frames are numbered from 0.
pub(crate) fn outlines(study: &Study, radius: f64, vertex_noise: f64) -> Vec<Outline> {
    let dataset = simulate(&RunPlan::new(study).unwrap(), &()).unwrap();
    let column = |name: &str| dataset.trajectory.get(name).map(<[f64]>::to_vec);
    let [t, x, y] = ["t", "x", "y"].map(|name| column(name).unwrap());
    let mut normal = Normal::new(study.run.seed.wrapping_add(8), 0);
    let frames = (0..t.len()).map(|row| {
        let body = Synthetic { centre: [x[row], y[row]], r0: radius, z: modes(&column, row) };
        let mut points = body.vertices(48, 0.0);
        for point in &mut points {
            point.iter_mut().for_each(|x| *x += vertex_noise * radius * normal.next());
        }
        Outline { frame: i64::try_from(row).unwrap(), t: row as f64, points, missing: 0 }
    });
    frames.collect()
}

/// The body as a cell with noisy vertices, written to a CSV file and read again.
pub(crate) fn cell(study: &Study, vertex_noise: f64) -> Sample {
    cell_of(study, RADIUS, vertex_noise)
}

/// The same with another radius.
pub(crate) fn cell_of(study: &Study, radius: f64, vertex_noise: f64) -> Sample {
    let tracks = crate::recordings::tracks(vec![outlines(study, radius, vertex_noise)]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cells.csv");
    write_csv(&tracks, &path).unwrap();
    let options = Options { interval: Some(study.run.dt_out), pixel_size: Some(1.0), ..Options::default() };
    Sample::read(&[path], &options, &ModeOptions::default()).unwrap()
}
