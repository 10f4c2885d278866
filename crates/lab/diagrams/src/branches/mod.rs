//! Branches: the motion that a start settles on, followed along a parameter, stable or not, and what begins and ends on the way.
//!
//! A [`BranchPlan`](motiform_study::BranchPlan) is carried out by [`follow()`]: the plan's own start is simulated until its motion is named
//! ([`settle`](mod@settle)), polished by Newton's method, and followed to both sides of the range. Then every special point and every end
//! of a branch is asked what begins there ([`Origin`]), in the order in which they were found, so that the same plan gives the same
//! bits. A motion that lies on a branch already followed is recognised and not followed twice.
//!
//! A branch is the unit of work: one that was interrupted is kept as far as it came, and followed from its beginning when the work is
//! taken up again ([`BranchFolder`]).

mod arrives;
mod aside;
pub mod draw;
pub(crate) mod family;
pub(crate) mod folder;
pub(crate) mod follow;
mod given;
mod kept;
mod known;
mod names;
mod nested;
mod origin;
mod path;
mod reading;
pub(crate) mod result;
pub mod settle;
mod single_loop;
pub mod starts;
mod stretches;
pub(crate) mod summary;
pub mod sweep;
mod table;

pub use folder::BranchFolder;
pub use follow::{Keep, follow, follow_kept, follow_within};
pub use motiform_continuation::{Allowance, Coefficient, End as BranchEnd, nine, stated};
pub use names::NamedPart;
pub use origin::Origin;
pub use path::path;
pub use reading::Reading;
pub use result::{Branches, Followed, Leg, Link, Sample};
pub(crate) use stretches::stability;
pub use stretches::{is_stable, motion_between, neutral_stretches, stretches};
pub use summary::{SpecialEntry, summary};
pub use table::columns;
