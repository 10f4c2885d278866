//! Quantities computed from recorded states: the tables of a dataset, the numbers of its manifest.

use motiform_dynamics::model::{turning_rate, velocity_and_acceleration};
use motiform_dynamics::{Model, Noise, Trajectory};
use motiform_store::table::{Column, Table};
use motiform_study::plan::{Computation, Named};
use motiform_study::quantity::state::{self, RISING, SPEED, T, TURNING_RATE, X, Y};
use motiform_study::study::ReturnMapSettings;
use motiform_study::{Dimension, Quantity};

/// The columns before the coordinates of the shape.
const PLACE: [&Quantity; 3] = [&T, &X, &Y];

/// The columns after the coordinates of the shape; [`pace`] computes their values.
const PACE: [&Quantity; 2] = [&SPEED, &TURNING_RATE];

/// The columns of a table of crossings.
pub(crate) const CROSSING: [&Quantity; 4] = [&T, &X, &Y, &RISING];

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
    let all = PLACE.map(of).into_iter().chain(coordinates).chain(PACE.map(of));
    Table { columns: all.chain(observed.map(|observed| column(observed.name, observed.meaning))).collect() }
}

/// The dimension of a column of a trajectory; that of a number for other names. A shape is a deviation of the outline and has that of
/// its size.
pub fn dimension(model: &dyn Model, column: &str) -> Dimension {
    if let Some(known) = state::ALL.iter().find(|known| known.name == column) {
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
    turns: bool,
    named: Vec<f64>,
    seen: Vec<f64>,
    boundary: Vec<f64>,
}

impl<'m> Readings<'m> {
    pub(crate) fn new(model: &'m dyn Model, c: &Computation) -> Self {
        Self {
            model,
            atol: c.control.absolute_tolerance(),
            turns: turns(model, c),
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
        let [speed, rate] = pace(self.model, shape, self.atol);
        let pace = [speed, if self.turns { rate } else { f64::NAN }];
        let values = [t].into_iter().chain(position.iter().copied()).chain(self.named.iter().copied());
        let values = values.chain(pace).chain(self.seen.iter().copied()).chain(self.boundary.iter().copied());
        table.columns.iter_mut().zip(values).for_each(|(column, value)| column.values.push(value));
    }
}

/// Returns `true` if the heading of a run has a derivative. A velocity under white noise has none, and neither has one that is read off a
/// shape under noise.
///
/// # Checked by  tests/all/noise.rs: noise on the velocity, on the shape alone, of the equations
pub(crate) fn turns(model: &dyn Model, c: &Computation) -> bool {
    let Some(settings) = c.noise else { return true };
    let additive = Noise::on(model, settings.velocity, settings.shape, settings.step).amplitudes;
    let own = model.noise().diffusion;
    let rough =
        |entry: usize| additive[entry] > 0.0 || own.as_ref().is_some_and(|diffusion| diffusion.moves(entry));
    model.velocities() > 0 && !(0..model.velocities()).any(rough)
}

/// Speed and turning rate of a shape; the latter is NaN at rest: below what a run with absolute tolerance `atol` resolves.
pub(crate) fn pace(model: &dyn Model, shape: &[f64], atol: f64) -> [f64; PACE.len()] {
    let (v, a) = velocity_and_acceleration(model, shape);
    let speed = libm::hypot(v[0], v[1]);
    let moves = speed > model.speed_resolution(shape, atol);
    [speed, turning_rate(v, a).filter(|_| moves).unwrap_or(f64::NAN)]
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
        let table = Table::of(&CROSSING, vec![Vec::new(); CROSSING.len()]);
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
