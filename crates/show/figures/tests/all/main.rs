//! Tests of what readers of figures see.

#![allow(clippy::expect_used, reason = "a test may fail")]

mod colours;
mod drawing;
mod every_figure;
#[path = "../../examples/gallery/kinds/mod.rs"]
mod kinds;
mod measurements;
mod phase_diagrams;
mod picture;
mod pixels;
mod references;
mod reports;
mod sizes;
