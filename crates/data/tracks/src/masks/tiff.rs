//! TIFF images of labels: whole numbers of one channel, plain or packed without loss, in strips or tiles.
//!
//! Source: TIFF revision 6.0 (1992); Deflate: Adobe Photoshop TIFF Technical Notes (2002).

use super::lzw::unpack as unpack_lzw;
use super::{Labels, pixels, unsuitable};
use crate::{Error, Place, Result};
use flate2::read::ZlibDecoder;
use std::collections::BTreeMap;
use std::io::Read;

/// Most images of a stack.
const MOST_PAGES: usize = 1 << 20;

pub(super) fn is_tiff(head: &[u8]) -> bool {
    head.starts_with(b"II\x2a\0") || head.starts_with(b"MM\0\x2a")
}

/// All images of a file.
pub(super) fn decode(bytes: &[u8], place: &Place) -> Result<Vec<Labels>> {
    let file = File { bytes, big: bytes.starts_with(b"MM"), place };
    let (mut pages, mut at) = (Vec::new(), file.number(4, 4)?);
    while at != 0 && pages.len() < MOST_PAGES {
        let (directory, next) = file.directory(at)?;
        pages.push(Page::of(&file, &directory)?.labels()?);
        at = next;
    }
    Ok(pages)
}

struct File<'b> {
    bytes: &'b [u8],
    /// `true` if the highest byte of a number comes first.
    big: bool,
    place: &'b Place,
}

/// Values of each tag.
type Directory = BTreeMap<usize, Vec<usize>>;

impl File<'_> {
    fn part(&self, at: usize, length: usize) -> Result<&[u8]> {
        let end = at.checked_add(length);
        end.and_then(|end| self.bytes.get(at..end)).ok_or_else(|| {
            Error::structure(
                &self.place.byte(at as u64),
                "the end of the file",
                "the image that its tags describe",
            )
        })
    }

    /// A number of 1, 2 or 4 bytes.
    fn number(&self, at: usize, length: usize) -> Result<usize> {
        Ok(self.value(self.part(at, length)?))
    }

    fn value(&self, bytes: &[u8]) -> usize {
        let add = |sum: usize, byte: &u8| sum << 8 | usize::from(*byte);
        if self.big { bytes.iter().fold(0, add) } else { bytes.iter().rev().fold(0, add) }
    }

    /// A directory of tags, and where the next one is. Tags of other types than bytes and whole numbers are passed over.
    fn directory(&self, at: usize) -> Result<(Directory, usize)> {
        let count = self.number(at, 2)?;
        let mut directory = Directory::new();
        for entry in (0..count).map(|k| at + 2 + 12 * k) {
            let [tag, kind] = [self.number(entry, 2)?, self.number(entry + 2, 2)?];
            let number = self.number(entry + 4, 4)?;
            let Some(size) =
                [(1, 1), (3, 2), (4, 4)].into_iter().find_map(|(of, size)| (of == kind).then_some(size))
            else {
                continue;
            };
            let length = number.saturating_mul(size);
            let from = if length <= 4 { entry + 8 } else { self.number(entry + 8, 4)? };
            let values = self.part(from, length)?.chunks_exact(size).map(|bytes| self.value(bytes));
            directory.insert(tag, values.collect());
        }
        Ok((directory, self.number(at + 2 + 12 * count, 4)?))
    }
}

/// The layout of an image in the file.
struct Page<'f, 'b> {
    file: &'f File<'b>,
    width: usize,
    height: usize,
    /// Bytes of a pixel.
    bytes: usize,
    compression: usize,
    /// `true` if each pixel is stored as its difference from the one to the left.
    differences: bool,
    /// Width and height of a strip or tile, and how many lie beside each other.
    block: [usize; 2],
    across: usize,
    /// Place and number of bytes of each strip or tile.
    blocks: Vec<[usize; 2]>,
}

