//! The classification of a motion, with its evidence.

mod ask;
mod case;
mod chaos;
mod classify;
mod course;
mod family;
mod far;
mod floquet;
mod form;
mod growth;
mod heteroclinic;
mod lane_look;
mod lanes;
mod lasting;
mod legs;
mod look;
mod moments;
mod motion;
mod period;
mod place;
mod recurrence;
mod repeating;
mod repeats;
mod resolution;
mod returns;
mod search;
mod settings;
mod shortest;
mod shrinking;
mod stay;
mod steady_turns;
#[cfg(test)]
mod tests_of_saddles;
#[cfg(test)]
mod tests_of_thresholds;
mod verdict;
mod words;

pub use classify::{classify, settle};
pub use course::{Course, Direction};
pub use form::Form;
pub use lanes::{Candidate, classifies_in_lanes, classify_in_lanes};
pub use repeating::{Repeating, repeating};
pub use resolution::Resolution;
pub use settings::Settings;
pub use verdict::{Attractor, Regime, Spread, Verdict};
