//! The inventory of a result: JSON lines, so that a line is added as each file appears.
//!
//! The first line says what the result is: `{"motiform":"0.1.0","kind":"scan","format":1,"complete":true}`. Then a line for each file:
//! `{"name":"part-00000.parquet","sha256":"..."}`. While the result is written, lines are appended in the order of the work, each before
//! its file has its name; a complete inventory is sorted and has one line for each file, so that its bytes depend only on the result.

use crate::{Error, Kind, VERSION};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::Path;

/// The name of the inventory. It begins with `_`: readers of Parquet folders (pandas, pyarrow, polars) skip such names.
pub const INVENTORY: &str = "_inventory.jsonl";

/// The format of inventories.
const FORMAT: u64 = 1;

/// Maximum size of an inventory in bytes: ten million files.
const MOST: u64 = 1 << 30;

/// The contents of a folder.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Inventory {
    /// Version of motiform that wrote it.
    pub version: String,
    /// The name of its [`Kind`]; a later version may have more of them.
    pub kind: String,
    /// `true` if the result is complete.
    pub complete: bool,
    /// Names of files, `/` between folders, with the digests that were written under this name: the last one last.
    pub files: BTreeMap<String, Vec<String>>,
    /// Beginnings of the names of incomplete files of this folder.
    pub(crate) partials: Vec<String>,
    /// The number of a replacement that is under way.
    pub(crate) moving: Option<String>,
    /// The name of the folder that is about to replace this one.
    pub(crate) gives_way_to: Option<String>,
    /// The name of the folder beside this one that replaces it, when that one is complete.
    pub(crate) replaced_by: Option<String>,
    /// The target of a result that is being written beside its place.
    pub(crate) staging_for: Option<String>,
}

impl Inventory {
    /// The inventory of a result without files.
    pub(crate) fn new(kind: Kind) -> Self {
        Self { version: VERSION.to_owned(), kind: kind.name().to_owned(), ..Self::default() }
    }

    /// Reads the inventory of a folder; `None` if there is none.
    ///
    /// # Errors
    /// [`Error::Inventory`].
    pub fn read(folder: &Path) -> Result<Option<Self>, Error> {
        Self::read_file(&folder.join(INVENTORY))
    }

    /// Reads an inventory; `None` if there is none.
    pub(crate) fn read_file(path: &Path) -> Result<Option<Self>, Error> {
        let damaged = |reason: String| Error::Inventory { path: path.to_owned(), reason };
        match fs::symlink_metadata(path) {
            Ok(there) if there.is_file() => {}
            Ok(_) => return Err(damaged("it is not a file".to_owned())), // reading a pipe might never end
            Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
                return Ok(None);
            }
            Err(error) => return Err(damaged(error.to_string())),
        }
        let mut bytes = Vec::new();
        let read = File::open(path).and_then(|file| file.take(MOST).read_to_end(&mut bytes));
        read.map_err(|error| damaged(error.to_string()))?;
        Self::parse(&String::from_utf8_lossy(&bytes)).map(Some).map_err(damaged)
    }

    /// Lines that are cut off, by a kill or a full disk, are skipped: what they would list is not known to be ours.
    fn parse(text: &str) -> Result<Self, String> {
        let mut lines = text.lines();
        let head: Value =
            lines.next().and_then(|line| serde_json::from_slice(line.as_bytes()).ok()).unwrap_or_default();
        let (Some(version), Some(kind)) = (head["motiform"].as_str(), head["kind"].as_str()) else {
            return Err("it is no inventory of motiform".to_owned());
        };
        if head["format"] != FORMAT {
            return Err(format!("motiform {version} wrote it in format {}, not {FORMAT}", head["format"]));
        }
        let mut found = Self {
            version: version.to_owned(),
            kind: kind.to_owned(),
            complete: head["complete"] == true,
            staging_for: head["staging_for"].as_str().map(str::to_owned),
            ..Self::default()
        };
        lines
            .filter_map(|line| serde_json::from_slice(line.as_bytes()).ok())
            .for_each(|line| found.add(&line));
        Ok(found)
    }

    fn add(&mut self, line: &Value) {
        if let (Some(name), Some(digest)) = (line["name"].as_str(), line["sha256"].as_str()) {
            self.list(name, digest);
        }
        if let Some(partial) = line["partial"].as_str() {
            self.partials.push(partial.to_owned());
        }
        if let Some(number) = line["moving"].as_str() {
            self.moving = Some(number.to_owned());
        }
        if let Some(name) = line["gives_way_to"].as_str() {
            self.gives_way_to = Some(name.to_owned());
        }
        if let Some(name) = line["replaced_by"].as_str() {
            self.replaced_by = Some(name.to_owned());
        }
    }

    /// Lists a file. A name that leads out of the folder is not listed.
    pub(crate) fn list(&mut self, name: &str, digest: &str) {
        let leads_out = name.is_empty()
            || name.split('/').any(|part| matches!(part, "" | "." | ".."))
            || name.contains(std::path::is_separator) && cfg!(windows) && name.contains(['\\', ':']);
        if leads_out || name == INVENTORY {
            return;
        }
        let digests = self.files.entry(name.to_owned()).or_default();
        digests.retain(|known| known != digest);
        digests.push(digest.to_owned());
    }

    /// The inventory as text.
    pub(crate) fn text(&self) -> String {
        let mut head = json!({ "motiform": self.version, "kind": self.kind, "format": FORMAT, "complete": self.complete });
        if let Some(target) = &self.staging_for {
            head["staging_for"] = json!(target);
        }
        let mut text = format!("{head}\n");
        for (name, digests) in &self.files {
            digests.iter().for_each(|digest| text += &file_line(name, digest));
        }
        text
    }

    /// The kind of the result, in words.
    pub fn words(&self) -> String {
        Kind::of_name(&self.kind).map_or_else(|| self.kind.clone(), |kind| kind.words().to_owned())
    }
}

/// The line of a file.
pub(crate) fn file_line(name: &str, digest: &str) -> String {
    format!("{}\n", json!({ "name": name, "sha256": digest }))
}

/// Returns `true` if a file is a figure, by its name: it can be drawn again.
pub fn is_figure(name: &str) -> bool {
    let end = name.rsplit_once('.').map_or("", |(_, end)| end);
    ["svg", "png", "pdf", "gif", "mp4"].contains(&end)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may fail")]
mod tests {
    use super::*;

    #[test]
    fn lines_are_read_back_and_those_cut_off_are_skipped() {
        let mut inventory = Inventory::new(Kind::Scan);
        inventory.list("b/c.json", "12");
        inventory.list("a", "34");
        let text = inventory.text();
        assert_eq!(Inventory::parse(&text).unwrap(), inventory);
        let torn = text + "{\"name\":\"d\",\"sha2";
        assert_eq!(Inventory::parse(&torn).unwrap(), inventory);
        assert!(Inventory::parse("{}").is_err() && Inventory::parse("").is_err());
    }

    #[test]
    fn names_that_lead_out_are_not_listed() {
        let mut inventory = Inventory::new(Kind::Scan);
        ["../a", "/a", "a/../b", "", "a//b", INVENTORY].iter().for_each(|name| inventory.list(name, "1"));
        assert!(inventory.files.is_empty());
    }
}
