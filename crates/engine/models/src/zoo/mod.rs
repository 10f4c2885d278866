//! Systems with known answers: what the methods of `motiform-analysis` are tried on before a model is.
//!
//! Each is a plain field without linear part (`Lambda = 0`, `N = f`), written once over any scalar. What is known of it
//! is in its doc comment, with sources; the numbers that tests use are in `reference/zoo.toml`.

mod heteroclinic;
mod hopf;
mod limit_cycle;
mod linear;
mod lorenz;
mod rossler;
mod torus;

pub use heteroclinic::Heteroclinic;
pub use hopf::Hopf;
pub use limit_cycle::VanDerPol;
pub use linear::Linear;
pub use lorenz::Lorenz;
pub use rossler::Rossler;
pub use torus::Torus;

/// Makes a field of fixed dimension a body without linear part, symmetry and drift: `System`, `Semilinear` with `Lambda = 0`, a `Shape`
/// that never moves, `Equivariant` under nothing. `plain!(Field, dim)` where `Field: VectorField<T>` for every scalar `T`; the caller
/// depends on `motiform-dynamics`.
#[macro_export]
macro_rules! plain {
    ($field:ty, $dim:expr $(, const $n:ident)?) => {
        impl$(<const $n: usize>)? motiform_dynamics::System for $field {
            fn dim(&self) -> usize {
                $dim
            }
        }

        impl<T: motiform_dynamics::Scalar $(, const $n: usize)?> motiform_dynamics::Semilinear<T> for $field {
            fn linear(&self, lambda: &mut [T::Real]) {
                for rate in lambda {
                    *rate = motiform_dynamics::Scalar::zero(*rate);
                }
            }

            fn nonlinear(&self, t: T::Real, u: &[T], du: &mut [T]) {
                motiform_dynamics::VectorField::<T>::eval(self, t, u, du);
            }
        }

        impl<T: motiform_dynamics::Scalar $(, const $n: usize)?> motiform_dynamics::Shape<T> for $field {
            fn velocity(&self, shape: &[T]) -> [T; 2] {
                [motiform_dynamics::Scalar::zero(shape[0]); 2]
            }
        }

        impl$(<const $n: usize>)? motiform_dynamics::Equivariant for $field {}
    };
}
