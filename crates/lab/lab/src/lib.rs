//! The laboratory executes plans. A [`Plan`](motiform_study::Plan) is simulated, or analysed for its motion, its exponents and its
//! steady shapes; a [`ScanPlan`](motiform_study::ScanPlan) is computed row by row; datasets and scans become figures.

mod accuracy;
pub mod analyse;
pub mod answers;
mod captured;
pub mod clock;
pub mod dataset;
pub mod draw;
pub mod ensemble;
pub mod equilibria;
pub mod fields;
pub mod flow;
pub mod given;
pub mod lifetimes;
pub mod live;
pub mod long;
pub mod many;
pub mod naming;
pub mod noisy;
pub mod pool;
pub mod readings;
pub mod recorder;
pub mod registry;
pub mod saddle;
pub mod sample_path;
pub mod samples;
pub mod scan;
pub mod section;
pub mod simulate;
pub mod statistics;
pub mod verify;
