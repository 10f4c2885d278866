//! Label masks: images in which every pixel has the number of its cell; 0 is the background.

mod contour;
mod folder;
mod lzw;
mod png;
mod tiff;

use crate::formats::Found;
use crate::gather::{Gather, Key};
use crate::input::io;
use crate::{Apart, Error, Image, Note, Options, Place, Result};
use contour::outlines;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The remedy where a frame occurs twice.
const REMEDY: Apart = Apart::Names("number the images at the ends of their names");

/// Most pixels of an image.
const MOST_PIXELS: usize = 1 << 28;

/// An image of labels, row by row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Labels {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) of: Vec<u32>,
}

/// Returns `true` if a file begins like an image.
pub(crate) fn is_image(head: &[u8]) -> bool {
    tiff::is_tiff(head) || png::is_png(head)
}

/// The contours at half level around the largest part of each cell, from a folder of images, an image, or a stack.
///
/// The frame of an image is the last number of its name; a stack counts its own. In a folder, `res_track.txt`
/// or `man_track.txt` of the Cell Tracking Challenge says which cells come from which. Coordinates are in
/// pixels, y downwards; the first pixel spans 0 to 1.
pub(crate) fn read(path: &Path, options: &Options) -> Result<Found> {
    let files =
        if path.is_dir() { folder::images(path)? } else { vec![(folder::number(path), path.to_owned())] };
    let alone = files.len() == 1;
    let mut gather = Gather::new(options.limits);
    let (mut size, mut parts) = (None, BTreeMap::<u32, usize>::new());
    for (order, (number, file)) in (0..).zip(&files) {
        let place = Place::file(file);
        let pages = decode(file, options)?;
        if pages.len() > 1 && !alone {
            let found = format!("a stack of {} images among other images", pages.len());
            return Err(Error::structure(&place, found, "one image in each file, or one stack alone"));
        }
        let first = if pages.len() > 1 { 0 } else { number.unwrap_or(order) };
        for (frame, labels) in (first..).zip(pages) {
            same_size(&mut size, &labels, &place)?;
            for (label, points, count) in outlines(&labels) {
                *parts.entry(label).or_default() += usize::from(count > 1);
                gather.outline(Key { cell: &label.to_string(), frame }, None, &points, &place)?;
            }
        }
    }
    let (mut cells, mut notes) = gather.finish(&Place::file(path), REMEDY)?;
    cells.sort_by_key(|cell| cell.name.parse::<u32>().unwrap_or(u32::MAX));
    let several = parts.into_iter().filter(|(_, frames)| *frames > 0);
    notes.extend(several.map(|(label, frames)| Note::SeveralParts { cell: label.to_string(), frames }));
    if path.is_dir() {
        notes.extend(folder::divisions(path)?);
    }
    let image = size.map(|size| Image { size, pixel: 1.0 });
    Ok(Found { cells, notes, image, ..Found::default() })
}

fn same_size(size: &mut Option<[f64; 2]>, labels: &Labels, place: &Place) -> Result<()> {
    let own = [labels.width as f64, labels.height as f64];
    let before = *size.get_or_insert(own);
    if own == before {
        return Ok(());
    }
    let found = format!("an image of {} x {} pixels", own[0], own[1]);
    Err(Error::structure(place, found, format!("{} x {} pixels, as the images before", before[0], before[1])))
}

/// The images of a file.
fn decode(path: &Path, options: &Options) -> Result<Vec<Labels>> {
    let (place, limit) = (Place::file(path), options.limits.file);
    let mut bytes = Vec::new();
    File::open(path).map_err(io(path))?.take(limit + 1).read_to_end(&mut bytes).map_err(io(path))?;
    if bytes.len() as u64 > limit {
        return Err(Error::Limit { place, what: "bytes", limit, key: "file" });
    }
    match bytes.as_slice() {
        head if tiff::is_tiff(head) => tiff::decode(&bytes, &place),
        head if png::is_png(head) => Ok(vec![png::decode(&bytes, &place)?]),
        _ => Err(Error::structure(&place, "no image", "a label mask as TIFF or PNG")),
    }
}

/// Checks the size of an image before memory is taken for it.
fn pixels(width: usize, height: usize, place: &Place) -> Result<usize> {
    match width.checked_mul(height).filter(|pixels| (1..=MOST_PIXELS).contains(pixels)) {
        Some(pixels) => Ok(pixels),
        None => {
            let found = format!("an image of {width} x {height} pixels");
            Err(Error::structure(place, found, format!("1 to {MOST_PIXELS} pixels")))
        }
    }
}

/// The error for an image that is no label mask.
fn unsuitable(place: &Place, found: impl Into<String>) -> Error {
    Error::structure(place, found, "one whole number for each pixel, of 8, 16 or 32 bits: a label mask")
}
