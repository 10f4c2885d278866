//! Coefficients of amplitude equations: complex expressions of the parameters, as a list of operations.

/// The kind of a coefficient's value, for all values of the parameters. It decides whether equations are
/// mirror symmetric.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A real number.
    Real,
    /// `i` times a real number.
    Imaginary,
    /// Any complex number.
    Complex,
}

impl Kind {
    fn sum(self, other: Self) -> Self {
        if self == other { self } else { Self::Complex }
    }

    fn product(self, other: Self) -> Self {
        match (self, other) {
            (Self::Real, kind) | (kind, Self::Real) => kind,
            (Self::Imaginary, Self::Imaginary) => Self::Real,
            _ => Self::Complex,
        }
    }

    fn power(self, exponent: i32) -> Self {
        match self {
            Self::Imaginary if exponent % 2 == 0 => Self::Real,
            kind => kind,
        }
    }
}

/// A function of a coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    /// Square root of a real number of at least 0.
    Sqrt,
    /// Sine of a real number (rad).
    Sin,
    /// Cosine of a real number (rad).
    Cos,
    /// Exponential.
    Exp,
}

impl Function {
    /// All functions with their names.
    pub(super) const ALL: [(&'static str, Self); 4] =
        [("sqrt", Self::Sqrt), ("sin", Self::Sin), ("cos", Self::Cos), ("exp", Self::Exp)];

    fn kind(self, argument: Kind) -> Option<Kind> {
        match (self, argument) {
            (_, Kind::Real) => Some(Kind::Real),
            (Self::Exp, _) => Some(Kind::Complex),
            _ => None,
        }
    }
}

/// Place of a coefficient in its [`Tape`].
pub(super) type Place = u32;

/// One operation on earlier results.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Operation {
    Number(f64),
    ImaginaryUnit,
    Parameter(usize),
    Add(Place, Place),
    Subtract(Place, Place),
    Multiply(Place, Place),
    Divide(Place, Place),
    Negate(Place),
    Conjugate(Place),
    WholePower(Place, i32),
    Power(Place, Place),
    Apply(Function, Place),
}

/// Operations in the order of their evaluation; each result is computed once.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tape(Vec<(Operation, Kind)>);

/// Maximum number of operations of a set of equations.
const MOST: usize = 20_000;

/// `re + i im`.
pub(super) type Value = [f64; 2];

impl Tape {
    /// The kind of a coefficient.
    pub(super) fn kind(&self, place: Place) -> Kind {
        self.0[place as usize].1
    }

    /// The number that a coefficient is, if it was written as one.
    pub(super) fn number(&self, place: Place) -> Option<f64> {
        match self.0[place as usize].0 {
            Operation::Number(number) => Some(number),
            Operation::Negate(inner) => self.number(inner).map(|number| -number),
            _ => None,
        }
    }

    /// Returns `true` if the list has reached the largest allowed length.
    pub(super) fn is_full(&self) -> bool {
        self.0.len() >= MOST
    }

    fn push(&mut self, operation: Operation, kind: Kind) -> Place {
        self.0.push((operation, kind));
        self.0.len() as Place - 1
    }

    pub(super) fn real(&mut self, number: f64) -> Place {
        self.push(Operation::Number(number), Kind::Real)
    }

    pub(super) fn imaginary_unit(&mut self) -> Place {
        self.push(Operation::ImaginaryUnit, Kind::Imaginary)
    }

    pub(super) fn parameter(&mut self, index: usize) -> Place {
        self.push(Operation::Parameter(index), Kind::Real)
    }

    /// Written as 0.
    fn is_zero(&self, place: Place) -> bool {
        self.number(place) == Some(0.0)
    }

    pub(super) fn add(&mut self, a: Place, b: Place) -> Place {
        if self.is_zero(a) {
            return b;
        }
        if self.is_zero(b) {
            return a;
        }
        let kind = self.kind(a).sum(self.kind(b));
        self.push(Operation::Add(a, b), kind)
    }

    pub(super) fn subtract(&mut self, a: Place, b: Place) -> Place {
        if self.is_zero(b) {
            return a;
        }
        let kind = self.kind(a).sum(self.kind(b));
        self.push(Operation::Subtract(a, b), kind)
    }

