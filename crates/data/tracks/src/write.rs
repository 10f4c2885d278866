//! Tracks -> files that other programs and [`read()`](crate::read()) understand.

use crate::input::io;
use crate::{Cell, Error, Format, Result, Tracks, header};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// Writes the long table: CSV with the columns cell, frame, i, x, y. Numbers have all their digits.
///
/// # Errors
/// [`Error::Io`].
pub fn write_csv(tracks: &Tracks, path: &Path) -> Result<()> {
    let mut file = BufWriter::new(File::create(path).map_err(io(path))?);
    csv(tracks, &mut file).and_then(|()| file.flush()).map_err(io(path))
}

fn csv(tracks: &Tracks, file: &mut impl Write) -> std::io::Result<()> {
    writeln!(file, "cell,frame,i,x,y")?;
    for cell in &tracks.cells {
        let name = header::quoted(&cell.name);
        for outline in &cell.frames {
            for (i, [x, y]) in outline.points.iter().enumerate() {
                writeln!(file, "{name},{},{i},{x},{y}", outline.frame)?;
            }
        }
    }
    Ok(())
}

/// Writes one cell as AmoePy's text: a line for each frame, `t x0 y0 x1 y1 ...`, in seconds and micrometres.
///
/// # Errors
/// [`Error::Unwritable`] where the units are others, [`Error::Io`].
pub fn write_amoepy(tracks: &Tracks, cell: &Cell, path: &Path) -> Result<()> {
    let units = (tracks.length_unit.as_str(), tracks.time_unit.as_str());
    if units != ("um", "s") {
        let reason = format!(
            "lengths are in {}, times in {}; it needs um and s: give pixel size and interval when they are read",
            units.0, units.1
        );
        return Err(Error::Unwritable { format: Format::AmoePy, reason });
    }
    let mut file = BufWriter::new(File::create(path).map_err(io(path))?);
    amoepy(cell, &mut file).and_then(|()| file.flush()).map_err(io(path))
}

fn amoepy(cell: &Cell, file: &mut impl Write) -> std::io::Result<()> {
    writeln!(file, "# t x0 y0 x1 y1 ...; units: s, um")?;
    for outline in &cell.frames {
        write!(file, "{}", outline.t)?;
        for [x, y] in &outline.points {
            write!(file, " {x} {y}")?;
        }
        writeln!(file)?;
    }
    Ok(())
}
