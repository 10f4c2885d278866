//! No allocation inside a step: counted by the allocator itself.

#[path = "all/common/mod.rs"]
mod common;

use common::{Oscillator, StuartLandau};
use motiform_dynamics::steppers::{DOP853, EXPONENTIAL_STEPPERS, STEPPERS};
use motiform_dynamics::{ExponentialOrbit, Integration, Noise, NoisyOrbit, Normal, Orbit, StepControl};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

#[allow(unsafe_code, reason = "an allocator cannot be written without; it only counts and passes on")]
// SAFETY: every call is passed on unchanged to the system allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's contract is the system allocator's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the pointer came from the system allocator with this layout.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn a_step_under_noise_allocates_nothing() {
    let adaptive = StepControl::Adaptive { rtol: 1e-9, atol: 1e-9 };
    let orbit = Orbit::new(&Oscillator, &DOP853, adaptive, 0.0, &[1.0, 0.0]).expect("valid");
    let noise = Noise { amplitudes: vec![1e-3; 2], rates: vec![0.0, -0.1], step: 0.0625 };
    let mut noisy = NoisyOrbit::new(orbit, noise, Normal::new(1, 1)).expect("valid");
    let mut state = vec![0.0; 2];
    let before = ALLOCATIONS.with(Cell::get);
    for _ in 0..1000 {
        noisy.advance(1e9).expect("the oscillator is smooth");
        noisy.at(0.5 * (noisy.t_old() + noisy.t()), &mut state);
    }
    assert_eq!(ALLOCATIONS.with(Cell::get) - before, 0);
}

#[test]
fn a_step_allocates_nothing() {
    for tableau in STEPPERS {
        let fixed = StepControl::Fixed { step: 1e-2 };
        let adaptive = StepControl::Adaptive { rtol: 1e-9, atol: 1e-9 };
        for control in [fixed, adaptive] {
            let Ok(mut orbit) = Orbit::new(&Oscillator, tableau, control, 0.0, &[1.0, 0.0]) else { continue };
            let mut state = vec![0.0; 2];
            let before = ALLOCATIONS.with(Cell::get);
            for _ in 0..1000 {
                orbit.advance(1e9).expect("the oscillator is smooth");
                let middle = 0.5 * (orbit.t_old() + orbit.t());
                orbit.dense().at(middle, &mut state);
                orbit.step_to(middle, &mut state);
            }
            let allocations = ALLOCATIONS.with(Cell::get) - before;
            assert_eq!(allocations, 0, "{} {control:?}", tableau.name);
        }
    }
    // The counter does count.
    let before = ALLOCATIONS.with(Cell::get);
    drop(std::hint::black_box(vec![0_u8; 100]));
    assert!(ALLOCATIONS.with(Cell::get) > before);
}

/// An exponential step allocates only when it meets a new step size.
#[test]
fn an_exponential_step_of_a_known_size_allocates_nothing() {
    for tableau in EXPONENTIAL_STEPPERS {
        let fixed = StepControl::Fixed { step: 1e-2 };
        let adaptive = StepControl::Adaptive { rtol: 1e-9, atol: 1e-9 };
        for control in [fixed, adaptive] {
            let Ok(mut orbit) = ExponentialOrbit::new(&StuartLandau, tableau, control, 0.0, &[0.5, 0.0])
            else {
                continue;
            };
            let mut state = vec![0.0; 2];
            let mut steps = |orbit: &mut ExponentialOrbit<'_, StuartLandau>| {
                let before = ALLOCATIONS.with(Cell::get);
                for _ in 0..1000 {
                    orbit.advance(1e9).expect("the field is smooth");
                    let middle = 0.5 * (orbit.t_old() + orbit.t());
                    orbit.dense().at(middle, &mut state);
                    orbit.step_to(middle, &mut state);
                }
                ALLOCATIONS.with(Cell::get) - before
            };
            assert!(steps(&mut orbit) < 50, "{} {control:?}: one table per size", tableau.name);
            assert_eq!(steps(&mut orbit), 0, "{} {control:?}", tableau.name);
        }
    }
}
