//! Access to the server, and its resistance to bad requests.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::Running;
use motiform_explorer::server::{Options, Patience, Server};
use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};
use tungstenite::Message;

#[test]
fn the_page_is_served_only_with_the_token() {
    let server = Running::anywhere();
    let (token, host) = (server.token().to_owned(), server.host().to_owned());
    for (name, kind) in
        [("", "text/html"), ("app.js", "text/javascript"), ("app.css", "text/css"), ("icon.svg", "image/svg")]
    {
        let (head, body) = server.get(&format!("/{token}/{name}"), &host);
        assert!(head.starts_with("http/1.1 200") && head.contains(kind) && !body.is_empty(), "{head}");
        assert!(head.contains("content-security-policy: default-src 'none'; script-src 'self'"));
        assert!(head.contains("referrer-policy: no-referrer") && head.contains("nosniff"));
    }
    // Only the page that is asked for by its reader may stand in a frame.
    for (query, framed) in [("", false), ("?embed", true), ("?embed=body,map", true), ("?embedded", false)] {
        let (head, _) = server.get(&format!("/{token}/{query}"), &host);
        assert!(head.starts_with("http/1.1 200"), "{query}: {head}");
        let denied = (head.contains("x-frame-options: deny"), head.contains("frame-ancestors 'none'"));
        assert_eq!(denied, (!framed, !framed), "{query}: {head}");
        assert!(head.contains("default-src 'none'; script-src 'self'"));
    }
    let localhost = format!("localhost:{}", server.port());
    assert!(server.get(&format!("/{token}/"), &localhost).0.starts_with("http/1.1 200"));
}

#[test]
fn nobody_else_gets_anything() {
    let server = Running::anywhere();
    let (token, host) = (server.token().to_owned(), server.host().to_owned());
    let wrong = "0".repeat(token.len());
    for path in [
        format!("/{wrong}/"),
        format!("/{wrong}/app.js"),
        format!("/{}/", &token[1..]),
        format!("/{wrong}/live"),
    ] {
        let (head, body) = server.get(&path, &host);
        assert!(
            head.starts_with("http/1.1 403") && body.is_empty() || path.ends_with("live"),
            "{path} {head}"
        );
        assert!(!head.starts_with("http/1.1 200"));
    }
    // Somebody else's name for this machine.
    for host in ["evil.example", "evil.example:80", &format!("evil.example:{}", server.port()), "127.0.0.1"] {
        assert!(server.get(&format!("/{token}/"), host).0.starts_with("http/1.1 403"), "{host}");
    }
    for path in [
        "/",
        "/index.html",
        "//",
        "/..",
        &format!("/{token}/../../etc/passwd"),
        &format!("/{token}/Cargo.toml"),
    ] {
        let (head, body) = server.get(path, &host);
        assert!(head.starts_with("http/1.1 40") && body.is_empty(), "{path}: {head}");
    }
    let head = server.get(&format!("/{token}/..%2f..%2fetc%2fpasswd"), &host).0;
    assert!(head.starts_with("http/1.1 404"), "{head}");
}

#[test]
fn other_methods_and_long_heads_are_refused() {
    let server = Running::anywhere();
    let (token, host) = (server.token().to_owned(), server.host().to_owned());
    let answer = |request: &str| {
        let mut stream = TcpStream::connect(&host).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut text = String::new();
        stream.read_to_string(&mut text).unwrap();
        text.split(' ').nth(1).unwrap().to_owned()
    };
    let head = |length: usize| {
        let begin = format!("GET /{token}/icon.svg HTTP/1.1\r\nHost: {host}\r\nCookie: ");
        let end = "\r\n\r\n";
        format!("{begin}{}{end}", "x".repeat(length - begin.len() - end.len()))
    };
    assert_eq!((answer(&head(16 * 1024)), answer(&head(16 * 1024 + 1))), ("200".into(), "431".into()));
    assert_eq!(
        answer(&format!("POST /{token}/ HTTP/1.1\r\nHost: {host}\r\nContent-Length: 3\r\n\r\nabc")),
        "405"
    );
    assert_eq!(answer("nonsense\r\n\r\n"), "400");
}

