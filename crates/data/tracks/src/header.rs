//! The header of a table: which column is which.

use crate::split::split;
use crate::units::divided;
use crate::{Columns, Error, Result};
use std::path::Path;

/// The usual names, compared without case and punctuation.
const CELL: &[&str] = &["cell", "cellid", "celllabel", "track", "trackid", "particle", "label", "id"];
const FRAME: &[&str] = &["frame", "frameid", "framenumber", "timepoint", "slice"];
pub(crate) const TIME: &[&str] = &["time", "t", "positiont", "post", "timestamp", "elapsed"];
const ORDER: &[&str] = &["i", "vertex", "vertexid", "node", "nodeid", "point", "pointid", "index"];
pub(crate) const X: &[&str] =
    &["x", "nodex", "xcoord", "xpx", "coordx", "posx", "positionx", "vertx", "vertexx"];
pub(crate) const Y: &[&str] =
    &["y", "nodey", "ycoord", "ypx", "coordy", "posy", "positiony", "verty", "vertexy"];
const TEXT: &[&str] = &["wkt", "geometry", "polygon", "geom"];

/// The places of the columns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Header {
    pub(crate) cell: Option<usize>,
    pub(crate) frame: Option<usize>,
    pub(crate) time: Option<usize>,
    pub(crate) i: Option<usize>,
    pub(crate) x: Option<usize>,
    pub(crate) y: Option<usize>,
    pub(crate) wkt: Option<usize>,
}

impl Header {
    /// # Errors
    /// [`Error::Column`] if an option names a column that is not there, or several columns could be meant.
    pub(crate) fn find(names: &[String], columns: &Columns, file: &Path) -> Result<Self> {
        let find = |wanted, option: &Option<String>, usual| column(names, wanted, option, usual, file);
        Ok(Self {
            cell: find("cell", &columns.cell, CELL)?,
            frame: find("frame", &columns.frame, FRAME)?,
            time: column(names, "time", &None, TIME, file).ok().flatten(),
            i: find("i", &columns.i, ORDER)?,
            x: find("x", &columns.x, X)?,
            y: find("y", &columns.y, Y)?,
            wkt: find("wkt", &columns.wkt, TEXT)?,
        })
    }
}

fn column(
    names: &[String],
    wanted: &'static str,
    option: &Option<String>,
    usual: &[&str],
    file: &Path,
) -> Result<Option<usize>> {
    let error = |found: String| Error::Column {
        file: file.to_owned(),
        wanted,
        found,
        known: names.iter().map(|name| crate::input::shorten(name)).take(60).collect(),
    };
    if let Some(name) = option {
        let found = names.iter().position(|other| other.trim() == name.trim());
        return found.map(Some).ok_or_else(|| error(format!("no column {name:?}")));
    }
    // exactly the plain name goes before all others, without a unit before one with it
    let exact = |reading: fn(&str) -> String| names.iter().position(|name| reading(name) == usual[0]);
    if let Some(exact) = exact(letters).or_else(|| exact(plain)) {
        return Ok(Some(exact));
    }
    let fits = |name: &&String| usual.contains(&plain(name).as_str());
    let found: Vec<&String> = names.iter().filter(fits).collect();
    match found.as_slice() {
        [] => Ok(None),
        [one] => Ok(names.iter().position(|name| name == *one)),
        _ => Err(error(format!("several columns ({found:?})"))),
    }
}

/// The column, or an error that says which one is missing.
pub(crate) fn needed(
    at: Option<usize>,
    wanted: &'static str,
    names: &[String],
    file: &Path,
) -> Result<usize> {
    at.ok_or_else(|| Error::Column {
        file: file.to_owned(),
        wanted,
        found: "no column".to_owned(),
        known: names.iter().map(|name| crate::input::shorten(name)).take(60).collect(),
    })
}

/// Letters and digits in lower case, without a unit: `Node X (px)` is `nodex`, `x_um` is `x`.
fn plain(name: &str) -> String {
    letters(divided(name).name)
}

/// Letters and digits in lower case.
pub(crate) fn letters(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// The separator of a table: the one of tab, semicolon and comma that occurs most often in the header.
pub(crate) fn separator(header: &str) -> u8 {
    let count = |separator: u8| header.bytes().filter(|&byte| byte == separator).count();
    [b',', b';', b'\t'].into_iter().max_by_key(|&separator| count(separator)).unwrap_or(b',')
}

/// Names of the columns of a header line.
pub(crate) fn names(header: &str) -> Vec<String> {
    let mut names = Vec::new();
    split(header, separator(header), &mut names);
    names.iter().map(|name| name.trim().to_owned()).collect()
}

/// Returns `true` if a line is the header of a table of vertices: it has x and y, or the names of the
/// options.
pub(crate) fn is_table(line: &str, columns: &Columns) -> bool {
    let names = names(line);
    let has = |option: &Option<String>, usual: &[&str]| match option {
        Some(name) => names.iter().any(|other| other == name.trim()),
        None => names.iter().any(|name| usual.contains(&plain(name).as_str())),
    };
    names.len() > 2 && has(&columns.x, X) && has(&columns.y, Y)
}

/// Returns `true` if a line is the header of TrackMate's table of spots.
pub(crate) fn is_of_spots(line: &str) -> bool {
    let names: Vec<String> = names(line).iter().map(|name| plain(name)).collect();
    ["positionx", "positiony", "quality", "radius"]
        .iter()
        .all(|wanted| names.iter().any(|name| name == wanted))
}

/// The place where `POLYGON` or `MULTIPOLYGON` begins in a line.
pub(crate) fn polygon(line: &str) -> Option<usize> {
    let upper = line.to_ascii_uppercase();
    let at = upper.match_indices("POLYGON").map(|found| found.0).find(|&at| {
        let rest = upper[at + "POLYGON".len()..].trim_start();
        rest.starts_with('(') || rest.starts_with('Z') || rest.starts_with("EMPTY")
    })?;
    Some(if upper[..at].ends_with("MULTI") { at - "MULTI".len() } else { at })
}

/// A field of CSV, in quotes where it needs them.
pub(crate) fn quoted(text: &str) -> std::borrow::Cow<'_, str> {
    if text.contains([',', '"', '\n', '\r', ';', '\t']) {
        format!("\"{}\"", text.replace('"', "\"\"").replace(['\n', '\r'], " ")).into()
    } else {
        text.into()
    }
}
