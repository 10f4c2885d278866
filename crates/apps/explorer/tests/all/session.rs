//! The messages to a page: the body, its motion, the files.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Page, Running};
use motiform_study::presets::PRESETS;
use motiform_study::{RunPlan, Study};
use serde_json::Value;
use std::time::Duration;

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
