//! The server: addresses, and rejection of requests.

use crate::catalogue::{Catalogue, StudyFile, file_name};
use crate::connection;
use crate::guard::{Names, Token};
use crate::page::asset;
use crate::protocol::LONGEST;
use crate::session::Greeting;
use crate::{Error, share};
use axum::Router;
use axum::extract::{Path, State, WebSocketUpgrade};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use axum::serve::ListenerExt as _;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::{Semaphore, watch};

/// The default port, if it is free.
pub const DEFAULT_PORT: u16 = 7373;

/// Maximum number of pages at a time: each has its own threads.
const PAGES: u32 = 8;

/// Time for pages to receive the message that the server is stopping.
const GOODBYE: Duration = Duration::from_secs(2);

/// Settings of the server.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The port; by default [`DEFAULT_PORT`], or any free one.
    pub port: Option<u16>,
    /// The token of an earlier start, so that its pages reconnect.
    pub token: Option<String>,
    /// The initial preset.
    pub preset: Option<String>,
    /// The initial model, where there is neither a preset nor a file.
    pub model: Option<String>,
    /// A study file to open.
    pub file: Option<StudyFile>,
}

/// A server that has its port, but has not yet answered any request.
pub struct Server {
    listener: TcpListener,
    shared: Arc<Shared>,
    port: u16,
    stop: watch::Sender<bool>,
    /// What the page opens: `preset=fig5a`, `model=my.toml`.
    opens: Option<String>,
}

/// Stops a server from another thread.
#[derive(Clone)]
pub struct Handle(watch::Sender<bool>);

impl Handle {
    /// Stops the server: pages are notified, threads end.
    pub fn stop(&self) {
        self.0.send_replace(true);
    }
}

/// What all requests share.
struct Shared {
    token: Token,
    names: Names,
    pages: Arc<Semaphore>,
    greeting: Greeting,
    catalogue: Catalogue,
    stop: watch::Receiver<bool>,
}

impl Server {
    /// Takes the port on 127.0.0.1.
    ///
    /// # Errors
    /// A port in use, an invalid token, no random numbers.
    pub fn bind(options: &Options) -> Result<Self, Error> {
        let token = options.token.as_deref().map_or_else(Token::random, Token::given)?;
        let listen = |port| {
            TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(|reason| Error::Port { port, reason })
        };
        let listener = match options.port {
            Some(port) => listen(port)?,
            None => listen(DEFAULT_PORT).or_else(|_| listen(0))?,
        };
        let port = listener.local_addr()?.port();
        let (stop, stopped) = watch::channel(false);
        let catalogue = Catalogue::new(options.file.as_ref())?;
        let file = options.file.as_ref().map(|file| file.path.as_str());
        let subject = file.map_or_else(String::new, |path| format!(" {}", share::quoted(path)));
        let restart = format!("motiform explore{subject} --port {port} --token {}", token.text());
        let greeting = Greeting::new(&catalogue.registry()?, &restart);
        let (names, pages) = (Names::new(port), Arc::new(Semaphore::new(PAGES as usize)));
        let shared = Arc::new(Shared { token, names, pages, greeting, catalogue, stop: stopped });
        let model = file.map(file_name).or_else(|| options.model.clone()).map(|name| format!("model={name}"));
        let opens = options.preset.as_ref().map(|name| format!("preset={name}")).or(model);
        Ok(Self { listener, shared, port, stop, opens })
    }

    /// The address of the page.
    #[must_use]
    pub fn address(&self) -> String {
        let opens = self.opens.as_ref().map_or_else(String::new, |opens| format!("#{opens}"));
        format!("http://127.0.0.1:{}/{}/{opens}", self.port, self.shared.token.text())
    }

    /// Stops the server.
    #[must_use]
    pub fn handle(&self) -> Handle {
        Handle(self.stop.clone())
    }

    /// Serves until it is stopped.
    ///
    /// # Errors
    /// The machine failed.
    pub fn run(self) -> Result<(), Error> {
        // One thread for all connections: the work is done by the sessions' own.
        let runtime = tokio::runtime::Builder::new_current_thread().enable_io().enable_time().build()?;
        let Self { listener, shared, stop, .. } = self;
        runtime.block_on(async move {
            listener.set_nonblocking(true)?;
            // Frames are small and wanted now: without this each waits up to 40 ms for the answer to the one before. Where it is
            // refused they come late, and that is all.
            let listener = tokio::net::TcpListener::from_std(listener)?;
            let listener = listener.tap_io(|stream| drop(stream.set_nodelay(true)));
            let mut stopped = shared.stop.clone();
            let done = async move {
                let _ = stopped.wait_for(|stop| *stop).await; // the sender lives as long as the server
            };
            let pages = Arc::clone(&shared.pages);
            let served = axum::serve(listener, router(shared)).with_graceful_shutdown(done).await;
            // Every page is told, and every session ends, but nobody waits for a page that does not listen.
            let _ = tokio::time::timeout(GOODBYE, pages.acquire_many(PAGES)).await;
            drop(stop);
            Ok(served?)
        })
    }
}

fn router(shared: Arc<Shared>) -> Router {
    Router::new()
        .route("/{token}/", get(page))
        .route("/{token}/{name}", get(file))
        .route("/{token}/live", get(live))
        .fallback(|| async { StatusCode::NOT_FOUND })
        .with_state(shared)
}

impl Shared {
    /// The answer does not reveal whether the token or the name was wrong.
    fn admits(&self, token: &str, headers: &HeaderMap) -> bool {
        let ours = self.names.host_is_ours(headers);
        self.token.is(token) && ours
    }
}

async fn page(State(shared): State<Arc<Shared>>, Path(token): Path<String>, headers: HeaderMap) -> Response {
    if shared.admits(&token, &headers) { asset_response("") } else { StatusCode::FORBIDDEN.into_response() }
}

async fn file(
    State(shared): State<Arc<Shared>>,
    Path((token, name)): Path<(String, String)>,
    headers: HeaderMap,
) -> Response {
    if shared.admits(&token, &headers) {
        asset_response(&name)
    } else {
        StatusCode::FORBIDDEN.into_response()
    }
}

/// Restrictions for the browser: not to load anything from other hosts, embed the page in another one, or reveal its address.
const HEADERS: [(HeaderName, &str); 6] = [
    (
        header::CONTENT_SECURITY_POLICY,
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; \
         base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    ),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::X_FRAME_OPTIONS, "DENY"),
    (header::REFERRER_POLICY, "no-referrer"),
    (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    (header::CACHE_CONTROL, "no-cache"),
];

fn asset_response(name: &str) -> Response {
    let Some(asset) = asset(name) else { return StatusCode::NOT_FOUND.into_response() };
    let mut response = asset.content.into_response();
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(asset.kind));
    for (name, value) in HEADERS {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}

async fn live(
    State(shared): State<Arc<Shared>>,
    Path(token): Path<String>,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Response {
    if !shared.admits(&token, &headers) || !shared.names.origin_is_ours(&headers) {
        return StatusCode::FORBIDDEN.into_response();
    }
    let Ok(place) = Arc::clone(&shared.pages).try_acquire_owned() else {
        return (StatusCode::SERVICE_UNAVAILABLE, "too many pages are open: close one").into_response();
    };
    let (greeting, stop) = (shared.greeting.clone(), shared.stop.clone());
    let catalogue = shared.catalogue.clone();
    upgrade.max_message_size(LONGEST).max_frame_size(LONGEST).on_upgrade(move |socket| async move {
        connection::serve(socket, greeting, catalogue, stop).await;
        drop(place);
    })
}
