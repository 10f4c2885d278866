//! Bifurcation diagrams from a plan, with their files, figures and pages: [`branches`] of motions along a parameter, [`curves`] of special
//! points over two parameters, and the [`atlas`] of a plane, which has both.

pub mod atlas;
pub mod branches;
pub mod curves;
mod settles;
mod verify;

pub use branches::{
    Allowance, BranchEnd, BranchFolder, Branches, Coefficient, Followed, Keep, Leg, Link, NamedPart, Origin,
    Reading, Sample, SpecialEntry, columns, draw, follow, follow_kept, follow_within, is_stable,
    motion_between, neutral_stretches, nine, path, settle, starts, stated, stretches, summary, sweep,
};
pub use verify::Verification;
