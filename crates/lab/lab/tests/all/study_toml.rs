//! Study files: every complaint has a place and a remedy, presets are overridden key by key, and the schema and the
//! reader know the same keys.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{preset, tensor};
use motiform_models::{MODELS, ModelInfo};
use motiform_study::presets::PRESETS;
use motiform_study::{Error, Study, study};
use proptest::prelude::*;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Write;

fn parse(text: &str) -> Result<Study, Error> {
    Study::parse(text, "study.toml", "study")
}

fn complaint(text: &str) -> String {
    match parse(text) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("accepted:\n{text}"),
    }
}

#[test]
fn complaints_have_a_place_and_a_remedy() {
    let texts = [
        "",
        "[model]\n",
        "[model.tenser]\n",
        "model = \"tensor\"\n",
        "[model.tensor]\nkappa2 = 0.5\nkappa2 = 0.6\n",
        "[model.tensor]\nkappa2 = \n",
        "[model.tensor\n",
        "[model.tensor]\nkapa2 = 1\n",
        "[model.tensor]\nkappa2 = true\n",
        "[model.tensor]\nkappa2 = inf\n",
        "[model.tensor]\nkappa2 = 1e999\n",
        "preset = \"fig5c\"\n",
        "preset = 5\n",
        "[model.tensor]\n[initial]\nv3 = 1\n",
        "[model.tensor]\n[run]\nstepper = 4\n",
        "[model.tensor]\n[run]\nseed = -1\n",
        "[model.tensor]\n[run]\nseed = 1.5\n",
        "[model.tensor]\n[run]\nmax_steps = \"many\"\n",
        "[model.tensor]\n[return_map]\ncenter = true\n",
        "[model.tensor]\n[scan]\naxes = [\"gamma=0:1:5\", \"kapa2=0:1:5\"]\n",
        "[model.tensor]\n[scan]\naxes = \"gamma=0:1:5\"\n",
        "[model.tensor]\n[scan]\naxes = [\"gamma=0:1:0\"]\n",
        "[model.tensor]\n[scan]\nsample = 4\n",
        "[model.tensor]\n[figure]\nanimation = \"no\"\n",
        "[model.tensor]\n[figures]\nscale = 1\n",
        "[model.tensor]\n[display]\nspeed = 0.01\n",
        "[model.tensor]\n[display]\nplane = [\"kappa2=1,0.5\"]\n",
        "[model.tensor]\n[display]\nplane = [\"kappa2=0,1\", \"kappa2=0,2\"]\n",
        "run = 5\n[model.tensor]\n",
        "free = [\"kappa2\", 5]\n[model.tensor]\n",
        "free = [\"kapa2\"]\n[model.tensor]\n",
        "# Umlaute zählen als ein Zeichen\n[model.tensor]\n\"größe\" = 1 # so\n",
        "[model.tensor]\r\ngamma = 1\r\nkapa2 = 1\r\n",
    ];
    let mut read = String::new();
    for text in texts {
        writeln!(read, "{}\n--> {}\n", text.trim_end().replace('\r', "\\r"), complaint(text)).unwrap();
    }
    insta::assert_snapshot!("complaints", read);
}

#[test]
fn line_and_column_count_characters_from_one() {
    let Err(Error::Study { line, column, .. }) = parse("title = \"äöü\"\n[model.tensor]\n  kapa2 = 1\n")
    else {
        panic!()
    };
    assert_eq!((line, column), (3, 3));
    let Err(Error::Study { line, column, .. }) = parse("title = \"äöü\" x\n[model.tensor]\n") else {
        panic!()
    };
    assert_eq!((line, column), (1, 15));
}