#[test]
fn a_socket_is_opened_from_our_page_alone() {
    let server = Running::anywhere();
    let with = |name: &'static str, value: Option<&str>| {
        let mut request = server.request();
        request.headers_mut().remove(name);
        if let Some(value) = value {
            request.headers_mut().insert(name, value.parse().unwrap());
        }
        server.try_page(request).map(|_| ())
    };
    for origin in [Some("http://evil.example"), Some("null"), Some("https://127.0.0.1"), None] {
        assert_eq!(with("origin", origin), Err(403), "{origin:?}");
    }
    assert_eq!(with("host", Some("evil.example")), Err(403));
    let mut request = server.request();
    *request.uri_mut() = format!("ws://{}/{}/live", server.host(), "0".repeat(32)).parse().unwrap();
    assert_eq!(server.try_page(request).map(|_| ()), Err(403));
    server.page().begin("tensor", Some("fig5a"));
}

/// The page that may stand in a frame may stand in a sandboxed one, which has no origin: it reads its files and opens its socket.
#[test]
fn a_sandboxed_frame_is_served_where_its_reader_asks_for_it() {
    let server = Running::anywhere();
    let (token, host) = (server.token().to_owned(), server.host().to_owned());
    let from = format!("{host}\r\nOrigin: null");
    for name in ["app.js", "app.css"] {
        let allowed = |host: &str| {
            server.get(&format!("/{token}/{name}"), host).0.contains("access-control-allow-origin: null")
        };
        assert!(
            allowed(&from) && !allowed(&host) && !allowed(&format!("{host}\r\nOrigin: http://evil.example"))
        );
    }
    let page = server.get(&format!("/{token}/?embed"), &from).0;
    assert!(!page.contains("access-control-allow-origin"), "nobody reads the page itself: {page}");
    let open = |query: &str, origin: &str| {
        let mut request = server.request();
        *request.uri_mut() = format!("ws://{host}/{token}/live{query}").parse().unwrap();
        request.headers_mut().insert("origin", origin.parse().unwrap());
        server.try_page(request).map(|_| ())
    };
    assert_eq!(open("?embed", "null"), Ok(()));
    for (query, origin) in [("", "null"), ("?embedded", "null"), ("?embed", "http://evil.example")] {
        assert_eq!(open(query, origin), Err(403), "{query} {origin}");
    }
}

