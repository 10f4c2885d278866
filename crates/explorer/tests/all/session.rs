//! The messages to a page: the body, its motion, the map, the files.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Page, Running};
use motiform_lab::analyse;
use motiform_models::ModelInfo;
use motiform_study::presets::PRESETS;
use motiform_study::{RunPlan, Study, presets};
use serde_json::Value;
use std::time::Duration;
use tungstenite::Message;

#[test]
fn every_preset_begins_and_moves() {
    let server = Running::anywhere();
    let mut page = server.page();
    for preset in PRESETS {
        let begun = page.begin(preset.model, Some(preset.name));
        assert!(begun["about"].as_str().unwrap().contains("Fig."));
        let first = page.advance(0.0);
        let sample = begun["sample"].as_f64().unwrap();
        let then = page.advance_whole(20.0 * sample);
        assert!((then.t - first.t - 20.0 * sample).abs() < 1e-9, "{}", preset.name);
        assert_eq!((first.flags & 1, then.flags & 1, then.outline.len()), (1, 1, 96), "{}", preset.name);
        assert!(first.samples.len() == 1 && (19..=21).contains(&then.samples.len()));
        assert_ne!(first.coordinates, then.coordinates, "{}", preset.name);
        assert!(
            then.radius > 0.0 && then.samples[0].len() == 5 + begun["observables"].as_array().unwrap().len()
        );
    }
}

