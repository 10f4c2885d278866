//! Many orbits in lanes: eight at a time, each with its own parameters, time, step size and outcome.
//!
//! An ensemble is a queue of members. Each lane of a bundle holds one; a lane whose member has finished, escaped or failed
//! is given the next one from the queue, so no slow orbit delays the others. A [`LaneTask`] defines what is computed along the
//! orbits; this is done in the lanes, and no orbit is stored.
//!
//! A lane computes the same bits as [`crate::Orbit`] for the same member, with the same sequence of steps, for every
//! width and instruction set (`tests/all/ensemble.rs`).

mod adaptive;
mod dense;
mod extent;
mod lane;
mod noisy;
mod noisy_track;
mod propagate;
mod tangent;

pub use adaptive::run_adaptive;
pub use dense::LaneDense;
pub use extent::{Extent, ShapeAlone, WithPosition};
pub use lane::{AfterStep, Entry, LaneTask, Leaving, Pace, Stepped, Then, Why};
pub use noisy::{NoisyMember, NoisyQueue, NoisySpan, NoisyTrack, propagate_noisy};
pub use propagate::{InLanes, Member, Propagation, Queue, propagate};
pub use tangent::LaneTangent;
