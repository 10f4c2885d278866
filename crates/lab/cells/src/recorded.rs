//! The tracked cell that a study file was fitted to, read back from the folder of results.

use crate::folder::{MODES, SUMMARY};
use crate::names::file_names;
use crate::{Error, Result};
use motiform_store::columns::{Column, Values, decode};
use motiform_study::Error as StudyError;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// A tracked cell: the frames that count.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedCell {
    /// Its name.
    pub name: String,
    /// Units of length and time.
    pub units: [String; 2],
    /// Its frames in the order of time.
    pub frames: Vec<RecordedFrame>,
}

/// A frame: the outline `R(theta) = R0 + sum 2 Re(z_n exp(i n theta))` about the centre.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedFrame {
    /// Time.
    pub t: f64,
    /// Centre.
    pub centre: [f64; 2],
    /// R0.
    pub radius: f64,
    /// z2, z3, ..: real and imaginary parts.
    pub z: Vec<[f64; 2]>,
}

/// The cell that a study file was fitted to; `None` where the file is in no folder of fits, or the folder names no such cell.
///
/// # Errors
/// A folder of fits whose files cannot be read.
pub fn recorded(study: &Path) -> Result<Option<RecordedCell>> {
    let folder = study.parent().unwrap_or(Path::new(""));
    let (summary, modes) = (folder.join(SUMMARY), folder.join(MODES));
    let (Ok(text), true) = (fs::read(&summary), modes.is_file()) else { return Ok(None) };
    let Ok(summary) = serde_json::from_slice::<Value>(&text) else { return Ok(None) };
    let cells: Vec<&str> =
        summary["cells"].as_array().into_iter().flatten().filter_map(|cell| cell["cell"].as_str()).collect();
    let stem = study.file_stem().unwrap_or_default().to_string_lossy();
    let files = file_names(cells.iter().copied());
    let Some(name) = files.iter().position(|file| *file == stem).map(|place| cells[place]) else {
        return Ok(None);
    };
    let columns = decode(&modes).map_err(|error| Error::Study(StudyError::unreadable(&modes, error)))?;
    let unit = |key: &str| summary["units"][key].as_str().unwrap_or_default().to_owned();
    let frames = frames(&columns, name);
    Ok((!frames.is_empty()).then(|| RecordedCell {
        name: name.to_owned(),
        units: [unit("length"), unit("time")],
        frames,
    }))
}

/// The rows of a cell that count.
fn frames(columns: &[Column], name: &str) -> Vec<RecordedFrame> {
    let find = |name: &str| columns.iter().find(|column| column.name == name).map(|column| &column.values);
    let numbers = |name: &str| match find(name) {
        Some(Values::Number(values)) => values.as_slice(),
        _ => &[],
    };
    let (Some(Values::Text(cells)), Some(Values::Whole(left_out))) = (find("cell"), find("left_out")) else {
        return Vec::new();
    };
    let [t, x, y, r0] = ["t", "x", "y", "r0"].map(numbers);
    let parts: Vec<[&[f64]; 2]> = (2..)
        .map(|n| [numbers(&format!("z{n}_re")), numbers(&format!("z{n}_im"))])
        .take_while(|[re, _]| !re.is_empty())
        .collect();
    let frame = |row: usize| RecordedFrame {
        t: t[row],
        centre: [x[row], y[row]],
        radius: r0[row],
        z: parts.iter().map(|part| part.map(|values| values[row])).collect(),
    };
    let counts = |row: &usize| cells[*row] == name && left_out[*row] == 0 && r0[*row].is_finite();
    (0..r0.len()).filter(counts).map(frame).collect()
}
