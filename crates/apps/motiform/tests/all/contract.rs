//! The command line that scripts and outside checks rely on: words, keys, exit codes, full-precision numbers.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{Folder, keys, names, read_json};
use serde_json::Value;

const SHORT: &str = "simulate tensor --preset fig5b --transient 0 --t-end 8 --dt-out 0.5";

#[test]
fn simulate_json_has_the_keys_of_the_contract() {
    let folder = Folder::new();
    let json = folder.run(&format!("{SHORT} --json")).expect(0).json();
    let expected = ["model", "parameters", "outcome", "t", "state", "position", "steps", "manifest"];
    // both tolerances beside what was agreed; a regime where a short look decides
    let known: Vec<_> = keys(&json).into_iter().filter(|key| *key != "control" && *key != "regime").collect();
    assert_eq!(known, expected);
    assert_eq!(keys(&json["control"]), ["rtol", "atol"]);
    assert_eq!(json["model"], "tensor");
    assert_eq!(keys(&json["state"]), ["v1", "v2", "s11", "s12", "u111", "u222"]);
    assert_eq!(json["outcome"]["kind"], "completed");
    assert_eq!((&json["t"], &json["outcome"]["t"]), (&8.0.into(), &8.0.into()));
    assert_eq!(json["position"].as_array().unwrap().len(), 2);
    assert!(json["steps"].as_u64().unwrap() > 0);
    assert_eq!(keys(&json["parameters"]).len(), 21);
    assert_eq!((&json["parameters"]["d2"], &json["parameters"]["a6"]), (&0.8.into(), &0.0.into()));
    let manifest = &json["manifest"];
    assert_eq!(manifest["motiform"], env!("CARGO_PKG_VERSION"));
    assert_eq!((&manifest["seed"], manifest["plan_hash"].as_str().unwrap().len()), (&1.into(), 64));
    assert_eq!(manifest["plan"]["computation"]["parameters"], json["parameters"]);
    assert_eq!(folder.names(), [""; 0], "--json alone writes no file");
}

/// The same words give the same bytes, and the table holds the very numbers that the JSON text shows.
#[test]
fn numbers_are_reproducible_and_in_full_precision() {
    let folder = Folder::new();
    let json = folder.run(&format!("{SHORT} --json --out run.csv")).expect(0);
    assert_eq!(folder.run(&format!("{SHORT} --json")).expect(0).stdout, json.stdout);
    let table = std::fs::read_to_string(folder.path("run.csv")).unwrap();
    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let last: Vec<f64> =
        table.lines().last().unwrap().split(',').map(|field| field.parse().unwrap()).collect();
    assert_eq!(table.lines().count(), 1 + 17, "a header, then t = 0, 0.5, .. 8");
    let cell = |name: &str| last[header.iter().position(|&column| column == name).unwrap()];
    let json = json.json();
    let number = |value: &Value| value.as_f64().unwrap();
    for name in keys(&json["state"]) {
        assert_eq!(number(&json["state"][name]), cell(name), "{name}");
    }
    assert_eq!([&json["position"][0], &json["position"][1]].map(number), [cell("x"), cell("y")]);
    assert_eq!(number(&json["t"]), cell("t"));
}

#[test]
fn a_run_writes_a_folder_with_tables_figures_and_its_manifest() {
    let folder = Folder::new();
    let told = folder.run("simulate tensor --preset fig3 --t-end 1000").expect(0).stdout;
    let expected = [
        "crossings.parquet",
        "manifest.json",
        "motion.png",
        "path.png",
        "path.svg",
        "return-map.png",
        "return-map.svg",
        "series.png",
        "series.svg",
        "trajectory.parquet",
    ];
    assert_eq!(folder.names(), ["tensor-fig3"]);
    assert_eq!(names(&folder.path("tensor-fig3")), [&["_inventory.jsonl"], &expected[..]].concat());
    assert!(told.contains(&format!("written   tensor-fig3: {}", expected.join(" "))), "{told}");
    let csv = "simulate tensor --t-end 5 --out plain --format csv --no-figures";
    folder.run(csv).expect(0);
    assert_eq!(names(&folder.path("plain")), ["_inventory.jsonl", "manifest.json", "trajectory.csv"]);
}

