//! One request and one answer of HTTP/1.1 (RFC 9112). `tungstenite` reads the head: it does so for WebSockets anyway.

use crate::server::timed::Timed;
use std::io::Read;
use std::net::Shutdown;
use std::time::Duration;
use tungstenite::error::{Error, ProtocolError};
use tungstenite::handshake::machine::TryParse as _;
use tungstenite::handshake::server::{Request, write_response};
use tungstenite::http::{HeaderValue, Response, StatusCode, header};

/// Bytes of the head of a request. Browsers send one or two thousand.
const LONGEST_HEAD: usize = 16 * 1024;

/// A response: all bodies are in the program.
pub(crate) type Answer = Response<&'static [u8]>;

/// Reads the head of a request; with it comes what was read beyond it.
///
/// # Errors
/// The status to answer with; none where the other side has gone, or takes too long.
pub(crate) fn head(stream: &mut Timed<'_>) -> Result<(Request, Vec<u8>), Option<StatusCode>> {
    let (mut bytes, mut part) = (Vec::new(), [0; 4096]);
    loop {
        match stream.read(&mut part) {
            Ok(read) if read > 0 => bytes.extend_from_slice(&part[..read]),
            _ => return Err(None),
        }
        if bytes.len() > LONGEST_HEAD {
            return Err(Some(StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE));
        }
        match Request::try_parse(&bytes) {
            Ok(Some((length, request))) => return Ok((request, bytes.split_off(length))),
            Ok(None) => {}
            Err(Error::Protocol(ProtocolError::WrongHttpMethod)) => {
                return Err(Some(StatusCode::METHOD_NOT_ALLOWED));
            }
            Err(_) => return Err(Some(StatusCode::BAD_REQUEST)),
        }
    }
}

/// An answer without content.
pub(crate) fn empty(status: StatusCode) -> Answer {
    let mut answer = Answer::new(&[]);
    *answer.status_mut() = status;
    answer
}

/// An answer as it is sent. It is the only one on its connection, unless the connection is handed over.
pub(crate) fn bytes(answer: &Answer) -> Vec<u8> {
    let mut head = answer.clone();
    if answer.status() != StatusCode::SWITCHING_PROTOCOLS {
        let headers = head.headers_mut();
        headers.insert(header::CONTENT_LENGTH, HeaderValue::from(answer.body().len()));
        headers.insert(header::CONNECTION, HeaderValue::from_static("close"));
    }
    let mut bytes = Vec::new();
    // A vector takes everything, and all our headers are text.
    let _ = write_response(&mut bytes, &head);
    bytes.extend_from_slice(answer.body());
    bytes
}

/// The time in which the other side must close the connection in turn.
const CLOSES_WITHIN: Duration = Duration::from_millis(400);

/// Lets the other side read an answer to its end: if what it still sends stayed unread, the operating system would reset the connection.
pub(crate) fn linger(stream: &mut Timed<'_>) {
    stream.within(CLOSES_WITHIN);
    let mut rest = [0; 4096];
    if stream.stream().shutdown(Shutdown::Write).is_ok() {
        while stream.read(&mut rest).is_ok_and(|read| read > 0) {}
    }
}
