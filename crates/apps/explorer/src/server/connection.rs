//! The connection to one page: incoming messages and answers, until one side disconnects.
//!
//! Two threads share it: that of the connection reads, another one writes. What a reader has to say to the
//! other side goes through the outbox, too.

use crate::server::accept::{Patience, shut};
use crate::server::outbox::{End, Next, Outbox};
use crate::server::rate::Bucket;
use crate::server::timed::Timed;
use crate::{Answer, Answers, Catalogue, Greeting, LONGEST, Request, Session, refusal};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};
use tungstenite::protocol::{CloseFrame, Role, WebSocketConfig};
use tungstenite::{Error, Message, WebSocket};

/// Reasons to close a connection (RFC 6455, 7.4.1; 1013 is registered with IANA).
const NORMAL: End = (1000, "");
pub(crate) const STOPPING: End = (1001, "the server is stopping");
const FLOOD: End = (1008, "too many messages");
const QUEUE: End = (1008, "too many messages are waiting");
const TOO_LONG: End = (1009, "a message was too long");
const NO_MESSAGE: End = (1009, "a message was too long, or does not belong to this protocol");
const NO_THREADS: End = (1011, "the system provides no threads");
pub(crate) const NO_PLACE: End = (1013, "too many pages are open: close one");

/// Bytes of a message that is read to its end, although it may be too long to be taken: what stays unread makes the operating system
/// reset the connection, and the page never sees the reason.
const READ_WHOLE: usize = 32 * LONGEST;

/// A page has so long to read why it is closed, and to close in turn.
pub(crate) const GOODBYE: Duration = Duration::from_millis(400);

/// The data that a page is served with.
pub(crate) struct Guest {
    pub(crate) greeting: Greeting,
    pub(crate) catalogue: Catalogue,
    pub(crate) patience: Patience,
}

/// The side of a connection that is read. Whatever its protocol would answer, pongs for example, is answered through the outbox.
struct Reading<'s>(Timed<'s>);

impl Read for Reading<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> std::io::Result<usize> {
        self.0.read(bytes)
    }
}

impl Write for Reading<'_> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// Serves one page; `rest` was read together with its request.
pub(crate) fn serve(stream: &TcpStream, rest: Vec<u8>, outbox: &Arc<Outbox>, guest: Guest) {
    let Guest { greeting, catalogue, patience } = guest;
    let _ = outbox.push(Message::text(greeting.text())); // if the server stops already, its end goes first
    let say = Arc::clone(outbox);
    let answers = Answers::new(move |answer| say.push(message(answer)));
    thread::scope(|scope| {
        let writing = || write(stream, outbox, patience);
        let writes = thread::Builder::new().name("answers".to_owned()).spawn_scoped(scope, writing).is_ok();
        let session = Session::start(answers, catalogue).ok().filter(|_| writes);
        let mut socket = reader(stream, rest, patience.silence);
        let end = match &session {
            Some(session) => Line { session, outbox, patience }.talk(&mut socket),
            None => Some(NO_THREADS),
        };
        if let Some(end) = end {
            outbox.close(end);
            goodbye(&mut socket, outbox);
        }
        // The session's threads may be waiting to say something to a page that does not read: they end only once nobody listens.
        outbox.leave();
        shut(stream);
        drop(session);
    });
}

/// Tells a page why there is no place for it.
pub(crate) fn refuse(stream: &TcpStream, why: End) {
    let outbox = Outbox::default();
    outbox.close(why);
    write(stream, &outbox, Patience { silence: GOODBYE, ..Patience::default() });
    goodbye(&mut reader(stream, Vec::new(), GOODBYE), &outbox);
}

fn reader(stream: &TcpStream, rest: Vec<u8>, time: Duration) -> WebSocket<Reading<'_>> {
    let config =
        WebSocketConfig::default().max_message_size(Some(READ_WHOLE)).max_frame_size(Some(READ_WHOLE));
    WebSocket::from_partially_read(Reading(Timed::new(stream, time)), rest, Role::Server, Some(config))
}

/// Waits until the page has been told why, and closes in turn. Messages that still arrive are read and ignored: if they stayed unread, the
/// operating system would reset the connection, and the page would never see the reason.
fn goodbye(socket: &mut WebSocket<Reading<'_>>, outbox: &Outbox) {
    let end = Instant::now() + GOODBYE;
    socket.get_mut().0.within(GOODBYE);
    while !matches!(socket.read(), Ok(Message::Close(_)) | Err(_)) {}
    outbox.left_until(end);
}

/// Sends what is in the outbox, and pings, until the connection ends.
fn write(stream: &TcpStream, outbox: &Outbox, patience: Patience) {
    let mut socket = WebSocket::from_raw_socket(Timed::new(stream, patience.silence), Role::Server, None);
    let mut ping = Instant::now() + patience.ping;
    loop {
        let next = outbox.next(ping);
        socket.get_mut().within(patience.silence);
        let sent = match next {
            Next::Send(message) => socket.send(message),
            Next::Nothing => {
                ping += patience.ping;
                socket.send(Message::Ping(Vec::new().into()))
            }
            Next::Close(end) => {
                let _ = socket.send(closing(end)); // the page may have gone already
                return outbox.leave();
            }
            Next::Gone => return,
        };
        if sent.is_err() {
            // The page has gone, or does not read.
            outbox.leave();
            return shut(stream);
        }
    }
}

fn closing((code, reason): End) -> Message {
    Message::Close(Some(CloseFrame { code: code.into(), reason: reason.into() }))
}

fn message(answer: Answer) -> Message {
    match answer {
        Answer::Text(text) => Message::text(text),
        Answer::Binary(bytes) => Message::binary(bytes),
    }
}

/// A page that is served.
struct Line<'l> {
    session: &'l Session,
    outbox: &'l Outbox,
    patience: Patience,
}

impl Line<'_> {
    /// Takes messages; returns the reason to close the connection, or `None` if the page has gone.
    fn talk(&self, socket: &mut WebSocket<Reading<'_>>) -> Option<End> {
        let mut bucket = Bucket::new(Instant::now());
        loop {
            socket.get_mut().0.within(self.patience.silence);
            let end = match socket.read() {
                Ok(Message::Close(_)) => Some(NORMAL),
                Ok(_) if !bucket.take(Instant::now()) => Some(FLOOD),
                Ok(Message::Ping(words)) => self.say(Message::Pong(words))?,
                Ok(message) => self.hear(&message)?,
                Err(Error::Capacity(_) | Error::Protocol(_) | Error::Utf8(_)) => Some(NO_MESSAGE),
                Err(_) => return None,
            };
            if end.is_some() {
                return end;
            }
        }
    }

    /// Takes one message: the reason to close the connection, if there is one; `None` if the page has gone.
    fn hear(&self, heard: &Message) -> Option<Option<End>> {
        if matches!(heard, Message::Text(_) | Message::Binary(_)) && heard.len() > LONGEST {
            return Some(Some(TOO_LONG));
        }
        let request = match heard {
            Message::Text(text) => Request::parse(text),
            Message::Binary(_) => Err("messages must be JSON texts".to_owned()),
            _ => return Some(None),
        };
        match request {
            Ok(request) => Some((!self.session.ask(request)).then_some(QUEUE)),
            Err(why) => self.say(message(refusal(&why))),
        }
    }

    /// Says something beside the answers of the session; `None` if the page has gone.
    fn say(&self, message: Message) -> Option<Option<End>> {
        self.outbox.push(message).ok().map(|()| None)
    }
}
