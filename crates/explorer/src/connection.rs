//! The connection to one page: incoming messages and answers, until one side disconnects.

use crate::answers::{self, Answer, Answers};
use crate::catalogue::Catalogue;
use crate::protocol::{Ask, Refused};
use crate::rate::Bucket;
use crate::session::{Greeting, Session};
use axum::extract::ws::{CloseFrame, Message, WebSocket};
use std::time::Instant;
use tokio::sync::{mpsc, watch};

/// Why a connection is closed (RFC 6455, 7.4.1).
const GOING_AWAY: u16 = 1001;
const POLICY: u16 = 1008;
const TOO_BIG: u16 = 1009;
const FAILED: u16 = 1011;

/// Serves one page.
pub(crate) async fn serve(
    mut socket: WebSocket,
    greeting: Greeting,
    catalogue: Catalogue,
    mut stop: watch::Receiver<bool>,
) {
    let (answers, mut waiting) = Answers::new();
    let (code, reason) = match Session::start(answers, catalogue) {
        Ok(session) => {
            let end = match socket.send(Message::text(greeting.text())).await {
                Ok(()) => talk(&mut socket, &session, &mut waiting, &mut stop).await,
                Err(_) => None,
            };
            // Its threads may be waiting to say something: nobody listens any more.
            drop(waiting);
            let _ = tokio::task::spawn_blocking(move || drop(session)).await;
            match end {
                Some(end) => end,
                None => return,
            }
        }
        Err(_) => (FAILED, "the system provides no threads"),
    };
    // The page may have gone already.
    let _ = socket.send(Message::Close(Some(CloseFrame { code, reason: reason.into() }))).await;
}

/// Waits for the server to stop.
async fn stopped(stop: &mut watch::Receiver<bool>) {
    // Without a sender there is no server: that is a stop, too.
    let _ = stop.wait_for(|stop| *stop).await;
}

/// Transfers messages in both directions; returns the reason to close the connection, or `None` if the page has disconnected.
async fn talk(
    socket: &mut WebSocket,
    session: &Session,
    waiting: &mut mpsc::Receiver<Answer>,
    stop: &mut watch::Receiver<bool>,
) -> Option<(u16, &'static str)> {
    let mut bucket = Bucket::new(Instant::now());
    let stopped = stopped(stop);
    tokio::pin!(stopped);
    loop {
        tokio::select! {
            message = socket.recv() => {
                let text = match message? {
                    Ok(Message::Text(text)) => Some(text),
                    Ok(Message::Binary(_)) => None,
                    Ok(Message::Close(_)) => return None,
                    Ok(Message::Ping(_) | Message::Pong(_)) => continue,
                    Err(_) => return Some((TOO_BIG, "a message was too long, or does not belong to this protocol")),
                };
                if !bucket.take(Instant::now()) {
                    return Some((POLICY, "too many messages"));
                }
                match text.as_deref().ok_or_else(|| "messages must be JSON texts".to_owned()).and_then(Ask::parse) {
                    Ok(ask) => if !session.ask(ask) {
                        return Some((POLICY, "too many messages are waiting"));
                    },
                    Err(why) => {
                        let refused = answers::text(&Refused { id: None, why }.into());
                        socket.send(Message::text(refused)).await.ok()?;
                    }
                }
            }
            answer = waiting.recv() => {
                let message = match answer? {
                    Answer::Text(text) => Message::text(text),
                    Answer::Binary(bytes) => Message::binary(bytes),
                };
                socket.send(message).await.ok()?;
            }
            () = &mut stopped => return Some((GOING_AWAY, "the server is stopping")),
        }
    }
}
