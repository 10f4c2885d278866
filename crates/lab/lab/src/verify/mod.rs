//! Results computed again and compared with what is on disk, bit by bit.

mod dataset;
mod rows;
mod scan;

pub use dataset::verify_dataset;
pub use scan::verify_scan;

/// The result of a repeated computation.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Repeated {
    /// Rows that were compared.
    pub rows: usize,
    /// The differences, in sentences.
    pub different: Vec<String>,
}
