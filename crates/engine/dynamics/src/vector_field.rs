//! Vector fields: `u' = f(t, u)`.

use crate::{Obstacle, Scalar};

/// Anything with a state of fixed length.
pub trait System {
    /// Number of scalars in the state.
    fn dim(&self) -> usize;

    /// The reason why this state has no rates, if it has none. A rate that is not a number must have its reason here;
    /// asked only after one was met, so it may be slow.
    fn obstacle(&self, _u: &[f64]) -> Option<Obstacle> {
        None
    }

    /// Number of leading entries of the state that control the steps of exponential methods: all of them,
    /// unless the others are slaved to them.
    fn controlling(&self) -> usize {
        self.dim()
    }

    /// Length of the vectors that the state is made of, where it is a shape followed by vectors tangent to it. Error control
    /// measures an error in the shape against its own entry, one in another vector against that vector's largest entry.
    fn vectors(&self) -> Option<usize> {
        None
    }

    /// The entries i of the state, as bits `1 << i`, whose plane `u_i = 0` no orbit crosses because `u_i` is a factor of their rate.
    /// Error control measures them against their own size alone, however small they become, and rejects a step that changes their sign.
    fn kept(&self) -> u64 {
        0
    }

    /// Corrects the state at the end of an accepted step: writes the corrected one into `projected` and says `true`,
    /// or says `false` and leaves it alone, which is the default. [`crate::Orbit`] and [`crate::ExponentialOrbit`] go
    /// on from the corrected state. Errors are controlled on the flow alone, which knows nothing of the correction:
    /// a result may depend on the step size, to first order.
    ///
    /// # Shapes
    /// `u` and `projected` have length [`System::dim`].
    ///
    /// # Errors
    /// The [`Obstacle`], if the state has no correction: the step fails.
    fn project(&self, _u: &[f64], _projected: &mut [f64]) -> Result<bool, Obstacle> {
        Ok(false)
    }
}

/// An ordinary differential equation `u' = f(t, u)` over one scalar type.
///
/// The trait has one method; write it once for all scalars:
///
/// ```
/// use motiform_dynamics::{Scalar, System, VectorField};
///
/// /// u'' = -u
/// struct Oscillator;
/// impl System for Oscillator {
///     fn dim(&self) -> usize { 2 }
/// }
/// impl<T: Scalar> VectorField<T> for Oscillator {
///     fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
///         du[0] = u[1];
///         du[1] = -u[0];
///     }
/// }
/// let mut du = [0.0; 2];
/// Oscillator.eval(0.0, &[1.0, 2.0], &mut du);
/// assert_eq!(du, [2.0, -1.0]);
/// ```
pub trait VectorField<T: Scalar>: System {
    /// Writes `f(t, u)` into `du`; must not read `du`, allocate or keep state.
    ///
    /// # Shapes
    /// `u` and `du` have length [`System::dim`].
    fn eval(&self, t: T::Real, u: &[T], du: &mut [T]);
}

/// A field split as `u' = Lambda u + N(t, u)` with a diagonal, real `Lambda`: what exponential steppers need.
///
/// `eval` must equal `Lambda u + N(t, u)`; [`crate::conformance::semilinear_defect`] checks it. By default
/// `Lambda` is 0, and the whole field is `N`.
pub trait Semilinear<T: Scalar>: VectorField<T> {
    /// Writes the diagonal of `Lambda` (inverse model time).
    fn linear(&self, lambda: &mut [T::Real]) {
        lambda.iter_mut().for_each(|rate| *rate = rate.zero());
    }

    /// Writes `N(t, u)` into `du`.
    fn nonlinear(&self, t: T::Real, u: &[T], du: &mut [T]) {
        self.eval(t, u, du);
    }
}

impl<S: System + ?Sized> System for &S {
    fn dim(&self) -> usize {
        (**self).dim()
    }

    fn obstacle(&self, u: &[f64]) -> Option<Obstacle> {
        (**self).obstacle(u)
    }

    fn controlling(&self) -> usize {
        (**self).controlling()
    }

    #[inline(always)]
    fn vectors(&self) -> Option<usize> {
        (**self).vectors()
    }

    #[inline(always)]
    fn kept(&self) -> u64 {
        (**self).kept()
    }

    fn project(&self, u: &[f64], projected: &mut [f64]) -> Result<bool, Obstacle> {
        (**self).project(u, projected)
    }
}

impl<T: Scalar, F: VectorField<T> + ?Sized> VectorField<T> for &F {
    #[inline(always)]
    fn eval(&self, t: T::Real, u: &[T], du: &mut [T]) {
        (**self).eval(t, u, du);
    }
}

impl<T: Scalar, F: Semilinear<T> + ?Sized> Semilinear<T> for &F {
    fn linear(&self, lambda: &mut [T::Real]) {
        (**self).linear(lambda);
    }

    #[inline(always)]
    fn nonlinear(&self, t: T::Real, u: &[T], du: &mut [T]) {
        (**self).nonlinear(t, u, du);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A system that answers nothing as the defaults do.
    struct Odd;

    impl System for Odd {
        fn dim(&self) -> usize {
            6
        }

        fn obstacle(&self, _u: &[f64]) -> Option<Obstacle> {
            Some(Obstacle::Closure { residual: 0.5 })
        }

        fn controlling(&self) -> usize {
            4
        }

        fn vectors(&self) -> Option<usize> {
            Some(3)
        }

        fn kept(&self) -> u64 {
            5
        }

        fn project(&self, _u: &[f64], projected: &mut [f64]) -> Result<bool, Obstacle> {
            projected.fill(7.0);
            Ok(true)
        }
    }

    #[test]
    fn a_reference_answers_as_the_system_does() {
        fn answers<S: System>(system: S) -> String {
            let mut projected = [0.0; 6];
            let changed = system.project(&[0.0; 6], &mut projected);
            let sizes = (system.dim(), system.controlling());
            let layout = (system.vectors(), system.kept());
            format!("{sizes:?} {:?} {layout:?} {changed:?} {}", system.obstacle(&[0.0; 6]), projected[0])
        }
        assert_eq!(answers(&Odd), answers(Odd));
        assert_eq!(answers(&Odd), "(6, 4) Some(Closure { residual: 0.5 }) (Some(3), 5) Ok(true) 7");
    }
}
