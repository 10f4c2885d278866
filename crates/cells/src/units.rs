//! Units of the data, as they stand beside numbers.

use crate::Sample;

/// Units of lengths and times.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Units {
    /// Of lengths; `pixel` where the scale is unknown.
    pub length: String,
    /// Of times; `frame` where the interval is unknown.
    pub time: String,
    /// Whether y points down in the images: figures then show what the images show.
    pub y_down: bool,
}

impl Units {
    /// Those of a data set.
    #[must_use]
    pub fn of(sample: &Sample) -> Self {
        let tracks = &sample.tracks;
        Self {
            length: tracks.length_unit.clone(),
            time: tracks.time_unit.clone(),
            y_down: tracks.y_down == Some(true),
        }
    }

    /// The same for pages: `um` as `µm`.
    #[must_use]
    pub fn typeset(self) -> Self {
        let length = if self.length == "um" { "µm".to_owned() } else { self.length };
        Self { length, ..self }
    }

    /// Unit of speeds.
    #[must_use]
    pub fn speed(&self) -> String {
        format!("{}/{}", self.length, self.time)
    }

    /// Unit of diffusion coefficients.
    #[must_use]
    pub fn diffusion(&self) -> String {
        format!("{}^2/{}", self.length, self.time)
    }
}