#[test]
fn what_is_no_message_is_refused_and_the_connection_stays() {
    let server = Running::anywhere();
    let mut page = server.page();
    for bad in
        ["", "nonsense", "{}", "[1]", r#"{"do":"open","path":"/etc/passwd"}"#, r#"{"do":"advance","dt":"x"}"#]
    {
        page.say(bad);
        let why = page.json("refused")["why"].as_str().unwrap().to_owned();
        assert!(why.len() > 10 && !why.contains("column") && !why.contains("expected"), "{bad}: {why}");
    }
    page.socket.send(Message::binary(vec![1, 2, 3])).unwrap();
    assert!(page.json("refused")["why"].as_str().unwrap().contains("JSON"));
    page.say(r#"{"do":"advance","dt":1}"#);
    assert!(page.json("refused")["why"].as_str().unwrap().contains("send begin first"));
    // Input that makes no sense is refused with the name that was meant, and the body goes on.
    page.begin("tensor", Some("fig5a"));
    for (bad, says) in [
        (r#"{"do":"begin","model":"tenser","preset":null}"#, "tensor"),
        (r#"{"do":"begin","model":"tensor","preset":"fig5c"}"#, "fig5"),
        (r#"{"do":"set","parameters":{"kapa2":1}}"#, "kappa2"),
        (r#"{"do":"set","parameters":{"kappa2":1e7}}"#, "10000000"),
        (r#"{"do":"noise","amplitude":-1}"#, "noise"),
        (r#"{"do":"noise","amplitude":1e9}"#, "0 to 1"),
        (r#"{"do":"begin","model":"tensor","preset":"fig5a","noise":1.5}"#, "0 to 1"),
        (r#"{"do":"put","noise":2}"#, "0 to 1"),
        (r#"{"do":"kick","strength":9}"#, "0 to 3"),
        (r#"{"do":"pull","state":[0,0,0,0,0,0],"to":[0,0]}"#, "centre"),
        (r#"{"do":"advance","dt":-1}"#, "forward"),
        (r#"{"do":"begin","model":"tensor","preset":null,"state":[1,2]}"#, "6"),
        (r#"{"do":"map","epoch":1,"x":{"name":"kappa2","low":1,"high":1},"y":null,"count":9}"#, "window"),
        (r#"{"do":"map","epoch":1,"x":{"name":"nothing","low":0,"high":1},"y":null,"count":9}"#, "nothing"),
        (
            r#"{"do":"map","epoch":1,"x":{"name":"kappa2","low":0,"high":1},"y":null,"count":7}"#,
            "count = 7: give 8 to 160",
        ),
        (
            r#"{"do":"map","epoch":1,"x":{"name":"kappa2","low":0,"high":1},"y":null,"count":161}"#,
            "count = 161: give 8 to 160",
        ),
        (r#"{"do":"returns","section":"speed","count":0}"#, "count = 0: give 1 to 2000"),
        (r#"{"do":"returns","section":"speed","count":2001}"#, "count = 2001: give 1 to 2000"),
        (r#"{"do":"put","position":[1.001e12,0]}"#, "up to 1e12"),
        (r#"{"do":"put","position":[0,-1.001e12]}"#, "up to 1e12"),
        (r#"{"do":"export","id":3,"what":"/etc/passwd"}"#, "no file"),
    ] {
        page.say(bad);
        let why = page.json("refused")["why"].as_str().unwrap().to_owned();
        assert!(why.contains(says), "{bad}: {why}");
    }
    for (range, branches, says) in [
        ((1.6, 0.3), 8, "kappa2=1.6:0.3: the range must rise"),
        ((0.9, 0.9), 8, "kappa2=0.9:0.9: the range must rise"),
        ((0.3, 1.6), 0, "branches = 0: give 1 to 24"),
        ((0.3, 1.6), 25, "branches = 25: give 1 to 24"),
    ] {
        let (low, high) = range;
        let along = format!(r#"{{"name":"kappa2","low":{low},"high":{high}}}"#);
        page.say(&format!(r#"{{"do":"follow","epoch":1,"along":{along},"branches":{branches}}}"#));
        let why = page.json("followed")["why"].as_str().unwrap().to_owned();
        assert!(why.contains(says), "{along} {branches}: {why}");
    }
    assert!(page.advance(1.0).t > 0.0);
}

#[test]
fn floods_and_huge_messages_end_a_connection_and_nothing_else() {
    let server = Running::anywhere();
    let mut other = server.page();
    other.begin("tensor", Some("fig5b"));
    for length in [32 * 1024 + 1, 40_000, 100_000, 1 << 20] {
        let mut huge = server.page();
        huge.socket.send(Message::text("x".repeat(length))).unwrap();
        assert_eq!(huge.closed(), Some(1009), "{length}");
    }
    let mut endless = server.page();
    let _ = endless.socket.send(Message::text("x".repeat(4 << 20))); // may be closed before it is all sent
    assert!(endless.closed().is_none_or(|code| code == 1009));
    let mut flood = server.page();
    flood.begin("tensor", Some("fig5a"));
    for _ in 0..5000 {
        if flood.socket.send(Message::text(r#"{"do":"kick"}"#)).is_err() {
            break; // closed already
        }
    }
    assert_eq!(flood.closed(), Some(1008));
    assert!(other.advance(1.0).t > 0.0, "others do not notice");
    server.page().begin("cell", None);
}

#[test]
fn pages_are_counted() {
    let server = Running::anywhere();
    let mut pages: Vec<_> = (0..8).map(|_| server.page()).collect();
    let mut ninth = server.try_page(server.request()).unwrap();
    assert_eq!(ninth.closed(), Some(1013), "a page is told why");
    drop(ninth);
    let mut last = pages.pop().unwrap();
    last.socket.close(None).unwrap();
    last.closed();
    drop(last);
    let again = (0..200).any(|_| {
        std::thread::sleep(Duration::from_millis(25));
        server.try_page(server.request()).unwrap().closes_at_once().is_none()
    });
    assert!(again, "a place is free again");
}

#[test]
fn a_server_that_comes_back_takes_its_pages_back() {
    let server = Running::anywhere();
    let (port, token, address) = (server.port(), server.token().to_owned(), server.address.clone());
    let mut page = server.try_page(server.request()).unwrap();
    let restart = page.json("hello")["restart"].as_str().unwrap().to_owned();
    assert_eq!(restart, format!("motiform explore --port {port} --token {token}"));
    server.stop();
    assert_eq!(page.closed(), Some(1001));
    drop(page);
    drop(server);
    let again = Running::start(&Options { port: Some(port), token: Some(token), ..Options::default() });
    assert_eq!(again.address, address);
    again.page().begin("tensor", Some("fig5a"));
}

#[test]
fn a_port_that_is_taken_and_a_weak_token_are_said() {
    let server = Running::anywhere();
    let bind = |options: &Options| Server::bind(options).map(|_| ()).unwrap_err().to_string();
    let taken = bind(&Options { port: Some(server.port()), ..Options::default() });
    assert!(taken.contains(&server.port().to_string()) && taken.contains("give another one"), "{taken}");
    let weak = bind(&Options { token: Some("1234".to_owned()), ..Options::default() });
    assert!(weak.contains("16 to 128"), "{weak}");
}

/// A server whose patience is short.
fn impatient() -> Running {
    let short = Duration::from_millis;
    let patience = Patience { head: short(300), ping: short(100), silence: short(700) };
    let free = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    Running::start(&Options { port: Some(free), patience, ..Options::default() })
}

/// Returns `true` if the other side closes this connection within some seconds.
fn ends(stream: &mut TcpStream) -> bool {
    stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
    match stream.read(&mut [0; 1024]) {
        Ok(read) => read == 0,
        Err(error) => error.kind() == std::io::ErrorKind::ConnectionReset,
    }
}

#[test]
fn who_sends_no_request_is_not_waited_for() {
    let server = impatient();
    let mut silent = TcpStream::connect(server.host()).unwrap();
    let mut slow = TcpStream::connect(server.host()).unwrap();
    slow.write_all(b"GET / HTTP/1.1\r\nHost: ").unwrap();
    assert!(ends(&mut silent) && ends(&mut slow));
    let (head, _) = server.get(&format!("/{}/", server.token()), server.host());
    assert!(head.starts_with("http/1.1 200"));
}

#[test]
fn of_many_connections_without_a_request_the_oldest_ends() {
    let server = Running::anywhere(); // with its usual patience of ten seconds
    let begun = Instant::now();
    let mut silent: Vec<_> = (0..100).map(|_| TcpStream::connect(server.host()).unwrap()).collect();
    let (head, _) = server.get(&format!("/{}/", server.token()), server.host());
    assert!(head.starts_with("http/1.1 200"), "others are answered meanwhile");
    assert!(ends(&mut silent[0]) && ends(&mut silent[30]));
    assert!(begun.elapsed() < Patience::default().head, "long before their time is over");
    silent[99].set_read_timeout(Some(Duration::from_millis(50))).unwrap();
    assert!(silent[99].read(&mut [0; 8]).is_err(), "the last one is waited for");
}

/// A page that neither reads nor answers pings loses its place; one that only answers pings keeps it.
#[test]
fn pings_free_the_place_of_a_page_that_is_gone() {
    let server = impatient();
    let mut gone: Vec<_> = (0..7).map(|_| server.page()).collect();
    let mut kept = server.page();
    assert_eq!(server.try_page(server.request()).unwrap().closed(), Some(1013));
    let begun = Instant::now();
    kept.socket.get_mut().set_read_timeout(Some(Duration::from_millis(100))).unwrap();
    while begun.elapsed() < Duration::from_secs(2) {
        let _ = kept.socket.read(); // reading answers pings
    }
    kept.socket.get_mut().set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    kept.begin("tensor", Some("fig5a"));
    server.page();
    gone.clear();
}
