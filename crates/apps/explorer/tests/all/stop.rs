//! A server ends soon whatever it computes: no job outlives its page.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::Running;
use std::time::{Duration, Instant};

/// A second is asked for; a busy machine gets some.
const SOON: Duration = Duration::from_secs(5);

/// Bodies whose naming takes long: chaos that begins, rests at saddles, weak chaos, a motion at rest.
const BODIES: [(&str, &str); 6] = [
    ("cell", r#"{"length":13.5}"#),
    ("cell", r#"{"length":29.45}"#),
    ("cell", r#"{"length":6.0}"#),
    ("cell", r#"{"length":0.1}"#),
    ("tensor", r#"{"gamma":0.001,"kappa2":-0.1,"kappa3":1,"a1":1,"b1":0.5,"b3":1}"#),
    ("tensor", r#"{"gamma":1,"kappa2":0.5,"kappa3":0.1,"a1":-1,"b1":-0.5,"b2":0.3,"d1":0.1,"d2":0.8}"#),
];

/// The time that a server takes to end.
fn end(server: Running) -> Duration {
    let begun = Instant::now();
    drop(server);
    begun.elapsed()
}

/// A page that never answers the close, one that never reads, and a connection that never asks: none of them is waited for.
#[test]
fn a_client_that_does_not_listen() {
    let server = Running::anywhere();
    let mut silent = server.page();
    let mut deaf = server.page();
    silent.begin("tensor", Some("fig5a"));
    deaf.begin("tensor", Some("fig5a"));
    let mute = std::net::TcpStream::connect(server.host()).unwrap();
    // More answers than the system keeps for a reader that does not read them.
    deaf.socket.get_mut().set_write_timeout(Some(Duration::from_millis(200))).unwrap();
    for _ in 0..1000 {
        if deaf.socket.send(tungstenite::Message::text(r#"{"do":"advance","dt":5}"#)).is_err() {
            break;
        }
    }
    std::thread::sleep(Duration::from_millis(300));
    let took = end(server);
    println!("nobody listens: {took:?}");
    assert!(took < Duration::from_secs(1), "{took:?}");
    drop((silent, deaf, mute));
}

/// At several moments of naming and of exponents; each moment with two of the bodies, at which other work is under way.
#[test]
fn while_a_body_is_named() {
    for ((model, parameters), wait) in BODIES.into_iter().zip([50, 700, 2500].into_iter().cycle()) {
        let server = Running::anywhere();
        let mut page = server.page();
        page.say(&format!(r#"{{"do":"begin","model":"{model}","parameters":{parameters}}}"#));
        page.json("begun");
        std::thread::sleep(Duration::from_millis(wait));
        let took = end(server);
        println!("{model} {parameters} after {wait} ms: {took:?}");
        assert!(took < SOON, "{model} {parameters} after {wait} ms: {took:?}");
    }
}

#[test]
fn while_a_map_is_filled() {
    let axis = |name: &str, low: f64, high: f64| format!(r#"{{"name":"{name}","low":{low},"high":{high}}}"#);
    let maps = [
        ("cell", axis("length", 13.0, 14.0), "null".to_owned()),
        ("tensor", axis("kappa2", -0.2, 0.2), axis("gamma", -0.02, 0.02)),
    ];
    for (model, x, y) in maps {
        let server = Running::anywhere();
        let mut page = server.page();
        let preset = if model == "cell" { "fig6a" } else { "fig1" };
        page.begin(model, Some(preset));
        page.say(&format!(r#"{{"do":"map","epoch":1,"x":{x},"y":{y},"count":97}}"#));
        std::thread::sleep(Duration::from_millis(800));
        let took = end(server);
        println!("map of {model}: {took:?}");
        assert!(took < SOON, "map of {model}: {took:?}");
    }
}

#[test]
fn while_branches_are_followed() {
    for wait in [50, 1000, 4000] {
        let server = Running::anywhere();
        let mut page = server.page();
        page.say(
            r#"{"do":"begin","model":"tensor","preset":"fig4","parameters":{"kappa2":0.9,"kappa3":0.1}}"#,
        );
        page.json("begun");
        page.say(r#"{"do":"follow","epoch":1,"along":{"name":"kappa2","low":0.3,"high":1.6},"branches":24}"#);
        std::thread::sleep(Duration::from_millis(wait));
        let took = end(server);
        println!("branches after {wait} ms: {took:?}");
        assert!(took < SOON, "branches after {wait} ms: {took:?}");
    }
}

#[test]
fn while_a_file_is_made() {
    for what in ["body.apng", "path.png", "map.csv"] {
        let server = Running::anywhere();
        let mut page = server.page();
        page.begin("tensor", Some("fig5a"));
        page.advance_whole(200.0);
        page.say(&format!(r#"{{"do":"export","id":5,"what":"{what}","section":"path","y":null}}"#));
        std::thread::sleep(Duration::from_millis(30));
        let took = end(server);
        println!("{what}: {took:?}");
        assert!(took < SOON, "{what}: {took:?}");
    }
}
