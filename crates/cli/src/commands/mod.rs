//! One file per command.

pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod figure;
pub(crate) mod models;
pub(crate) mod simulate;
