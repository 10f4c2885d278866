//! Fields over time and arc length as HDF5: named dimensions, units, attributes; opens in h5py, MATLAB, Julia.

use crate::Error;
use crate::Fields;
use hdf5_pure::{AttrValue, File, FileBuilder};
use std::path::Path;

/// Approximate bytes of a chunk: what a reader of one time has to decompress.
const CHUNK_BYTES: usize = 1 << 20;
/// Level of the deflate compression; higher ones cost time and save little on numbers.
const DEFLATE: u32 = 4;

/// A dataset to be written.
struct Part<'a> {
    name: &'static str,
    meaning: &'static str,
    values: &'a [f64],
    /// Name and length of each dimension, slowest first.
    dims: Vec<(&'static str, usize)>,
    /// The reason why values may be NaN.
    undefined: Option<&'static str>,
}

/// Writes the datasets `t` (t), `s` (s), `phi` (t, s) and `outline` (t, point, xy).
///
/// Every dataset has the attributes `units`, `long_name` and `dims` (names of its dimensions, slowest first);
/// `outline` has `undefined`, which gives the reason for NaN values. Double precision, lossless compression.
///
/// # Errors
/// A file that cannot be written, also for inconsistent lengths, or without any time, arc or point.
///
/// # Not
/// HDF5 dimension scales: `hdf5-pure` 0.47 writes no `DIMENSION_LIST` (references of variable length), so `dims` names
/// the datasets instead.
///
/// # Checked by
/// tests/all/hdf5.rs: h5py, and reading back
pub fn write_fields(path: &Path, fields: &Fields) -> Result<(), Error> {
    let parts = parts(fields);
    for part in &parts {
        check(part).map_err(|why| Error::write_failed(path, why))?;
    }
    let mut file = FileBuilder::new();
    for (name, text) in &fields.attributes {
        file.set_attr(name, AttrValue::VarLenString(text.clone()));
    }
    for part in &parts {
        add(&mut file, part);
    }
    file.write(path).map_err(|error| Error::write_failed(path, error))
}

/// Reads the fields back.
///
/// # Errors
/// [`Error::Unreadable`] for a file that is not HDF5, or lacks these datasets with consistent lengths.
pub fn read_fields(path: &Path) -> Result<Fields, Error> {
    let unreadable = |why: &dyn std::fmt::Display| Error::unreadable(path, why);
    let file = File::open(path).map_err(|error| unreadable(&error))?;
    let read = |name: &str| {
        let values = file.dataset(name).and_then(|set| set.read_f64());
        values.map_err(|error| unreadable(&format!("dataset {name}: {error}")))
    };
    let (times, arcs, phi, outlines) = (read("t")?, read("s")?, read("phi")?, read("outline")?);
    let attributes = file.root().attrs().map_err(|error| unreadable(&error))?;
    let texts =
        attributes.iter().filter_map(|(name, value)| Some((name.clone(), value.as_str()?.to_owned())));
    let mut attributes: Vec<(String, String)> = texts.collect();
    attributes.sort_unstable(); // the file has no order of its own
    let points = outlines.len() / (2 * times.len()).max(1);
    let fields = Fields { times, arcs, phi, outlines, points, attributes };
    for part in parts(&fields) {
        check(&part).map_err(|why| unreadable(&why))?;
    }
    Ok(fields)
}

fn parts(fields: &Fields) -> [Part<'_>; 4] {
    let (t, s) = (("t", fields.times.len()), ("s", fields.arcs.len()));
    let part = |name, meaning, values, dims| Part { name, meaning, values, dims, undefined: None };
    [
        part("t", "time", &fields.times, vec![t]),
        part("s", "arc length along the boundary", &fields.arcs, vec![s]),
        part("phi", "phi in the normal angle 2 pi (s + phi)/L", &fields.phi, vec![t, s]),
        Part {
            undefined: Some("NaN where the boundary could not be closed"),
            ..part(
                "outline",
                "boundary, absolute coordinates x and y",
                &fields.outlines,
                vec![t, ("point", fields.points), ("xy", 2)],
            )
        },
    ]
}

/// Checks that the lengths of a part agree with its values; the error names the difference.
fn check(part: &Part<'_>) -> Result<(), String> {
    let lengths = || part.dims.iter().map(|(_, length)| *length);
    let (name, got) = (part.name, part.values.len());
    let expected = lengths().try_fold(1usize, usize::checked_mul);
    match expected {
        Some(0) => Err(format!("{name} is empty; give at least one value")),
        Some(expected) if expected == got => Ok(()),
        _ => {
            let lengths = lengths().map(|length| length.to_string()).collect::<Vec<_>>().join(" x ");
            let names = part.dims.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
            Err(format!("{name} has {got} values for {lengths} ({names}); give one value for each"))
        }
    }
}

fn add(file: &mut FileBuilder, part: &Part<'_>) {
    let shape: Vec<u64> = part.dims.iter().map(|(_, length)| *length as u64).collect();
    let names = part.dims.iter().map(|(name, _)| (*name).to_owned()).collect();
    let text = |text: &str| AttrValue::VarLenString(text.to_owned());
    let units = if part.name == "t" { "model time" } else { "model length" };
    let dataset = file.create_dataset(part.name).with_f64_data(part.values).with_shape(&shape);
    dataset.set_attr("units", text(units));
    dataset.set_attr("long_name", text(part.meaning));
    dataset.set_attr("dims", AttrValue::VarLenStringArray(names));
    if let Some(why) = part.undefined {
        dataset.set_attr("undefined", text(why));
    }
    if shape.len() > 1 {
        // whole times in a chunk: one frame of a film is one read
        let frame = 8 * part.values.len() / part.dims[0].1;
        let times = (CHUNK_BYTES / frame.max(1)).clamp(1, part.dims[0].1);
        let chunk: Vec<u64> = std::iter::once(times as u64).chain(shape[1..].iter().copied()).collect();
        dataset.with_chunks(&chunk).with_shuffle().with_deflate(DEFLATE);
    }
}
