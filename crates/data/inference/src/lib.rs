//! From observed tracks of shape modes to amplitude equations.
//!
//! [`fit()`] finds the coefficients of all rotation-covariant terms and the noise by maximum likelihood through an extended Kalman filter;
//! [`stage_velocities`] estimates the drift of the stage; [`select`] chooses the terms that the data support;
//! [`identifiability()`] finds the combinations of coefficients that the motion determines; [`handedness`]
//! tests whether left and right differ; [`warnings()`] and [`drift()`] state reasons to doubt the fit;
//! [`ladder()`] compares models from a random walk on by frames that their fits did not see; [`weak()`] is an inexpensive independent
//! estimate; [`place()`] and [`place_among`] locate the model in the
//! paper's planes; [`Fit::definition`] makes it a model.
//! Knows no file. Method and measurements: docs/inference.md.

mod between;
mod change;
mod definition;
mod draws;
mod error;
mod field;
mod filter;
mod fit;
mod handed;
mod identifiability;
mod ladder;
mod library;
mod linear;
mod names;
mod null;
mod observation;
mod p_value;
mod place;
mod pooled;
mod scales;
mod senses;
mod stage;
mod subsets;
mod walk;
mod warnings;
mod weak;

pub use between::{BetweenCells, between_cells};
pub use change::{CHANGED, change, handed_beside_change};
pub use definition::equations;
pub use draws::draws;
pub use error::{Error, Result};
pub use fit::{
    CellScatter, Coefficient, Ending, Estimate, Fit, Likelihood, Natural, Noise, Parameters, Settings, fit,
    fit_from, likelihood,
};
pub use handed::{COLOURED, DOUBTED_RATE, HANDED_RATE, Handedness, SEEN, Symmetry, handedness};
pub use identifiability::{
    Combination, EquationKnowledge, FIXED, FREE, Identifiability, Knowledge, identifiability,
};
pub use ladder::{BLOCKS, Ladder, LadderModel, Rung, ladder};
pub use library::{Library, MOST_MODES, Term};
pub use names::paper;
pub use null::{WALK_RATE, walk_p_value};
pub use observation::{LEAST_FRAMES, Observation, Track};
pub use p_value::PValue;
pub use place::{Coordinate, Place, Placement, Plane, coordinates, place, place_among};
pub use pooled::{Pooled, pooled, pooled_fits};
pub use scales::Scales;
pub use senses::{HandedCell, Senses, senses};
pub use stage::{Beside, StageVelocity, WithStage, handed_beside, stage_velocities, with_stage};
pub use subsets::{
    Averaged, Selection, Subset, Subsets, TIE, averaged, refit_tied, refit_with, select, subsets,
};
pub use walk::{
    Bounded, Fix, Misfit, PersistentWalk, SPREAD_SCATTER, WalkTests, WalkTogether, persistent_walk,
    walk_likelihood, walk_together,
};
pub use warnings::{
    COARSE, Channel, Drift, DriftPoint, Stretch, UnequalNoise, Warning, carried_cells, drift, fastest_rate,
    warnings, whiteness,
};
pub use weak::{Weak, weak};
