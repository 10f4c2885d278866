//! Statistics of many bodies ([`motiform_statistics`]): bodies are simulated from one study ([`simulated`]) or read from dataset folders
//! ([`read`]); the result becomes tables ([`tables()`]), a summary ([`summary()`]), figures ([`draw()`]) and a folder ([`write()`]).

mod bodies;
mod datasets;
mod draw;
mod error;
mod folder;
mod kept;
mod record;
mod sampling;
mod summary;
mod tables;

pub use bodies::{MOST, SIMULATED, simulated, simulated_kept};
pub use datasets::read;
pub use draw::draw;
pub use error::{Error, Result};
pub use folder::{open, write};
pub use record::{Measurement, mode_names};
pub use sampling::{coarser_than_own, samples_apart};
pub use summary::{sentences, summary};
pub use tables::{Named, tables};
