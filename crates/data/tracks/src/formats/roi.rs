//! ImageJ's `.roi`: big-endian, integer offsets from left and top, floats where the outline is finer than pixels.
//!
//! Source: ij/io/RoiDecoder.java.

use crate::{Error, Place, Result};

/// Bytes of the header; coordinates follow.
const HEADER: usize = 64;

/// Option bit: coordinates as floats follow those as integers.
const SUB_PIXEL: u16 = 128;

/// Polygon, freehand and traced outlines.
const OUTLINES: [u8; 3] = [0, 7, 8];

/// An outline in pixels.
pub(super) struct Roi {
    pub(super) points: Vec<[f64; 2]>,
    /// Frame that ImageJ stores: the time of a hyperstack, otherwise the slice.
    pub(super) position: Option<i64>,
}

/// # Errors
/// [`Error::Structure`] for other regions than outlines, [`Error::Truncated`].
pub(super) fn decode(bytes: &[u8], place: &Place) -> Result<Roi> {
    let bytes = Bytes { bytes, place };
    if !bytes.bytes.starts_with(b"Iout") {
        return Err(Error::structure(place, "other data", "an ImageJ region (it begins with Iout)"));
    }
    let kind = bytes.slice(6, 1)?[0];
    if !OUTLINES.contains(&kind) || bytes.u32(36)? > 0 {
        let found = if bytes.u32(36)? > 0 { "a composite region" } else { name(kind) };
        return Err(Error::structure(place, found, "a polygon, freehand or traced outline"));
    }
    let count = match bytes.u16(16)? {
        0 => bytes.u32(18)? as usize, // more than 65535
        count => usize::from(count),
    };
    let points = if bytes.u16(50)? & SUB_PIXEL != 0 {
        bytes.floats(HEADER.saturating_add(count.saturating_mul(4)), count)?
    } else {
        bytes.offsets(count)?
    };
    Ok(Roi { points, position: bytes.position()? })
}

fn name(kind: u8) -> &'static str {
    match kind {
        1 => "a rectangle",
        2 => "an oval",
        3 => "a line",
        4 => "a freehand line",
        5 => "a polyline",
        9 => "an angle",
        10 => "points",
        _ => "a region of an unknown kind",
    }
}

struct Bytes<'a> {
    bytes: &'a [u8],
    place: &'a Place,
}

impl Bytes<'_> {
    fn slice(&self, at: usize, length: usize) -> Result<&[u8]> {
        let missing =
            || Error::Truncated { place: self.place.clone(), missing: format!("byte {at} of the region") };
        self.bytes.get(at..at.saturating_add(length)).ok_or_else(missing)
    }

    fn u16(&self, at: usize) -> Result<u16> {
        let slice = self.slice(at, 2)?;
        Ok(u16::from_be_bytes([slice[0], slice[1]]))
    }

    fn u32(&self, at: usize) -> Result<u32> {
        let slice = self.slice(at, 4)?;
        Ok(u32::from_be_bytes([slice[0], slice[1], slice[2], slice[3]]))
    }

    /// Left, top and the offsets from them.
    fn offsets(&self, count: usize) -> Result<Vec<[f64; 2]>> {
        let signed = |at| Ok::<_, Error>(f64::from(self.u16(at)?.cast_signed()));
        let (top, left) = (signed(8)?, signed(10)?);
        let length = count.saturating_mul(2);
        let xs = self.slice(HEADER, length)?;
        let ys = self.slice(HEADER.saturating_add(length), length)?;
        let value = |pair: &[u8; 2]| f64::from(i16::from_be_bytes(*pair));
        let pairs = xs.as_chunks::<2>().0.iter().zip(ys.as_chunks::<2>().0);
        Ok(pairs.map(|(x, y)| [left + value(x), top + value(y)]).collect())
    }

    /// Coordinates as floats, in the image.
    fn floats(&self, at: usize, count: usize) -> Result<Vec<[f64; 2]>> {
        let length = count.saturating_mul(4);
        let xs = self.slice(at, length)?;
        let ys = self.slice(at.saturating_add(length), length)?;
        let value = |quad: &[u8; 4]| f64::from(f32::from_be_bytes(*quad));
        let pairs = xs.as_chunks::<4>().0.iter().zip(ys.as_chunks::<4>().0);
        Ok(pairs.map(|(x, y)| [value(x), value(y)]).collect())
    }

    fn position(&self) -> Result<Option<i64>> {
        let second = self.u32(60)? as usize;
        let time = if second > 0 { self.u32(second.saturating_add(12)).unwrap_or(0) } else { 0 };
        let slice = self.u32(56)?;
        Ok([time, slice].into_iter().find(|&n| n > 0).map(i64::from))
    }
}