#[test]
fn numbers_are_read_as_toml_writes_them() {
    let text = "[model.tensor]\ngamma = +1_000\nkappa2 = -1_0.5e-1\nkappa3 = 0x10\na1 = 0b101\na2 = 0o17\na3 = -0.0\n\
        [run]\nseed = 0xff_ff\nmax_steps = 18446744073709551615\n";
    // TOML's integers end at 2^63 - 1; a reader may go on to 2^64 - 1, ours or the parser's choice.
    let study = parse(text).or_else(|_| parse(&text.replace("18446744073709551615", "9223372036854775807")));
    let study = study.unwrap();
    let values: Vec<f64> = study.parameters.iter().map(|entry| entry.1).collect();
    assert_eq!(values, [1000.0, -1.05, 16.0, 5.0, 15.0, 0.0]);
    assert!(values[5].is_sign_negative());
    assert_eq!(study.run.seed, 0xffff);
}

#[test]
fn a_preset_is_changed_key_by_key() {
    let read = parse(
        "preset = \"fig3\"\ntitle = \"Mine\"\n[model.tensor]\ngamma = 0.03\n[initial]\nx = 1\n\
         [run]\nt_end = 50\n[return_map]\ny = 2.5\n[figure]\nto = 20\n",
    )
    .unwrap();
    let expected = preset("fig3", |study| {
        "study".clone_into(&mut study.name);
        "Mine".clone_into(&mut study.title);
        study.set("gamma", 0.03).unwrap();
        study.set_initial("x", 1.0).unwrap();
        study.run.t_end = 50.0;
        study.return_map.as_mut().unwrap().y = 2.5;
        study.figure.to = 20.0;
    });
    assert_eq!(read, expected);
    let same = parse("preset = \"fig3\"\n[model.tensor]\n").unwrap();
    assert_eq!(same, preset("fig3", |study| "study".clone_into(&mut study.name)));
}

#[test]
fn what_a_fit_says_of_itself_is_passed_over() {
    let alone = parse("[model.tensor]\ngamma = 0.5\n").unwrap();
    let fitted =
        "[model.tensor]\ngamma = 0.5\n[fit]\nfiles = [\"a.csv\"]\ncovariance = [[1e-3, nan], [nan, 2]]\n";
    assert_eq!(parse(fitted).unwrap(), alone);
}

#[test]
fn ties_are_texts_of_parameters() {
    let mut expected = parse("[model.tensor]\nd3 = 0.5\n").unwrap();
    expected.tie("b3", "2*d3").unwrap();
    assert_eq!(parse("[model.tensor]\nd3 = 0.5\n[ties]\nb3 = \"2*d3\"\n").unwrap(), expected);
    for wrong in ["b3 = 2", "b33 = \"d3\"", "b3 = \"d33\"", "b3 = \"b3\""] {
        let problem = parse(&format!("[model.tensor]\n[ties]\n{wrong}\n")).unwrap_err().to_string();
        assert!(problem.contains("study.toml:3:"), "{wrong}: {problem}");
    }
}

#[test]
fn a_model_alone_is_a_study() {
    let mut expected = Study::of_model(tensor());
    "study".clone_into(&mut expected.name);
    assert_eq!(parse("[model.tensor]\n").unwrap(), expected);
}

/// The tables and keys of the schema for one model, as `table.key -> schema of the value`.
fn schema_keys(info: &ModelInfo) -> Vec<(String, Value)> {
    let defaults: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
    let schema = study::schema();
    let mut keys = Vec::new();
    for (name, value) in schema["properties"].as_object().unwrap() {
        if ["fit", "ties"].contains(&name.as_str()) {
            continue; // whatever fits say of themselves, and parameters of any model: see the tests of each
        }
        let tables = match name.as_str() {
            "model" => vec![(format!("model.{}", info.name), &value["properties"][info.name])],
            _ if value["type"] == "object" => vec![(name.clone(), value)],
            _ => {
                keys.push((name.clone(), value.clone()));
                continue;
            }
        };
        for (table, value) in tables {
            assert_eq!(value["additionalProperties"], false, "{table}");
            for (key, value) in value["properties"].as_object().unwrap() {
                let of_another_model =
                    table == "initial" && key != "random" && info.coordinate(&defaults, key).is_err();
                if !of_another_model {
                    keys.push((format!("{table}.{key}"), value.clone()));
                }
            }
        }
    }
    keys
}

