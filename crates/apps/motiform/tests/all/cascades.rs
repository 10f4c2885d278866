//! Cascades of period doublings: how many in a row are followed is a setting, and the rest is counted.

use crate::common::Folder;
use serde_json::Value;

/// Roessler's equations with a = b = 0.2: z1 = x + iy, and z is the real part of z2, whose imaginary part decays.
const ROESSLER: &str = "[model.amplitudes]\nmodes = [1, 2]\nsymmetry = \"none\"\n[model.amplitudes.parameters]\nc = 2.0\n\
    [model.amplitudes.equations]\n\
    z1 = \"i*z1+0.1*(z1-conj(z1))-(z2+conj(z2))/2\"\n\
    z2 = \"0.2+(z2+conj(z2))/2*((z1+conj(z1))/2-c)-(z2-conj(z2))/2\"\n";

fn doublings(json: &Value) -> Vec<f64> {
    let branches = json["branches"].as_array().expect("branches");
    let entries = branches.iter().flat_map(|branch| branch["special"].as_array().expect("a list"));
    let mut all: Vec<f64> = entries
        .filter(|entry| entry["kind"] == "period-doubling")
        .map(|entry| entry["c"].as_f64().expect("a number"))
        .collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    all
}

/// Three doublings in a row are followed, so that four are found: intervals between them shrink by Feigenbaum's constant (4.669).
#[test]
fn as_many_doublings_as_are_asked_for() {
    let folder = Folder::new();
    folder.write("roessler.toml", ROESSLER);
    let follow = |options: &str| {
        folder.run(&format!("continue roessler.toml --along c=2:4.2 {options} --json")).expect(0).json()
    };
    let all = follow("");
    let found = doublings(&all);
    assert_eq!(found.len(), 4, "{found:?}");
    let ratio = |i: usize| (found[i + 1] - found[i]) / (found[i + 2] - found[i + 1]);
    assert!((ratio(1) / 4.669 - 1.0).abs() < 0.03, "{found:?}");
    assert_eq!((&all["doublings_left"], &all["origins_left"]), (&1.into(), &0.into()));
    let one = follow("--doublings 1");
    assert_eq!(doublings(&one)[..], found[..2]);
    assert_eq!(one["doublings_left"], 1);
    assert_eq!(doublings(&follow("--doublings 0"))[..], found[..1]);
}
