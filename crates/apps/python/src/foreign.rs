//! Functions of C by their address: the only file of this crate with `unsafe`.
//!
//! A compiled function cannot be called otherwise. Rust cannot check that an address is that of a function with this signature, that the
//! function stays within the lengths it was told, or that several threads may call it: the caller in Python promises it
//! (`motiform.Field` says so), as with every function that `ctypes` or `scipy.LowLevelCallable` calls. What can be checked is: an address
//! is not 0, and slices have the
//! lengths that were promised to the function. Tests: tests/test_fields.py.

#![allow(unsafe_code, reason = "a call of a compiled function; see above")]

use motiform_lab::given::Given;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::num::NonZero;

/// `void f(double t, const double *x, const double *p, double *out)`.
type Function = unsafe extern "C" fn(f64, *const f64, *const f64, *mut f64);

/// The address of such a function.
#[derive(Clone, Copy)]
struct Address(NonZero<usize>);

impl Address {
    fn new(address: usize, what: &str) -> PyResult<Self> {
        let wrong = || {
            PyValueError::new_err(format!(
                "{what} has the address 0: give a function that is compiled and loaded"
            ))
        };
        NonZero::new(address).map(Self).ok_or_else(wrong)
    }

    /// Calls the function.
    fn call(self, t: f64, x: &[f64], parameters: &[f64], out: &mut [f64]) {
        // SAFETY: function pointers and addresses have one size on all targets of this package, and the address is not 0, so this is a
        // value of the
        // type. That there is a function with this signature is the promise of the caller.
        let function = unsafe { std::mem::transmute::<usize, Function>(self.0.get()) };
        // SAFETY: the pointers are those of slices that live during the call; `out` is not shared. The promised lengths are those of
        // the slices (`Foreign::new` and the callers in `given` keep them).
        unsafe { function(t, x.as_ptr(), parameters.as_ptr(), out.as_mut_ptr()) }
    }
}

/// A compiled function of `dim` coordinates and `parameters` parameters, with its Jacobian if there is one.
pub(crate) struct Foreign {
    dim: usize,
    parameters: usize,
    rates: Address,
    jacobian: Option<Address>,
}

impl Foreign {
    pub(crate) fn new(sizes: (usize, usize), rates: usize, jacobian: Option<usize>) -> PyResult<Self> {
        let rates = Address::new(rates, "function")?;
        let jacobian = jacobian.map(|address| Address::new(address, "jacobian")).transpose()?;
        Ok(Self { dim: sizes.0, parameters: sizes.1, rates, jacobian })
    }

    /// Calls with slices of the promised lengths only.
    fn call(&self, function: Address, t: f64, x: &[f64], parameters: &[f64], out: (&mut [f64], usize)) {
        assert!(
            x.len() == self.dim && parameters.len() == self.parameters && out.0.len() == out.1,
            "lengths"
        );
        out.0.fill(f64::NAN); // what the function does not write is not a number
        function.call(t, x, parameters, out.0);
    }
}

impl Given for Foreign {
    fn dim(&self) -> usize {
        self.dim
    }

    fn rates(&self, t: f64, x: &[f64], parameters: &[f64], dx: &mut [f64]) {
        self.call(self.rates, t, x, parameters, (dx, self.dim));
    }

    fn jacobian(&self, t: f64, x: &[f64], parameters: &[f64], matrix: &mut [f64]) -> bool {
        let Some(jacobian) = self.jacobian else { return false };
        self.call(jacobian, t, x, parameters, (matrix, self.dim * self.dim));
        true
    }
}
