//! Damaged messages are read or refused, and a session that hears them goes on. `MOTIFORM_FUZZ=200000` tries more.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::messages;
use crate::protocol::common::{Alone, Page};

use super::mutate::{each, in_turn};
use messages::MESSAGES;
use motiform_explorer::Request;

#[test]
fn messages_are_read() {
    let good = each("messages", (20, 20_000), in_turn(&MESSAGES), |bytes| {
        match Request::parse(&String::from_utf8_lossy(bytes)) {
            Ok(_) => true,
            Err(why) => {
                assert!(!why.is_empty() && why.len() < 200, "{why}"); // nothing of the message is repeated
                false
            }
        }
    });
    assert!(good > 100, "{good}");
}

/// The immediate answer of a session to messages of any content; its errands for helpers are not done.
#[test]
fn messages_are_heard() {
    const BEGIN: &str = r#"{"do":"begin","model":"tensor","preset":"fig5a"}"#;
    let mut page = Alone::new(1);
    each("messages heard", (21, 1000), in_turn(&MESSAGES), |bytes| {
        page.say(&String::from_utf8_lossy(bytes));
        page.errands.lock().unwrap().clear();
        page.answered().iter().any(|answer| !crate::protocol::common::is_of(answer, "refused"))
    });
    page.say(BEGIN);
    page.next("begun");
}
