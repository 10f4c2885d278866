//! `motiform explore`.

use crate::args::ExploreOptions;
use crate::output::{End, print, warn};
use motiform_explorer::{Options, Server};
use motiform_study::presets::{PRESETS, model_of};
use std::process::{Command, Stdio};

pub(crate) fn run(options: &ExploreOptions) -> anyhow::Result<End> {
    if let Some(name) = options.preset.as_ref().filter(|name| model_of(name).is_none()) {
        let known: Vec<&str> = PRESETS.iter().map(|preset| preset.name).collect();
        let value = name.clone();
        anyhow::bail!("--preset {value}: unknown preset; give one of {}", known.join(", "));
    }
    let server = Server::bind(&Options {
        port: options.port,
        token: options.token.clone(),
        preset: options.preset.clone(),
    })?;
    let address = server.address();
    print(&format!("the explorer is running at\n  {address}\non this machine only; Ctrl-C stops it"))?;
    let handle = server.handle();
    // Fails only if a handler is set already: then the first Ctrl-C ends the program, and nothing is lost.
    let _ = ctrlc::set_handler(move || handle.stop());
    if !options.no_open && !open(&address) {
        warn("no browser could be opened: open the address above");
    }
    server.run()?;
    Ok(End::Done)
}

/// Opens an address in the browser; returns whether this was possible.
fn open(address: &str) -> bool {
    let (program, arguments): (&str, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("rundll32", &["url.dll,FileProtocolHandler"])
    } else {
        ("xdg-open", &[])
    };
    let mut command = Command::new(program);
    command.args(arguments).arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let Ok(mut child) = command.spawn() else { return false };
    // Whoever asked must hear that it is done; a desktop that says no is said by the address above.
    std::thread::spawn(move || child.wait());
    true
}
