//! `motiform atlas`: regions, and the bifurcations that bound them.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{Folder, names, read_json};
use serde_json::Value;

/// The paper's Fig. 4, coarsely.
const FIG4: &str = "atlas tensor --preset fig4 --axis kappa2=0.7:1.5:33 --axis kappa3=0.08:0.32:25 --samples 2 --lines 3 --threads 2";

/// The points of the curves of a kind in `atlas.csv`, stretch by stretch.
fn curve(folder: &Folder, file: &str, kind: &str) -> Vec<Vec<[f64; 2]>> {
    let text = std::fs::read_to_string(folder.path(file)).unwrap().replace(&format!("\"{kind}\""), kind);
    let kind = kind.replace(", ", ",");
    let mut stretches: Vec<(String, Vec<[f64; 2]>)> = Vec::new();
    for line in text.replace(", ", ",").lines().skip(1).filter(|line| line.contains(&format!(",{kind},"))) {
        let (number, rest) = line.split_once(',').unwrap();
        let fields: Vec<&str> = rest.strip_prefix(&kind).unwrap().split(',').collect();
        let at = [2, 3].map(|place| fields[place].parse::<f64>().unwrap());
        match stretches.last_mut().filter(|last| last.0 == number) {
            Some(last) => last.1.push(at),
            None => stretches.push((number.to_owned(), vec![at])),
        }
    }
    stretches.into_iter().map(|stretch| stretch.1).collect()
}

/// Where curves pass a value upwards, by linear interpolation between their points.
fn crossings(curves: &[Vec<[f64; 2]>], y: f64) -> Vec<f64> {
    let pairs = curves.iter().flat_map(|curve| curve.windows(2));
    pairs
        .filter(|pair| (pair[0][1] - y) * (pair[1][1] - y) <= 0.0 && pair[0][1] != pair[1][1])
        .map(|pair| pair[0][0] + (y - pair[0][1]) / (pair[1][1] - pair[0][1]) * (pair[1][0] - pair[0][0]))
        .collect()
}

fn passes(curves: &[Vec<[f64; 2]>], [x, y]: [f64; 2]) -> bool {
    crossings(curves, y).iter().any(|found| (found - x).abs() < 2e-3) // points lie up to .02 of the ranges apart
}

/// The condition under which straight motion of the paper's full model begins to turn: the sum of the principal minors of its stability
/// matrix for odd deviations vanishes, beside the eigenvalue 0 of rotations. `r` is the amplitude of `z1`, a root of the condition that
/// `z2` is steady.
fn turning(kappa2: f64, kappa3: f64) -> f64 {
    let s = |r: f64| 0.5 * (r * r - 1.0);
    let u = |r: f64| (0.0125 * r.powi(3) + 0.4 * r * s(r)) / kappa3;
    let steady = |r: f64| kappa2 * s(r) + 0.125 * r * r - 0.3 * r * u(r);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if steady(low) * steady(middle) <= 0.0 { high = middle } else { low = middle }
    }
    let r = low;
    4.0 * s(r) * (kappa2 + kappa3) + 2.0 * r * (0.25 * r + 0.3 * u(r)) + kappa2 * kappa3 - 0.12 * r * r
}

fn between<'j>(summary: &'j Value, sides: [&str; 2]) -> &'j Value {
    let all = summary["boundaries"].as_array().unwrap();
    let side = |entry: &Value, place: usize| entry["between"][place] == serde_json::json!([sides[place]]);
    all.iter().find(|entry| side(entry, 0) && side(entry, 1)).unwrap_or_else(|| panic!("{sides:?}: {all:#?}"))
}