impl<'f, 'b> Page<'f, 'b> {
    fn of(file: &'f File<'b>, directory: &Directory) -> Result<Self> {
        let first = |tag: usize| directory.get(&tag).and_then(|values| values.first().copied());
        let needed = |tag: usize, name: &str| {
            first(tag).ok_or_else(|| Error::structure(file.place, format!("no {name}"), "a TIFF image"))
        };
        let [width, height] = [needed(256, "width")?, needed(257, "height")?];
        pixels(width, height, file.place)?;
        let bits = first(258).unwrap_or(1);
        let whole = matches!(first(339).unwrap_or(1), 1 | 2) && first(277).unwrap_or(1) == 1;
        if !whole || !matches!(bits, 8 | 16 | 32) {
            let channels = first(277).unwrap_or(1);
            let found = format!(
                "pixels of {channels} channels of {bits} bits, sample format {}",
                first(339).unwrap_or(1)
            );
            return Err(unsuitable(file.place, found));
        }
        let tiled = directory.contains_key(&322);
        let block = match tiled {
            true => [needed(322, "width of tiles")?, needed(323, "height of tiles")?],
            false => [width, first(278).unwrap_or(height).clamp(1, height)],
        };
        pixels(block[0], block[1], file.place)?;
        let tags = if tiled { [324, 325] } else { [273, 279] };
        let [offsets, sizes] = tags.map(|tag| directory.get(&tag).cloned().unwrap_or_default());
        let across = width.div_ceil(block[0]);
        let count = across * height.div_ceil(block[1]);
        if offsets.len() < count || sizes.len() < count {
            let found = format!("{} of {count} parts of the image", offsets.len().min(sizes.len()));
            return Err(Error::structure(file.place, found, "all of them"));
        }
        let blocks = offsets.into_iter().zip(sizes).map(|(at, size)| [at, size]).take(count).collect();
        let compression = first(259).unwrap_or(1);
        let differences = first(317).unwrap_or(1) == 2;
        Ok(Self { file, width, height, bytes: bits / 8, compression, differences, block, across, blocks })
    }

    fn labels(&self) -> Result<Labels> {
        let mut of = vec![0; self.width * self.height];
        for (k, &[at, size]) in self.blocks.iter().enumerate() {
            let [left, top] = [k % self.across * self.block[0], k / self.across * self.block[1]];
            let rows = match self.across == 1 && self.block[0] == self.width {
                true => self.block[1].min(self.height - top), // the last strip may be shorter
                false => self.block[1],
            };
            let row = self.block[0] * self.bytes;
            let data = self.unpacked(self.file.part(at, size)?, rows * row)?;
            for (y, line) in data.chunks_exact(row).enumerate().take(self.height - top) {
                let seen = self.block[0].min(self.width - left);
                let place = (top + y) * self.width + left;
                self.row(line, &mut of[place..place + seen]);
            }
        }
        Ok(Labels { width: self.width, height: self.height, of })
    }

    /// The numbers of a row.
    fn row(&self, line: &[u8], out: &mut [u32]) {
        let mask = u32::MAX >> (32 - 8 * self.bytes);
        let mut before = 0_u32;
        for (pixel, out) in line.chunks_exact(self.bytes).zip(out) {
            let value = u32::try_from(self.file.value(pixel)).unwrap_or(0);
            before = if self.differences { before.wrapping_add(value) & mask } else { value };
            *out = before;
        }
    }

    /// The bytes of a strip or tile.
    fn unpacked(&self, packed: &[u8], length: usize) -> Result<Vec<u8>> {
        let found = match self.compression {
            1 => Some(packed.to_vec()),
            5 => unpack_lzw(packed, length),
            8 | 32946 => inflated(packed, length),
            32773 => unpack_bits(packed),
            other => {
                let found = format!("compression {other}");
                return Err(Error::structure(
                    self.file.place,
                    found,
                    "none, LZW, Deflate or PackBits: save it again so",
                ));
            }
        };
        found.filter(|data| data.len() >= length).ok_or_else(|| {
            Error::structure(self.file.place, "a part of the image that cannot be unpacked", "a whole image")
        })
    }
}

fn inflated(packed: &[u8], length: usize) -> Option<Vec<u8>> {
    let mut data = Vec::new();
    ZlibDecoder::new(packed).take(length as u64).read_to_end(&mut data).ok()?;
    Some(data)
}

/// Runs of bytes: n from 0 to 127 stands before n + 1 bytes, 257 - n before one that is repeated so often; 128 is nothing.
fn unpack_bits(mut packed: &[u8]) -> Option<Vec<u8>> {
    let mut data = Vec::new();
    while let Some((&head, rest)) = packed.split_first() {
        packed = match head {
            0..=127 => {
                let (run, rest) = rest.split_at_checked(usize::from(head) + 1)?;
                data.extend_from_slice(run);
                rest
            }
            128 => rest,
            129..=255 => {
                let (&byte, rest) = rest.split_first()?;
                data.resize(data.len() + 257 - usize::from(head), byte);
                rest
            }
        };
    }
    Some(data)
}
