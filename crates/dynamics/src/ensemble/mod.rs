//! Many orbits in lanes: eight at a time, each with its own parameters, time, step size and fate.
//!
//! An ensemble is a queue of members. Each lane of a bundle holds one; a lane whose member has finished, escaped or failed
//! is given the next one from the queue, so no hard orbit stalls the others. The members say what is done with their
//! orbits ([`Members`]): what is watched is watched in the lanes, and no orbit is stored.
//!
//! A lane computes the bits that [`crate::Orbit`] computes for the same member, with the same sequence of steps, for every
//! width and instruction set (`tests/ensemble.rs`).

mod adaptive;
mod dense;
mod lane;
mod propagate;
mod tangent;

pub use adaptive::run_adaptive;
pub use dense::LaneDense;
pub use lane::{Entry, Landed, Leaving, Members, Pace, Stepped, Turn, Why};
pub use propagate::{InLanes, Member, Propagation, Queue, propagate, propagate_on};
pub use tangent::LaneTangent;
