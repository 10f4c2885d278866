//! `motiform statistics`: text, JSON, folder, exit codes and error texts.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Folder, keys, names};

const SHORT: &str =
    "statistics tensor --set gamma=1 --set kappa2=2 --set kappa3=2 --noise 0.3 --t-end 100 --bodies 10";

#[test]
fn text_json_and_folder_agree() {
    let folder = Folder::new();
    let done = folder.run(SHORT).expect(0);
    assert!(
        done.stdout.contains("10 bodies, 2001 samples every 0.05; 95 % intervals over bodies"),
        "{}",
        done.stdout
    );
    assert_eq!(folder.names(), [""; 0], "without --out it writes no file");
    let json = folder.run(&format!("{SHORT} --json --threads 1 --out found")).expect(0).json();
    assert_eq!((&json["bodies"], &json["errors"]["over"]), (&10.into(), &"bodies".into()));
    assert!(keys(&json["autocorrelations"]).contains(&"velocity"));
    assert_eq!(json["first_passage"].as_array().unwrap().len(), 6);
    let found = names(&folder.path("found"));
    for name in
        ["statistics.json", "msd.parquet", "autocorrelations.png", "spectra.svg", "first_passage.parquet"]
    {
        assert!(found.iter().any(|there| there == name), "{found:?}");
    }
    assert!(folder.run(&format!("{SHORT} --out found")).expect(2).stderr.contains("--force"));
    folder.run(&format!("{SHORT} --out found --force")).expect(0);
    let settings = format!("{SHORT} --json --disc 2 --disc 0.5 --threshold s=0.1");
    let json = folder.run(&settings).expect(0).json();
    assert_eq!(json["first_passage"][0]["radius"], 0.5);
    assert_eq!((&json["residence"]["quantity"], &json["residence"]["threshold"]), (&"s".into(), &0.1.into()));
}

#[test]
fn datasets_are_measured() {
    let folder = Folder::new();
    for seed in [1, 2] {
        let words = "simulate tensor --set gamma=1 --noise 0.2 --t-end 300 --no-figures";
        folder.run(&format!("{words} --seed {seed} --out run{seed}")).expect(0);
    }
    let done = folder.run("statistics run1 run2 --transient 20").expect(0);
    assert!(done.stdout.contains("2 bodies") && done.stdout.contains("over 16 blocks"), "{}", done.stdout);
}

#[test]
fn bad_input_names_the_remedy() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("empty")).unwrap();
    for (words, told) in [
        ("statistics", "MODEL|STUDY.toml|DATASET"),
        ("statistics tensr", "tensor"),
        ("statistics empty", "give a folder written by `motiform simulate`"),
        ("statistics empty --bodies 3", "datasets are recorded already"),
        ("statistics empty --initial v1=0.1", "datasets are recorded already"),
        ("statistics empty --t-end 10", "datasets are recorded already"),
        ("statistics empty --rtol 1e-6", "datasets are recorded already"),
        ("statistics empty --max-steps 10", "datasets are recorded already"),
        ("statistics tensor cell", "give one model or study"),
        ("statistics tensor --bodies 0", "give a number from 1 to 100000"),
        ("statistics tensor --initial v1=0.1", "leave out the initial values, or give noise"),
        ("statistics tensor --threshold speed=fast", "is not a number"),
        ("statistics tensor --bodies 8 --t-end 10 --threshold heading", "choose one of speed, s, u"),
        ("statistics tensor --bodies 8 --t-end 10 --disc -1", "disc = -1: give a radius above 0"),
        ("statistics tensor --bodies 8 --t-end 10 --dt-out 0", "dt_out = 0: give a time above 0"),
        (
            "statistics tensor --bodies 8 --t-end 10 --units -20um,1min",
            "write what a unit of length is (nm, um",
        ),
        (
            "statistics tensor --bodies 8 --t-end 10 --units 20kg,1min",
            "write what a unit of length is (nm, um",
        ),
        ("statistics tensor --bodies 8 --t-end 10 --dt-out 1", "record longer, or more often"),
    ] {
        let done = folder.run(words).expect(2);
        assert!(done.stderr.contains(told), "{words}: {}", done.stderr);
    }
}

/// Where the limit on samples of all bodies makes them coarser, it is said; what is then too coarse is unknown, with the remedy.
#[test]
fn coarser_samples_than_usual_are_said() {
    let folder = Folder::new();
    folder.write(
        "turning.toml",
        "[model.amplitudes]\nmodes = [1, 2]\n[model.amplitudes.equations]\nz1 = \"-(0.05 + 6.2*i)*z1\"\nz2 = \"-z2\"\n\
         [model.amplitudes.noise]\nz1 = \"0.4\"\nz2 = \"0.1\"\n",
    );
    let words = "statistics turning.toml --transient 100 --bodies 30";
    let fine = folder.run(&format!("{words} --t-end 400 --dt-out 0.05 --threshold z2 --json")).expect(0);
    assert!(fine.stderr.is_empty() && fine.json()["residence"]["quantity"] == "z2", "{}", fine.stderr);
    let done = folder.run("statistics turning.toml --t-end 2000 --bodies 1000 --max-steps 10").stderr;
    assert!(done.contains("samples are 1 apart, and 0.1 in the subject's own run"), "{done}");
    let done = folder.run(&format!("{words} --t-end 400 --dt-out 1")).expect(0);
    assert!(done.stdout.contains("sampled too coarsely: within 1 velocity changes"), "{}", done.stdout);
    assert!(done.stdout.contains("at least every 0.08 (dt_out)"), "{}", done.stdout);
}

/// A slow switch in one short record: values without intervals, and the reason, in text and in the summary.
#[test]
fn one_short_record_of_a_slow_switch_has_no_intervals() {
    let folder = Folder::new();
    folder.write(
        "switch.toml",
        "[model.amplitudes]\nmodes = [2, 3]\nsymmetry = \"none\"\nvelocity = \"re(z2)+2\"\n[model.amplitudes.noise]\nz3 = \"0.6\"\n\
         [model.amplitudes.equations]\nz2 = \"re(z2) - re(z2)^3 + re(z3) - i*im(z2)\"\nz3 = \"-z3\"\n",
    );
    let words = "statistics switch.toml --bodies 1 --t-end 200 --transient 50 --dt-out 0.5";
    let done = folder.run(words).expect(0);
    assert!(done.stdout.contains("no intervals: the "), "{}", done.stdout);
    assert!(done.stdout.contains("(no interval), root mean square"), "{}", done.stdout);
    let found = folder.run(&format!("{words} --json --out s")).expect(0).json();
    assert!(found["no_intervals"].is_string() && found["mean_speed"].get("lower").is_none(), "{found}");
    let all =
        folder.run("statistics switch.toml --bodies 30 --t-end 100 --transient 50 --dt-out 0.5").expect(0);
    assert!(!all.stdout.contains("no interval"), "{}", all.stdout);
}
