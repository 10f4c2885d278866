//! Sessions without a server: the messages of the protocol, and their answers.

mod common;
mod drives;
mod fuzz;
mod local;
pub(crate) mod messages;
#[path = "../../../../../lab/lab/tests/all/common/mutate.rs"]
pub(crate) mod mutate;
