//! The steppers: one file each, and the registry that enrols them in every test.

mod dop853;
mod dopri5;
mod euler;
mod heun;
mod rk4;
pub mod runge_kutta;
pub mod tableau;

pub use dop853::DOP853;
pub use dopri5::DOPRI5;
pub use euler::EULER;
pub use heun::HEUN;
pub use rk4::RK4;
pub use tableau::Tableau;

/// Every stepper, from the simplest to the one to use by default.
pub static STEPPERS: [&Tableau; 5] = [&EULER, &HEUN, &RK4, &DOPRI5, &DOP853];

/// The stepper of this name, if there is one.
#[must_use]
pub fn find(name: &str) -> Option<&'static Tableau> {
    STEPPERS.into_iter().find(|stepper| stepper.name == name)
}
