//! A server on a thread, and a page that speaks to it.

#![allow(
    dead_code,
    clippy::unwrap_used,
    clippy::panic,
    reason = "shared by tests, each of which uses a part"
)]

use motiform_explorer::server::{Handle, Options, Server};
use serde_json::Value;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::thread::JoinHandle;
use std::time::Duration;
use tungstenite::client::IntoClientRequest;
use tungstenite::handshake::client::Request;
use tungstenite::protocol::CloseFrame;
use tungstenite::{HandshakeError, Message, WebSocket};

/// A running server.
pub(crate) struct Running {
    pub(crate) address: String,
    handle: Handle,
    thread: Option<JoinHandle<()>>,
}

impl Running {
    pub(crate) fn start(options: &Options) -> Self {
        let server = Server::bind(options).unwrap();
        let (address, handle) = (server.address(), server.handle());
        let thread = std::thread::spawn(move || server.run());
        Self { address, handle, thread: Some(thread) }
    }

    /// On any free port: tests run side by side.
    pub(crate) fn anywhere() -> Self {
        let free = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        Self::start(&Options { port: Some(free), ..Options::default() })
    }

    pub(crate) fn host(&self) -> &str {
        self.address.split('/').nth(2).unwrap()
    }

    pub(crate) fn port(&self) -> u16 {
        self.host().split(':').nth(1).unwrap().parse().unwrap()
    }

    pub(crate) fn token(&self) -> &str {
        self.address.split('/').nth(3).unwrap()
    }

    /// Status line and headers, and the body, of a request.
    pub(crate) fn get(&self, path: &str, host: &str) -> (String, String) {
        let mut stream = TcpStream::connect(self.host()).unwrap();
        write!(stream, "GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n").unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let (head, body) = text.split_once("\r\n\r\n").unwrap();
        (head.to_lowercase(), body.to_owned())
    }

    /// The opening request of a page.
    pub(crate) fn request(&self) -> Request {
        let mut request =
            format!("ws://{}/{}/live", self.host(), self.token()).into_client_request().unwrap();
        let origin = format!("http://{}", self.host()).parse().unwrap();
        request.headers_mut().insert("origin", origin);
        request
    }

    /// A page, or the status that it is refused with.
    pub(crate) fn try_page(&self, request: Request) -> Result<Page, u16> {
        let stream = TcpStream::connect(self.host()).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        match tungstenite::client(request, stream) {
            Ok((socket, _)) => Ok(Page { socket, other: Vec::new() }),
            Err(HandshakeError::Failure(tungstenite::Error::Http(response))) => {
                Err(response.status().as_u16())
            }
            Err(error) => panic!("{error}"),
        }
    }

    pub(crate) fn page(&self) -> Page {
        let mut page = self.try_page(self.request()).unwrap();
        assert_eq!(page.json("hello")["is"], "hello");
        page
    }

    pub(crate) fn stop(&self) {
        self.handle.stop();
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.handle.stop();
        if let Some(thread) = self.thread.take() {
            let ended = thread.join();
            assert!(ended.is_ok() || std::thread::panicking());
        }
    }
}

/// An open page.
pub(crate) struct Page {
    pub(crate) socket: WebSocket<TcpStream>,
    /// Messages that came while another one was waited for.
    pub(crate) other: Vec<Message>,
}

/// A frame as the page reads it.
pub(crate) struct Frame {
    pub(crate) flags: u8,
    pub(crate) revision: u32,
    pub(crate) t: f64,
    pub(crate) position: [f64; 2],
    pub(crate) radius: f64,
    pub(crate) coordinates: Vec<f64>,
    pub(crate) samples: Vec<Vec<f64>>,
    pub(crate) outline: Vec<[f64; 2]>,
}

impl Page {
    pub(crate) fn say(&mut self, text: &str) {
        self.socket.send(Message::text(text.to_owned())).unwrap();
    }

    /// The next message that `wanted` takes; others are kept aside.
    pub(crate) fn next<T>(&mut self, mut wanted: impl FnMut(&Message) -> Option<T>) -> T {
        if let Some(place) = self.other.iter().position(|message| wanted(message).is_some()) {
            return wanted(&self.other.remove(place)).unwrap();
        }
        loop {
            let message = self.socket.read().unwrap();
            match wanted(&message) {
                Some(found) => return found,
                None => self.other.push(message),
            }
        }
    }

