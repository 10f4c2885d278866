//! Binary messages, as described in `PROTOCOL.md`.

use serde_json::json;

/// Kinds of binary messages: their first byte.
const FRAME: u8 = 1;
const CELLS: u8 = 2;
const FILE: u8 = 3;
const SWARM: u8 = 4;

/// One frame of the body.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Frame {
    pub(crate) revision: u32,
    /// Computing took too long for a frame: the body has not reached the requested time.
    pub(crate) behind: bool,
    pub(crate) t: f64,
    pub(crate) position: [f64; 2],
    /// Undeformed radius that the outline is drawn with.
    pub(crate) radius: f64,
    pub(crate) coordinates: Vec<f64>,
    /// Rows of `columns` numbers.
    pub(crate) samples: Vec<f64>,
    pub(crate) columns: usize,
    /// Relative to the position; `None` if the shape is not a curve.
    pub(crate) outline: Option<Vec<[f64; 2]>>,
}

impl Frame {
    pub(crate) fn encode(&self) -> Vec<u8> {
        let outline = self.outline.as_deref().unwrap_or_default();
        let rows = self.samples.len() / self.columns.max(1);
        let flags = u8::from(self.outline.is_some()) | (u8::from(self.behind) << 1);
        let numbers = 4 + self.coordinates.len() + self.samples.len() + 2 * outline.len();
        let mut out = Vec::with_capacity(16 + 8 * numbers);
        out.extend([FRAME, flags]);
        for count in [rows, self.columns, outline.len()] {
            out.extend(u16::try_from(count).unwrap_or(u16::MAX).to_le_bytes());
        }
        out.extend(self.revision.to_le_bytes());
        out.extend(u32::try_from(self.coordinates.len()).unwrap_or(u32::MAX).to_le_bytes());
        let [x, y] = self.position;
        let head = [self.t, x, y, self.radius];
        let all = head.iter().chain(&self.coordinates).chain(&self.samples).chain(outline.iter().flatten());
        all.for_each(|number| out.extend(number.to_le_bytes()));
        out
    }
}

/// A cell of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cell {
    pub(crate) place: [u16; 2],
    /// It stands for 2^level cells along each axis.
    pub(crate) level: u8,
    /// Place in the list of regimes.
    pub(crate) regime: u8,
    /// The largest Lyapunov exponent and the half width of its 95 % interval; NaN where the verdict has none.
    pub(crate) exponent: [f32; 2],
}

/// Some cells of a map.
pub(crate) fn cells(epoch: u32, cells: &[Cell]) -> Vec<u8> {
    let mut out = Vec::with_capacity(16 + 16 * cells.len());
    out.extend([CELLS, 0]);
    out.extend(u16::try_from(cells.len()).unwrap_or(u16::MAX).to_le_bytes());
    out.extend(epoch.to_le_bytes());
    out.extend([0; 8]);
    for cell in cells {
        out.extend(cell.place[0].to_le_bytes());
        out.extend(cell.place[1].to_le_bytes());
        out.extend([cell.level, cell.regime, 0, 0]);
        cell.exponent.iter().for_each(|number| out.extend(number.to_le_bytes()));
    }
    out
}

/// A body of a swarm.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Swimmer {
    pub(crate) position: [f64; 2],
    /// Between its shape and that of the body, in the model's own coordinates.
    pub(crate) distance: f64,
    /// As many points for each, relative to its position; empty if the shape is not a curve.
    pub(crate) outline: Vec<[f64; 2]>,
}

/// The bodies of a swarm; `points` for each outline, NaN where there is none.
pub(crate) fn swarm(revision: u32, t: f64, points: usize, swimmers: &[Swimmer]) -> Vec<u8> {
    let mut out = Vec::with_capacity(24 + swimmers.len() * (24 + 8 * points));
    out.extend([SWARM, 0]);
    for count in [swimmers.len(), points, 0] {
        out.extend(u16::try_from(count).unwrap_or(u16::MAX).to_le_bytes());
    }
    out.extend(revision.to_le_bytes());
    out.extend([0; 4]);
    out.extend(t.to_le_bytes());
    for Swimmer { position: [x, y], distance, .. } in swimmers {
        [x, y, distance].into_iter().for_each(|number| out.extend(number.to_le_bytes()));
    }
    for swimmer in swimmers {
        let outline = swimmer.outline.iter().copied().chain(std::iter::repeat([f64::NAN; 2])).take(points);
        outline.flatten().for_each(|number| out.extend((number as f32).to_le_bytes()));
    }
    out
}

