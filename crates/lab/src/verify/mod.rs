//! Results computed again and compared with what is on disk, bit by bit.

mod dataset;
mod rows;
mod scan;

pub use dataset::verify_dataset;
pub use scan::verify_scan;

/// What was computed again.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Repeated {
    /// Rows that were compared.
    pub rows: usize,
    /// What is not the same, in sentences.
    pub different: Vec<String>,
}
