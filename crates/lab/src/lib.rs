//! The laboratory: what carries plans out. A [`Plan`](motiform_study::Plan) is simulated, asked for its motion, its exponents and its
//! steady shapes; a [`ScanPlan`](motiform_study::ScanPlan) is computed row by row; datasets and scans become figures.

pub mod analyse;
pub mod continuation;
pub mod draw;
pub mod ensemble;
pub mod equilibria;
pub mod fields;
pub mod flow;
pub mod live;
pub mod naming;
mod pool;
mod readings;
pub mod registry;
pub mod saddle;
pub mod samples;
pub mod scan;
pub mod section;
pub mod simulate;
