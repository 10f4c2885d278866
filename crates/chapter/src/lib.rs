//! What the chapters of the reproduction share: their settings, claims, and the bifurcations that are continued in parameters.
//!
//! A chapter runs studies and scans through its [`Context`](context::Context), and says what it finds as [`claims`]. Branches and curves
//! belong to two figures: the [`lines`] of Fig. 1, which are known from formulas, and the [`branches`] and [`curves`] of Fig. 4.

pub mod branches;
pub mod claims;
pub mod context;
pub mod curves;
pub mod fault;
pub mod kept;
pub mod lines;
pub mod plane;
