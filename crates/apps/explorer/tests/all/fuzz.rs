//! A sample of damaged messages, sent to a server: it answers the next page as ever. Far more of them are
//! read in the process (`session/tests/all/fuzz.rs`).

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;
use crate::protocol::messages;

use crate::protocol::mutate::{Mutator, cases};
use common::{Page, Running};
use messages::MESSAGES;
use std::time::Duration;
use tungstenite::Message;

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
    let count = cases(3000).min(20_000); // each goes through a socket
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