#[test]
fn a_change_keeps_the_state_and_is_named() {
    let server = Running::anywhere();
    let mut page = server.page();
    let begun = page.begin("tensor", Some("fig5a"));
    assert_eq!(named(&mut page, revision(&begun)), "zigzag");
    let before = page.advance(3.0);
    page.say(r#"{"do":"set","parameters":{"kappa2":0.5,"kappa3":0.1}}"#);
    let changed = page.json("changed");
    assert_eq!(changed["parameters"]["kappa2"], 0.5);
    let after = page.advance(0.0);
    assert_eq!((after.t, after.position), (before.t, before.position));
    assert_eq!(after.coordinates, before.coordinates);
    assert_eq!(u64::from(after.revision), revision(&changed));
    assert_eq!(named(&mut page, revision(&changed)), "chaotic");
    let exponents = page.next(|message| {
        let value: Value = serde_json::from_str(message.to_text().ok()?).ok()?;
        let changed = value["revision"].as_u64() == Some(revision(&changed));
        (value["is"] == "exponents" && changed && value["done"] == true).then_some(value)
    });
    let largest = &exponents["exponents"][0];
    assert!(largest["value"].as_f64().unwrap() > 3.0 * largest["error"].as_f64().unwrap(), "{exponents}");
}

#[test]
fn kick_noise_restart_and_a_state_to_begin_with() {
    let server = Running::anywhere();
    let mut page = server.page();
    page.begin("tensor", Some("fig2"));
    let before = page.advance(1.0);
    page.say(r#"{"do":"kick"}"#);
    page.json("changed");
    let kicked = page.advance(0.0);
    assert!(kicked.coordinates != before.coordinates && kicked.position == before.position);
    page.say(r#"{"do":"restart"}"#);
    page.json("changed");
    let again = page.advance(0.0);
    assert_eq!((again.t, again.coordinates[0], again.coordinates[1]), (0.0, 0.02, 0.03));
    page.say(r#"{"do":"noise","amplitude":0.05}"#);
    assert_eq!(page.json("changed")["noise"], 0.05);
    let (a, b) = (page.advance(20.0), page.advance(20.0));
    assert!(a.t < b.t);
    // What a page knows is enough to begin there again.
    let state = serde_json::to_string(&b.coordinates).unwrap();
    let [x, y] = b.position;
    page.say(&format!(
        concat!(
            r#"{{"do":"begin","model":"tensor","preset":"fig2","parameters":{{"gamma":-0.05}},"#,
            r#""state":{},"position":[{:?},{:?}],"t":{:?}}}"#
        ),
        state, x, y, b.t
    ));
    assert_eq!(page.json("begun")["parameters"]["gamma"], -0.05);
    let back = page.advance(0.0);
    assert_eq!((back.t, back.position), (b.t, b.position));
    for (a, b) in back.coordinates.iter().zip(&b.coordinates) {
        assert!((a - b).abs() <= 4.0 * f64::EPSILON * b.abs().max(1e-3), "{a} {b}");
    }
}

#[test]
fn a_body_that_blows_up_says_so_and_can_be_restarted() {
    let server = Running::anywhere();
    let mut page = server.page();
    page.say(concat!(
        r#"{"do":"begin","model":"tensor","preset":"fig4","parameters":{"kappa2":0.2,"kappa3":0.1},"#,
        r#""state":[8,1,30,0,-20,0],"position":null}"#
    ));
    page.json("begun");
    page.advance_whole(5.0);
    let ended = page.json("ended");
    assert_eq!(ended["outcome"], "blow-up");
    assert!(ended["text"].as_str().unwrap().contains("t*"));
    let rest = page.advance(5.0);
    assert_eq!(rest.t, page.advance(5.0).t, "it goes on no further");
    page.say(r#"{"do":"restart"}"#);
    page.json("changed");
    assert!(page.advance(1.0).t > 0.0);
}

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

#[test]
fn files_are_what_they_are_called() {
    let server = Running::anywhere();
    let mut page = server.page();
    page.begin("tensor", Some("fig3"));
    assert!(page.export("path.svg").unwrap_err().contains("let the body move on"));
    page.advance_whole(8000.0);
    page.json("exponents");
    page.say(
        r#"{"do":"map","epoch":1,"x":{"name":"kappa2","low":-0.2,"high":0.2},"y":{"name":"gamma","low":-0.1,"high":0.1},"count":8}"#,
    );
    page.json("mapped");
    for subject in ["path", "series", "spectrum", "return-map", "exponent", "map"] {
        let (head, svg) = page.export(&format!("{subject}.svg")).unwrap();
        assert_eq!(head["name"], format!("motiform-fig3-{subject}.svg"));
        let text = String::from_utf8(svg).unwrap();
        assert!(text.starts_with("<svg") && text.trim_end().ends_with("</svg>"), "{subject}");
        let (head, png) = page.export(&format!("{subject}.png")).unwrap();
        assert!(head["mime"] == "image/png" && png.starts_with(b"\x89PNG"), "{subject}");
    }
    let apng = page.export("body.apng").unwrap().1;
    assert!(apng.starts_with(b"\x89PNG") && apng.windows(4).any(|chunk| chunk == b"acTL"));
    let csv = String::from_utf8(page.export("motion.csv").unwrap().1).unwrap();
    assert!(csv.starts_with("t,x,y,v1,v2,s11,s12,u111,u222,speed,turning_rate,s_norm,u_norm\n"));
    assert!(csv.lines().count() > 10_000 && !csv.contains("NaN"));
    let csv = String::from_utf8(page.export("map.csv").unwrap().1).unwrap();
    assert!(csv.starts_with("cell,sample,kappa2,gamma,regime,attractor,course,margin"));
    let toml = String::from_utf8(page.export("study.toml").unwrap().1).unwrap();
    let study = Study::parse(&toml, "study.toml", "study").unwrap();
    let now = page.advance(0.0).coordinates;
    assert_eq!(study.initial[..6].iter().map(|entry| entry.1).collect::<Vec<_>>(), now);
    RunPlan::new(&study).unwrap();
}

/// The strips of Fig. 3 from the page: a closed curve of many points, and spectra with the right names.
#[test]
fn strips_show_the_motion() {
    let server = Running::anywhere();
    let mut page = server.page();
    page.begin("tensor", Some("fig3"));
    page.advance_whole(8000.0);
    page.say(r#"{"do":"strips","section":"path","y":null}"#);
    let strips = page.json("strips");
    let points = strips["returns"]["points"].as_array().unwrap();
    assert_eq!(strips["returns"]["y"], 0.0);
    assert!(points.len() > 60, "{}", points.len());
    assert_closed(points);
    let names: Vec<_> =
        strips["spectra"].as_array().unwrap().iter().map(|curve| curve["name"].clone()).collect();
    assert_eq!(names, ["speed", "s_norm"], "the triangle of the reduced model has decayed");
    let lengths =
        [&strips["frequencies"], &strips["spectra"][0]["power"]].map(|list| list.as_array().unwrap().len());
    assert!(lengths[0] > 500 && lengths[0] == lengths[1]);
    page.say(r#"{"do":"strips","section":"speed","y":null}"#);
    assert!(page.json("strips")["returns"]["points"].as_array().unwrap().len() > 50);
}

/// Points on a closed curve about their centre: seen from there none is far from the next.
fn assert_closed(points: &[Value]) {
    let points: Vec<[f64; 2]> = points.iter().map(|p| [0, 1].map(|k| p[k].as_f64().unwrap())).collect();
    let centre = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64);
    let polar = |p: &[f64; 2]| {
        let [x, y] = [p[0] - centre[0], p[1] - centre[1]];
        (y.atan2(x), x.hypot(y))
    };
    let mut seen: Vec<(f64, f64)> = points.iter().map(polar).collect();
    seen.sort_by(|a, b| a.0.total_cmp(&b.0));
    let size = seen.iter().map(|p| p.1).fold(0.0, f64::max);
    let next = seen.iter().cycle().skip(1);
    for (a, b) in seen.iter().zip(next) {
        let turn = (b.0 - a.0).rem_euclid(std::f64::consts::TAU);
        assert!(turn < 0.5 && (b.1 - a.1).abs() < 0.25 * size, "{a:?} {b:?}");
    }
}

/// A circle at constant speed has no spectrum: it would be that of round-off.
#[test]
fn a_steady_motion_has_no_spectrum() {
    let server = Running::anywhere();
    let mut page = server.page();
    page.begin("tensor", Some("fig4"));
    page.advance_whole(60.0);
    page.say(r#"{"do":"strips","section":"speed","y":null}"#);
    let strips = page.json("strips");
    assert!(strips["frequencies"].as_array().unwrap().len() > 100);
    assert!(strips["spectra"].as_array().unwrap().is_empty(), "{strips}");
    assert!(strips["returns"]["points"].as_array().unwrap().is_empty());
}

#[test]
fn a_session_ends_with_its_page() {
    let threads = || std::fs::read_dir("/proc/self/task").map(Iterator::count);
    let Ok(_) = threads() else { return }; // no such count on this system
    let server = Running::anywhere();
    let before = threads().unwrap();
    for _ in 0..20 {
        let mut page = server.page();
        page.begin("cell", Some("fig6a"));
        page.say(r#"{"do":"map","epoch":1,"x":{"name":"length","low":6,"high":32},"y":null,"count":64}"#);
        page.json("map");
    }
    for _ in 0..400 {
        if threads().unwrap() <= before + 2 {
            return;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    panic!("{before} threads before, {} after", threads().unwrap());
}

fn revision(value: &Value) -> u64 {
    value["revision"].as_u64().unwrap()
}

fn named(page: &mut Page, revision: u64) -> String {
    let named = page.next(|message| {
        let value: Value = serde_json::from_str(message.to_text().ok()?).ok()?;
        (value["is"] == "named" && value["revision"] == revision).then_some(value)
    });
    assert!(named["why"].as_str().unwrap().len() > 10);
    named["regime"].as_str().unwrap().to_owned()
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
