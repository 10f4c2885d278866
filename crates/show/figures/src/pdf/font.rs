//! The letters of a face that a file uses, and the face itself as objects of the file.

use super::file::{File, short};
use crate::fonts::{Face, advance};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The glyphs of a face that are used, each with its character.
#[derive(Default)]
pub(super) struct Used(BTreeMap<u16, char>);

impl Used {
    /// Letters as the operand of `TJ`: numbers of glyphs, and blanks for characters that the face does not have.
    pub(super) fn letters(&mut self, face: Face, text: &str) -> String {
        let mut out = String::from("[");
        for character in text.chars() {
            match face.font().and_then(|font| font.glyph_index(character)) {
                Some(glyph) => {
                    self.0.entry(glyph.0).or_insert(character);
                    let _ = write!(out, "<{:04x}>", glyph.0);
                }
                None => out += &short(-1000.0 * advance(face, character)),
            }
        }
        out.replace("><", "") + "]"
    }

    /// Returns `true` if no glyph is used.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Writes the face with the widths and meanings of its used glyphs; the number of the font.
    pub(super) fn write(&self, face: Face, file: &mut File) -> usize {
        let (name, angle) = match face {
            Face::Regular => ("MotiformSans", 0),
            Face::Italic => ("MotiformSans-Italic", -12),
        };
        let bytes = face.bytes();
        let data = file.stream(&format!("/Length1 {} ", bytes.len()), bytes);
        let units = |value: i16| {
            short(
                f64::from(value) * 1000.0 / face.font().map_or(1000.0, |font| f64::from(font.units_per_em())),
            )
        };
        let (bounds, ascent, descent) = face.font().map_or_else(Default::default, |font| {
            let all = font.global_bounding_box();
            let bounds = [all.x_min, all.y_min, all.x_max, all.y_max].map(units).join(" ");
            (bounds, units(font.ascender()), units(font.descender()))
        });
        // 4: its own set of characters; 64: italic
        let flags = if face == Face::Italic { 4 + 64 } else { 4 };
        let descriptor = file.object(&format!(
            "<< /Type /FontDescriptor /FontName /{name} /Flags {flags} /FontBBox [{bounds}] /ItalicAngle {angle} /Ascent {ascent} \
             /Descent {descent} /CapHeight {ascent} /StemV 80 /FontFile2 {data} 0 R >>"
        ));
        let widths: String = self
            .0
            .iter()
            .map(|(glyph, one)| format!("{glyph} [{}] ", short(1000.0 * advance(face, *one))))
            .collect();
        let glyphs = file.object(&format!(
            "<< /Type /Font /Subtype /CIDFontType2 /BaseFont /{name} /CIDSystemInfo << /Registry (Adobe) \
            /Ordering (Identity) /Supplement 0 >> /FontDescriptor {descriptor} 0 R /CIDToGIDMap /Identity \
            /DW 600 /W [{widths}] >>"
        ));
        let meanings = file.stream("", self.meanings().as_bytes());
        file.object(&format!(
            "<< /Type /Font /Subtype /Type0 /BaseFont /{name} /Encoding /Identity-H /DescendantFonts \
            [{glyphs} 0 R] /ToUnicode {meanings} 0 R >>"
        ))
    }

    /// The table of the characters of the glyphs, by which a reader copies and finds text.
    fn meanings(&self) -> String {
        let mut out = String::from(
            "/CIDInit /ProcSet findresource begin\n12 dict begin\nbegincmap\n/CMapName /Letters def\n/CMapType 2 def\n\
             1 begincodespacerange\n<0000> <ffff>\nendcodespacerange\n",
        );
        let all: Vec<(&u16, &char)> = self.0.iter().collect();
        // a table has at most 100 entries
        for part in all.chunks(100) {
            let _ = writeln!(out, "{} beginbfchar", part.len());
            for (glyph, character) in part {
                let mut units = [0; 2];
                let hex: String =
                    character.encode_utf16(&mut units).iter().map(|unit| format!("{unit:04x}")).collect();
                let _ = writeln!(out, "<{glyph:04x}> <{hex}>");
            }
            out += "endbfchar\n";
        }
        out + "endcmap\nCMapName currentdict /CMap defineresource pop\nend\nend\n"
    }
}
