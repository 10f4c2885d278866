//! The connection to one page: incoming messages and answers, until one side disconnects.

use crate::accept::Patience;
use crate::rate::Bucket;
use axum::extract::ws::{CloseFrame, Message, WebSocket};
use motiform_session::{Answer, Answers, Catalogue, Gone, Greeting, LONGEST, Request, Session, refusal};
use std::time::{Duration, Instant};
use tokio::sync::{mpsc, watch};
use tokio::time::timeout;

/// Why a connection is closed (RFC 6455, 7.4.1; 1013 is registered with IANA).
const GOING_AWAY: u16 = 1001;
const POLICY: u16 = 1008;
const TOO_BIG: u16 = 1009;

/// Bytes of a message that is read to its end, although it may be too long to be taken: what stays unread makes the operating system
/// reset the connection, and the page never sees the reason.
pub(crate) const READ_WHOLE: usize = 32 * LONGEST;
const FAILED: u16 = 1011;
const TRY_AGAIN_LATER: u16 = 1013;

/// Number of queued answers: threads that are faster than the page wait for it.
const WAITING: usize = 64;

/// A page has so long to read why it is closed, and to close in turn.
const GOODBYE: Duration = Duration::from_millis(400);

/// What a page is served with.
pub(crate) struct Guest {
    pub(crate) greeting: Greeting,
    pub(crate) catalogue: Catalogue,
    pub(crate) stop: watch::Receiver<bool>,
    pub(crate) patience: Patience,
}

/// The reason why a connection is closed.
type End = (u16, &'static str);

/// Both ends of a session. They are dropped in this order, wherever the server stops: its threads may be waiting to say something to a page
/// that does not read, and end only once nobody listens any more.
struct Ends {
    waiting: mpsc::Receiver<Answer>,
    session: Session,
}

/// Serves one page.
pub(crate) async fn serve(mut socket: WebSocket, guest: Guest) {
    let Guest { greeting, catalogue, mut stop, patience } = guest;
    let (sender, waiting) = mpsc::channel(WAITING);
    let answers = Answers::new(move |answer| sender.blocking_send(answer).map_err(|_| Gone));
    let Ok(session) = Session::start(answers, catalogue) else {
        return close(socket, (FAILED, "the system provides no threads")).await;
    };
    let mut ends = Ends { waiting, session };
    let end = match socket.send(Message::text(greeting.text())).await {
        Ok(()) => {
            let mut line = Line { socket: &mut socket, session: &ends.session, patience };
            line.talk(&mut ends.waiting, &mut stop).await
        }
        Err(_) => None,
    };
    let ended = tokio::task::spawn_blocking(move || drop(ends));
    if let Some(end) = end {
        close(socket, end).await;
    }
    let _ = ended.await;
}

/// Tells a page that there is no place for it.
pub(crate) async fn refuse(socket: WebSocket) {
    close(socket, (TRY_AGAIN_LATER, "too many pages are open: close one")).await;
}

/// Closes a connection, with its reason. Messages that still arrive are read and ignored: if they stayed unread, the operating system would
/// reset the connection, and the page would never see the reason.
async fn close(mut socket: WebSocket, (code, reason): End) {
    let goodbye = async {
        // The page may have gone already.
        let _ = socket.send(Message::Close(Some(CloseFrame { code, reason: reason.into() }))).await;
        while let Some(message) = socket.recv().await {
            if matches!(message, Ok(Message::Close(_)) | Err(_)) {
                break;
            }
        }
    };
    let _ = timeout(GOODBYE, goodbye).await;
}

/// Waits for the server to stop.
async fn stopped(stop: &mut watch::Receiver<bool>) {
    // Without a sender there is no server: that is a stop, too.
    let _ = stop.wait_for(|stop| *stop).await;
}

fn message(answer: Answer) -> Message {
    match answer {
        Answer::Text(text) => Message::text(text),
        Answer::Binary(bytes) => Message::binary(bytes),
    }
}

/// A page that is served.
struct Line<'l> {
    socket: &'l mut WebSocket,
    session: &'l Session,
    patience: Patience,
}

impl Line<'_> {
    /// Transfers messages in both directions; returns the reason to close the connection, or `None` if the page has disconnected.
    async fn talk(
        &mut self,
        waiting: &mut mpsc::Receiver<Answer>,
        stop: &mut watch::Receiver<bool>,
    ) -> Option<End> {
        let mut bucket = Bucket::new(Instant::now());
        let mut heard = Instant::now();
        let mut pings = tokio::time::interval(self.patience.ping);
        let stopped = stopped(stop);
        tokio::pin!(stopped);
        loop {
            tokio::select! {
                message = self.socket.recv() => {
                    heard = Instant::now();
                    if let Some(end) = self.hear(message?, &mut bucket).await? {
                        return Some(end);
                    }
                }
                answer = waiting.recv() => {
                    self.send(message(answer?)).await?;
                }
                _ = pings.tick() => {
                    if heard.elapsed() > self.patience.silence {
                        return None; // a page that has gone without a word
                    }
                    self.send(Message::Ping(Vec::new().into())).await?;
                }
                () = &mut stopped => return Some((GOING_AWAY, "the server is stopping")),
            }
        }
    }

    /// Takes one message: the reason to close the connection, if there is one; `None` if the page has disconnected.
    async fn hear(
        &mut self,
        heard: Result<Message, axum::Error>,
        bucket: &mut Bucket,
    ) -> Option<Option<End>> {
        let text = match heard {
            Ok(Message::Text(text)) if text.len() <= LONGEST => Some(text),
            Ok(Message::Binary(bytes)) if bytes.len() <= LONGEST => None,
            Ok(Message::Text(_) | Message::Binary(_)) => {
                return Some(Some((TOO_BIG, "a message was too long")));
            }
            Ok(Message::Close(_)) => return None,
            Ok(Message::Ping(_) | Message::Pong(_)) => {
                let allowed = bucket.take(Instant::now());
                return Some((!allowed).then_some((POLICY, "too many messages")));
            }
            Err(_) => {
                return Some(Some((TOO_BIG, "a message was too long, or does not belong to this protocol")));
            }
        };
        if !bucket.take(Instant::now()) {
            return Some(Some((POLICY, "too many messages")));
        }
        match text.as_deref().ok_or_else(|| "messages must be JSON texts".to_owned()).and_then(Request::parse)
        {
            Ok(request) => {
                Some((!self.session.ask(request)).then_some((POLICY, "too many messages are waiting")))
            }
            Err(why) => {
                self.send(message(refusal(&why))).await?;
                Some(None)
            }
        }
    }

    /// Sends a message; `None` if the page has gone, or does not read.
    async fn send(&mut self, message: Message) -> Option<()> {
        timeout(self.patience.silence, self.socket.send(message)).await.ok()?.ok()
    }
}