/// Known values: the formula of `turning`; 1.121937264 (Hopf of circular motion) and .783547485, 1.148047264 (the zigzag begins to
/// rotate) at kappa3 = .1.
#[test]
fn the_plane_of_the_papers_fig_4_has_its_regions_and_lines() {
    let folder = Folder::new();
    let done = folder.run(&format!("{FIG4} --out a"));
    assert!(matches!(done.code, Some(0 | 1)), "{}", done.stderr);
    let summary = read_json(&folder.path("a/summary.json"));
    let regions = summary["regions"].as_array().unwrap();
    for motion in ["straight", "circular", "zigzag", "chaotic"] {
        assert!(regions.iter().any(|region| region["motions"] == serde_json::json!([motion])), "{motion}");
    }
    let lines = summary["lines"].as_array().unwrap();
    assert!(lines.iter().any(|line| line["steps"].as_u64() > Some(0)), "{lines:#?}");
    assert!(lines.iter().all(|line| line["refused"].is_null()), "their steps are enough: {lines:#?}");
    let turn = between(&summary, ["straight", "circular"]);
    assert_eq!(turn["kinds"][0]["kind"], "pitchfork", "{turn}");
    assert_eq!(turn["unnamed"], 0, "{turn}");
    let pitchfork = curve(&folder, "a/atlas.csv", "pitchfork");
    let points: Vec<[f64; 2]> = pitchfork.concat();
    assert!(points.len() > 20, "{}", points.len());
    for [kappa2, kappa3] in points {
        let off = turning(kappa2, kappa3);
        assert!(off.abs() < 1e-7, "{kappa2} {kappa3}: {off}");
    }
    let hopf = curve(&folder, "a/atlas.csv", "Hopf, subcritical");
    assert!(passes(&hopf, [1.121_937, 0.1]), "{:?}", crossings(&hopf, 0.1));
    let breaking = curve(&folder, "a/atlas.csv", "symmetry breaking");
    for kappa2 in [0.783_547, 1.148_047] {
        assert!(passes(&breaking, [kappa2, 0.1]), "{:?}", crossings(&breaking, 0.1));
    }
    let files = [
        "_inventory.jsonl",
        "atlas.csv",
        "atlas.json",
        "atlas.png",
        "atlas.svg",
        "cells.parquet",
        "curves.parquet",
        "manifest.json",
        "report.html",
        "summary.json",
    ];
    assert_eq!(names(&folder.path("a")), files);
    let drawn = folder.run("figure a --width 86mm --pdf --out paper").expect(0);
    assert!(drawn.stdout.contains("atlas.pdf"), "{}", drawn.stdout);
    assert!(folder.run("verify a").expect(0).stdout.contains("intact"));
}

/// Cells are those of a scan with the same axes, and cells that are taken from others have their motions.
#[test]
fn cells_are_those_of_the_scan() {
    let folder = Folder::new();
    let axes = "tensor --preset fig1 --axis kappa2=0.02:0.2:9 --axis gamma=-0.07:0.09:9 --samples 2 --seed 3";
    folder.run(&format!("atlas {axes} --lines 2 --branches 2 --out a")).expect(0);
    let rows = |name: &str| -> Vec<(String, String, String)> {
        let text = std::fs::read_to_string(folder.path(name)).unwrap();
        let fields = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        let rows = text.lines().skip(1).map(fields).filter(|row| row[0].is_empty());
        rows.map(|row| (row[3].clone(), row[4].clone(), row[1].clone())).collect()
    };
    let atlas = rows("a/atlas.csv");
    // motionless below gamma = 0, then straight or circular
    assert!(atlas.iter().any(|row| row.2 == "motionless") && atlas.iter().any(|row| row.2 == "circular"));
    let summary = read_json(&folder.path("a/summary.json"));
    assert!(summary["computed"].as_u64() < summary["cells"].as_u64(), "{summary}");
    let json = folder.run(&format!("scan {axes} --out s --no-figures --json")).expect(0).json();
    let count = |motion: &str| atlas.iter().filter(|row| row.2 == motion).count();
    for motion in ["motionless", "straight", "circular"] {
        let rows = json["regimes"][motion].as_u64().unwrap() as usize;
        // with one motion in each cell both starts lead there
        assert_eq!(2 * count(motion), rows, "{motion}");
    }
}

