//! The server of `motiform explore`, for one user on one machine: it listens on 127.0.0.1 only, every address
//! contains a random token, and a page can only send the messages of the protocol: no file is read or written
//! for it. The page is built into the program.
//!
//! Here: the port of the server, its address, and its end.

mod accept;
mod connection;
mod error;
mod guard;
mod handover;
mod http;
mod outbox;
mod page;
mod pages;
mod rate;
mod routes;
mod timed;

pub use accept::Patience;
pub use error::Error;
pub use guard::Token;
pub use handover::Handover;

use crate::{Catalogue, Greeting, StudyFile, file_name, quoted};
use accept::accept;
use connection::{GOODBYE, STOPPING};
use guard::Names;
use pages::Pages;
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The default port, if it is free.
pub const DEFAULT_PORT: u16 = 7373;

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
    /// The times for which clients may be silent.
    pub patience: Patience,
}

/// A server that has its port, but has not yet answered any request.
pub struct Server {
    listener: TcpListener,
    shared: Arc<Shared>,
    port: u16,
    stop: Arc<Stop>,
    /// The subject that the page opens: `preset=fig5a`, `model=my.toml`.
    opens: Option<String>,
}

/// The request that the server end.
pub(crate) struct Stop {
    is_set: AtomicBool,
    address: SocketAddr,
}

impl Stop {
    pub(crate) fn is_set(&self) -> bool {
        self.is_set.load(Ordering::Acquire)
    }
}

/// Stops a server from another thread.
#[derive(Clone)]
pub struct Handle(Arc<Stop>);

impl Handle {
    /// Stops the server: pages are notified, threads end.
    pub fn stop(&self) {
        self.0.is_set.store(true, Ordering::Release);
        let _ = TcpStream::connect(self.0.address); // wakes it; if it has ended already, nobody answers
    }
}

/// The data that all requests share.
pub(crate) struct Shared {
    pub(crate) token: Token,
    pub(crate) names: Names,
    pub(crate) pages: Pages,
    pub(crate) greeting: Greeting,
    pub(crate) catalogue: Catalogue,
    pub(crate) patience: Patience,
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
        let address = listener.local_addr()?;
        let port = address.port();
        let stop = Arc::new(Stop { is_set: AtomicBool::new(false), address });
        let catalogue = Catalogue::new(options.file.as_ref())?;
        let file = options.file.as_ref().map(|file| file.path.as_str());
        let subject = file.map_or_else(String::new, |path| format!(" {}", quoted(path)));
        let restart = format!("motiform explore{subject} --port {port} --token {}", token.text());
        let greeting = Greeting::new(&catalogue, &restart)?;
        let (names, pages, patience) = (Names::new(port), Pages::default(), options.patience);
        let shared = Arc::new(Shared { token, names, pages, greeting, catalogue, patience });
        let model = file.map(file_name).or_else(|| options.model.clone()).map(|name| format!("model={name}"));
        let opens = options.preset.as_ref().map(|name| format!("preset={name}")).or(model);
        Ok(Self { listener, shared, port, stop, opens })
    }

    /// The address of the page.
    pub fn address(&self) -> String {
        let opens = self.opens.as_ref().map_or_else(String::new, |opens| format!("#{opens}"));
        format!("http://127.0.0.1:{}/{}/{opens}", self.port, self.shared.token.text())
    }

    /// Stops the server.
    pub fn handle(&self) -> Handle {
        Handle(Arc::clone(&self.stop))
    }

    /// Serves until it is stopped. Every page is then told, and every session ends, but nobody waits for a page that does not listen.
    pub fn run(self) {
        accept(&self.listener, &self.stop, &self.shared);
        drop(self.listener);
        self.shared.pages.dismiss(STOPPING, GOODBYE);
    }
}
