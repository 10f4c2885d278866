//! Shape and drift: what every deformable body has in common.

use crate::noise::ModelNoise;
use crate::{Dual, Equivariant, Obstacle, Scalar, Semilinear, System, VectorField};

/// An autonomous shape state, and the velocity determined by it: `x' = v(shape)`.
///
/// Written once over the scalar, like the field.
pub trait Shape<T: Scalar>: VectorField<T> {
    /// Velocity `(vx, vy)` of the centre of mass for this shape state (model length per model time).
    fn velocity(&self, shape: &[T]) -> [T; 2];
}

/// A named coordinate of a state, e.g. `s11`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// Name on the command line and in files, ASCII.
    pub name: &'static str,
    /// Its meaning in one clause.
    pub meaning: &'static str,
}

/// A scalar computed from the shape for display, e.g. `|S|`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Observable {
    /// Column name in files, ASCII.
    pub name: &'static str,
    /// Notation in figures (`*` around italic letters).
    pub symbol: &'static str,
    /// Its meaning, with its formula.
    pub meaning: &'static str,
    /// Its unit is this power of a length.
    pub length: i8,
}

/// The drawn boundary of a body, centred on the origin.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// Points of a closed curve, anticlockwise, first point not repeated.
    Curve(Vec<[f64; 2]>),
    /// The shape is not a curve: the radius would be `radius <= 0` in the direction `angle` (rad).
    NotACurve {
        /// Smallest value of `R(theta)`.
        radius: f64,
        /// Direction where it occurs (rad).
        angle: f64,
    },
    /// The boundary could not be closed.
    NotClosed {
        /// The residual of the closing condition, relative to the length of the boundary.
        residual: f64,
    },
}

/// A deformable self-propelled body: its dynamics, its named coordinates and its outline.
///
/// All analyses of motiform work for any implementation. The trait is object-safe, so studies hold
/// a `Box<dyn Model>`; kernels use the concrete type. [`Semilinear`] gives the stiff part of the flow, for the
/// exponential steppers (a model without one returns `Lambda = 0`).
pub trait Model: Equivariant {
    /// The model itself, if there are kernels for its type.
    fn as_any(&self) -> Option<&dyn std::any::Any> {
        None
    }

    /// The named coordinates of the shape, in file order.
    fn coordinates(&self) -> &[Coordinate];

    /// Coordinates (as in [`Model::coordinates`]) to the internal state: a linear map, by default the identity.
    fn encode(&self, coordinates: &[f64], shape: &mut [f64]) {
        shape.copy_from_slice(coordinates);
    }

    /// The inverse of [`Model::encode`].
    fn decode(&self, shape: &[f64], coordinates: &mut [f64]) {
        coordinates.copy_from_slice(shape);
    }

    /// As [`Model::encode`], in a vector of its own.
    fn encoded(&self, coordinates: &[f64]) -> Vec<f64> {
        let mut shape = vec![0.0; self.dim()];
        self.encode(coordinates, &mut shape);
        shape
    }

    /// As [`Model::decode`], in a vector of its own.
    fn decoded(&self, shape: &[f64]) -> Vec<f64> {
        let mut coordinates = vec![0.0; self.dim()];
        self.decode(shape, &mut coordinates);
        coordinates
    }

    /// The noise that belongs to the model: none, unless its equations have some. Fields and analyses are those without it.
    fn noise(&self) -> ModelNoise {
        ModelNoise::default()
    }

    /// Number of leading coordinates that are the velocity itself, if it is an unknown.
    fn velocities(&self) -> usize {
        0
    }

    /// The scalars that figures show in addition to speed and turning rate; none by default.
    fn observables(&self) -> &[Observable] {
        &[]
    }

    /// Writes the observables of a shape.
    fn observe(&self, _shape: &[f64], _out: &mut [f64]) {}

    /// Quantities of the boundary that a run reports in addition to the shape (length, area, ...); none by default.
    fn measures(&self) -> &[Observable] {
        &[]
    }

    /// Writes the measures of a shape; NaN if the boundary does not exist.
    fn measure(&self, _shape: &[f64], _out: &mut [f64]) {}

    /// A scalar on the boundary (phi of the active cell, mean included) at `points` points of equal arc length;
    /// `None` for models without one.
    fn profile(&self, _shape: &[f64], _points: usize) -> Option<Vec<f64>> {
        None
    }

    /// Radius of the undeformed body, if the model fixes it; otherwise it is chosen for drawing.
    fn radius(&self) -> Option<f64> {
        None
    }

    /// The boundary for this shape: `points` points around a body of undeformed radius `radius` (model length); by default a circle.
    fn outline(&self, _shape: &[f64], radius: f64, points: usize) -> Outline {
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / points as f64;
        Outline::Curve(
            (0..points).map(|k| [radius * libm::cos(angle(k)), radius * libm::sin(angle(k))]).collect(),
        )
    }

    /// Largest deviation of the boundary from the circle, over all directions (model length); by default none.
    fn deformation(&self, _shape: &[f64]) -> f64 {
        0.0
    }
}

