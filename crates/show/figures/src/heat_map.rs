//! A grid of signed numbers as a small PNG.

use super::error::Result;
use super::palette::signed_colour;
use super::picture::indexed_png;

/// Colours of a picture on either side of zero; with zero they fill a palette of 8 bits.
const LEVELS: u8 = 127;

/// Numbers in rows; the first row is the lowest.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid<'a> {
    /// Length of a row.
    pub(super) columns: usize,
    /// Number of rows.
    pub(super) rows: usize,
    /// Row after row.
    pub(super) values: &'a [f64],
}

/// A [`Grid`] that owns its numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cells {
    columns: usize,
    rows: usize,
    values: Vec<f64>,
}

impl Grid<'_> {
    /// Means over boxes, so that at most (columns, rows) cells remain; boxes differ by at most one value a side.
    pub(super) fn averaged(&self, most: (usize, usize)) -> Cells {
        let (columns, rows) = (self.columns.min(most.0), self.rows.min(most.1));
        let mut values = Vec::with_capacity(columns * rows);
        for row in 0..rows {
            let inside = row * self.rows / rows..(row + 1) * self.rows / rows;
            for column in 0..columns {
                let (from, to) = (column * self.columns / columns, (column + 1) * self.columns / columns);
                let lines = inside.clone().map(|r| &self.values[r * self.columns..][from..to]);
                let count = inside.len() * (to - from);
                values.push(lines.flatten().map(|v| v / count as f64).sum());
            }
        }
        Cells { columns, rows, values }
    }
}

impl Cells {
    /// Columns and rows.
    pub(super) fn size(&self) -> (usize, usize) {
        (self.columns, self.rows)
    }

    /// One of the numbers.
    pub(super) fn value(&self, column: usize, row: usize) -> f64 {
        self.values[row * self.columns + column]
    }

    /// Largest magnitude.
    pub(super) fn largest(&self) -> f64 {
        self.values.iter().fold(0.0, |largest, v| largest.max(v.abs()))
    }

    /// The PNG, lowest row at the bottom; `limit` and beyond take the ends of the colours.
    pub(super) fn png(&self, limit: f64) -> Result<Vec<u8>> {
        let colours = (0..=2 * LEVELS).map(|i| signed_colour(f64::from(i) / f64::from(LEVELS) - 1.0));
        let index = |v: &f64| ((v / limit).clamp(-1.0, 1.0) * f64::from(LEVELS)).round() as i16;
        let pixel = |v: &f64| (index(v) + i16::from(LEVELS)) as u8;
        let pixels: Vec<u8> = self.values.rchunks(self.columns).flatten().map(pixel).collect();
        indexed_png(self.columns, &colours.collect::<Vec<_>>(), &pixels)
    }
}

#[cfg(test)]
mod tests {
    use super::super::palette::Colour;
    use super::*;

    #[test]
    fn boxes_are_averaged_and_small_grids_kept() {
        let values: Vec<f64> = (0..15).map(f64::from).collect();
        let grid = Grid { columns: 5, rows: 3, values: &values };
        assert_eq!(grid.averaged((9, 9)).values, values);
        // columns 0..2 and 2..5; all rows
        assert_eq!(grid.averaged((2, 1)).values, [5.5, 8.0]);
    }

    #[test]
    fn the_first_row_is_at_the_bottom_and_zero_is_pale() {
        let grid = Grid { columns: 2, rows: 2, values: &[-3.0, 0.0, 1.5, 3.0] };
        let bytes = grid.averaged((9, 9)).png(3.0).expect("a png");
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().expect("a header");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut pixels).expect("an image");
        let seen: Vec<_> = pixels.chunks(3).map(|c| Colour(c[0], c[1], c[2])).collect();
        let near = signed_colour(64.0 / 127.0); // 0.5 rounded to a level
        assert_eq!(seen, [near, signed_colour(1.0), signed_colour(-1.0), signed_colour(0.0)]);
    }
}
