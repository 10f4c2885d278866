//! Quantities computed from recorded states: the tables of a dataset, the numbers of its manifest.

use motiform_dynamics::model::{turning_rate, velocity_and_acceleration};
use motiform_dynamics::{Model, Trajectory};
use motiform_study::plan::{Computation, Named};
use motiform_study::study::ReturnMapSettings;
use motiform_study::table::Table;

/// The trajectory as a table, with derived quantities.
pub(crate) fn motion(model: &dyn Model, trajectory: &Trajectory, c: &Computation) -> Table {
    let atol = c.control.absolute_tolerance();
    // A velocity that is read off a shape under noise has no derivative.
    let turns = c.noise.is_none() || model.velocities() > 0;
    let shape = ..model.dim();
    let rows = trajectory.len();
    let read = |of: &dyn Fn(&[f64]) -> f64| -> Vec<f64> { trajectory.iter().map(|(_, u)| of(u)).collect() };
    let mut table = Table::default();
    table.push("t", "model time", trajectory.times().to_vec());
    table.push("x", "position of the centre of mass (model length)", read(&|u| u[u.len() - 2]));
    table.push("y", "position of the centre of mass (model length)", read(&|u| u[u.len() - 1]));
    let mut coordinates = vec![Vec::with_capacity(rows); model.coordinates().len()];
    let mut observed = vec![Vec::with_capacity(rows); model.observables().len()];
    let mut measured = vec![Vec::with_capacity(rows); model.measures().len()];
    let (mut named, mut seen) = (vec![0.0; coordinates.len()], vec![0.0; observed.len()]);
    let mut boundary = vec![0.0; measured.len()];
    let (mut speed, mut turning) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
    for (_, u) in trajectory.iter() {
        model.decode(&u[shape], &mut named);
        model.observe(&u[shape], &mut seen);
        model.measure(&u[shape], &mut boundary);
        let columns = coordinates.iter_mut().chain(&mut observed).chain(&mut measured);
        for (column, &value) in columns.zip(named.iter().chain(&seen).chain(&boundary)) {
            column.push(value);
        }
        let (size, rate) = pace(model, &u[shape], atol);
        speed.push(size);
        turning.push(if turns { rate } else { f64::NAN });
    }
    for (coordinate, values) in model.coordinates().iter().zip(coordinates) {
        table.push(coordinate.name, coordinate.meaning, values);
    }
    table.push("speed", "|v| (model length per model time)", speed);
    table.push(
        "turning_rate",
        "d(heading)/dt (rad per model time); undefined at rest, and where noise leaves the velocity no derivative",
        turning,
    );
    for (observable, values) in model.observables().iter().zip(observed) {
        table.push(observable.name, observable.meaning, values);
    }
    for (measure, values) in model.measures().iter().zip(measured) {
        table.push(measure.name, measure.meaning, values);
    }
    table
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

/// The crossings of the segment, in order.
pub(crate) fn crossings(trajectory: &Trajectory, map: &ReturnMapSettings) -> Table {
    let inside = |x: f64| map.x_min < x && x < map.x_max;
    let kept: Vec<_> = trajectory
        .crossings()
        .iter()
        .filter(|crossing| inside(crossing.state[crossing.state.len() - 2]))
        .collect();
    let mut table = Table::default();
    table.push("t", "time of the crossing", kept.iter().map(|c| c.t).collect());
    table.push(
        "x",
        "x where the path crosses the segment",
        kept.iter().map(|c| c.state[c.state.len() - 2]).collect(),
    );
    table.push(
        "y",
        "y of the segment, to round-off",
        kept.iter().map(|c| c.state[c.state.len() - 1]).collect(),
    );
    table.push(
        "rising",
        "1 where y grows, 0 where it falls",
        kept.iter().map(|c| f64::from(u8::from(c.rising))).collect(),
    );
    table
}
