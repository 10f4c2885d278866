//! The steppers: one file each, and the registries that include them in every test.

mod dop853;
mod dopri5;
mod etdrk4;
mod euler;
pub mod exponential;
mod heun;
mod hochbruck4;
mod ifrk4;
mod krogstad4;
mod method;
pub mod phi_functions;
mod rk4;
pub mod runge_kutta;
pub mod tableau;
pub mod unrolled;

pub use dop853::DOP853;
pub use dopri5::DOPRI5;
pub use etdrk4::ETDRK4;
pub use euler::EULER;
pub use exponential::ExponentialTableau;
pub use heun::HEUN;
pub use hochbruck4::HOCHBRUCK4;
pub use ifrk4::IFRK4;
pub use krogstad4::KROGSTAD4;
pub use method::Method;
pub use rk4::RK4;
pub use tableau::Tableau;

/// Every explicit stepper, from the simplest to the one to use by default.
pub static STEPPERS: [&Tableau; 5] = [&EULER, &HEUN, &RK4, &DOPRI5, &DOP853];

/// Every exponential stepper (for fields with a stiff linear part), the one to use by default last.
pub static EXPONENTIAL_STEPPERS: [&ExponentialTableau; 4] = [&IFRK4, &ETDRK4, &HOCHBRUCK4, &KROGSTAD4];

/// The explicit stepper of this name, if there is one.
pub fn find(name: &str) -> Option<&'static Tableau> {
    STEPPERS.into_iter().find(|stepper| stepper.name == name)
}

/// The exponential stepper of this name, if there is one.
pub fn find_exponential(name: &str) -> Option<&'static ExponentialTableau> {
    EXPONENTIAL_STEPPERS.into_iter().find(|stepper| stepper.name == name)
}