/// A file made from the schema alone is accepted whole; each key has a description.
#[test]
fn the_reader_accepts_every_key_of_the_schema() {
    let mut text = String::new();
    for (key, value) in schema_keys(tensor()) {
        assert!(value["description"].as_str().is_some_and(|text| text.len() > 3), "{key}: {value}");
        let example = match value["type"].as_str().unwrap_or("either") {
            "either" if key == "initial.random" => "0.5",
            "string" if key == "preset" => "\"fig5a\"",
            "string" if key == "continue.along" => "\"gamma=0:1\"",
            "string" if key == "continue.in" => "\"gamma,kappa2=0:1\"",
            "string" if key == "continue.from" => "\"zigzag\"",
            "string" if key == "continue.direction" => "\"up\"",
            "string" => "\"text\"",
            "number" if key == "display.speed" => "5",
            "number" => "0.5",
            "integer" => "3",
            "boolean" => "true",
            "array" if key == "scan.axes" => "[\"gamma=0:1:3\"]",
            "array" if key == "display.plane" => "[\"gamma=0,1\"]",
            "array" if key == "continue.curve" => "[\"hopf\"]",
            "array" => "[\"gamma\"]",
            other => panic!("{key}: {other}"),
        };
        writeln!(text, "{key} = {example}").unwrap();
    }
    let study = parse(&text).unwrap();
    assert_eq!((study.parameters.len(), study.run.seed, study.random), (21, 3, Some(0.5.into())));
}

/// The keys that the reader names in its messages stand in the schema.
#[test]
fn the_schema_has_every_key_that_the_reader_knows() {
    for info in MODELS {
        let schema: BTreeSet<String> = schema_keys(info).into_iter().map(|(key, _)| key).collect();
        assert_eq!(schema, keys_that_the_reader_knows(info));
    }
}

fn keys_that_the_reader_knows(info: &ModelInfo) -> BTreeSet<String> {
    let model = format!("model.{}", info.name);
    let mut known: BTreeSet<String> =
        info.parameters().iter().map(|spec| format!("{model}.{}", spec.name)).collect();
    let listed = |complaint: &str| -> Vec<String> {
        let list = complaint.lines().next().unwrap().rsplit_once(" are ").unwrap().1;
        list.split(", ").map(str::to_owned).collect()
    };
    for table in ["run", "scan", "continue", "atlas", "return_map", "figure", "display"] {
        let keys = listed(&complaint(&format!("[{model}]\n[{table}]\nzzz = 1\n")));
        known.extend(keys.iter().map(|key| format!("{table}.{key}")));
    }
    let initial = listed(&complaint(&format!("[{model}]\n[initial]\nzzz = 1\n")));
    known.extend(initial.iter().chain([&"random".to_owned()]).map(|key| format!("initial.{key}")));
    let tables = [
        "model",
        "ties",
        "initial",
        "run",
        "scan",
        "continue",
        "atlas",
        "return_map",
        "figure",
        "display",
        "fit",
    ];
    let top = listed(&complaint(&format!("zzz = 1\n[{model}]\n")));
    known.extend(top.into_iter().filter(|key| !tables.contains(&key.as_str())));
    known
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// The answer to any text in a study file is a study, or an error at a line that exists.
    #[test]
    fn no_text_is_too_strange(
        which in 0..PRESETS.len(),
        at in 0.0..1.0,
        drop in 0_usize..40,
        insert in "\\PC{0,8}|[\\[\\]\"'=.\\r\\n\\t#]{1,5}",
    ) {
        let text: Vec<char> = PRESETS[which].text.chars().collect();
        let at = (at * text.len() as f64) as usize;
        let end = (at + drop).min(text.len());
        let text: String = text[..at].iter().chain(&insert.chars().collect::<Vec<_>>()).chain(&text[end..]).collect();
        if let Err(Error::Study { line, column, problem, .. }) = parse(&text) {
            prop_assert!(line >= 1 && line <= text.matches('\n').count() + 1);
            prop_assert!(column >= 1 && !problem.is_empty());
        }
    }
}
