//! Damaged messages are refused, and the server answers the next page as ever. `MOTIFORM_FUZZ=200000` tries more.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;
#[path = "../../../lab/tests/all/common/mutate.rs"]
mod mutate;

use common::{Page, Running};
use mutate::{Mutator, cases};
use std::time::Duration;
use tungstenite::Message;

const MESSAGES: [&str; 12] = [
    r#"{"do":"begin","model":"tensor","preset":"fig5a"}"#,
    r#"{"do":"begin","model":"cell","preset":"fig6a","parameters":{"length":21.0},"noise":0.001,"seed":3}"#,
    r#"{"do":"set","parameters":{"kappa2":0.5,"kappa3":0.1}}"#,
    r#"{"do":"noise","amplitude":0.05}"#,
    r#"{"do":"kick"}"#,
    r#"{"do":"advance","dt":0.5}"#,
    r#"{"do":"strips","section":"path","y":0.5}"#,
    r#"{"do":"map","epoch":1,"x":{"name":"kappa2","low":-0.2,"high":0.2},"y":{"name":"gamma","low":-0.1,"high":0.1},"count":9}"#,
    r#"{"do":"evidence","epoch":1,"cell":[1,1]}"#,
    r#"{"do":"share"}"#,
    r#"{"do":"follow","epoch":1,"along":{"name":"kappa2","low":0.3,"high":1.6},"branches":2}"#,
    r#"{"do":"place","epoch":1,"branch":0,"point":3}"#,
];

/// A page, as soon as those that were left are gone: a server takes only so many.
fn fresh(server: &Running) -> Page {
    loop {
        match server.try_page(server.request()) {
            Ok(mut page) => match page.socket.read().unwrap() {
                Message::Text(hello) => {
                    assert!(hello.contains("hello"), "{hello}");
                    return page;
                }
                Message::Close(Some(end)) => assert_eq!(u16::from(end.code), 1013, "{end:?}"),
                other => panic!("{other:?}"),
            },
            Err(status) => assert_eq!(status, 503),
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn messages() {
    let server = Running::anywhere();
    let mut random = Mutator::new(20);
    let mut page = fresh(&server);
    let count = cases(3000);
    let mut lost = 0;
    for case in 0..count {
        let text =
            String::from_utf8_lossy(&random.mutate(MESSAGES[case % MESSAGES.len()].as_bytes())).into_owned();
        if page.socket.send(Message::text(text)).is_err() {
            // too long, or a page that asks faster than anything answers: its connection ends, not the server
            lost += 1;
            page = fresh(&server);
        }
        if case % 50 == 49 {
            page = fresh(&server);
            page.begin("tensor", Some("fig5a"));
            assert!(page.advance_whole(1.0).t > 0.0);
        }
    }
    println!("{count} messages, {lost} connections ended");
    let mut last = fresh(&server);
    last.begin("tensor", Some("fig2"));
    assert!(last.advance_whole(1.0).t > 0.0);
}
