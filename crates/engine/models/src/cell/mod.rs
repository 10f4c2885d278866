//! The active cell model: a closed boundary that deforms spontaneously, and moves as a result of its deformation.
//!
//! Source: paper, the equations for phi_t and v in 'Deformed domain'; Matsuo et al., its reference for the model.

mod circle;
mod closure;
mod convolution;
pub mod field;
mod kkt;
mod names;
pub mod outline;
mod parameters;
pub mod reduction;
mod velocity;

pub use closure::MAX_CLOSURE_MODES;
pub use field::{CellField, MAX_MODES};
pub use outline::Boundary;
pub use parameters::CellParameters;

use crate::Error;
use crate::parameters::Parameters as _;
use circle::Circle;
use closure::Closure;
use motiform_dynamics::model::{Coordinate, Observable};
use motiform_dynamics::simd;
use motiform_dynamics::{
    Dual, Equivariant, Lanes, Model, Obstacle, Outline, Scalar, Semilinear, Shape, Symmetry, System,
    VectorField,
};
use names::{MEASURES, OBSERVABLES};
use velocity::Push;

/// The active cell model for one set of parameters.
///
/// State: `(Re phi_1, Im phi_1, Re phi_2, ..)`, see [`field`]. A body is moved by
/// [`motiform_dynamics::ExponentialOrbit::in_plane`]: the equation is far too stiff for explicit steps.
///
/// ```
/// use motiform_dynamics::{ExponentialOrbit, Integration, Model, Request, StepControl, drive::drive};
/// use motiform_dynamics::steppers::KROGSTAD4;
/// use motiform_models::cell::{Cell, CellParameters};
///
/// // length = 7: mode 1 alone is unstable, and the cell swims straight.
/// let cell = Cell::new(&CellParameters { length: 7.0, modes: 12.0, ..Default::default() })?;
/// let mut start = vec![0.0; 24 + 2]; // the modes, then x and y
/// start[0] = 0.01;
/// let control = StepControl::Adaptive { rtol: 1e-8, atol: 1e-10 };
/// let mut orbit = ExponentialOrbit::in_plane(&cell, &KROGSTAD4, control, 0.0, &start)?;
/// drive(&mut orbit, &Request { watched: 24, ..Request::until(400.0, 26) }, &mut ())?;
/// assert!((2.0 * orbit.state()[0] - 2.944).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    parameters: CellParameters,
    field: CellField<f64>,
    mean: f64,
    closure: Closure,
    circle: Circle,
    feedback: bool,
}

impl Cell {
    /// The model with these parameters.
    ///
    /// # Errors
    /// [`Error::OutOfRange`], [`Error::NotWhole`], [`Error::TooFewModes`] with the number that this length needs, and
    /// [`Error::NoRoomForFeedback`].
    pub fn new(parameters: &CellParameters) -> Result<Self, Error> {
        let p = *parameters;
        let mut checked = p;
        for (spec, value) in CellParameters::specs().iter().zip(p.values()) {
            checked.set(spec.name, value)?;
        }
        let modes = whole("modes", p.modes)?;
        if modes < p.fewest_modes() {
            return Err(Error::TooFewModes { modes, length: p.length, needed: p.fewest_modes() });
        }
        let closure = Closure::new(whole("closure_modes", p.closure_modes)?, p.prior);
        let feedback = whole("feedback", p.feedback)? == 1;
        if feedback && closure.modes() > modes {
            return Err(Error::NoRoomForFeedback { modes, closure_modes: closure.modes() });
        }
        let circle = Circle::new(modes, modes.max(2 * closure.modes()));
        Ok(Self { parameters: p, field: CellField::new(&p, modes), mean: 0.0, closure, circle, feedback })
    }

    /// The same body with the mean of phi at `mean`: a normal-angle offset, which turns it by `2 pi mean / L` while the
    /// points keep their labels s. The mean is constant in time, so it is not an unknown of the state (it would add a
    /// neutral direction without meaning); [`Equivariant::rotate`] turns by a shift of s instead. [`Equivariant::mirror`] is then
    /// the mirror at the axis turned with the body.
    #[must_use]
    pub fn with_mean(mut self, mean: f64) -> Self {
        self.mean = mean;
        self
    }

