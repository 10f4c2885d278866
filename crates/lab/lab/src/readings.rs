//! Quantities computed from recorded states: the tables of a dataset, the numbers of its manifest.

use motiform_dynamics::model::{turning_rate, velocity_and_acceleration};
use motiform_dynamics::{Model, Trajectory};
use motiform_store::table::{Column, Table};
use motiform_study::Dimension;
use motiform_study::plan::{Computation, Named};
use motiform_study::quantity::state::{RISING, SPEED, T, TURNING_RATE, X, Y};
use motiform_study::study::ReturnMapSettings;

/// The trajectory as a table, with derived quantities.
pub(crate) fn motion(model: &dyn Model, trajectory: &Trajectory, c: &Computation) -> Table {
    let mut table = columns(model);
    table.columns.iter_mut().for_each(|column| column.values.reserve_exact(trajectory.len()));
    let mut readings = Readings::new(model, c);
    trajectory.iter().for_each(|(t, u)| readings.push(t, u, &mut table));
    table
}

/// The columns of a trajectory, without rows.
pub(crate) fn columns(model: &dyn Model) -> Table {
    let of = |quantity| Column::of(quantity, Vec::new());
    let column = |name: &str, meaning: &'static str| Column::new(name, meaning, Vec::new());
    let coordinates =
        model.coordinates().iter().map(|coordinate| column(coordinate.name, coordinate.meaning));
    let observed = model.observables().iter().chain(model.measures());
    let all = [&T, &X, &Y].map(of).into_iter().chain(coordinates).chain([&SPEED, &TURNING_RATE].map(of));
    Table { columns: all.chain(observed.map(|observed| column(observed.name, observed.meaning))).collect() }
}

/// The dimension of a column of a trajectory; that of a number for other names. A shape is a deviation of the outline and has that of
/// its size.
#[must_use]
pub fn dimension(model: &dyn Model, column: &str) -> Dimension {
    if let Some(known) = [&T, &X, &Y, &SPEED, &TURNING_RATE].into_iter().find(|known| known.name == column) {
        return known.dimension;
    }
    if let Some(seen) = model.observables().iter().chain(model.measures()).find(|known| known.name == column)
    {
        return Dimension::of(seen.length, 0);
    }
    match model.coordinates().iter().position(|known| known.name == column) {
        Some(place) if place < model.velocities() => Dimension::SPEED,
        Some(_) => Dimension::of(model.observables().iter().map(|size| size.length).max().unwrap_or(0), 0),
        None => Dimension::NUMBER,
    }
}

/// Turns states into rows.
pub(crate) struct Readings<'m> {
    model: &'m dyn Model,
    atol: f64,
    turning: Turning,
    named: Vec<f64>,
    seen: Vec<f64>,
    boundary: Vec<f64>,
}

impl<'m> Readings<'m> {
    pub(crate) fn new(model: &'m dyn Model, c: &Computation) -> Self {
        Self {
            model,
            atol: c.control.absolute_tolerance(),
            turning: Turning::of(model, c),
            named: vec![0.0; model.coordinates().len()],
            seen: vec![0.0; model.observables().len()],
            boundary: vec![0.0; model.measures().len()],
        }
    }

    /// Adds the row of a state `(shape, x, y)` to a table with [`columns`].
    pub(crate) fn push(&mut self, t: f64, u: &[f64], table: &mut Table) {
        let (shape, position) = u.split_at(self.model.dim());
        self.model.decode(shape, &mut self.named);
        self.model.observe(shape, &mut self.seen);
        self.model.measure(shape, &mut self.boundary);
        let (speed, rate) = pace(self.model, shape, self.atol);
        let pace = [speed, self.turning.rate(t, &self.named, rate)];
        let values = [t].into_iter().chain(position.iter().copied()).chain(self.named.iter().copied());
        let values = values.chain(pace).chain(self.seen.iter().copied()).chain(self.boundary.iter().copied());
        table.columns.iter_mut().zip(values).for_each(|(column, value)| column.values.push(value));
    }
}

/// The turning rate of a row.
#[derive(Clone, Copy)]
enum Turning {
    /// The derivative of the heading.
    Derivative,
    /// The change of the heading since the row before over the time between them: noise acts on the velocity, which has no derivative.
    /// With the row before: its time and heading.
    Differences(f64, f64),
    /// None: the velocity is read off a shape under noise, which is rough on all scales.
    Undefined,
}

impl Turning {
    fn of(model: &dyn Model, c: &Computation) -> Self {
        let Some(noise) = c.noise else { return Self::Derivative };
        if model.velocities() == 0 {
            Self::Undefined
        } else if noise.velocity > 0.0 || !model.noise().is_none() {
            Self::Differences(f64::NAN, f64::NAN)
        } else {
            Self::Derivative
        }
    }

    /// The rate of a row with these coordinates, which the equations without noise turn at `drift` (NaN at rest).
    fn rate(&mut self, t: f64, named: &[f64], drift: f64) -> f64 {
        match self {
            Self::Derivative => drift,
            Self::Undefined => f64::NAN,
            Self::Differences(before, heading) => {
                let now = if drift.is_nan() { f64::NAN } else { libm::atan2(named[1], named[0]) };
                let turned = libm::remainder(now - *heading, std::f64::consts::TAU);
                let rate = if t > *before { turned / (t - *before) } else { f64::NAN };
                (*before, *heading) = (t, now);
                rate
            }
        }
    }
}

/// Returns `true` if the turning rates of a plan are differences from row to row.
pub(crate) fn turns_by_rows(model: &dyn Model, c: &Computation) -> bool {
    matches!(Turning::of(model, c), Turning::Differences(..))
}

/// Speed and turning rate of a shape; the latter is NaN at rest: below what a run with absolute tolerance `atol` resolves.
pub(crate) fn pace(model: &dyn Model, shape: &[f64], atol: f64) -> (f64, f64) {
    let (v, a) = velocity_and_acceleration(model, shape);
    let speed = libm::hypot(v[0], v[1]);
    let moves = speed > model.speed_resolution(shape, atol);
    (speed, turning_rate(v, a).filter(|_| moves).unwrap_or(f64::NAN))
}

/// The measures of a shape that are defined, by name.
pub(crate) fn measures(model: &dyn Model, shape: &[f64]) -> Named {
    let mut values = vec![0.0; model.measures().len()];
    model.measure(shape, &mut values);
    let names = model.measures().iter().map(|measure| measure.name.to_owned());
    Named(names.zip(values).filter(|entry| !entry.1.is_nan()).collect())
}

/// The crossings of a segment.
pub(crate) struct Crossings {
    span: [f64; 2],
    table: Table,
}

impl Crossings {
    pub(crate) fn new(map: &ReturnMapSettings) -> Self {
        let table = Table::of(&[&T, &X, &Y, &RISING], vec![Vec::new(); 4]);
        Self { span: [map.x_min, map.x_max], table }
    }

    /// Adds a crossing of its line, if it lies on the segment.
    pub(crate) fn push(&mut self, t: f64, [x, y]: [f64; 2], rising: bool) {
        if self.span[0] < x && x < self.span[1] {
            let values = [t, x, y, f64::from(u8::from(rising))];
            self.table.columns.iter_mut().zip(values).for_each(|(column, value)| column.values.push(value));
        }
    }

    /// The same without what was found.
    pub(crate) fn emptied(mut self) -> Self {
        self.table.columns.iter_mut().for_each(|column| column.values.clear());
        self
    }

    /// In order.
    pub(crate) fn table(self) -> Table {
        self.table
    }
}