/// Velocity and its time derivative along the flow, exactly (duals): `(v, v')`.
pub fn velocity_and_acceleration<M: Shape<f64> + Shape<Dual<f64, 1>> + ?Sized>(
    model: &M,
    shape: &[f64],
) -> ([f64; 2], [f64; 2]) {
    let mut rate = vec![0.0; shape.len()];
    VectorField::<f64>::eval(model, 0.0, shape, &mut rate);
    drift(model, shape, &rate)
}

/// States up to this length are lifted to duals without allocating.
const LIFTED: usize = 256;

/// Velocity and its derivative along `rate`, exactly (duals): `(v, v')`. Allocates nothing for states of up to 256
/// entries.
pub fn drift<M: Shape<Dual<f64, 1>> + ?Sized>(
    model: &M,
    shape: &[f64],
    rate: &[f64],
) -> ([f64; 2], [f64; 2]) {
    let lift = |(&value, &slope): (&f64, &f64)| Dual { value, derivative: [slope] };
    let mut small = [Dual { value: 0.0, derivative: [0.0] }; LIFTED];
    let large: Vec<Dual<f64, 1>>;
    let lifted = if shape.len() <= LIFTED {
        for (place, pair) in small.iter_mut().zip(shape.iter().zip(rate)) {
            *place = lift(pair);
        }
        &small[..shape.len()]
    } else {
        large = shape.iter().zip(rate).map(lift).collect();
        &large
    };
    let [vx, vy] = model.velocity(lifted);
    ([vx.value, vy.value], [vx.derivative[0], vy.derivative[0]])
}

/// Turning rate `(vx vy' - vy vx') / |v|^2` (rad per model time); `None` if the body is at rest.
pub fn turning_rate(velocity: [f64; 2], acceleration: [f64; 2]) -> Option<f64> {
    let speed_squared = velocity[0] * velocity[0] + velocity[1] * velocity[1];
    let rate = (velocity[0] * acceleration[1] - velocity[1] * acceleration[0]) / speed_squared;
    rate.is_finite().then_some(rate)
}

/// A body in the plane: the shape state followed by the position `x, y` of its centre of mass.
///
/// The derived system satisfies the same traits: `u = (shape, x, y)`, `u' = (f(shape), v(shape))`.
#[derive(Clone, Copy, Debug)]
pub struct InPlane<M>(pub M);

impl<M: System> System for InPlane<M> {
    fn dim(&self) -> usize {
        self.0.dim() + 2
    }

    fn obstacle(&self, u: &[f64]) -> Option<Obstacle> {
        self.0.obstacle(&u[..u.len() - 2])
    }

    #[inline(always)]
    fn kept(&self) -> u64 {
        self.0.kept()
    }

    /// As for the shape; the position is unchanged.
    fn project(&self, u: &[f64], projected: &mut [f64]) -> Result<bool, Obstacle> {
        let (shape, position) = u.split_at(u.len() - 2);
        let (projected, place) = projected.split_at_mut(shape.len());
        let changed = self.0.project(shape, projected)?;
        if changed {
            place.copy_from_slice(position);
        }
        Ok(changed)
    }
}

impl<T: Scalar, M: Shape<T>> VectorField<T> for InPlane<M> {
    #[inline(always)]
    fn eval(&self, t: T::Real, u: &[T], du: &mut [T]) {
        let (shape, _) = u.split_at(u.len() - 2);
        let (rate, drift) = du.split_at_mut(u.len() - 2);
        self.0.eval(t, shape, rate);
        [drift[0], drift[1]] = self.0.velocity(shape);
    }
}

/// The position has no linear part. An exponential stepper needs the velocity at every stage this way;
/// [`crate::ExponentialOrbit::in_plane`] needs it once per step.
impl<T: Scalar, M: Shape<T> + Semilinear<T>> Semilinear<T> for InPlane<M> {
    fn linear(&self, lambda: &mut [T::Real]) {
        let (shape, position) = lambda.split_at_mut(self.0.dim());
        self.0.linear(shape);
        for rate in position {
            *rate = rate.zero();
        }
    }

    #[inline]
    fn nonlinear(&self, t: T::Real, u: &[T], du: &mut [T]) {
        let (shape, _) = u.split_at(u.len() - 2);
        let (rate, drift) = du.split_at_mut(u.len() - 2);
        self.0.nonlinear(t, shape, rate);
        drift.copy_from_slice(&self.0.velocity(shape));
    }
}

impl<T: Scalar, M: Shape<T> + ?Sized> Shape<T> for &M {
    #[inline(always)]
    fn velocity(&self, shape: &[T]) -> [T; 2] {
        (**self).velocity(shape)
    }
}

/// The velocity over `f64`, without naming the scalar.
pub fn velocity<M: Shape<f64> + ?Sized>(model: &M, shape: &[f64]) -> [f64; 2] {
    Shape::<f64>::velocity(model, shape)
}
