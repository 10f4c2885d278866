//! Requests by hand about the body, the computations ahead of it, and the bodies of a swarm.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Page, Running};
use serde_json::Value;
use tungstenite::Message;

#[test]
fn a_body_is_pulled_thrown_and_put_elsewhere() {
    let server = Running::anywhere();
    let mut page = server.page();
    page.begin("tensor", Some("fig5a"));
    let before = page.advance(1.0);
    let state = serde_json::to_string(&before.coordinates).unwrap();
    let to = [1.4 * before.radius, 0.0];
    page.say(&format!(r#"{{"do":"pull","state":{state},"to":{to:?}}}"#));
    page.json("changed");
    let pulled = page.advance(0.0);
    let right = pulled.outline.iter().filter(|point| point[1].abs() < 0.1 * before.radius);
    let reach = right.map(|point| point[0]).fold(0.0, f64::max);
    // a larger deformation may be drawn about a larger circle
    let wanted = to[0] + pulled.radius - before.radius;
    assert!((reach / wanted - 1.0).abs() < 0.03, "{reach} for {wanted}");
    assert_eq!(pulled.coordinates[..2], before.coordinates[..2], "the velocity stays");
    assert_eq!((pulled.t, pulled.position), (before.t, before.position));
    page.say(r#"{"do":"put","position":[5,-2],"velocity":[0.3,0.4]}"#);
    page.json("changed");
    let thrown = page.advance(0.0);
    assert_eq!((thrown.position, &thrown.coordinates[..2]), ([5.0, -2.0], [0.3, 0.4].as_slice()));
    assert_eq!(thrown.coordinates[2..], pulled.coordinates[2..], "the shape stays");
    // Everything at once, as undoing does it.
    let [x, y] = before.position;
    let all = format!(
        r#"{{"do":"put","parameters":{{"kappa2":0.8}},"state":{state},"position":[{x},{y}],"t":{},"noise":0.01}}"#,
        before.t
    );
    page.say(&all);
    let changed = page.json("changed");
    assert_eq!(
        (&changed["parameters"]["kappa2"], &changed["noise"]),
        (&Value::from(0.8), &Value::from(0.01))
    );
    let again = page.advance(0.0);
    assert_eq!((again.t, again.position, again.coordinates), (before.t, before.position, before.coordinates));
}

/// Positions and distances of a swarm.
fn swarm(page: &mut Page) -> Vec<[f64; 3]> {
    page.next(|message| match message {
        Message::Binary(bytes) if bytes[0] == 4 => {
            let count = usize::from(u16::from_le_bytes([bytes[2], bytes[3]]));
            let points = usize::from(u16::from_le_bytes([bytes[4], bytes[5]]));
            assert_eq!(bytes.len(), 24 + count * (24 + 8 * points), "the whole message");
            let number =
                |place: usize| f64::from_le_bytes(bytes[24 + 8 * place..32 + 8 * place].try_into().unwrap());
            Some((0..count).map(|k| [0, 1, 2].map(|c| number(3 * k + c))).collect())
        }
        _ => None,
    })
}

#[test]
fn a_swarm_begins_goes_on_after_a_change_and_ends() {
    let server = Running::anywhere();
    let mut page = server.page();
    page.begin("tensor", Some("fig5a"));
    let at = page.advance(1.0);
    page.say(r#"{"do":"swarm","bodies":12,"from":"starts","spread":0}"#);
    let begun = swarm(&mut page);
    assert!(begun.len() == 12 && begun.iter().all(|one| one[..2] == at.position));
    let named: Vec<Value> = (0..12).map(|_| page.json("member")).collect();
    assert!(named.iter().any(|one| one["regime"] == "zigzag"), "{named:?}");
    page.advance(5.0);
    let moved = swarm(&mut page);
    assert!(moved.iter().zip(&begun).all(|(a, b)| a[..2] != b[..2]));
    page.say(r#"{"do":"set","parameters":{"kappa2":0.8}}"#);
    let revision = page.json("changed")["revision"].clone();
    page.advance(0.0);
    assert_eq!(swarm(&mut page), moved, "they go on where they were");
    assert_eq!(page.json("member")["revision"], revision);
    page.say(r#"{"do":"swarm","bodies":0,"from":"starts","spread":0}"#);
    page.advance(1.0);
    page.other.clear();
    page.advance(1.0);
    assert!(!page.other.iter().any(|one| matches!(one, Message::Binary(bytes) if bytes[0] == 4)));
    page.say(r#"{"do":"swarm","bodies":201,"from":"starts","spread":0}"#);
    assert!(page.json("refused")["why"].as_str().unwrap().contains("200"));
}

/// Two neighbouring starts of a chaotic body part; those of a zigzag do not.
#[test]
fn neighbours_of_a_chaotic_body_part() {
    let server = Running::anywhere();
    let mut page = server.page();
    let mut growth = |preset: &str| {
        page.begin("tensor", Some(preset));
        page.say(r#"{"do":"swarm","bodies":1,"from":"near","spread":1e-6}"#);
        let first = swarm(&mut page)[0][2];
        let mut last = first;
        for _ in 0..40 {
            page.advance(10.0);
            last = swarm(&mut page)[0][2];
        }
        last / first
    };
    let (chaos, order) = (growth("fig5b"), growth("fig5a"));
    assert!(chaos > 1e3 && order < 10.0, "{chaos} and {order}");
}

#[test]
fn returns_come_at_once() {
    let server = Running::anywhere();
    let mut page = server.page();
    let begun = page.begin("tensor", Some("fig3"));
    page.say(r#"{"do":"returns","section":"path","count":300}"#);
    let told = page.json("returns");
    assert_eq!((&told["revision"], &told["complete"]), (&begun["revision"], &Value::from(true)));
    let points = told["returns"]["points"].as_array().unwrap();
    assert!(points.len() >= 300, "{}", points.len());
    assert!(told["time"].as_f64().unwrap() > 1000.0);
    assert_eq!(page.advance(0.0).samples.len(), 1, "the body itself has not moved");
    // A motion without returns ends by itself, and a change ends it at once.
    page.say(concat!(
        r#"{"do":"begin","model":"tensor","preset":"fig4","parameters":{"kappa2":0.2,"kappa3":0.1},"#,
        r#""state":[8,1,30,0,-20,0],"position":[0,0]}"#
    ));
    page.json("begun");
    page.say(r#"{"do":"returns","section":"speed","count":300}"#);
    assert_eq!(page.json("returns")["complete"], false, "it blows up");
}