    /// The next JSON message of a kind.
    pub(crate) fn json(&mut self, kind: &str) -> Value {
        self.next(|message| {
            let value: Value = serde_json::from_str(message.to_text().ok()?).ok()?;
            (value["is"] == kind).then_some(value)
        })
    }

    pub(crate) fn begin(&mut self, model: &str, preset: Option<&str>) -> Value {
        let preset = preset.map_or("null".to_owned(), |preset| format!("{preset:?}"));
        self.say(&format!(
            r#"{{"do":"begin","model":"{model}","preset":{preset},"parameters":{{}},"state":null,"position":null}}"#
        ));
        self.json("begun")
    }

    pub(crate) fn advance(&mut self, dt: f64) -> Frame {
        self.say(&format!(r#"{{"do":"advance","dt":{dt}}}"#));
        self.next(|message| match message {
            Message::Binary(bytes) if bytes[0] == 1 => Some(frame(bytes)),
            _ => None,
        })
    }

    /// Moves on by `dt` in all, in as many pictures as a busy machine needs; the samples of all of them.
    pub(crate) fn advance_whole(&mut self, dt: f64) -> Frame {
        let mut frame = self.advance(0.0);
        let (end, mut samples) = (frame.t + dt, std::mem::take(&mut frame.samples));
        loop {
            let before = frame.t;
            frame = self.advance((end - before).min(100.0));
            samples.append(&mut frame.samples);
            if frame.t >= end - 1e-9 || frame.t == before {
                frame.samples = samples;
                return frame;
            }
        }
    }

    /// A file, or why there is none.
    pub(crate) fn export(&mut self, what: &str) -> Result<(Value, Vec<u8>), String> {
        self.say(&format!(r#"{{"do":"export","id":5,"what":"{what}","section":"path","y":null}}"#));
        self.next(|message| match message {
            Message::Binary(bytes) if bytes[0] == 3 => {
                let length = u32::from_le_bytes(bytes[4..8].try_into().unwrap()) as usize;
                let head = serde_json::from_slice(&bytes[8..8 + length]).unwrap();
                Some(Ok((head, bytes[8 + length..].to_vec())))
            }
            Message::Text(text) => {
                let value: Value = serde_json::from_str(text).unwrap();
                (value["is"] == "refused" && value["id"] == 5)
                    .then(|| Err(value["why"].as_str().unwrap().to_owned()))
            }
            _ => None,
        })
    }

    /// The code with which the server closes instead of a greeting.
    pub(crate) fn closes_at_once(&mut self) -> Option<u16> {
        match self.socket.read() {
            Ok(Message::Close(Some(CloseFrame { code, .. }))) => Some(code.into()),
            _ => None,
        }
    }

    /// Reads until the server closes; its code.
    pub(crate) fn closed(&mut self) -> Option<u16> {
        loop {
            match self.socket.read() {
                Ok(Message::Close(Some(CloseFrame { code, .. }))) => return Some(code.into()),
                Ok(_) => {}
                Err(_) => return None,
            }
        }
    }
}

fn frame(bytes: &[u8]) -> Frame {
    let short = |place: usize| usize::from(u16::from_le_bytes([bytes[place], bytes[place + 1]]));
    let long = |place: usize| u32::from_le_bytes(bytes[place..place + 4].try_into().unwrap());
    let mut numbers = bytes[16..].chunks_exact(8).map(|chunk| f64::from_le_bytes(chunk.try_into().unwrap()));
    let (rows, columns, points, coordinates) = (short(2), short(4), short(6), long(12) as usize);
    let mut take = |count: usize| -> Vec<f64> { numbers.by_ref().take(count).collect() };
    let head = take(4);
    let frame = Frame {
        flags: bytes[1],
        revision: long(8),
        t: head[0],
        position: [head[1], head[2]],
        radius: head[3],
        coordinates: take(coordinates),
        samples: (0..rows).map(|_| take(columns)).collect(),
        outline: (0..points).map(|_| [0; 2].map(|_: i32| take(1)[0])).collect(),
    };
    assert!(numbers.next().is_none(), "the whole message is read");
    frame
}
