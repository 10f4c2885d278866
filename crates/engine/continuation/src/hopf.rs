//! The kind of a Hopf bifurcation: its first Lyapunov coefficient, for relative equilibria too.

use super::normal_form::{Coefficient, NormalForm, Undetermined};
use super::reduction::extrapolated;
use motiform_analysis::equilibrium::neutral_direction;
use motiform_analysis::linear::{add, complement, dot, eigenvalues};
use motiform_dynamics::{Dual, Equivariant, VectorField};
use nalgebra::{Complex, DMatrix, DVector};

type Number = Dual<f64, 1>;
/// A complex vector.
pub(super) type Vector = DVector<Complex<f64>>;

/// Shapes below this part of the unit of the equations are 0.
const ROUND_OFF: f64 = 1e-9;

/// A coefficient below this one, for shapes in the unit of the equations, may be 0: one that vanishes with the parameter has the sign of
/// the error of the place.
const VANISHES: f64 = 1e-10;

/// The reduced field on the slice normal to the group orbit through a shape `u`:
/// `g(w) = Q' (f - xi G)(u + Q w)`, `xi = Gu . f(u + Q w) / Gu . G(u + Q w)`, with `Q` a basis of the slice.
///
/// In it a relative equilibrium is an equilibrium, without the neutral direction.
struct Slice<'b> {
    body: &'b dyn Equivariant,
    shape: &'b [f64],
    neutral: Vec<Vec<f64>>,
    basis: Vec<Vec<f64>>,
}

impl Slice<'_> {
    /// `Dg(w) y`, exactly.
    fn derivative(&self, w: &[f64], y: &[f64]) -> Vec<f64> {
        let dim = self.shape.len();
        let mut shape = self.shape.to_vec();
        let mut direction = vec![0.0; dim];
        for ((basis, a), b) in self.basis.iter().zip(w).zip(y) {
            add(&mut shape, *a, basis);
            add(&mut direction, *b, basis);
        }
        let lifted: Vec<Number> =
            shape.iter().zip(&direction).map(|(&value, &d)| Dual { value, derivative: [d] }).collect();
        let mut rates = lifted.clone();
        VectorField::<Number>::eval(self.body, 0.0, &lifted, &mut rates);
        let rate: Vec<f64> = rates.iter().map(|r| r.value).collect();
        let mut out: Vec<f64> = rates.iter().map(|r| r.derivative[0]).collect();
        if let Some(neutral) = self.neutral.first() {
            let (spin, turned) = (self.body.spun(&shape), self.body.spun(&direction));
            let along = dot(neutral, &spin);
            let xi = dot(neutral, &rate) / along;
            let slope = (dot(neutral, &out) - xi * dot(neutral, &turned)) / along;
            add(&mut out, -xi, &turned);
            add(&mut out, -slope, &spin);
        }
        self.basis.iter().map(|row| dot(row, &out)).collect()
    }

    /// `Dg(h y) x` at `h = -2, -1, 1, 2` steps, and at 0.
    fn stencil(&self, x: &[f64], y: &[f64], h: f64) -> [Vec<f64>; 5] {
        [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| {
            let at: Vec<f64> = y.iter().map(|value| k * h * value).collect();
            self.derivative(&at, x)
        })
    }

    /// `D^2 g (x, y)`, by differences of fourth order.
    fn second(&self, x: &[f64], y: &[f64], h: f64) -> Vec<f64> {
        let [a, b, _, d, e] = self.stencil(x, y, h);
        (0..x.len()).map(|i| (a[i] - e[i] + 8.0 * (d[i] - b[i])) / (12.0 * h)).collect()
    }

    /// `D^3 g (x, y, y)`, by differences of fourth order.
    fn third(&self, x: &[f64], y: &[f64], h: f64) -> Vec<f64> {
        let [a, b, c, d, e] = self.stencil(x, y, h);
        let at = |i: usize| (16.0 * (b[i] + d[i]) - a[i] - e[i] - 30.0 * c[i]) / (12.0 * h * h);
        (0..x.len()).map(at).collect()
    }

    /// `D^2 g (x, y)` for complex vectors.
    fn bilinear(&self, x: &Vector, y: &Vector, h: f64) -> Vector {
        let part = |v: &Vector, f: fn(&Complex<f64>) -> f64| v.iter().map(f).collect::<Vec<f64>>();
        let ([xr, xi], [yr, yi]) =
            ([part(x, |z| z.re), part(x, |z| z.im)], [part(y, |z| z.re), part(y, |z| z.im)]);
        let (rr, ii) = (self.second(&xr, &yr, h), self.second(&xi, &yi, h));
        let (ri, ir) = (self.second(&xr, &yi, h), self.second(&xi, &yr, h));
        DVector::from_fn(x.len(), |i, _| Complex::new(rr[i] - ii[i], ri[i] + ir[i]))
    }

    /// `D^3 g (q, q, conj q)`.
    fn trilinear(&self, q: &Vector, h: f64) -> Vector {
        let a: Vec<f64> = q.iter().map(|z| z.re).collect();
        let b: Vec<f64> = q.iter().map(|z| z.im).collect();
        let (aaa, abb) = (self.third(&a, &a, h), self.third(&a, &b, h));
        let (baa, bbb) = (self.third(&b, &a, h), self.third(&b, &b, h));
        DVector::from_fn(q.len(), |i, _| Complex::new(aaa[i] + abb[i], baa[i] + bbb[i]))
    }
}