    /// Its parameters.
    pub fn parameters(&self) -> &CellParameters {
        &self.parameters
    }

    /// Number of modes.
    pub fn modes(&self) -> usize {
        self.field.modes()
    }

    /// The shape field, for kernels over other scalars.
    pub fn field(&self) -> &CellField<f64> {
        &self.field
    }

    /// `phi(s)` at `points` equally spaced points, the mean included.
    pub fn phi(&self, shape: &[f64], points: usize) -> Vec<f64> {
        let at = |j: usize| {
            let wave = |(i, mode): (usize, &[f64])| {
                let angle = std::f64::consts::TAU * (((i + 1) * j) % points) as f64 / points as f64;
                let (sin, cos) = libm::sincos(angle);
                2.0 * (mode[0] * cos - mode[1] * sin)
            };
            self.mean + shape.chunks_exact(2).enumerate().map(wave).sum::<f64>()
        };
        (0..points).map(at).collect()
    }
}

/// A whole number from a parameter.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "whole, and within its allowed range"
)]
fn whole(name: &'static str, value: f64) -> Result<usize, Error> {
    if value.fract() == 0.0 { Ok(value as usize) } else { Err(Error::NotWhole { name, value }) }
}

impl System for Cell {
    fn dim(&self) -> usize {
        self.field.dim()
    }

    fn obstacle(&self, shape: &[f64]) -> Option<Obstacle> {
        let finite = shape.iter().all(|x| x.is_finite());
        let residual = self.close(shape).err().filter(|_| finite)?;
        Some(Obstacle::Closure { residual })
    }

    /// With `feedback = 1`, phi becomes `phi + eps`.
    fn project(&self, shape: &[f64], projected: &mut [f64]) -> Result<bool, Obstacle> {
        if self.feedback {
            self.feed_back(shape, projected).map_err(|residual| Obstacle::Closure { residual })?;
        }
        Ok(self.feedback)
    }
}

impl<T: Scalar<Real = f64>> VectorField<T> for Cell {
    #[inline]
    fn eval(&self, t: f64, u: &[T], du: &mut [T]) {
        self.field.eval(t, u, du);
    }
}

impl<T: Scalar<Real = f64>> Semilinear<T> for Cell {
    fn linear(&self, lambda: &mut [f64]) {
        Semilinear::<T>::linear(&self.field, lambda);
    }

    #[inline]
    fn nonlinear(&self, t: f64, u: &[T], du: &mut [T]) {
        self.field.nonlinear(t, u, du);
    }
}

impl<T: Scalar<Real = f64>> Shape<T> for Cell {
    fn velocity(&self, shape: &[T]) -> [T; 2] {
        simd::run(Push { cell: self, shape })
    }
}

impl Equivariant for Cell {
    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }

    /// A shift of s, `phi_n -> exp(-i n angle) phi_n`: the normal that was at s is now at `s + L angle / 2 pi`.
    fn rotate(&self, angle: f64, shape: &mut [f64]) {
        for (mode, n) in shape.chunks_exact_mut(2).zip(1_u32..) {
            let (sin, cos) = libm::sincos(f64::from(n) * angle);
            (mode[0], mode[1]) = (cos * mode[0] + sin * mode[1], cos * mode[1] - sin * mode[0]);
        }
    }

    /// `phi(s) -> -phi(-s)`: `phi_n -> -conj(phi_n)`.
    fn mirror(&self, shape: &mut [f64]) {
        for mode in shape.chunks_exact_mut(2) {
            mode[0] = -mode[0];
        }
    }

    /// `-i n phi_n`.
    fn spin(&self, shape: &[f64], out: &mut [f64]) {
        for ((mode, rate), n) in shape.chunks_exact(2).zip(out.chunks_exact_mut(2)).zip(1_u32..) {
            (rate[0], rate[1]) = (f64::from(n) * mode[1], -f64::from(n) * mode[0]);
        }
    }

    /// `(1e-13 + atol / |phi|) (2 pi)^2 / L^2` times the mean of `|alpha2| phi_s^2 + |alpha3| phi_ss^2`: what the
    /// integral of (VEL) leaves where it vanishes by cancellation, for modes known to `atol`.
    fn speed_resolution(&self, shape: &[f64], atol: f64) -> f64 {
        let (p, k1) = (&self.parameters, self.parameters.wavenumber());
        let power = |(mode, n): (&[f64], u32)| {
            let k2 = (k1 * f64::from(n)) * (k1 * f64::from(n));
            2.0 * (mode[0] * mode[0] + mode[1] * mode[1])
                * (p.alpha2.abs() * k2 + p.alpha3_total().abs() * k2 * k2)
        };
        let size = 2.0 * shape.iter().map(|x| x * x).sum::<f64>().sqrt();
        let relative = if size > 0.0 { 1e-13 + atol / size } else { 0.0 };
        relative * k1 * k1 * shape.chunks_exact(2).zip(1..).map(power).sum::<f64>()
    }
}

