//! Curves of special points over two parameters: what bounds the regimes in a plane.
//!
//! A [`CurvePlan`](motiform_study::CurvePlan) is carried out by [`follow_curves`]: branches are followed along one parameter, as in
//! [`crate::branches::follow()`], and each special point of the kinds asked for is followed through the plane, to both sides. A special
//! point that lies on a curve already followed is recognised. A curve is the unit of work: one that was interrupted is followed again when
//! the work is taken up ([`CurveFolder`]).

mod crossing;
mod family;
mod folder;
mod follow;
mod result;
mod summary;
mod table;

pub(crate) use crossing::same_point;
pub use folder::CurveFolder;
pub use follow::{follow_curve, follow_curve_within, follow_curves, follow_curves_kept};
pub use result::{CurveLeg, CurveSample, Curves, FollowedCurve};
pub use summary::{codimension_2, curve_ends, curve_summary, not_found};
pub use table::curve_columns;
