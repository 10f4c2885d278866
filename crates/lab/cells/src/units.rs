//! Units of the data, as they stand beside numbers.

use crate::Sample;
use motiform_study::quantity::Unit;
use motiform_study::{Dimension, Quantity};
use motiform_tracks::Tracks;

/// Units of lengths and times.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Units {
    /// Of lengths; `pixel` where the scale is unknown.
    pub length: String,
    /// Of times; `frame` where the interval is unknown.
    pub time: String,
    /// `true` if y points down in the images: figures then do the same.
    pub y_down: bool,
}

impl Units {
    /// Those of a data set.
    pub fn of(sample: &Sample) -> Self {
        Self::of_tracks(&sample.tracks)
    }

    /// Those of outlines.
    pub fn of_tracks(tracks: &Tracks) -> Self {
        Self {
            length: tracks.length_unit.clone(),
            time: tracks.time_unit.clone(),
            y_down: tracks.y_down == Some(true),
        }
    }

    /// The same for pages: `um` as `µm`.
    #[must_use]
    pub fn typeset(self) -> Self {
        Self { length: Unit::typeset(&self.length), time: Unit::typeset(&self.time), ..self }
    }

    /// The unit of times after a number: `s`, `frames`.
    pub fn times(&self) -> &str {
        if self.time == "frame" { "frames" } else { &self.time }
    }

    /// A time with its unit, from the number as it is written: `1 frame`, `2.5 frames`, `1 s`.
    pub fn of_time(&self, number: &str) -> String {
        format!("{number} {}", if number == "1" { &self.time } else { self.times() })
    }

    /// The unit of lengths after a number: `um`, `pixels`.
    pub fn lengths(&self) -> &str {
        if self.length == "pixel" { "pixels" } else { &self.length }
    }

    /// The unit of a dimension after a number.
    pub fn behind(&self, dimension: Dimension) -> String {
        match dimension {
            Dimension::TIME => self.times().to_owned(),
            Dimension::LENGTH => self.lengths().to_owned(),
            other => self.unit(other),
        }
    }

    /// The unit of a dimension; empty where there is none.
    pub fn unit(&self, dimension: Dimension) -> String {
        dimension.unit([&self.length, &self.time])
    }

    /// A label with its unit.
    pub fn label(&self, label: &str, dimension: Dimension) -> String {
        let unit = self.unit(dimension);
        if unit.is_empty() { label.to_owned() } else { format!("{label} ({unit})") }
    }

    /// The label of a quantity with its unit.
    pub fn axis(&self, quantity: &Quantity) -> String {
        self.label(quantity.symbol, quantity.dimension)
    }
}
