//! The points of branches as a table.

use super::family::Bodies;
use super::result::{Branches, Sample};
use super::sweep::{SweepPoint, Sweeps};
use motiform_store::columns::{Column, Values};
use motiform_study::quantity::motion;
use motiform_study::{BranchPlan, Error, Quantity};

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
        Column::of(&motion::BRANCH, whole(&|branch, _| branch)),
        Column::of(&motion::POINT, whole(&|_, point| point)),
        Column::new(name, "the parameter that is varied", Values::Number(parameters)),
    ]
}

fn motions(rows: &Rows<'_>) -> Vec<Column> {
    let text = |read: &dyn Fn(&Sample) -> &'static str| {
        Values::Text(rows.iter().map(|row| read(row.2).to_owned()).collect())
    };
    let whole = |read: &dyn Fn(&Sample) -> i64| Values::Whole(rows.iter().map(|row| read(row.2)).collect());
    let special = |sample: &Sample| sample.point.special.map_or("", |special| special.name());
    let (form, course) = (|s: &Sample| s.reading.form, |s: &Sample| s.reading.direction.course);
    let unstable = |sample: &Sample| i64::try_from(sample.point.unstable).unwrap_or(i64::MAX);
    vec![
        Column::of(&motion::MOTION, text(&|sample| sample.reading.motion.name())),
        Column::of(&motion::FORM, text(&|sample| form(sample).map_or("", |form| form.name()))),
        Column::of(&motion::COURSE, text(&|sample| course(sample).map_or("", |course| course.name()))),
        Column::of(&motion::SPECIAL, text(&special)),
        Column::of(&motion::STABLE, whole(&|sample| i64::from(sample.point.is_stable()))),
        Column::of(&motion::UNSTABLE, whole(&unstable)),
    ]
}

/// A number, and how it is read; NaN where it has no meaning.
type Number = (&'static Quantity, fn(&Sample) -> f64);

const NUMBERS: [Number; 11] = [
    (&motion::PERIOD, |s| s.reading.period.unwrap_or(f64::NAN)),
    (&motion::TURNING_RATE, |s| s.reading.turning_rate.unwrap_or(f64::NAN)),
    (&motion::HEADING, |s| s.reading.direction.heading.unwrap_or(f64::NAN)),
    (&motion::NET_ROTATION, |s| s.reading.net_rotation.unwrap_or(f64::NAN)),
    (&motion::SPEED, |s| s.reading.speed[0]),
    (&motion::SPEED_MIN, |s| s.reading.speed[1]),
    (&motion::SPEED_MAX, |s| s.reading.speed[2]),
    (&motion::SIZE, |s| s.reading.size),
    (&motion::LEADING_RE, |s| s.reading.leading.map_or(f64::NAN, |leading| leading.0)),
    (&motion::LEADING_IM, |s| s.reading.leading.map_or(f64::NAN, |leading| leading.1)),
    (&motion::SLOPE, |s| s.point.slope),
];

fn numbers(rows: &Rows<'_>) -> Vec<Column> {
    let values = |read: fn(&Sample) -> f64| Values::Number(rows.iter().map(|row| read(row.2)).collect());
    NUMBERS.iter().map(|&(quantity, read)| Column::of(quantity, values(read))).collect()
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
    let speed = |place: usize| move |point: &SweepPoint| point.speed.map(|speed| speed[place]);
    vec![
        Column::of(&motion::UP, Values::Whole(all.iter().map(|entry| entry.0).collect())),
        Column::new(name, "the parameter that is varied", number(&|point| Some(point.parameter))),
        Column::of(&motion::SPEED, number(&speed(0))),
        Column::of(&motion::SPEED_MIN, number(&speed(1))),
        Column::of(&motion::SPEED_MAX, number(&speed(2))),
        Column::of(&motion::TURNING_RATE, number(&|point| point.turning_rate)),
        Column::of(&motion::SIZE, number(&|point| point.size)),
    ]
}
