//! The points of branches as a table.

use super::family::Bodies;
use super::result::{Branches, Sample};
use super::sweep::{SweepPoint, Sweeps};
use motiform_store::columns::{Column, Values};
use motiform_study::{BranchPlan, Error};

/// A row per point, branch by branch, each in its order.
///
/// # Errors
/// An unknown model.
pub fn columns(plan: &BranchPlan, found: &Branches) -> Result<Vec<Column>, Error> {
    let rows: Vec<(usize, usize, &Sample)> = found
        .branches
        .iter()
        .enumerate()
        .flat_map(|(branch, followed)| {
            followed.samples().enumerate().map(move |(point, sample)| (branch, point, sample))
        })
        .collect();
    let mut all = places(plan, &rows);
    all.extend(motions(&rows));
    all.extend(numbers(&rows));
    let model = Bodies::new(plan)?.model(plan.start_value())?;
    for (place, coordinate) in model.coordinates().iter().enumerate() {
        let values = rows.iter().map(|row| row.2.reading.state[place]).collect();
        all.push(Column::new(coordinate.name, coordinate.meaning, Values::Number(values)));
    }
    Ok(all)
}

type Rows<'r> = [(usize, usize, &'r Sample)];

fn places(plan: &BranchPlan, rows: &Rows<'_>) -> Vec<Column> {
    let whole = |read: &dyn Fn(usize, usize) -> usize| {
        Values::Whole(rows.iter().map(|row| i64::try_from(read(row.0, row.1)).unwrap_or(i64::MAX)).collect())
    };
    let parameters = rows.iter().map(|row| row.2.point.parameter).collect();
    let name = &plan.computation.along.name;
    vec![
        Column::new("branch", "number of the branch, from 0", whole(&|branch, _| branch)),
        Column::new("point", "number of the point along the branch, from 0", whole(&|_, point| point)),
        Column::new(name, "the parameter that is varied", Values::Number(parameters)),
    ]
}

fn motions(rows: &Rows<'_>) -> Vec<Column> {
    let text = |read: &dyn Fn(&Sample) -> &'static str| {
        Values::Text(rows.iter().map(|row| read(row.2).to_owned()).collect())
    };
    let whole = |read: &dyn Fn(&Sample) -> i64| Values::Whole(rows.iter().map(|row| read(row.2)).collect());
    let special = |sample: &Sample| sample.point.special.map_or("", |special| special.name());
    vec![
        Column::new("motion", "kind of motion", text(&|sample| sample.reading.motion.name())),
        Column::new(
            "form",
            "symmetry of a motion that repeats, empty for the others",
            text(&|sample| sample.reading.form.map_or("", |form| form.name())),
        ),
        Column::new(
            "course",
            "sense of rotation, or direction to the field, where the model has no mirror or has a field; otherwise empty",
            text(&|sample| sample.reading.direction.course.map_or("", |course| course.name())),
        ),
        Column::new("special", "what happens here, empty at ordinary points", text(&special)),
        Column::new(
            "stable",
            "1 where small deviations die out",
            whole(&|sample| i64::from(sample.point.is_stable())),
        ),
        Column::new(
            "unstable",
            "number of growing directions of the reduced motion; at a special point without the critical ones",
            whole(&|sample| i64::try_from(sample.point.unstable).unwrap_or(i64::MAX)),
        ),
    ]
}

/// Name, meaning, and how it is read; NaN where it has no meaning.
type Number = (&'static str, &'static str, fn(&Sample) -> f64);

const NUMBERS: [Number; 11] = [
    ("period", "time after which the body is as it was, but for the net rotation (model time)", |s| {
        s.reading.period.unwrap_or(f64::NAN)
    }),
    ("turning_rate", "mean turning rate of the heading (rad per model time)", |s| {
        s.reading.turning_rate.unwrap_or(f64::NAN)
    }),
    (
        "heading",
        "direction of the displacement (rad from the x-axis), where rotations are no symmetry",
        |s| s.reading.direction.heading.unwrap_or(f64::NAN),
    ),
    ("net_rotation", "net rotation per period (rad, -pi to pi)", |s| {
        s.reading.net_rotation.unwrap_or(f64::NAN)
    }),
    ("speed", "mean speed (model length per model time)", |s| s.reading.speed[0]),
    ("speed_min", "smallest speed", |s| s.reading.speed[1]),
    ("speed_max", "largest speed", |s| s.reading.speed[2]),
    ("size", "largest size |u| of the shape, velocity included where it is an unknown", |s| s.reading.size),
    ("leading_re", "leading eigenvalue, or multiplier of an orbit: real part", |s| {
        s.reading.leading.map_or(f64::NAN, |leading| leading.0)
    }),
    ("leading_im", "its imaginary part", |s| s.reading.leading.map_or(f64::NAN, |leading| leading.1)),
    ("slope", "derivative of the parameter by the length along the branch", |s| s.point.slope),
];

fn numbers(rows: &Rows<'_>) -> Vec<Column> {
    let values = |read: fn(&Sample) -> f64| Values::Number(rows.iter().map(|row| read(row.2)).collect());
    NUMBERS.iter().map(|&(name, meaning, read)| Column::new(name, meaning, values(read))).collect()
}

/// The samples of both sweeps: a row per value of the parameter and direction.
pub(crate) fn sweep_columns(plan: &BranchPlan, sweeps: &Sweeps) -> Vec<Column> {
    let all: Vec<(i64, &SweepPoint)> = [(1, &sweeps.up), (0, &sweeps.down)]
        .into_iter()
        .flat_map(|(up, all)| all.iter().map(move |p| (up, p)))
        .collect();
    let number = |read: &dyn Fn(&SweepPoint) -> Option<f64>| {
        Values::Number(all.iter().map(|entry| read(entry.1).unwrap_or(f64::NAN)).collect())
    };
    let name = &plan.computation.along.name;
    vec![
        Column::new(
            "up",
            "1 where the parameter was swept upwards, 0 downwards",
            Values::Whole(all.iter().map(|entry| entry.0).collect()),
        ),
        Column::new(name, "the parameter that is varied", number(&|point| Some(point.parameter))),
        Column::new(
            "speed",
            "mean speed; undefined where the run ended early",
            number(&|point| point.speed.map(|speed| speed[0])),
        ),
        Column::new("speed_min", "smallest speed", number(&|point| point.speed.map(|speed| speed[1]))),
        Column::new("speed_max", "largest speed", number(&|point| point.speed.map(|speed| speed[2]))),
        Column::new(
            "turning_rate",
            "mean turning rate of the heading (rad per model time)",
            number(&|point| point.turning_rate),
        ),
        Column::new("size", "largest size |u| of the shape", number(&|point| point.size)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_models::amplitudes;

    /// The parameter along a branch becomes a column.
    #[test]
    fn no_parameter_has_the_name_of_a_column() {
        for column in motions(&[]).into_iter().chain(numbers(&[])) {
            let name = column.name.as_str();
            assert!(amplitudes::reserved(name).is_some(), "{name} can be a parameter of amplitude equations");
        }
        for name in ["branch", "point", "up"] {
            assert!(amplitudes::reserved(name).is_some(), "{name} can be a parameter of amplitude equations");
        }
    }
}