/// The critical vectors `q` of a Hopf bifurcation in the full space, an orthonormal basis: several where the shape's symmetry makes the
/// eigenvalue a multiple one. Orbits begin as `u + epsilon Re(q e^(i frequency t))`, seen from the frame that turns with the shape.
pub(super) fn critical_space(body: &dyn Equivariant, shape: &[f64], frequency: f64) -> Option<Vec<Vector>> {
    let slice = slice(body, shape);
    let a = matrix(&slice);
    let space = null_space(&a, Complex::new(0.0, frequency), copies(&eigenvalues_of(&a), frequency).max(1))?;
    let lifted = |q: nalgebra::DVectorView<'_, Complex<f64>>| {
        let (mut re, mut im) = (vec![0.0; shape.len()], vec![0.0; shape.len()]);
        for (direction, z) in slice.basis.iter().zip(q.iter()) {
            add(&mut re, z.re, direction);
            add(&mut im, z.im, direction);
        }
        DVector::from_iterator(shape.len(), re.into_iter().zip(im).map(|(re, im)| Complex::new(re, im)))
    };
    Some(space.column_iter().map(lifted).collect())
}

fn slice<'b>(body: &'b dyn Equivariant, shape: &'b [f64]) -> Slice<'b> {
    let neutral = neutral_direction(body, shape);
    let basis = complement(&neutral, shape.len());
    Slice { body, shape, neutral, basis }
}

/// `Dg(0)`.
fn matrix(slice: &Slice<'_>) -> DMatrix<Complex<f64>> {
    let dim = slice.basis.len();
    let origin = vec![0.0; dim];
    let mut out = DMatrix::zeros(dim, dim);
    for j in 0..dim {
        let mut unit = origin.clone();
        unit[j] = 1.0;
        for (i, value) in slice.derivative(&origin, &unit).into_iter().enumerate() {
            out[(i, j)] = Complex::new(value, 0.0);
        }
    }
    out
}

/// Steps of the differences: the first one in units of the shape's size, and how often it is doubled.
const STEPS: (f64, i32) = (2e-3, 5);

/// The same for a body at rest, in units of the equations: over a wide range.
const STEPS_AT_REST: (f64, i32) = (1e-4, 12);

/// Eigenvalues that differ by less than this part are the same.
const SAME: f64 = 1e-7;

/// The first Lyapunov coefficient of the reduced motion at a Hopf bifurcation, for a critical vector of length 1:
/// `l1 = Re( <p, C(q,q,q*)> - 2 <p, B(q, A^-1 B(q,q*))> + <p, B(q*, (2 i omega - A)^-1 B(q,q))> ) / (2 omega)`.
///
/// Its error is the difference of two results from steps of different size, and of those for two shapes that differ by `solved`, the error
/// of the solution: near a double eigenvalue 0, and where a part of the shape vanishes, the latter is the larger one; `extent` is the
/// size that changes of the shape are small against, and `length` the unit of the equations. Where two pairs have the same frequency (a
/// rotating and a standing oscillation of a symmetric shape) one coefficient says nothing.
///
/// Source: Kuznetsov (2004), Elements of Applied Bifurcation Theory, eq. (5.62).
///
/// # Checked by  tests/all/normal_forms.rs: normal forms (exact), the van der Pol and the Lorenz equations, the reduced model's formula
pub(super) fn first_lyapunov(
    body: &dyn Equivariant,
    shape: &[f64],
    frequency: f64,
    solved: f64,
    (extent, length): (f64, f64),
) -> NormalForm {
    let size = shape.iter().fold(0.0, |m: f64, x| m.max(x.abs())).min(extent);
    // Newton's method leaves a body at rest at round-off: that is no size.
    let size = if size > ROUND_OFF * length { size } else { 0.0 };
    let found = at_shape(body, shape, (size, length), frequency);
    let found =
        found.map(|found| Coefficient { error: found.error.max(VANISHES / (length * length)), ..found });
    if size == 0.0 {
        return found.into();
    }
    let moved: Vec<f64> = shape.iter().enumerate().map(|(i, x)| x + solved * [1.0, -1.0][i % 2]).collect();
    let beside = at_shape(body, &moved, (size, length), frequency);
    let both = found.and_then(|here| Ok((here, beside?)));
    both.map(|(here, beside)| Coefficient { error: here.error + (here.value - beside.value).abs(), ..here })
        .into()
}