/// A model as text: dz1/dt = (a - |z1|^2) z1, dz2/dt = -(b + |z2|^2) z2 + z1^2: rest loses its stability along a = 0.
#[test]
fn a_model_as_text_has_an_atlas() {
    let folder = Folder::new();
    folder.write(
        "own.toml",
        "[model.amplitudes]\nmodes = [1, 2]\n[model.amplitudes.parameters]\na = 0.2\nb = 1.0\n\n\
         [model.amplitudes.equations]\nz1 = \"(a - |z1|^2)*z1\"\nz2 = \"-(b + |z2|^2)*z2 + z1^2\"\n",
    );
    let words = "atlas own.toml --axis a=-0.35:0.45:9 --axis b=0.5:1.5:5 --samples 2 --lines 2 --branches 2 --out a --json";
    let json = folder.run(words).expect(0).json();
    assert_eq!(
        json["boundaries"][0]["between"],
        serde_json::json!([["motionless"], ["straight"]]),
        "{json:#}"
    );
    assert_eq!(
        (&json["named"], &json["boundaries"][0]["kinds"][0]["kind"]),
        (&1.0.into(), &"pitchfork".into())
    );
    let line = curve(&folder, "a/atlas.csv", "pitchfork").concat();
    assert!(line.len() > 5 && line.iter().all(|at| at[0].abs() < 1e-9), "{line:?}");
}

/// Circles of radius 1 and of radius 1e7 on a plane in whose middle all linear terms vanish, which alone say how large motions are: the
/// same regions, boundaries, lines, and ends.
#[test]
fn an_atlas_is_the_same_in_any_unit() {
    let folder = Folder::new();
    let atlas = |name: &str, cubic: &str| {
        folder.write(
            name,
            &format!(
                "[model.amplitudes]\nmodes = [1]\n[model.amplitudes.parameters]\nmu = 0.5\nnu = 0.5\n\n\
                 [model.amplitudes.equations]\nz1 = \"(mu + i*nu)*z1 - {cubic}*|z1|^2*z1\"\n"
            ),
        );
        let words = format!(
            "atlas {name} --axis mu=-1:1:9 --axis nu=-1:1:9 --samples 1 --no-figures --out {name}-atlas --json"
        );
        let json = folder.run(&words).json();
        let lines = json["lines"].as_array().unwrap();
        assert!(lines.len() > 2 && lines.iter().all(|line| line["refused"].is_null()), "{lines:#?}");
        ["regions", "boundaries", "ends", "curves"].map(|key| json[key].clone())
    };
    assert_eq!(atlas("one.toml", "1"), atlas("large.toml", "1e-14"));
}

/// Van der Pol's equations: at mu = 0 all orbits are closed. Rest ends there whatever the stiffness.
#[test]
fn a_plane_with_a_family_of_orbits_at_one_value_has_an_atlas() {
    let folder = Folder::new();
    folder.write(
        "pol.toml",
        "[model.amplitudes]\nmodes = [1]\nsymmetry = \"none\"\n[model.amplitudes.parameters]\nmu = 1\nk = 1\n\n\
         [model.amplitudes.equations]\nz1 = \"im(z1) + i*(mu*(1 - re(z1)^2)*im(z1) - k*re(z1))\"\n",
    );
    let words = "atlas pol.toml --axis mu=-1:1:17 --axis k=0.2:2:17 --samples 2 --lines 4 --no-figures --out pol --json";
    let json = folder.run(words).json();
    let hopf = json["curves"].as_array().unwrap().iter().find(|curve| curve["kind"] == "hopf");
    assert!(hopf.is_some_and(|curve| curve["points"].as_u64() > Some(10)), "{json:#}");
}

#[test]
fn what_is_no_plane_is_refused_with_the_remedy() {
    let folder = Folder::new();
    for (words, says) in [
        ("atlas tensor --preset fig4 --axis kappa2=0.1:1", "two parameters"),
        ("atlas tensor --preset fig4 --axis kappa2=0.1:1 --axis kappa2=0.1:1", "two different"),
        ("atlas tensor --preset fig4 --axis kappa2=0.1:1 --axis v1=0.1:1", "v1"),
        ("atlas tensor --preset fig4 --axis kappa2=0.1 --axis kappa3=0.1:1", "kappa2"),
        ("atlas tensor --preset fig4 --axis kappa2=1:0.1:a --axis kappa3=0.1:1", "COUNT"),
    ] {
        let done = folder.run(words).expect(2);
        assert!(done.stderr.contains(says), "{words}: {}", done.stderr);
    }
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}
