//! `motiform verify`: intact results are intact, and every kind of damage is found.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::Folder;
use std::fs;

#[test]
fn a_dataset_is_computed_again_to_the_same_bits() {
    let folder = Folder::new();
    for format in ["parquet", "csv"] {
        let run = "simulate tensor --preset fig5a --t-end 300 --dt-out 0.1 --transient 7 --no-figures";
        folder.run(&format!("{run} --format {format} --out {format}")).expect(0);
        let sample = folder.run(&format!("verify {format} --json")).expect(0).json();
        let all = folder.run(&format!("verify {format} --all --json")).expect(0).json();
        let (sample, all) = (sample["rows"].as_u64().unwrap(), all["rows"].as_u64().unwrap());
        assert!((900..2000).contains(&sample) && all == 3001, "{sample} {all}");
    }
    // one digit of one number, the second after the point, and an inventory that fits: only computing again finds it
    let table = folder.path("csv/trajectory.csv");
    let text = fs::read_to_string(&table).unwrap();
    let row = text.lines().nth(50).unwrap();
    let at = text.find(row).unwrap() + row.match_indices('.').nth(3).unwrap().0 + 2;
    let other = if &text[at..=at] == "4" { "5" } else { "4" };
    fs::write(&table, format!("{}{other}{}", &text[..at], &text[at + 1..])).unwrap();
    let done = folder.run("verify csv").expect(1);
    assert!(
        done.stdout.contains("changed   trajectory.csv") && done.stdout.contains("trajectory, row 49"),
        "{}",
        done.stdout
    );
    let sum = std::process::Command::new("sha256sum").arg(&table).output().unwrap();
    let digest = String::from_utf8(sum.stdout).unwrap()[..64].to_owned();
    let inventory = folder.path("csv/_inventory.jsonl");
    let lines = fs::read_to_string(&inventory).unwrap();
    let old = lines.lines().find(|line| line.contains("trajectory.csv")).unwrap();
    fs::write(
        &inventory,
        lines.replace(old, &format!("{{\"name\":\"trajectory.csv\",\"sha256\":\"{digest}\"}}")),
    )
    .unwrap();
    let found = folder.run("verify csv --json").expect(1).json();
    assert!(found["changed"].as_array().unwrap().is_empty() && found["intact"] == false);
    assert!(found["different"][0].as_str().unwrap().contains("row 49"), "{found}");
}

#[test]
fn scans_and_other_kinds() {
    let folder = Folder::new();
    let scan =
        "scan tensor --preset fig1 --axis kappa2=0.1:0.2:3 --samples 1 --budget 300 --no-figures --out scan";
    folder.run(scan);
    let found = folder.run("verify scan --all --json").expect(0).json();
    assert_eq!((found["rows"].as_u64(), found["kind"].as_str()), (Some(3), Some("scan")));
    let branches =
        "continue tensor --preset fig5a --along kappa2=0.85:0.95 --branches 1 --points 5 --out branches";
    folder.run(branches).expect(0);
    folder.run("verify branches").expect(0);
    fs::write(folder.path("branches/notes.md"), "mine").unwrap();
    assert!(folder.run("verify branches").expect(0).stdout.contains("others'   notes.md"));
    fs::remove_file(folder.path("scan/part-00001.parquet")).unwrap();
    assert!(folder.run("verify scan").expect(1).stdout.contains("missing   part-00001.parquet"));
    let manifest = fs::read_to_string(folder.path("branches/manifest.json")).unwrap();
    fs::write(folder.path("branches/manifest.json"), manifest.replace("0.85", "0.84")).unwrap();
    let done = folder.run("verify branches").expect(1);
    assert!(done.stdout.contains("its plan does not give its hash"), "{}", done.stdout);
    fs::create_dir(folder.path("empty")).unwrap();
    for (words, why) in [("verify empty", "no inventory"), ("verify nothing", "there is no folder nothing")] {
        assert!(folder.run(words).expect_error(2).stderr.contains(why));
    }
}
