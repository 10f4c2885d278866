//! The points of branches as a table.

use super::family::Bodies;
use super::result::{Branches, Sample};
use super::sweep::{SweepPoint, Sweeps};
use motiform_analysis::regime::{Course, Form};
use motiform_continuation::Point;
use motiform_store::columns::Column;
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
        all.push(Column::new(coordinate.name, coordinate.meaning, values));
    }
    Ok(all)
}

type Rows<'r> = [(usize, usize, &'r Sample)];

fn places(plan: &BranchPlan, rows: &Rows<'_>) -> Vec<Column> {
    let parameters = rows.iter().map(|row| row.2.point.parameter).collect();
    vec![
        Column::of(&motion::BRANCH, rows.iter().map(|row| row.0).collect()),
        Column::of(&motion::POINT, rows.iter().map(|row| row.1).collect()),
        Column::new(&plan.computation.along.name, "the parameter that is varied", parameters),
    ]
}

fn motions(rows: &Rows<'_>) -> Vec<Column> {
    let (points, readings) =
        (|| rows.iter().map(|row| &row.2.point), || rows.iter().map(|row| &row.2.reading));
    let special = points().map(|point| point.special.map_or("", |special| special.name()));
    let course = readings().map(|reading| reading.direction.course.map_or("", Course::name));
    vec![
        Column::of(&motion::MOTION, readings().map(|reading| reading.motion.name()).collect()),
        Column::of(&motion::FORM, readings().map(|reading| reading.form.map_or("", Form::name)).collect()),
        Column::of(&motion::COURSE, course.collect()),
        Column::of(&motion::SPECIAL, special.collect()),
        Column::of(&motion::STABLE, points().map(Point::is_stable).collect()),
        Column::of(&motion::UNSTABLE, points().map(|point| point.unstable).collect()),
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
    let of = |&(quantity, read): &Number| Column::of(quantity, rows.iter().map(|row| read(row.2)).collect());
    NUMBERS.iter().map(of).collect()
}

/// The samples of both sweeps: a row per value of the parameter and direction.
pub(crate) fn sweep_columns(plan: &BranchPlan, sweeps: &Sweeps) -> Vec<Column> {
    let all: Vec<(i64, &SweepPoint)> = [(1, &sweeps.up), (0, &sweeps.down)]
        .into_iter()
        .flat_map(|(up, all)| all.iter().map(move |p| (up, p)))
        .collect();
    let points = || all.iter().map(|entry| entry.1);
    let speed = |place: usize| points().map(|point| point.speed.map(|speed| speed[place])).collect();
    let parameters = points().map(|point| point.parameter).collect();
    vec![
        Column::of(&motion::UP, all.iter().map(|entry| entry.0).collect()),
        Column::new(&plan.computation.along.name, "the parameter that is varied", parameters),
        Column::of(&motion::SPEED, speed(0)),
        Column::of(&motion::SPEED_MIN, speed(1)),
        Column::of(&motion::SPEED_MAX, speed(2)),
        Column::of(&motion::TURNING_RATE, points().map(|point| point.turning_rate).collect()),
        Column::of(&motion::SIZE, points().map(|point| point.size).collect()),
    ]
}
