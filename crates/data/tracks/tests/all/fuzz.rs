//! Random bytes and damaged files of every format: an error or an answer, never a panic, never without an end.

use crate::common::{Files, csv, zip};
use crate::formats::{amoepy, quimp_nodes, quimp_table, wkt};
use crate::imagej::roi;
use crate::tables::PARQUET;
use crate::trackmate::dividing;
#[path = "../../../../lab/lab/tests/all/common/mutate.rs"]
mod mutate;
use motiform_tracks::modes::{ModeOptions, fit_radius, fold, modes, outline_modes, tangent_modes};
use motiform_tracks::{Format, Limits, Options, read};
use mutate::{each, in_turn};
use proptest::prelude::*;

fn samples() -> Vec<(Format, Vec<u8>)> {
    let points = crate::common::outlines(1).remove(0);
    let region = roi(0, 3, &points, true);
    vec![
        (Format::Csv, csv(3).into_bytes()),
        (Format::Parquet, PARQUET.to_vec()),
        (Format::TrackMate, dividing().into_bytes()),
        (Format::QuimpTable, quimp_table(2).into_bytes()),
        (Format::QuimpNodes, quimp_nodes(2).into_bytes()),
        (Format::AmoePy, amoepy(3).into_bytes()),
        (Format::Roi, region.clone()),
        (Format::RoiZip, zip(&[("1-1.roi", &region), ("2-1.roi", &region)])),
        (Format::Wkt, wkt(3).into_bytes()),
    ]
}

/// Reads and measures, and says whether it could; with the format given, detection does not stand in the way of damage.
fn follow(bytes: &[u8], format: Option<Format>) -> bool {
    let files = Files::new();
    let path = files.put("x", bytes);
    files.put("x.paQP", bytes);
    let limits = Limits { vertices: 100_000, outlines: 1000, piece: 1 << 20, file: 1 << 22 };
    match read(&[path], &Options { format, limits, ..Options::default() }) {
        Ok(tracks) => {
            let finite = |x: &f64| x.is_finite();
            assert!(
                tracks.cells.iter().flat_map(|c| &c.frames).flat_map(|o| &o.points).flatten().all(finite)
            );
            for cell in modes(&tracks, &ModeOptions::default()) {
                for fit in cell.used().filter_map(|frame| frame.radius.as_ref()) {
                    assert!(fit.z.iter().flatten().chain(&fit.unit_covariance).all(finite));
                }
            }
            true
        }
        Err(error) => {
            assert!(!error.to_string().is_empty());
            false
        }
    }
}

#[test]
fn formats() {
    for (seed, (format, sample)) in (50..).zip(samples()) {
        each(&format!("{format:?}"), (seed, 300), in_turn(&[sample]), |bytes| follow(bytes, Some(format)));
    }
}

/// Bytes replaced, left out, doubled or cut.
fn damage(mut bytes: Vec<u8>, blows: &[(u8, prop::sample::Index, u8)]) -> Vec<u8> {
    const WORDS: [&str; 12] = [
        "",
        "NaN",
        "-1",
        "1e999",
        "99999999999999999999",
        "\n",
        "\t",
        ",",
        "<",
        "\"",
        "#frame ",
        "POLYGON((",
    ];
    for (kind, at, value) in blows {
        if bytes.is_empty() {
            break;
        }
        let at = at.index(bytes.len());
        match kind % 5 {
            0 => bytes[at] = *value,
            1 => drop(bytes.remove(at)),
            2 => drop(bytes.splice(at..at, WORDS[usize::from(*value) % 12].bytes())),
            3 => bytes.truncate(bytes.len() - at % 50),
            _ => {
                let end = (at + usize::from(*value)).min(bytes.len());
                let copy = bytes[at..end].to_vec();
                drop(bytes.splice(at..at, copy));
            }
        }
    }
    bytes
}

fn blows() -> impl Strategy<Value = Vec<(u8, prop::sample::Index, u8)>> {
    prop::collection::vec(any::<(u8, prop::sample::Index, u8)>(), 1..8)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..400), format in 0..10_usize) {
        follow(&bytes, Format::ALL.get(format).copied());
    }

    #[test]
    fn random_bytes_after_the_beginning(bytes in prop::collection::vec(any::<u8>(), 0..300), start in 1..200_usize) {
        for (format, sample) in samples() {
            let mut content = sample[..start.min(sample.len())].to_vec();
            content.extend(&bytes);
            follow(&content, Some(format));
        }
    }

    #[test]
    fn damaged_files(blows in blows(), found in any::<bool>()) {
        for (format, sample) in samples() {
            follow(&damage(sample, &blows), (!found).then_some(format));
        }
    }

    /// A file of one format, read as another.
    #[test]
    fn wrong_formats(format in 0..9_usize) {
        for (_, sample) in samples() {
            follow(&sample, Some(Format::ALL[format]));
        }
    }

    /// Any polygon: an answer without NaN, or none.
    #[test]
    fn any_polygon(points in prop::collection::vec(prop::array::uniform2(-1e3..1e3_f64), 0..60), round in any::<bool>()) {
        let points: Vec<[f64; 2]> = points.into_iter().map(|p| if round { p.map(|x| (x / 300.0).round()) } else { p }).collect();
        let modes = outline_modes(&points, &ModeOptions::default());
        prop_assert!(modes.area.is_finite() && modes.centroid.iter().all(|x| x.is_finite() || points.is_empty()));
        if let Some(fit) = fit_radius(&points, 5) {
            prop_assert!(fit.z.iter().flatten().chain(&fit.centre).all(|x| x.is_finite()) && fit.sigma.is_finite());
        }
        if let Some(tangent) = tangent_modes(&points, 5) {
            prop_assert!(tangent.w.iter().flatten().all(|x| x.is_finite()));
        }
        prop_assert!(fold(&points, [0.5, 0.5]).is_none_or(|fold| fold.back.is_finite()));
    }
}
