//! Tests of what readers of figures see.

#![allow(clippy::expect_used, reason = "a test may fail")]

mod colours;
mod drawing;
#[path = "../../examples/gallery/kinds/mod.rs"]
mod kinds;
mod references;
mod sizes;