/// A file.
pub(crate) fn file(id: u32, name: &str, mime: &str, content: &[u8]) -> Vec<u8> {
    let head = json!({ "id": id, "name": name, "mime": mime }).to_string();
    let mut out = Vec::with_capacity(8 + head.len() + content.len());
    out.extend([FILE, 0, 0, 0]);
    out.extend(u32::try_from(head.len()).unwrap_or(u32::MAX).to_le_bytes());
    out.extend(head.as_bytes());
    out.extend(content);
    out
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    fn number(bytes: &[u8], place: usize) -> f64 {
        f64::from_le_bytes(bytes[place..place + 8].try_into().unwrap())
    }

    #[test]
    fn frames_are_laid_out_as_written() {
        let frame = Frame {
            revision: 258,
            behind: true,
            t: 1.5,
            position: [2.0, -3.0],
            radius: 0.5,
            coordinates: vec![7.0, 8.0],
            samples: vec![10.0, 11.0, 12.0, 13.0, 14.0, 15.0],
            columns: 3,
            outline: Some(vec![[20.0, 21.0]]),
        };
        let bytes = frame.encode();
        assert_eq!(bytes[..16], [1, 3, 2, 0, 3, 0, 1, 0, 2, 1, 0, 0, 2, 0, 0, 0]);
        let numbers: Vec<f64> = (16..bytes.len()).step_by(8).map(|place| number(&bytes, place)).collect();
        let expected = [1.5, 2.0, -3.0, 0.5, 7.0, 8.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0, 20.0, 21.0];
        assert_eq!(numbers, expected);
        assert_eq!(Frame { outline: None, ..frame }.encode()[1], 2);
    }

    #[test]
    fn swarms_are_laid_out_as_written() {
        let one = Swimmer { position: [1.0, 2.0], distance: 0.5, outline: vec![[1.0, -2.0]] };
        let none = Swimmer { outline: Vec::new(), ..one.clone() };
        let bytes = swarm(258, 7.5, 1, &[one, none]);
        assert_eq!(bytes[..16], [4, 0, 2, 0, 1, 0, 0, 0, 2, 1, 0, 0, 0, 0, 0, 0]);
        let numbers: Vec<f64> = (0..7).map(|k| number(&bytes, 16 + 8 * k)).collect();
        assert_eq!(numbers, [7.5, 1.0, 2.0, 0.5, 1.0, 2.0, 0.5]);
        assert_eq!(bytes[72..80], [0, 0, 128, 63, 0, 0, 0, 192]);
        assert_eq!(bytes.len(), 88);
        assert!(f32::from_le_bytes(bytes[80..84].try_into().unwrap()).is_nan());
    }

    #[test]
    fn cells_and_files_are_laid_out_as_written() {
        let bytes = cells(3, &[Cell { place: [4, 258], level: 2, regime: 6, exponent: [1.0, -2.0] }]);
        assert_eq!(bytes[16..], [4, 0, 2, 1, 2, 6, 0, 0, 0, 0, 128, 63, 0, 0, 0, 192]);
        assert_eq!(bytes[..8], [2, 0, 1, 0, 3, 0, 0, 0]);
        let bytes = file(5, "a.svg", "image/svg+xml", b"<svg/>");
        let length = usize::from(bytes[4]);
        let head: serde_json::Value = serde_json::from_slice(&bytes[8..8 + length]).unwrap();
        assert_eq!(head, json!({ "id": 5, "name": "a.svg", "mime": "image/svg+xml" }));
        assert_eq!(&bytes[8 + length..], b"<svg/>");
    }
}
