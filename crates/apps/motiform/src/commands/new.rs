//! `motiform new`.

use crate::args::NewOptions;
use crate::output::{End, print};
use motiform_study::Error;
use std::fs::OpenOptions;
use std::io::Write;

const STUDY: &str = include_str!("templates/study.toml");
const EQUATIONS: &str = include_str!("templates/equations.toml");

/// Writes a file that was not there.
pub(crate) fn run(options: &NewOptions) -> anyhow::Result<End> {
    let path = &options.file;
    if path.extension().is_none_or(|end| end != "toml") {
        let remedy = "a study ends in .toml: give a name such as mine.toml";
        return Err(Error::Setting { key: "FILE", value: path.display().to_string(), remedy }.into());
    }
    let text = if options.equations { EQUATIONS } else { STUDY };
    let file = OpenOptions::new().write(true).create_new(true).open(path);
    let written = file.and_then(|mut file| file.write_all(text.as_bytes()).and_then(|()| file.sync_all()));
    written.map_err(|error| match error.kind() {
        std::io::ErrorKind::AlreadyExists => {
            let remedy = "it exists and stays as it is: give another name";
            Error::Setting { key: "FILE", value: path.display().to_string(), remedy }
        }
        _ => Error::write_failed(path, error),
    })?;
    let file = path.display();
    print(&format!("written     {file}\nnext        motiform check {file}; motiform simulate {file}"))?;
    Ok(End::Done)
}
