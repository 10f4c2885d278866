//! The format of a file, from its content.

use crate::input::{Input, shorten, text as text_of};
use crate::{Error, Format, Options, Result, Setting, header, masks};
use std::path::Path;

/// Bytes that are looked at.
const HEAD: u64 = 1 << 16;

/// The format of a file. The extension plays no part.
///
/// # Errors
/// [`Error::UnknownFormat`] with what the content looks like, [`Error::Ambiguous`] where it fits several formats.
pub fn detect(path: &Path, options: &Options) -> Result<Format> {
    if path.is_dir() {
        return Ok(Format::Masks);
    }
    let head = Input::head(path, options.limits, HEAD)?;
    let may = |found: &str, setting| Error::UnknownFormat {
        file: path.to_owned(),
        found: found.to_owned(),
        setting,
    };
    let unknown = |found: &str| may(found, None);
    let text = match head.as_slice() {
        [] => return Err(unknown("the file is empty")),
        [b'P', b'K', 3, 4, ..] | [b'P', b'K', 5, 6, ..] => return Ok(Format::RoiZip),
        [b'P', b'A', b'R', b'1', ..] => return Ok(Format::Parquet),
        [b'I', b'o', b'u', b't', ..] => return Ok(Format::Roi),
        image if masks::is_image(image) => return Ok(Format::Masks),
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => return Err(unknown("text in UTF-16: save it as UTF-8")),
        bytes if bytes.contains(&0) => return Err(unknown("binary data")),
        bytes => text_of(bytes),
    };
    let text = text.trim_start_matches('\u{feff}').trim_start();
    if text.is_empty() {
        return Err(unknown("the file is blank"));
    }
    if text.starts_with('<') {
        return if text.contains("<TrackMate") {
            Ok(Format::TrackMate)
        } else {
            Err(unknown("XML, but not of TrackMate"))
        };
    }
    if header::is_of_spots(text.lines().next().unwrap_or_default()) {
        return Err(unknown(
            "TrackMate's table of spots, which has one place for each cell and frame, but no outlines: give the XML file that \
             TrackMate saves; it has the outlines that detectors of masks, labels and thresholds draw",
        ));
    }
    let candidates = candidates(text, options);
    match candidates.as_slice() {
        [one] => Ok(*one),
        [] if text.starts_with("#p2 - QuimP") => {
            Err(unknown("QuimP's parameters: give the .snQP file of the same name"))
        }
        [] => Err(may(&looks(text), Some(Setting::Columns))),
        _ => Err(Error::Ambiguous { file: path.to_owned(), candidates }),
    }
}

/// The text formats that the first lines fit.
fn candidates(text: &str, options: &Options) -> Vec<Format> {
    let lines: Vec<&str> = text.lines().take(60).collect();
    if quimp_nodes(&lines) {
        return vec![Format::QuimpNodes];
    }
    if lines.iter().any(|line| block(line).is_some()) {
        return vec![Format::QuimpTable];
    }
    let mut found = Vec::new();
    if header::is_table(lines[0], &options.columns) {
        found.push(Format::Csv);
    }
    if lines.iter().take(2).any(|line| header::polygon(line).is_some()) {
        found.push(Format::Wkt);
    }
    if amoepy(&lines) {
        found.push(Format::AmoePy);
    }
    found
}

/// Number of the frame in a line `#frame 3`.
pub(crate) fn block(line: &str) -> Option<&str> {
    let rest = line.strip_prefix('#')?.trim_start();
    let word = rest.get(..5)?;
    let number = rest.get(5..)?;
    let is = word.eq_ignore_ascii_case("frame") && number.starts_with([' ', '\t']);
    is.then_some(number.trim())
}

/// A line `#Frame N` and below it the count of nodes alone.
fn quimp_nodes(lines: &[&str]) -> bool {
    let count = |line: &str| line.trim().parse::<u64>().is_ok();
    lines.windows(2).any(|pair| block(pair[0]).is_some() && count(pair[1]))
}

/// Lines of an odd count of numbers, at least 7, separated by blanks, below comments.
fn amoepy(lines: &[&str]) -> bool {
    let data = lines.iter().find(|line| !line.starts_with('#') && !line.trim().is_empty());
    data.is_some_and(|line| {
        let mut words = line.split_ascii_whitespace();
        let numbers = words.clone().count();
        // a very long line may be cut at the end of the head
        (numbers % 2 == 1 || line.len() > 1 << 15) && numbers >= 7 && words.all(|w| w.parse::<f64>().is_ok())
    })
}

/// A description for the error.
fn looks(text: &str) -> String {
    let first = text.lines().next().unwrap_or_default();
    format!("text that begins {:?}; a table needs a header with columns for frame, x and y", shorten(first))
}
