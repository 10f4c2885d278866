//! Errors in the data of a figure.

/// The reasons why a figure cannot be drawn. Every message names the datum and the remedy. Positions in lists are counted from 0.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each message says what its fields are")]
pub enum FigureError {
    /// The data are empty.
    #[error("{what} is empty; give at least one value")]
    Empty { what: &'static str },
    /// A number is NaN or infinite.
    #[error("{what} number {index} is {value}; leave undefined values out (or `None`) instead")]
    NotFinite { what: &'static str, index: usize, value: f64 },
    /// A number is finite, but its figure has no sensible axes.
    #[error("{what} number {index} is {value:e}; cut the data where it exceeds {limit:e}")]
    TooLarge { what: &'static str, index: usize, value: f64, limit: f64 },
    /// Two corresponding lists differ in length.
    #[error("{what} has {got} values for {expected} times; give one value (or `None`) per time")]
    Shape { what: String, expected: usize, got: usize },
    /// A spectrum differs in length from its frequencies.
    #[error("spectrum '{curve}' has {got} values for {expected} frequencies; give one value per frequency")]
    Powers { curve: String, expected: usize, got: usize },
    /// A field does not fill its grid.
    #[error(
        "the field has {got} values for {columns} times and {rows} places; give {columns} x {rows} values"
    )]
    Cells { columns: usize, rows: usize, got: usize },
    /// A panel that is wider than its place.
    #[error(
        "panel {panel} needs {needed:.0} mm on paper and has {given:.0} mm; give the figure more width, or fewer columns"
    )]
    Narrow { panel: String, needed: f64, given: f64 },
    /// A width that cannot be read.
    #[error("{text:?} is not a width: write it with a unit (mm, cm, in, px), such as 86mm or 1200px")]
    Width { text: String },
    /// Times do not increase.
    #[error("{what} number {index} is smaller than the one before it; sort the data by time")]
    Unsorted { what: &'static str, index: usize },
    /// Values that must increase do not.
    #[error("{what} number {index} is not above the one before it; sort the values and give each once")]
    NotIncreasing { what: &'static str, index: usize },
    /// A cell of a phase diagram is not at a cell centre.
    #[error(
        "cell number {index} lies at ({x}, {y}), which is not a cell centre; give it a value of each axis"
    )]
    OffGrid { index: usize, x: f64, y: f64 },
    /// Two cells of a phase diagram have the same position.
    #[error("cell number {index} has the same position as an earlier one; merge their shares")]
    SameCell { index: usize },
    /// The shares of a cell do not add up to 1.
    #[error("the shares of cell number {index} add up to {sum}; give shares of at least 0 that add up to 1")]
    Shares { index: usize, sum: f64 },
    /// A size in pixels or a rate is out of range.
    #[error("{what} is {value}; choose it between {min} and {max}")]
    OutOfRange { what: &'static str, value: f64, min: f64, max: f64 },
    /// The text passed to the rasteriser is not a figure of this crate.
    #[error("cannot read the svg: {why}; give the text that a figure's `svg` returned")]
    Svg { why: String },
    /// The program was built without the rasteriser.
    #[error("this program was built without PNG; use the svg, which contains the same drawing")]
    NoRaster,
    /// The PNG encoder failed.
    #[error("cannot encode the png: {source}; try a smaller image")]
    Png {
        #[from]
        source: png::EncodingError,
    },
}

/// Result of a drawing function.
pub type Result<T> = std::result::Result<T, FigureError>;

/// Largest magnitude drawn: beyond it the products of a layout could overflow.
const LIMIT: f64 = 1e100;

/// Rejects values that are not finite, or too large for an axis.
pub(crate) fn check_finite(what: &'static str, values: impl IntoIterator<Item = f64>) -> Result<()> {
    for (index, value) in values.into_iter().enumerate() {
        if !value.is_finite() {
            return Err(FigureError::NotFinite { what, index, value });
        }
        if value.abs() > LIMIT {
            return Err(FigureError::TooLarge { what, index, value, limit: LIMIT });
        }
    }
    Ok(())
}

/// Rejects a setting outside its range.
pub(crate) fn check_range(what: &'static str, value: f64, min: f64, max: f64) -> Result<()> {
    if (min..=max).contains(&value) { Ok(()) } else { Err(FigureError::OutOfRange { what, value, min, max }) }
}
