//! The crossings of a plan's orbit with a surface: one coordinate at a fixed value.

use crate::simulate::after_transient;
use motiform_dynamics::Watch;
use motiform_dynamics::drive::drive;
use motiform_dynamics::{Direction, InPlane, Model, Request, Section, Trajectory};
use motiform_store::table::{Column, Table};
use motiform_study::plan::check;
use motiform_study::quantity::state::{RISING, T, X, Y};
use motiform_study::{Ending, Error, Plan};

/// The crossings of `coordinate = value` (a coordinate of the shape, or `x`, `y`) while the plan records: a table with
/// `t`, `x`, `y`, all coordinates and `rising` (1 where the coordinate grows), and how the run ended.
///
/// Crossings are located to round-off, with steps of the method itself.
///
/// # Errors
/// An unknown coordinate, a value that is not finite, a plan with noise.
pub fn section(
    plan: &Plan,
    coordinate: &str,
    value: f64,
    direction: Direction,
    watch: &dyn Watch,
) -> Result<(Table, Ending), Error> {
    let c = &plan.computation;
    check("value", value, true, "give a finite number")?;
    let place = plan.info()?.coordinate(&c.parameters.values(), coordinate)?;
    let model = crate::analyse::model(plan)?;
    let weights = reading(model.as_ref(), place);
    let (ended, start) = after_transient(plan, model.as_ref(), watch)?;
    let mut trajectory = Trajectory::new(start.len());
    if let Some(ending) = ended {
        return Ok((table(model.as_ref(), &trajectory), ending));
    }
    let body = InPlane(model.as_ref());
    let mut orbit = plan.method()?.orbit(&body, c.control.into(), 0.0, &start)?;
    let g = |_t: f64, u: &[f64]| weights.iter().zip(u).map(|(w, x)| w * x).sum::<f64>() - value;
    let sections = [Section { g: &g, direction, terminal: false }];
    let request = Request {
        max_steps: c.max_steps,
        escape_norm: c.escape_norm,
        watched: model.dim(),
        sections: &sections,
        watch,
        ..Request::until(c.t_end, start.len())
    };
    let outcome = drive(orbit.as_mut(), &request, &mut trajectory)?;
    Ok((table(model.as_ref(), &trajectory), outcome.into()))
}

/// The weights that give coordinate `place` of a state `(shape, x, y)`: coordinates are linear in the state.
fn reading(model: &dyn Model, place: usize) -> Vec<f64> {
    let dim = model.dim();
    let mut weights = vec![0.0; dim + 2];
    if place >= dim {
        weights[place] = 1.0;
        return weights;
    }
    let (mut unit, mut coordinates) = (vec![0.0; dim], vec![0.0; dim]);
    for entry in 0..dim {
        unit.fill(0.0);
        unit[entry] = 1.0;
        model.decode(&unit, &mut coordinates);
        weights[entry] = coordinates[place];
    }
    weights
}

fn table(model: &dyn Model, trajectory: &Trajectory) -> Table {
    let found = trajectory.crossings();
    let mut columns = vec![Vec::with_capacity(found.len()); model.coordinates().len()];
    let mut coordinates = vec![0.0; columns.len()];
    for crossing in found {
        model.decode(&crossing.state[..model.dim()], &mut coordinates);
        for (column, &value) in columns.iter_mut().zip(&coordinates) {
            column.push(value);
        }
    }
    let place = |back: usize| found.iter().map(|c| c.state[c.state.len() - back]).collect();
    let mut table = Table::of(&[&T, &X, &Y], vec![found.iter().map(|c| c.t).collect(), place(2), place(1)]);
    for (coordinate, values) in model.coordinates().iter().zip(columns) {
        table.push(coordinate.name, coordinate.meaning, values);
    }
    let rising = found.iter().map(|c| f64::from(u8::from(c.rising))).collect();
    table.columns.push(Column::of(&RISING, rising));
    table
}
