//! Continuation: a motion followed through a parameter, stable or not, with the places where it is born, changes and dies.
//!
//! A [`Family`] says which body belongs to a parameter value. A [`Branch`] is an **iterator over points**: the loop belongs to the
//! caller, who may stop at any point, and [`Branch::end`] says why it ended by itself. Special points come in their place among the
//! others, each with its [`Special`]; [`switch()`] gives the branches that cross there.
//!
//! * relative equilibria ([`Branch::of_equilibria`]): `f(u, p) = omega G u`, unknowns `(u, omega, p)`;
//! * relative periodic orbits ([`Branch::of_orbits`]): `Phi_T(u) = R(angle) [M] u` by multiple shooting on the full shape equations,
//!   unknowns `(nodes, T, angle, p)`. An orbit that is its own mirror image after half a period is the solution of the problem over
//!   that half, without any rotation.
//!
//! Newton's steps are orthogonal to the directions along the orbit and along the group, so no section and no coordinate can break
//! down. Eigenvalues and multipliers are those of the reduced motion: the neutral directions are divided out exactly, before any
//! eigenvalue is computed. (At a drift pitchfork the critical and the neutral direction form a Jordan block: of the unreduced
//! matrix only half of the digits are right.) Special points are solved for: every iterate is a solution of the equations.
//!
//! A [`Curve`] follows a special point through two parameters ([`Family2`]), a [`WholeCurve`] to both of its ends.
//!
//! Source: pseudo-arclength: Keller (1977), in Applications of Bifurcation Theory; relative orbits: Wulff and Schebesch (2006),
//! SIAM J. Appl. Dyn. Syst. 5, 235; normal forms: Kuznetsov (2004), Elements of Applied Bifurcation Theory.

mod allowance;
mod beginning;
mod between;
mod brackets;
mod branch;
mod branch_point;
mod certificate;
mod classes;
mod coefficient;
mod copies;
mod correct;
mod critical;
mod crossings;
mod curve;
mod curve_steps;
mod curve_symmetry;
mod curve_tracer;
mod degenerate;
mod described;
mod dip;
mod elimination;
mod ends;
mod equilibria;
mod families;
mod family;
mod homoclinic;
mod hopf;
mod joins;
mod kinds_of_oscillations;
mod leaving;
mod levels;
mod locate;
mod meeting;
mod normal_form;
mod normal_forms;
mod one_point;
mod onset;
mod orbits;
mod oscillating;
mod oscillation;
mod passages;
mod path;
mod periods;
mod place;
mod point;
mod problem;
mod rays;
mod reduced_maps;
mod reduction;
mod section;
mod settings;
mod shooting;
mod smooth;
mod special;
mod steps;
mod switch;
mod tangents;
mod told;
mod touch;
mod tracer;
mod twice;
mod vanishing;
mod variation;
mod vicinity;
mod whole_curve;
mod zero;

pub use allowance::Allowance;
pub use branch::Branch;
pub use certificate::{Certificate, TestFunction};
pub use copies::same_motion;
pub use curve::{Curve, CurvePoint};
pub use degenerate::Degenerate;
pub use family::{Family, Family2};
pub use homoclinic::{Connection, ConnectionKind, PeriodLaw};
pub use joins::{Joins, Passed};
pub use normal_form::{Coefficient, NormalForm, Undetermined};
pub use path::{OrbitPath, path};
pub use point::{End, Motion, Point, nine};
pub use settings::Settings;
pub use special::{Broken, Hopf, Special};
pub use switch::switch;
pub use told::stated;
pub use whole_curve::WholeCurve;
