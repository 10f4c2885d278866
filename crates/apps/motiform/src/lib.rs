//! The laboratory for deformable self-propelled domains - cells, droplets and other bodies whose shape and motion drive each other - as
//! a library.
//!
//! A body is a shape state with a velocity read off it: `x' = v(shape)`. Write its equations once, over any scalar, and everything here
//! works for it: its motion is simulated and named, its exponents and branches are computed, its parameters scanned, and all of it
//! drawn.
//!
//! # From a model of one's own to a named motion and a figure
//!
//! A particle that is pushed by its own past: `w` is the fading memory of its velocity `v`,
//!
//! ```text
//! v' = (gamma - |v|^2) v - k w,    w' = (v - w) / tau
//! ```
//!
//! For `k tau < 1` it goes straight with the speed `sqrt(gamma - k)`. Beyond, it goes in circles: speed `sqrt(gamma - 1/tau)`, turning
//! rate `sqrt(k tau - 1)/tau`.
//!
#![doc = concat!("```\n", include_str!("../examples/own_model.rs"), "```")]
//!
//! Everything that takes a study takes this one. Its motions are mapped over parameters, and its branches followed; `&()` is a
//! [`Watch`](dynamics::Watch) that stops nothing:
//!
//! ```no_run
//! use motiform::prelude::*;
//!
//! # let mut study = Study::of_model(ModelInfo::find("tensor")?);
//! study.scan.axes = vec![Axis::parse("k=0.1:0.9:41")?];
//! let scan = Scan::open("map".as_ref(), &ScanPlan::new(&study)?, Shard::WHOLE, Opening::New)?; // or Resume, after a kill
//! scan.run(&Classify, 2, &())?;
//!
//! study.follow.along = Some(Along::parse("k=0.1:0.9")?);
//! let plan = BranchPlan::new(&study, &study.follow.branches()?)?;
//! let branches = follow(&plan, None, &())?;
//! println!("{}", motiform::diagrams::summary(&plan, &branches)); // circles begin at k tau = 1
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | question | answer |
//! | --- | --- |
//! | Lyapunov exponents; those of transient chaos | [`lyapunov`](prelude::lyapunov); [`lab::saddle`] |
//! | steady motions, stable or not; crossings of a surface | [`lab::equilibria`]; [`lab::section`] |
//! | motions of many starts; mean lives of transient chaos | [`lab::samples`]; [`lab::lifetimes`] |
//! | curves of bifurcations; all motions of a plane | [`diagrams::curves`]; [`diagrams::atlas`] |
//! | statistics of many bodies under noise | [`lab::statistics`] |
//!
//! # The ideas, one page each
//!
//! * [`dynamics`]: one equation over any scalar; steppers, orbits, ensembles in lanes, noise, outcomes.
//! * [`models`]: what moves: the tensor model and the active cell of the paper, equations given as text, models of one's own.
//! * [`analysis`]: what is asked of a motion: its name, its stability, its exponents.
//! * [`continuation`]: branches of motions and curves of bifurcations, as equations.
//! * [`study`]: studies and plans as data: checked, hashed, printable.
//! * [`store`]: tables and result folders; what in them is ours.
//! * [`lab`]: plans carried out: runs, scans, samples, statistics.
//! * [`diagrams`]: branches, curves and atlases, with their figures.
//! * [`tracks`], [`statistics`], [`inference`], [`cells`]: from tracked cells to named motions and fitted models.
//! * [`figures`]: plain data to SVG, PNG, PDF and films.
//! * [`paper`]: the reproduction of the paper, a customer of all of these.

pub use motiform_analysis as analysis;
pub use motiform_cells as cells;
pub use motiform_continuation as continuation;
pub use motiform_diagrams as diagrams;
pub use motiform_dynamics as dynamics;
pub use motiform_figures as figures;
pub use motiform_inference as inference;
pub use motiform_lab as lab;
pub use motiform_models as models;
pub use motiform_models::parameters;
pub use motiform_paper as paper;
pub use motiform_statistics as statistics;
pub use motiform_store as store;
pub use motiform_study as study;
pub use motiform_tracks as tracks;

/// The names that most programs need: the traits of a model, studies and plans, and the verbs.
pub mod prelude {
    pub use motiform_analysis::{Regime, regime::Verdict};
    pub use motiform_diagrams::follow;
    pub use motiform_dynamics::model::{Coordinate, Observable, Outline};
    pub use motiform_dynamics::{
        Equivariant, Model, Scalar, Semilinear, Shape, Symmetry, System, VectorField, Watch,
    };
    pub use motiform_lab::analyse::{Spans, classify, lyapunov};
    pub use motiform_lab::draw::still;
    pub use motiform_lab::scan::{Classify, Opening, Scan, Shard, Totals};
    pub use motiform_lab::simulate::simulate;
    pub use motiform_models::{About, ModelInfo, Parameters, register};
    pub use motiform_study::branches::Along;
    pub use motiform_study::scan::Axis;
    pub use motiform_study::{BranchPlan, Dataset, Plan, RunPlan, ScanPlan, Study, presets};
}
