//! The server: addresses, and rejection of requests.

use crate::Error;
use crate::accept::{Patience, accept};
use crate::connection::{self, Guest};
use crate::guard::{NO_ORIGIN, Names, Token, no_origin};
use crate::page::asset;
use axum::Router;
use axum::extract::{Path, RawQuery, State, WebSocketUpgrade};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use motiform_session::{Catalogue, Greeting, StudyFile, file_name, quoted};
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::{Semaphore, watch};

/// The default port, if it is free.
pub const DEFAULT_PORT: u16 = 7373;

/// Maximum number of pages at a time: each has its own threads.
const PAGES: u32 = 8;

/// Time for pages to receive the message that the server is stopping, and for their sessions to end: Ctrl-C takes less than a second.
const GOODBYE: Duration = Duration::from_millis(700);

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
    /// How long others may be silent.
    pub patience: Patience,
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
    patience: Patience,
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
        let subject = file.map_or_else(String::new, |path| format!(" {}", quoted(path)));
        let restart = format!("motiform explore{subject} --port {port} --token {}", token.text());
        let greeting = Greeting::new(&catalogue, &restart)?;
        let (names, pages) = (Names::new(port), Arc::new(Semaphore::new(PAGES as usize)));
        let patience = options.patience;
        let shared = Arc::new(Shared { token, names, pages, greeting, catalogue, patience, stop: stopped });
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
            let listener = tokio::net::TcpListener::from_std(listener)?;
            let mut stopped = shared.stop.clone();
            let (pages, patience) = (Arc::clone(&shared.pages), shared.patience);
            tokio::select! {
                () = accept(listener, router(shared), patience) => {}
                _ = stopped.wait_for(|stop| *stop) => {} // the sender lives as long as the server
            }
            // Every page is told, and every session ends, but nobody waits for a page that does not listen.
            let _ = tokio::time::timeout(GOODBYE, pages.acquire_many(PAGES)).await;
            drop(stop);
            Ok(())
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

/// Whether the reader asks for a page to stand within another one.
fn is_embed(query: Option<&str>) -> bool {
    query.is_some_and(|query| query == "embed" || query.starts_with("embed="))
}

async fn page(
    State(shared): State<Arc<Shared>>,
    Path(token): Path<String>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Response {
    if !shared.admits(&token, &headers) {
        return StatusCode::FORBIDDEN.into_response();
    }
    let mut response = asset_response("");
    if is_embed(query.as_deref()) {
        let headers = response.headers_mut();
        headers.remove(header::X_FRAME_OPTIONS);
        let policy = POLICY.replace("; frame-ancestors 'none'", "");
        if let Ok(policy) = HeaderValue::from_str(&policy) {
            headers.insert(header::CONTENT_SECURITY_POLICY, policy);
        }
    }
    response
}

async fn file(
    State(shared): State<Arc<Shared>>,
    Path((token, name)): Path<(String, String)>,
    headers: HeaderMap,
) -> Response {
    if !shared.admits(&token, &headers) {
        return StatusCode::FORBIDDEN.into_response();
    }
    let mut response = asset_response(&name);
    if no_origin(&headers) {
        // The page in a sandboxed frame: it has no origin, and its browser asks whether it may read its own script.
        let name = header::ACCESS_CONTROL_ALLOW_ORIGIN;
        response.headers_mut().insert(name, HeaderValue::from_static(NO_ORIGIN));
    }
    response
}

/// What the page may load, and that no other page may embed it.
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
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Response {
    let ours = shared.names.origin_is_ours(&headers) || (is_embed(query.as_deref()) && no_origin(&headers));
    if !shared.admits(&token, &headers) || !ours {
        return StatusCode::FORBIDDEN.into_response();
    }
    let upgrade = upgrade.max_message_size(connection::READ_WHOLE).max_frame_size(connection::READ_WHOLE);
    let Ok(place) = Arc::clone(&shared.pages).try_acquire_owned() else {
        // A refused upgrade looks to a page as if there were no server: it is told by a code instead.
        return upgrade.on_upgrade(connection::refuse);
    };
    let guest = Guest {
        greeting: shared.greeting.clone(),
        catalogue: shared.catalogue.clone(),
        stop: shared.stop.clone(),
        patience: shared.patience,
    };
    upgrade.on_upgrade(move |socket| async move {
        connection::serve(socket, guest).await;
        drop(place);
    })
}