impl Model for Cell {
    fn coordinates(&self) -> &[Coordinate] {
        names::coordinates(self.modes())
    }

    /// `phi_n = (c_n - i s_n) / 2`.
    fn encode(&self, c: &[f64], shape: &mut [f64]) {
        for (mode, c) in shape.chunks_exact_mut(2).zip(c.chunks_exact(2)) {
            (mode[0], mode[1]) = (0.5 * c[0], -0.5 * c[1]);
        }
    }

    fn decode(&self, shape: &[f64], c: &mut [f64]) {
        for (mode, c) in shape.chunks_exact(2).zip(c.chunks_exact_mut(2)) {
            (c[0], c[1]) = (2.0 * mode[0], -2.0 * mode[1]);
        }
    }

    fn observables(&self) -> &[Observable] {
        &OBSERVABLES[..OBSERVABLES.len().min(self.modes())]
    }

    fn observe(&self, shape: &[f64], out: &mut [f64]) {
        for (x, mode) in out.iter_mut().zip(shape.chunks_exact(2)) {
            *x = 2.0 * libm::hypot(mode[0], mode[1]);
        }
    }

    fn measures(&self) -> &[Observable] {
        &MEASURES
    }

    fn measure(&self, shape: &[f64], out: &mut [f64]) {
        match self.boundary(shape, 4 * self.modes()) {
            Ok(boundary) => {
                let crosses = f64::from(u8::from(boundary.crossing.is_some()));
                out.copy_from_slice(&[boundary.length, boundary.area, boundary.closure_residual, crosses]);
            }
            Err(residual) => out.copy_from_slice(&[f64::NAN, f64::NAN, residual, f64::NAN]),
        }
    }

    fn profile(&self, shape: &[f64], points: usize) -> Option<Vec<f64>> {
        Some(self.phi(shape, points))
    }

    fn radius(&self) -> Option<f64> {
        Some(1.0 / self.parameters.wavenumber())
    }

    /// The boundary has its own size (its length is a parameter): `radius` is not used.
    fn outline(&self, shape: &[f64], _radius: f64, points: usize) -> Outline {
        match self.boundary(shape, points) {
            Ok(boundary) => Outline::Curve(boundary.points),
            Err(residual) => Outline::NotClosed { residual },
        }
    }

    /// Largest `| |X| - L / 2 pi |` over the boundary; NaN if it cannot be closed.
    fn deformation(&self, shape: &[f64]) -> f64 {
        let radius = 1.0 / self.parameters.wavenumber();
        let Ok(boundary) = self.boundary(shape, 128) else { return f64::NAN };
        boundary.points.iter().map(|p| (libm::hypot(p[0], p[1]) - radius).abs()).fold(0.0, f64::max)
    }
}

/// The field works over lanes and duals; this line fails to compile if it does not.
const _: fn() = || {
    fn takes<T: Scalar, F: Semilinear<T>>() {}
    takes::<Dual<f64, 6>, Cell>();
    takes::<Lanes<8>, CellField<Lanes<8>>>();
    takes::<Dual<Lanes<8>, 6>, CellField<Lanes<8>>>();
};
