//! All integration tests of this crate, in one program.

mod results;
#[cfg(feature = "formats")]
mod tables;