#[test]
fn set_overrides_the_preset_and_a_negative_number_is_a_value() {
    let folder = Folder::new();
    let words = "simulate tensor --preset fig5a --transient 0 --t-end 1 --json";
    let json = folder
        .run(&format!("{words} --set kappa2=-0.25 --initial y=-1e-3 --set kappa2=-0.5 --seed 7"))
        .expect(0)
        .json();
    let computation = &json["manifest"]["plan"]["computation"];
    assert_eq!(computation["parameters"]["kappa2"], -0.5, "the last one counts");
    assert_eq!(computation["initial"]["y"], -1e-3);
    assert_eq!(computation["initial"]["s11"], -0.2, "the preset's own start stays");
    assert_eq!((&json["manifest"]["seed"], &computation["seed"]), (&7.into(), &7.into()));
}

/// A preset says what its model is.
#[test]
fn a_preset_needs_no_model() {
    let folder = Folder::new();
    for (model, name) in [("tensor", "fig5a"), ("amplitudes", "chiral")] {
        let alone = folder.run(&format!("classify --preset {name} --json")).expect(0).json();
        assert_eq!(alone, folder.run(&format!("classify {model} --preset {name} --json")).expect(0).json());
    }
    let refused = folder.run("classify --preset fig55").expect(2);
    assert!(refused.stderr.contains("no model has such a preset"), "{}", refused.stderr);
    assert!(folder.run("models chiral").expect(0).stdout.contains("omega"));
}

#[test]
fn models_lists_and_shows() {
    let folder = Folder::new();
    let list = folder.run("models").expect(0).stdout;
    assert!(list.starts_with("tensor ") && list.contains("fig1 fig2 fig3 fig4 fig5a fig5b"), "{list}");
    assert_eq!(folder.run("models --json").expect(0).json()[0]["name"], "tensor");

    let page = folder.run("models tensor").expect(0).stdout;
    let json = folder.run("models tensor --json").expect(0).json();
    let all = ["name", "title", "source", "equations", "parameters", "coordinates", "presets"];
    assert_eq!(keys(&json), all);
    let entries = |key: &str| json[key].as_array().unwrap().clone();
    assert_eq!((entries("parameters").len(), entries("presets").len()), (21, 6));
    for entry in entries("parameters").iter().chain(&entries("coordinates")) {
        let (name, meaning) = (entry["name"].as_str().unwrap(), entry["meaning"].as_str().unwrap());
        assert!(page.contains(name) && page.contains(meaning), "{name}");
    }
    for entry in entries("presets") {
        assert!(page.contains(entry["about"].as_str().unwrap()), "{entry}");
    }
    assert!(page.contains("[free: kappa2, gamma]"));
}

#[test]
fn check_prints_the_plan_that_simulate_carries_out() {
    let folder = Folder::new();
    folder.write(
        "swim.toml",
        "preset = \"fig5a\"\n[model.tensor]\nkappa2 = 1.0\n[run]\ntransient = 1\nt_end = 2\n",
    );
    let told = folder.run("check swim.toml").expect(0).stdout;
    let json = folder.run("simulate swim.toml --json").expect(0).json();
    let hash = json["manifest"]["plan_hash"].as_str().unwrap();
    assert!(told.contains("kappa2=1 ") && told.contains("transient 1, recorded 2,"), "{told}");
    assert!(told.trim_end().ends_with(hash), "{told}");
    assert_eq!(folder.run("check swim.toml --json").expect(0).json(), json["manifest"]["plan"]);
    assert_eq!(folder.names(), ["swim.toml"], "check computes and writes nothing");
    folder.write("noisy.toml", "preset = \"fig5a\"\n[run]\nnoise = 1e-3\nnoise_velocity = 0\nseed = 4\n");
    let told = folder.run("check noisy.toml").expect(0).stdout;
    assert!(told.contains("rtol 1e-9, atol 1e-12"), "{told}");
    assert!(
        told.contains(
            "noise       amplitude 0.001 on the shape, 0 on the velocity, steps of 0.03125, seed 4"
        ),
        "{told}"
    );
}

/// A body without a shape has no noise on it: sentences name what noise acts on.
#[test]
fn noise_is_said_of_what_the_body_has() {
    let folder = Folder::new();
    let run = "simulate noisy-heading --noise-velocity 0.05 --t-end 20 --out run --no-animation";
    let told = folder.run(run).expect(0).stdout;
    assert!(told.contains("noise     amplitude 0.05 on the velocity, steps"), "{told}");
    let figure = std::fs::read_to_string(folder.path("run/path.svg")).unwrap();
    assert!(figure.contains("White noise of amplitude 0.05 on each coordinate of the velocity, seed 1"));
}

