//! A session without threads says what a session on threads says, to the bit.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::protocol::common::{Alone, Page, Served, binaries};
use motiform_explorer::Answer;

const BEGIN: &str = r#"{"do":"begin","model":"tensor","preset":"fig5a","state":[0.3,0.1,0.2,0.05,0.01,-0.02],"position":[0,0]}"#;
const MAP: &str = concat!(
    r#"{"do":"map","epoch":1,"x":{"name":"kappa2","low":0.5,"high":1.5},"#,
    r#""y":{"name":"kappa3","low":0.1,"high":0.9},"count":9}"#
);

fn texts(answers: &[Answer], is: &str) -> Vec<String> {
    let texts = answers.iter().filter_map(|answer| match answer {
        Answer::Text(text) if text.contains(&format!("\"is\":\"{is}\"")) => Some(text.clone()),
        _ => None,
    });
    texts.collect()
}

/// Frames of a body, and what is said of its motion until its exponents are there.
fn motion(page: &mut impl Page) -> (Vec<Vec<u8>>, Vec<String>) {
    page.say(BEGIN);
    page.until("begun");
    for _ in 0..40 {
        page.say(r#"{"do":"advance","dt":0.5}"#);
    }
    page.say(r#"{"do":"share"}"#);
    let mut all = page.until("share");
    while !texts(&all, "exponents").iter().any(|text| text.contains("\"done\":true")) {
        all.extend(page.until("exponents"));
    }
    let frames = binaries(&all, 1).into_iter().map(<[u8]>::to_vec).collect();
    (frames, [texts(&all, "named"), texts(&all, "exponents")].concat())
}

#[test]
fn a_body_and_its_motion_are_the_same() {
    let (frames, said) = motion(&mut Served::new());
    let (ours, ours_said) = motion(&mut Alone::new(1));
    assert!(frames.len() == 40 && said.len() > 60, "{} frames, {} texts", frames.len(), said.len());
    // Flag 2 says that a frame took too long here or there.
    let plain = |frames: Vec<Vec<u8>>| -> Vec<Vec<u8>> {
        frames.into_iter().filter(|frame| frame[1] & 2 == 0).map(|frame| frame[16..].to_vec()).collect()
    };
    assert_eq!(plain(frames), plain(ours));
    assert_eq!(said, ours_said);
}

/// The cells of a whole map: 16 bytes each, in the order of their places.
fn cells(page: &mut impl Page) -> Vec<Vec<u8>> {
    page.say(BEGIN);
    page.say(MAP);
    let all = page.until("mapped");
    let mut cells: Vec<Vec<u8>> =
        binaries(&all, 2).iter().flat_map(|message| message[16..].chunks(16).map(<[u8]>::to_vec)).collect();
    cells.sort();
    cells
}

#[test]
fn a_map_is_the_same_from_threads_and_from_helpers() {
    let served = cells(&mut Served::new());
    assert!(served.len() > 60, "{}", served.len());
    assert_eq!(cells(&mut Alone::new(1)), served);
    assert_eq!(cells(&mut Alone::new(3)), served);
}