/// The same at one shape, with the error of the differences only.
fn at_shape(
    body: &dyn Equivariant,
    shape: &[f64],
    (size, length): (f64, f64),
    frequency: f64,
) -> Result<Coefficient, Undetermined> {
    let slice = slice(body, shape);
    let a = matrix(&slice);
    if others_critical(&a, frequency) {
        return Err(Undetermined::Directions);
    }
    let (unit, (first, count)) = if size > 0.0 { (size, STEPS) } else { (length, STEPS_AT_REST) };
    let all: Option<Vec<f64>> = critical(&a, frequency).and_then(|pair| {
        (0..count).map(|j| coefficient(&slice, &a, &pair, unit * first * 2.0_f64.powi(j))).collect()
    });
    let found = extrapolated(&all.unwrap_or_default());
    if found.value.is_finite() && found.error.is_finite() { Ok(found) } else { Err(Undetermined::Obstructed) }
}

/// The eigenvalues of a real matrix.
fn eigenvalues_of(a: &DMatrix<Complex<f64>>) -> Vec<(f64, f64)> {
    let columns: Vec<Vec<f64>> =
        a.column_iter().map(|column| column.iter().map(|z| z.re).collect()).collect();
    eigenvalues(&columns).unwrap_or_default()
}

/// Number of eigenvalues that are the critical one.
fn copies(all: &[(f64, f64)], frequency: f64) -> usize {
    let same = |value: &&(f64, f64)| libm::hypot(value.0, value.1 - frequency) < SAME * frequency;
    all.iter().filter(same).count()
}

/// Returns `true` if there are several eigenvalues like the critical one, or one that is 0: there the coefficient has a pole.
fn others_critical(a: &DMatrix<Complex<f64>>, frequency: f64) -> bool {
    let (all, least) = (eigenvalues_of(a), SAME * frequency);
    copies(&all, frequency) > 1 || all.iter().any(|value| libm::hypot(value.0, value.1) < least)
}

/// The critical pair: its frequency, `q` and `p` with `<p, q> = 1`.
struct Pair {
    frequency: f64,
    q: Vector,
    p: Vector,
}

fn critical(a: &DMatrix<Complex<f64>>, frequency: f64) -> Option<Pair> {
    let imaginary = Complex::new(0.0, frequency);
    let q = null_vector(a, imaginary)?;
    let p = null_vector(&a.transpose(), -imaginary)?;
    let p = &p / p.dotc(&q).conj();
    Some(Pair { frequency, q, p })
}

/// The coefficient from steps of this length.
fn coefficient(slice: &Slice<'_>, a: &DMatrix<Complex<f64>>, pair: &Pair, h: f64) -> Option<f64> {
    let Pair { frequency, q, p } = pair;
    let dim = a.nrows();
    let conjugate = q.map(|z| z.conj());
    let mean = a.clone().lu().solve(&slice.bilinear(q, &conjugate, h))?;
    let twice = DMatrix::identity(dim, dim) * Complex::new(0.0, 2.0 * frequency) - a;
    let second = twice.lu().solve(&slice.bilinear(q, q, h))?;
    let sum = p.dotc(&slice.trilinear(q, h)) - p.dotc(&slice.bilinear(q, &mean, h)) * 2.0
        + p.dotc(&slice.bilinear(&conjugate, &second, h));
    Some(sum.re / (2.0 * frequency))
}

/// The vector of length 1 that `A - value` takes to 0.
fn null_vector(a: &DMatrix<Complex<f64>>, value: Complex<f64>) -> Option<Vector> {
    Some(null_space(a, value, 1)?.column(0).into_owned())
}

/// An orthonormal basis of the vectors that `A - value` takes to 0, by inverse iteration on as many as there are.
fn null_space(a: &DMatrix<Complex<f64>>, value: Complex<f64>, count: usize) -> Option<DMatrix<Complex<f64>>> {
    let dim = a.nrows();
    let shift = value * (1.0 + 1e-9); // off the eigenvalue, so that the matrix has an inverse
    let inverse = (a - DMatrix::identity(dim, dim) * shift).lu();
    let mut space = DMatrix::from_fn(dim, count, |i, j| {
        Complex::new(if j > 0 && i % (j + 1) == 0 { -1.0 } else { 1.0 }, 0.3 / (1.0 + i as f64))
    });
    for _ in 0..4 {
        space = inverse.solve(&space)?;
        if count == 1 {
            let length = space.norm();
            space /= Complex::new(length, 0.0);
        } else {
            space = space.qr().q();
        }
    }
    space.iter().all(|z| z.re.is_finite() && z.im.is_finite()).then_some(space)
}
