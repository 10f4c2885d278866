//! Branches of the motion on the screen: what is told of them, and bodies placed on their points.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Page, Running};
use serde_json::Value;

/// The body of Fig. 4 on the zigzag of docs/continuation.md.
fn zigzag(server: &Running) -> Page {
    let mut page = server.page();
    page.say(r#"{"do":"begin","model":"tensor","preset":"fig4","parameters":{"kappa2":0.9,"kappa3":0.1}}"#);
    page.json("begun");
    page
}

fn follow(page: &mut Page, epoch: u32, branches: u32) {
    let along = r#"{"name":"kappa2","low":0.3,"high":1.6}"#;
    page.say(&format!(r#"{{"do":"follow","epoch":{epoch},"along":{along},"branches":{branches}}}"#));
}

fn place(page: &mut Page, branch: u64, point: usize) {
    page.say(&format!(r#"{{"do":"place","epoch":1,"branch":{branch},"point":{point}}}"#));
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn near(value: &Value, expected: f64, tolerance: f64) {
    let value = value.as_f64().unwrap();
    assert!((value - expected).abs() <= tolerance, "{value} is not {expected} +- {tolerance}");
}

/// The values are those that `motiform continue` gives: the start is another state on the same zigzag.
#[test]
fn branches_come_one_by_one_with_their_special_points() {
    let server = Running::anywhere();
    let mut page = zigzag(&server);
    follow(&mut page, 1, 4);
    let start = page.json("branches");
    assert_eq!((&start["along"]["name"], &start["parameters"]["kappa3"]), (&"kappa2".into(), &0.1.into()));
    let mut straight = [Vec::new(), Vec::new()];
    let motions: Vec<Value> = (0..4)
        .map(|number| {
            let branch = page.json("branch");
            if number == 1 {
                straight = ["parameter", "speed"].map(|name| numbers(&branch[name]));
            }
            assert_eq!((branch["epoch"].as_u64(), branch["branch"].as_u64()), (Some(1), Some(number)));
            let count = |name: &str| branch[name].as_array().unwrap().len();
            let points = count("parameter");
            assert!(points > 50);
            assert_eq!(["speed", "period", "motion", "unstable", "neutral"].map(count), [points; 5]);
            assert_eq!(["between", "stable"].map(count), [points - 1; 2]);
            branch["between"][points / 2].clone()
        })
        .collect();
    assert_eq!(motions, ["zigzag", "straight", "quasi-periodic", "circular"]);
    let done = page.json("followed");
    assert_eq!(
        (done["branches"].as_u64(), done["left"].as_u64(), &done["why"]),
        (Some(4), Some(4), &Value::Null)
    );
    let mut specials = Value::Null;
    for _ in 0..4 {
        specials = page.json("specials");
    }
    let points = specials["points"].as_array().unwrap();
    let of = |branch: u64| points.iter().filter(move |point| point["branch"] == branch).collect::<Vec<_>>();
    let zigzag = of(0);
    let kinds: Vec<_> = zigzag.iter().map(|point| point["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["symmetry-breaking", "symmetry-breaking", "homoclinic"]);
    for (point, value) in zigzag.iter().zip([0.783_547_485, 1.148_047_264, 1.344_178_98]) {
        near(&point["parameter"], value, 1e-7);
    }
    // at the connection the orbit is at its saddle, the straight motion there
    let [parameter, speed] = straight;
    let after =
        (1..parameter.len()).find(|&k| (parameter[k - 1] < 1.344_178_98) != (parameter[k] < 1.344_178_98));
    let (low, high) = (speed[after.unwrap() - 1], speed[after.unwrap()]);
    near(&zigzag[2]["speed"], 0.5 * (low + high), 0.6 * (high - low).abs());
    assert!(zigzag[0]["speed"].is_null());
    let hopf = of(3);
    assert_eq!((&hopf[0]["kind"], &hopf[0]["criticality"]), (&"hopf".into(), &"subcritical".into()));
    near(&hopf[0]["parameter"], 1.121_937_264, 1e-7);
}

#[test]
fn a_body_placed_on_a_stable_point_follows_its_orbit() {
    let server = Running::anywhere();
    let mut page = zigzag(&server);
    follow(&mut page, 1, 1);
    let branch = page.json("branch");
    page.json("followed");
    let (unstable, parameter) = (numbers(&branch["unstable"]), numbers(&branch["parameter"]));
    let point = (0..unstable.len()).find(|&k| unstable[k] == 0.0 && parameter[k] > 0.85).unwrap();
    let before = page.advance(3.0);
    place(&mut page, 0, point);
    let changed = page.json("changed");
    near(&changed["parameters"]["kappa2"], parameter[point], 1e-9);
    let orbit = page.json("orbit");
    assert_eq!((&orbit["revision"], orbit["unstable"].as_u64()), (&changed["revision"], Some(0)));
    assert_eq!(orbit["parameters"], changed["parameters"]);
    near(&orbit["t"], before.t, 1e-12);
    let after = page.advance_whole(orbit["time"].as_f64().unwrap());
    let points = orbit["points"].as_array().unwrap();
    let end = numbers(points.last().unwrap());
    // the body runs with the tolerance of a picture
    for axis in 0..2 {
        assert!((after.position[axis] - before.position[axis] - end[axis]).abs() < 1e-4);
    }
}

#[test]
fn a_body_placed_on_an_unstable_point_leaves_its_orbit() {
    let server = Running::anywhere();
    let mut page = zigzag(&server);
    follow(&mut page, 1, 2);
    page.json("branch");
    let straight = page.json("branch");
    assert_eq!(straight["between"][0], "straight");
    let parameter = numbers(&straight["parameter"]);
    let point = (0..parameter.len()).find(|&k| parameter[k] > 0.9).unwrap();
    assert!(numbers(&straight["unstable"])[point] > 0.0);
    let before = page.advance(1.0);
    place(&mut page, 1, point);
    let orbit = page.json("orbit");
    assert!(orbit["unstable"].as_u64().unwrap() > 0);
    let speed = numbers(&straight["speed"])[point];
    let aside = |page: &mut Page, dt: f64| {
        let after = page.advance_whole(dt);
        let way = [0, 1].map(|axis| after.position[axis] - before.position[axis]);
        let line = numbers(&orbit["points"][360]);
        let along = line[0].hypot(line[1]);
        near(&Value::from(along), speed * orbit["time"].as_f64().unwrap(), 1e-4 * along);
        ((line[0] * way[1] - line[1] * way[0]) / along).abs()
    };
    assert!(aside(&mut page, 2.0) < 0.05, "it begins on the line");
    assert!(aside(&mut page, 600.0) > 1.0, "it has left the line");
}

#[test]
fn branches_of_another_body_are_dropped() {
    let server = Running::anywhere();
    let mut page = zigzag(&server);
    follow(&mut page, 1, 1);
    page.json("followed");
    page.say(r#"{"do":"set","parameters":{"kappa2":1.0}}"#);
    page.json("changed");
    place(&mut page, 0, 3);
    page.json("orbit");
    page.json("changed");
    page.say(r#"{"do":"set","parameters":{"gamma":0.9}}"#);
    page.json("changed");
    place(&mut page, 0, 3);
    assert!(page.json("refused")["why"].as_str().unwrap().contains("follow the branches again"));
    place(&mut page, 7, 3);
    page.json("refused");
}

#[test]
fn what_cannot_be_followed_is_said() {
    let server = Running::anywhere();
    let mut page = server.page();
    page.begin("tensor", Some("fig5b"));
    follow(&mut page, 1, 2);
    let why = page.json("followed")["why"].clone();
    assert!(why.as_str().unwrap().contains("neither is steady nor repeats"), "{why}");
    page.begin("cell", Some("fig6a"));
    page.say(r#"{"do":"follow","epoch":2,"along":{"name":"modes","low":8,"high":32},"branches":2}"#);
    let why = page.json("followed")["why"].clone();
    assert!(why.as_str().unwrap().contains("whole number"), "{why}");
}

#[test]
fn following_stops_on_request() {
    let server = Running::anywhere();
    let mut page = zigzag(&server);
    follow(&mut page, 1, 24);
    page.json("branch");
    page.say(r#"{"do":"unfollow"}"#);
    place(&mut page, 0, 3);
    page.json("orbit");
    follow(&mut page, 2, 1);
    assert_eq!(page.json("followed")["epoch"], 2, "there is no end of the first one");
}
