//! `motiform explore` on the command line: the address, the end, and what it refuses.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(all(unix, feature = "explorer"))]

use crate::common;

use common::Folder;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Command, Stdio};

#[test]
fn the_address_is_printed_and_ctrl_c_is_the_usual_end() {
    let folder = Folder::new();
    let mut command = folder.command("explore --no-open --preset fig3 --token abcdefghijklmnop0123");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut out = BufReader::new(child.stdout.take().unwrap());
    let (mut says, mut address) = (String::new(), String::new());
    out.read_line(&mut says).unwrap();
    out.read_line(&mut address).unwrap();
    let address = address.trim();
    let rest = address.strip_prefix("http://").unwrap();
    let (host, path) = rest.split_once('/').unwrap();
    assert!(host.starts_with("127.0.0.1:"), "{address}");
    assert_eq!(path, "abcdefghijklmnop0123/#preset=fig3");
    let mut stream = TcpStream::connect(host).unwrap();
    write!(stream, "GET /abcdefghijklmnop0123/ HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n")
        .unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200") && answer.contains("<title>"));
    let kill = Command::new("bash").args(["-c", &format!("kill -INT {}", child.id())]).status().unwrap();
    assert!(kill.success());
    assert_eq!(child.wait().unwrap().code(), Some(0));
    let mut errors = String::new();
    child.stderr.take().unwrap().read_to_string(&mut errors).unwrap();
    assert_eq!((errors.as_str(), folder.names()), ("", vec![]), "nothing is written anywhere");
}

#[test]
fn what_cannot_be_served_is_said() {
    let folder = Folder::new();
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    for (words, says) in [
        ("--preset fig5c", "fig5b"),
        ("--token short", "16 to 128"),
        ("--port 0", "1..=65535"),
        (&format!("--port {port}"), port.as_str()),
    ] {
        let done = folder.run(&format!("explore --no-open {words}")).expect(2);
        assert!(done.stderr.contains(says), "{words}: {}", done.stderr);
    }
}

/// Everybody on a machine can read the arguments of programs: the token is not among those of the browser's. Only the user can read the
/// file that is handed over, and it goes with the server.
#[test]
fn a_browser_is_given_a_file_and_not_the_token() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = Folder::new();
    let opener = "#!/bin/sh\n# Only what is complete is there to be read.\necho \"$@\" > said.part; cp -p \"$1\" \
     copy.html\nmv said.part said\n";
    folder.write("xdg-open", opener);
    std::fs::set_permissions(folder.path("xdg-open"), std::fs::Permissions::from_mode(0o755)).unwrap();
    std::fs::create_dir(folder.path("running")).unwrap();
    let path = std::env::join_paths(
        std::iter::once(folder.path("")).chain(std::env::split_paths(&std::env::var_os("PATH").unwrap())),
    );
    let mut command = folder.command("explore --preset fig3");
    command.env("PATH", path.unwrap()).env("XDG_RUNTIME_DIR", folder.path("running"));
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut out = BufReader::new(child.stdout.take().unwrap());
    let (mut says, mut address) = (String::new(), String::new());
    out.read_line(&mut says).unwrap();
    out.read_line(&mut address).unwrap();
    let token = address.trim().split('/').nth(3).unwrap().to_owned();
    while !folder.path("said").exists() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let said = std::fs::read_to_string(folder.path("said")).unwrap();
    assert!(!said.contains(&token) && said.contains("running/motiform-"), "{said}");
    let text = std::fs::read_to_string(folder.path("copy.html")).unwrap();
    assert!(text.contains(&format!("url={}", address.trim())), "{text}");
    assert_eq!(std::fs::metadata(folder.path("copy.html")).unwrap().permissions().mode() & 0o777, 0o600);
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert_eq!(std::fs::read_dir(folder.path("running")).unwrap().count(), 0);
}
