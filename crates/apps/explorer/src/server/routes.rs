//! The addresses of the server, and the requests that each admits.

use crate::server::Shared;
use crate::server::accept::shut;
use crate::server::connection::{self, Guest};
use crate::server::guard::{NO_ORIGIN, no_origin};
use crate::server::http::{Answer, empty};
use crate::server::page::asset;
use std::net::TcpStream;
use std::sync::Arc;
use tungstenite::handshake::server::{Request, create_response};
use tungstenite::http::{HeaderName, HeaderValue, StatusCode, header};

/// The content security policy: what the page may load, and that no other page may embed it.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; \
                      base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Restrictions for the browser: not to load anything from other hosts, embed the page in another one, or reveal its address.
const HEADERS: [(HeaderName, &str); 6] = [
    (header::CONTENT_SECURITY_POLICY, POLICY),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::X_FRAME_OPTIONS, "DENY"),
    (header::REFERRER_POLICY, "no-referrer"),
    (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    (header::CACHE_CONTROL, "no-cache"),
];

/// The name of the address at which the page opens its WebSocket.
const LIVE: &str = "live";

/// The token and the name of `/TOKEN/NAME`; other addresses have nothing.
fn parts(request: &Request) -> Option<(&str, &str)> {
    request.uri().path().strip_prefix('/')?.split_once('/').filter(|(_, name)| !name.contains('/'))
}

/// Returns `true` if the reader asks for a page to stand within another one.
fn is_embed(request: &Request) -> bool {
    request.uri().query().is_some_and(|query| query == "embed" || query.starts_with("embed="))
}

/// Returns `true` if this token opens the server, and the request was sent to it by its own name. The answer
/// does not reveal which was wrong.
fn admits(shared: &Shared, token: &str, request: &Request) -> bool {
    let ours = shared.names.host_is_ours(request.headers());
    shared.token.is(token) && ours
}

/// Returns `true` if a request is for the WebSocket.
pub(crate) fn is_live(request: &Request) -> bool {
    parts(request).is_some_and(|(_, name)| name == LIVE)
}

/// The answer to a request for a file.
pub(crate) fn file(request: &Request, shared: &Shared) -> Answer {
    let Some((token, name)) = parts(request) else { return empty(StatusCode::NOT_FOUND) };
    if !admits(shared, token, request) {
        return empty(StatusCode::FORBIDDEN);
    }
    let Some(asset) = asset(name) else { return empty(StatusCode::NOT_FOUND) };
    let mut answer = Answer::new(asset.content);
    let headers = answer.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(asset.kind));
    headers.extend(HEADERS.map(|(name, value)| (name, HeaderValue::from_static(value))));
    if name.is_empty() && is_embed(request) {
        headers.remove(header::X_FRAME_OPTIONS);
        let policy = POLICY.replace("; frame-ancestors 'none'", "");
        if let Ok(policy) = HeaderValue::from_str(&policy) {
            headers.insert(header::CONTENT_SECURITY_POLICY, policy);
        }
    }
    if !name.is_empty() && no_origin(request.headers()) {
        // The page in a sandboxed frame: it has no origin, and its browser asks whether it may read its own script.
        headers.insert(header::ACCESS_CONTROL_ALLOW_ORIGIN, HeaderValue::from_static(NO_ORIGIN));
    }
    answer
}

/// The answer that opens a WebSocket (RFC 6455, 4.2.2).
///
/// # Errors
/// The status to answer with instead.
pub(crate) fn opening(request: &Request, shared: &Shared) -> Result<Answer, StatusCode> {
    let (token, _) = parts(request).ok_or(StatusCode::NOT_FOUND)?;
    let headers = request.headers();
    let ours = shared.names.origin_is_ours(headers) || (is_embed(request) && no_origin(headers));
    if !admits(shared, token, request) || !ours {
        return Err(StatusCode::FORBIDDEN);
    }
    let opening = create_response(request).map_err(|_| StatusCode::BAD_REQUEST)?;
    Ok(opening.map(|()| [].as_slice()))
}

/// Serves a page whose WebSocket is open, if there is a place for it; `rest` was read together with its request.
pub(crate) fn live(stream: &Arc<TcpStream>, rest: Vec<u8>, shared: &Shared) {
    let place = match shared.pages.enter(stream) {
        Ok(place) => place,
        // A refused upgrade looks to a page as if there were no server: it is told by a code instead.
        Err(why) => return connection::refuse(stream, why),
    };
    let (greeting, catalogue) = (shared.greeting.clone(), shared.catalogue.clone());
    connection::serve(stream, rest, place.outbox(), Guest { greeting, catalogue, patience: shared.patience });
    shut(stream);
}