    pub(super) fn multiply(&mut self, a: Place, b: Place) -> Place {
        let is_one = |place| self.0[place as usize].0 == Operation::Number(1.0);
        if is_one(a) {
            return b;
        }
        if is_one(b) {
            return a;
        }
        // a term that is written as none does not break a symmetry
        if self.is_zero(a) || self.is_zero(b) {
            return self.real(0.0);
        }
        let kind = self.kind(a).product(self.kind(b));
        self.push(Operation::Multiply(a, b), kind)
    }

    pub(super) fn divide(&mut self, a: Place, b: Place) -> Place {
        let kind = self.kind(a).product(self.kind(b));
        self.push(Operation::Divide(a, b), kind)
    }

    pub(super) fn negate(&mut self, a: Place) -> Place {
        self.push(Operation::Negate(a), self.kind(a))
    }

    pub(super) fn conjugate(&mut self, a: Place) -> Place {
        match self.kind(a) {
            Kind::Real => a,
            kind => self.push(Operation::Conjugate(a), kind),
        }
    }

    pub(super) fn whole_power(&mut self, a: Place, exponent: i32) -> Place {
        let kind = self.kind(a).power(exponent);
        self.push(Operation::WholePower(a, exponent), kind)
    }

    /// `a^b` of real numbers.
    pub(super) fn power(&mut self, a: Place, b: Place) -> Option<Place> {
        let real = self.kind(a) == Kind::Real && self.kind(b) == Kind::Real;
        real.then(|| self.push(Operation::Power(a, b), Kind::Real))
    }

    /// `None` if the function needs a real argument and this may be none.
    pub(super) fn apply(&mut self, function: Function, a: Place) -> Option<Place> {
        let kind = function.kind(self.kind(a))?;
        Some(self.push(Operation::Apply(function, a), kind))
    }

    /// All coefficients for these values of the parameters. What has no value (a division by 0, the root of a
    /// negative number) is not finite.
    pub(super) fn evaluate(&self, parameters: &[f64]) -> Vec<Value> {
        let mut values: Vec<Value> = Vec::with_capacity(self.0.len());
        for &(operation, kind) in &self.0 {
            let [re, im] = value(operation, parameters, &values);
            values.push(match kind {
                Kind::Real => [re, 0.0],
                Kind::Imaginary => [0.0, im],
                Kind::Complex => [re, im],
            });
        }
        values
    }
}

fn value(operation: Operation, parameters: &[f64], values: &[Value]) -> Value {
    let at = |place: Place| values[place as usize];
    match operation {
        Operation::Number(number) => [number, 0.0],
        Operation::ImaginaryUnit => [0.0, 1.0],
        Operation::Parameter(index) => [parameters[index], 0.0],
        Operation::Add(a, b) => [at(a)[0] + at(b)[0], at(a)[1] + at(b)[1]],
        Operation::Subtract(a, b) => [at(a)[0] - at(b)[0], at(a)[1] - at(b)[1]],
        Operation::Multiply(a, b) => product(at(a), at(b)),
        Operation::Divide(a, b) => quotient(at(a), at(b)),
        Operation::Negate(a) => [-at(a)[0], -at(a)[1]],
        Operation::Conjugate(a) => [at(a)[0], -at(a)[1]],
        Operation::WholePower(a, exponent) => whole_power(at(a), exponent),
        Operation::Power(a, b) => [libm::pow(at(a)[0], at(b)[0]), 0.0],
        Operation::Apply(function, a) => apply(function, at(a)),
    }
}

fn product(a: Value, b: Value) -> Value {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// Real and imaginary denominators divide directly, so that real coefficients have the bits of real arithmetic.
fn quotient(a: Value, b: Value) -> Value {
    match b {
        [re, 0.0] => [a[0] / re, a[1] / re],
        [0.0, im] => [a[1] / im, -a[0] / im],
        [re, im] => {
            let size = re * re + im * im;
            let [x, y] = product(a, [re, -im]);
            [x / size, y / size]
        }
    }
}

fn whole_power(a: Value, exponent: i32) -> Value {
    let mut power = [1.0, 0.0];
    for _ in 0..exponent.unsigned_abs() {
        power = product(power, a);
    }
    if exponent < 0 { quotient([1.0, 0.0], power) } else { power }
}

fn apply(function: Function, [re, im]: Value) -> Value {
    match function {
        Function::Sqrt => [re.sqrt(), 0.0],
        Function::Sin => [libm::sin(re), 0.0],
        Function::Cos => [libm::cos(re), 0.0],
        Function::Exp => {
            let (sin, cos) = libm::sincos(im);
            let size = libm::exp(re);
            [size * cos, size * sin]
        }
    }
}