/// The motion is named in words and JSON, unless there is noise; figures are called by it.
#[test]
fn simulate_names_what_it_simulated() {
    let folder = Folder::new();
    let words = "simulate tensor --preset fig5a --set kappa2=0.5 --set kappa3=0.4 --t-end 20";
    let told = folder.run(&format!("{words} --out run --no-animation")).expect(0).stdout;
    assert!(told.contains("motion    at the end circular: "), "{told}");
    assert!(!told.contains("Zigzag") && told.starts_with("Circular motion: "), "{told}");
    let figure = std::fs::read_to_string(folder.path("run/path.svg")).unwrap();
    assert!(!figure.contains("Zigzag"), "a title from the preset's motion");
    assert_eq!(read_json(&folder.path("run/manifest.json"))["regime"], "circular");
    assert_eq!(folder.run(&format!("{words} --json")).expect(0).json()["regime"], "circular");
    let noisy = folder.run(&format!("{words} --json --noise 1e-3")).expect(0).json();
    assert!(noisy.get("regime").is_none());
    let told = folder.run(&format!("{words} --noise 1e-3 --out noisy")).expect(0).stdout;
    assert!(told.contains("noise     amplitude 0.001 on the shape, 0.001 on the velocity"), "{told}");
    assert!(told.starts_with("Tensor model: ") && !told.contains("motion "), "{told}");
}

#[test]
fn the_schema_lists_every_parameter() {
    let folder = Folder::new();
    let schema = folder.run("check --schema").expect(0).json();
    let model = folder.run("models tensor --json").expect(0).json();
    let known = &schema["properties"]["model"]["properties"]["tensor"]["properties"];
    for parameter in model["parameters"].as_array().unwrap() {
        let name = parameter["name"].as_str().unwrap();
        assert_eq!(known[name]["description"], parameter["meaning"], "{name}");
    }
    assert_eq!(keys(known).len(), 21);
}

#[test]
fn completions_know_every_command() {
    let folder = Folder::new();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = folder.run(&format!("completions {shell}")).expect(0).stdout;
        for word in ["models", "simulate", "check", "figure", "completions", "dt-out"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    folder.run("completions bash").expect(0);
    folder.bash("bash -n <($motiform completions bash)").expect(0);
}

#[test]
fn figure_draws_the_same_bytes_again_and_nothing_else() {
    let folder = Folder::new();
    folder.run("simulate tensor --preset fig5a --transient 0 --t-end 20 --out a").expect(0);
    let bytes = |name: &str| std::fs::read(folder.path("a").join(name)).unwrap();
    let all = names(&folder.path("a"));
    let before: Vec<Vec<u8>> = all.iter().map(|name| bytes(name)).collect();
    let told = folder.run("figure a").expect(0).stdout;
    assert_eq!(told, "a: path.svg path.png series.svg series.png motion.png\n");
    assert_eq!(names(&folder.path("a")), all);
    for (name, old) in all.iter().zip(&before) {
        assert!(bytes(name) == *old, "{name} changed");
    }

    let beyond = folder.run("figure a --from 1e6 --out beyond").expect(2).stderr;
    assert!(beyond.contains("fewer than two rows") && beyond.contains("--from"), "{beyond}");
    assert!(!folder.path("beyond").exists(), "no folder without figures");

    let manifest = read_json(&folder.path("a/manifest.json"));
    folder.run("figure a --scale 7 --no-animation").expect(0);
    let svg = String::from_utf8(bytes("path.svg")).unwrap();
    assert!(svg.contains("7 times true size"), "the caption says the scale");
    assert_eq!(read_json(&folder.path("a/manifest.json")), manifest, "the dataset itself is not touched");
}

#[test]
fn exit_codes() {
    let folder = Folder::new();
    folder.run("--version").expect(0);
    folder.run("--help").expect(0);
    folder.run("simulate tensor --t-end 1 --json").expect(0);
    folder.run("simulate tensor --t-end 100 --max-steps 3 --json").expect(1);
    folder.run("simulate tensor --t-end 0").expect(2);
    folder.run("").expect(2); // 130: interruption.rs
}
