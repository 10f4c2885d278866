//! The objects of a PDF file, and the table that leads to them.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write as _;

/// A PDF file under construction. Objects are numbered from 1 in the order in which they are added.
#[derive(Default)]
pub(super) struct File {
    bytes: Vec<u8>,
    /// The offset of each object in the file.
    places: Vec<usize>,
}

impl File {
    pub(super) fn new() -> Self {
        // the second line says that the file is not plain text
        Self { bytes: b"%PDF-1.5\n%\xe2\xe3\xcf\xd3\n".to_vec(), places: Vec::new() }
    }

    /// The number of the next object.
    pub(super) fn next(&self) -> usize {
        self.places.len() + 1
    }

    /// Adds an object; its number.
    pub(super) fn object(&mut self, content: &str) -> usize {
        self.begin();
        self.bytes.extend(content.as_bytes());
        self.end()
    }

    /// Adds a compressed stream with further entries in its dictionary; its number.
    pub(super) fn stream(&mut self, entries: &str, content: &[u8]) -> usize {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
        // writing into memory does not fail
        let _ = encoder.write_all(content);
        let packed = encoder.finish().unwrap_or_default();
        self.begin();
        let head = format!("<< /Length {} /Filter /FlateDecode {entries}>>\nstream\n", packed.len());
        self.bytes.extend(head.as_bytes());
        self.bytes.extend(packed);
        self.bytes.extend(b"\nendstream");
        self.end()
    }

    fn begin(&mut self) {
        self.places.push(self.bytes.len());
        let head = format!("{} 0 obj\n", self.places.len());
        self.bytes.extend(head.as_bytes());
    }

    fn end(&mut self) -> usize {
        self.bytes.extend(b"\nendobj\n");
        self.places.len()
    }

    /// The file, whose catalogue is the object of this number.
    pub(super) fn finish(mut self, catalogue: usize) -> Vec<u8> {
        let (table, count) = (self.bytes.len(), self.places.len() + 1);
        let mut tail = format!("xref\n0 {count}\n0000000000 65535 f \n");
        tail.extend(self.places.iter().map(|place| format!("{place:010} 00000 n \n")));
        tail += &format!("trailer\n<< /Size {count} /Root {catalogue} 0 R >>\nstartxref\n{table}\n%%EOF\n");
        self.bytes.extend(tail.as_bytes());
        self.bytes
    }
}

/// A number with at most four digits after the point, and no more than it needs.
pub(super) fn short(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
