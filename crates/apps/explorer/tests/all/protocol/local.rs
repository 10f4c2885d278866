//! A session without threads: everything that a page can ask for, and what becomes stale.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::protocol::common::{Alone, Page, binaries, is_of};
use serde_json::Value;

const BEGIN: &str = r#"{"do":"begin","model":"tensor","preset":"fig5a","state":[0.3,0.1,0.2,0.05,0.01,-0.02],"position":[0,0]}"#;

fn begun() -> Alone {
    let mut page = Alone::new(2);
    page.say(BEGIN);
    assert_eq!(page.next("begun")["revision"], 1);
    page
}

#[test]
fn what_is_no_message_is_refused_and_the_session_goes_on() {
    let mut page = Alone::new(1);
    page.say("nonsense");
    assert!(page.next("refused")["why"].as_str().unwrap().contains("JSON"));
    page.say(r#"{"do":"advance","dt":1}"#);
    assert!(page.next("refused")["why"].as_str().unwrap().contains("begin first"));
    page.say(BEGIN);
    assert_eq!(page.next("named")["regime"], "zigzag");
}

/// The page waits for the file with this number.
#[test]
fn a_file_of_no_body_is_refused_by_its_number() {
    let mut page = Alone::new(1);
    page.say(r#"{"do":"export","id":41,"what":"study.toml"}"#);
    let refused = page.next("refused");
    assert_eq!(refused["id"], 41);
    assert!(refused["why"].as_str().unwrap().contains("begin first"), "{refused}");
}

/// A start, a state, a place or a time beyond anything that can be shown is refused, and the body goes on.
#[test]
fn what_lies_beyond_everything_is_refused() {
    let mut page = begun();
    for (bad, says) in [
        (r#"{"do":"start","coordinates":{"s11":3e299}}"#, "1e9"),
        (r#"{"do":"start","coordinates":{"s11":-1.001e9}}"#, "1e9"),
        (r#"{"do":"put","state":[0.3,0.1,3e299,0,0,0]}"#, "1e9"),
        (r#"{"do":"put","velocity":[3e299,0]}"#, "1e9"),
        (r#"{"do":"put","position":[0,-3e299]}"#, "1e12"),
        (r#"{"do":"put","t":3e299}"#, "1e12"),
        (r#"{"do":"begin","model":"tensor","preset":"fig5a","state":[3e299,0,0,0,0,0]}"#, "1e9"),
        (r#"{"do":"begin","model":"tensor","preset":"fig5a","t":3e299}"#, "1e12"),
    ] {
        page.say(bad);
        let why = page.next("refused")["why"].as_str().unwrap().to_owned();
        assert!(why.contains(says), "{bad}: {why}");
    }
    page.say(r#"{"do":"start","coordinates":{"s11":0.999e9}}"#);
    assert_eq!(page.next("changed")["revision"], 2, "just inside");
}

/// The next body can begin after a swarm from any start.
#[test]
fn a_swarm_from_the_largest_start_leaves_the_session_as_it_was() {
    for from in ["starts", "near", "noises"] {
        let mut page = begun();
        page.say(r#"{"do":"start","coordinates":{"s11":1e9,"u111":-1e9}}"#);
        page.next("changed");
        page.say(&format!(r#"{{"do":"swarm","bodies":3,"from":"{from}","spread":1}}"#));
        page.say(r#"{"do":"advance","dt":1}"#);
        page.say(r#"{"do":"kick","strength":0.2}"#);
        for revision in 1..3 {
            page.say(BEGIN);
            assert!(page.next("begun")["revision"].as_u64() >= Some(revision), "{from}");
        }
        page.say(r#"{"do":"share"}"#);
        page.next("share");
    }
}

#[test]
fn what_is_found_of_an_earlier_motion_is_not_told() {
    let mut page = begun();
    // The errand of the first motion is on its way when the body changes.
    let first = page.errands.lock().unwrap().pop_front().unwrap();
    page.say(r#"{"do":"set","parameters":{"kappa2":0.5}}"#);
    let back = std::sync::Mutex::new(Vec::new());
    motiform_explorer::assist(&first, &|text| back.lock().unwrap().push(text.to_owned()));
    for report in back.into_inner().unwrap() {
        page.session.report(&report);
    }
    assert!(page.answered().iter().all(|answer| !is_of(answer, "named")));
    assert_eq!(page.next("named")["revision"], 2);
}

#[test]
fn a_map_is_computed_by_helpers_and_has_evidence() {
    let mut page = begun();
    page.say(r#"{"do":"map","epoch":3,"x":{"name":"kappa2","low":0.5,"high":1.5},"y":null,"count":16}"#);
    assert_eq!(page.errands.lock().unwrap().len(), 3, "the name, and a batch for each helper");
    let mapped = page.next("mapped");
    assert_eq!((mapped["epoch"].as_u64(), mapped["cells"].as_u64() >= Some(16)), (Some(3), true));
    page.say(r#"{"do":"evidence","epoch":3,"cell":[5,0]}"#);
    let evidence = page.next("evidence");
    assert!(evidence["regime"].is_string() && evidence["numbers"]["lambda_1"].is_number(), "{evidence}");
    page.say(r#"{"do":"export","id":4,"what":"map.csv"}"#);
    let all = page.answered();
    let file = String::from_utf8_lossy(binaries(&all, 3)[0]).into_owned();
    assert!(file.contains("cell,sample,kappa2,regime"), "{file}");
}

#[test]
fn a_map_that_is_not_wanted_any_more_is_cleared() {
    let mut page = begun();
    page.say(r#"{"do":"map","epoch":3,"x":{"name":"kappa2","low":0.5,"high":1.5},"y":null,"count":16}"#);
    page.say(r#"{"do":"unmap"}"#);
    let errands = page.errands.lock().unwrap().clone();
    let cleared = errands.iter().filter(|text| text.starts_with("map") && text.ends_with('\n')).count();
    assert_eq!(cleared, 2);
    while page.work() {}
    assert!(page.answered().iter().all(|answer| !is_of(answer, "mapped")));
}

#[test]
fn branches_returns_and_swarms_are_computed_by_helpers() {
    let mut page = begun();
    page.say(r#"{"do":"follow","epoch":1,"along":{"name":"kappa2","low":0.6,"high":1.2},"branches":1}"#);
    assert_eq!(page.next("followed")["branches"], 1);
    page.say(r#"{"do":"place","epoch":1,"branch":0,"point":3}"#);
    let orbit: Value = page.next("orbit");
    assert!(orbit["points"].as_array().unwrap().len() > 10);
    page.say(r#"{"do":"returns","section":"speed","count":20}"#);
    assert_eq!(page.next("returns")["complete"], true);
    page.say(r#"{"do":"swarm","bodies":2,"from":"starts","spread":0}"#);
    assert!(page.next("member")["body"].as_u64().is_some_and(|body| body < 2));
    page.say(r#"{"do":"export","id":1,"what":"study.toml"}"#);
    assert_eq!(binaries(&page.answered(), 3).len(), 1);
}
