//! The map beside a body: what its cells say, when it stops.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Page, Running};
use motiform_lab::analyse;
use motiform_models::ModelInfo;
use motiform_study::{RunPlan, Study, presets};
use serde_json::Value;
use tungstenite::Message;

/// A map is what `motiform classify` says of each cell's parameters, and every cell comes: those that are
/// shipped with the program, and those that are computed.
#[test]
fn the_map_says_what_classify_says() {
    let server = Running::anywhere();
    let mut page = server.page();
    page.begin("tensor", Some("fig1"));
    page.say(
        r#"{"do":"map","epoch":1,"x":{"name":"kappa2","low":-0.22,"high":0.22},"y":{"name":"gamma","low":-0.16,"high":0.12},"count":32}"#,
    );
    let map = page.json("map");
    let (columns, rows) = (count(&map["x"]), count(&map["y"]));
    assert!((32..=34).contains(&columns) && (32..=34).contains(&rows));
    assert_eq!(map["lines"].as_array().unwrap().len(), 5);
    let cells = cells(&mut page, 1);
    assert_eq!(cells.len(), columns * rows);
    let levels: Vec<u8> = cells.iter().map(|cell| cell.2).collect();
    assert!(levels.contains(&3) && levels.contains(&0));
    let study = presets::find(ModelInfo::find("tensor").unwrap(), "fig1").unwrap();
    let regimes: Vec<String> = [
        "motionless",
        "straight",
        "pulsating-straight",
        "circular",
        "spinning",
        "rectangular",
        "quasi-periodic",
        "zigzag",
        "chaotic",
        "blow-up",
        "undetermined",
    ]
    .map(str::to_owned)
    .to_vec();
    for (i, j, _, regime, _) in cells.iter().step_by(61) {
        page.say(&format!(r#"{{"do":"evidence","epoch":1,"cell":[{i},{j}]}}"#));
        let evidence = page.json("evidence");
        assert_eq!(evidence["regime"].as_str().unwrap(), regimes[usize::from(*regime)]);
        let mut study = study.clone();
        for (name, value) in evidence["parameters"].as_object().unwrap() {
            study.set(name, value.as_f64().unwrap()).unwrap();
        }
        assert_eq!(evidence["regime"], classified(&study), "{evidence}");
    }
    // The same window again costs nothing, a part of it little.
    page.say(
        r#"{"do":"map","epoch":2,"x":{"name":"kappa2","low":-0.2,"high":0.2},"y":{"name":"gamma","low":-0.16,"high":0.12},"count":12}"#,
    );
    let again = self::cells(&mut page, 2);
    assert!(!again.is_empty());
    let old = |k: f64, g: f64| {
        cells.iter().find(|cell| {
            let [x, y] = [("x", cell.0), ("y", cell.1)].map(|(axis, place)| centre(&map[axis], place));
            x.to_bits() == k.to_bits() && y.to_bits() == g.to_bits()
        })
    };
    let second = page.json("map");
    for cell in &again {
        if let Some(known) = old(centre(&second["x"], cell.0), centre(&second["y"], cell.1)) {
            assert_eq!(known.3, cell.3);
        }
    }
}

/// A change of a parameter that the map does not vary makes it stale at once; of one that it varies, not.
#[test]
fn stale_maps_stop() {
    let server = Running::anywhere();
    let mut page = server.page();
    page.begin("tensor", Some("fig4"));
    let window = r#""x":{"name":"kappa2","low":0.1,"high":1.6},"y":{"name":"kappa3","low":0.1,"high":1.0},"count":100}"#;
    page.say(&format!(r#"{{"do":"map","epoch":1,{window}"#));
    page.json("map");
    page.json("progress");
    page.say(r#"{"do":"set","parameters":{"gamma":0.9}}"#);
    page.json("changed");
    page.say(&format!(r#"{{"do":"map","epoch":2,{window}"#));
    page.json("map");
    page.other.clear();
    // From here on there is nothing of the first map.
    page.json("progress");
    page.json("progress");
    let stale = page.other.iter().filter(|message| epoch(message) == Some(1)).count();
    assert_eq!(stale, 0);
    page.say(r#"{"do":"set","parameters":{"kappa2":0.3}}"#);
    page.json("changed");
    page.json("progress"); // it goes on
    page.say(r#"{"do":"unmap"}"#);
}

#[test]
fn one_axis_is_a_map_too() {
    let server = Running::anywhere();
    let mut page = server.page();
    page.begin("tensor", Some("fig4"));
    page.say(r#"{"do":"map","epoch":4,"x":{"name":"kappa2","low":0.5,"high":1.5},"y":null,"count":16}"#);
    let map = page.json("map");
    assert!(map["y"].is_null());
    let cells = cells(&mut page, 4);
    assert_eq!(cells.len(), count(&map["x"]));
    // Fig. 4(b): the largest exponent along the axis, as the evidence has it.
    for (i, ..) in &cells {
        page.say(&format!(r#"{{"do":"evidence","epoch":4,"cell":[{i},0]}}"#));
        let numbers = &page.json("evidence")["numbers"];
        let told = cells.iter().find(|cell| cell.0 == *i).unwrap().4;
        match numbers["lambda_1"].as_f64() {
            Some(exponent) => assert_eq!(told, exponent as f32),
            None => assert!(told.is_nan()),
        }
    }
    for what in ["map.svg", "map.csv", "map.png", "map-exponents.svg", "map-exponents.png"] {
        page.export(what).unwrap();
    }
    page.say(
        r#"{"do":"map","epoch":5,"x":{"name":"kappa2","low":1.2,"high":1.5},"y":{"name":"kappa3","low":0.7,"high":1},"count":8}"#,
    );
    self::cells(&mut page, 5);
    assert!(page.export("map-exponents.svg").unwrap_err().contains("one axis"));
}

fn classified(study: &Study) -> String {
    let verdict = analyse::classify(&RunPlan::new(study).unwrap(), 0.0, &()).unwrap().unwrap();
    verdict.regime.name().to_owned()
}

fn count(side: &Value) -> usize {
    usize::try_from(side["count"].as_u64().unwrap()).unwrap()
}

fn centre(side: &Value, place: u16) -> f64 {
    side["first"].as_f64().unwrap() + f64::from(place) * side["step"].as_f64().unwrap()
}

/// The number of the map that a message belongs to.
fn epoch(message: &Message) -> Option<u32> {
    match message {
        Message::Binary(bytes) if bytes[0] == 2 => Some(u32::from_le_bytes(bytes[4..8].try_into().unwrap())),
        Message::Text(text) => {
            let value: Value = serde_json::from_str(text).ok()?;
            (value["is"] == "progress").then(|| u32::try_from(value["epoch"].as_u64().unwrap()).unwrap())
        }
        _ => None,
    }
}

/// A cell of a map: i, j, level, regime, exponent.
type Told = (u16, u16, u8, u8, f32);

/// All cells of a map.
fn cells(page: &mut Page, wanted: u32) -> Vec<Told> {
    page.json("mapped");
    let mut found = Vec::new();
    page.other.retain(|message| {
        let Message::Binary(bytes) = message else { return true };
        if bytes[0] != 2 || epoch(message) != Some(wanted) {
            return true;
        }
        found.extend(bytes[16..].chunks_exact(16).map(|cell| {
            let place = |k: usize| u16::from_le_bytes([cell[k], cell[k + 1]]);
            let exponent = f32::from_le_bytes(cell[8..12].try_into().unwrap());
            (place(0), place(2), cell[4], cell[5], exponent)
        }));
        false
    });
    found
}
