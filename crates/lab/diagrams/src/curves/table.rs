//! The points of curves as a table.

use super::family::PlaneBodies;
use super::result::{CurveSample, Curves, FollowedCurve};
use motiform_continuation::{Coefficient, Degenerate, Special};
use motiform_store::columns::Column;
use motiform_study::quantity::special;
use motiform_study::{CurvePlan, Error, Quantity};

type Rows<'r> = [(usize, usize, &'r FollowedCurve, &'r CurveSample)];

/// A row per point, curve by curve, each from one end to the other.
///
/// # Errors
/// An unknown model.
pub fn curve_columns(plan: &CurvePlan, found: &Curves) -> Result<Vec<Column>, Error> {
    let rows: Vec<_> = found
        .curves
        .iter()
        .enumerate()
        .flat_map(|(number, curve)| {
            curve.samples().enumerate().map(move |(point, sample)| (number, point, curve, sample))
        })
        .collect();
    let mut all = places(plan, &rows);
    all.extend(numbers(&rows));
    let model = PlaneBodies::new(plan)?.model([plan.branches().start_value(), plan.fixed_value()])?;
    for (place, coordinate) in model.coordinates().iter().enumerate() {
        let values = rows.iter().map(|row| row.3.state[place]).collect();
        all.push(Column::new(coordinate.name, coordinate.meaning, values));
    }
    Ok(all)
}

fn places(plan: &CurvePlan, rows: &Rows<'_>) -> Vec<Column> {
    let degenerate = rows.iter().map(|row| row.3.degenerate.map_or("", Degenerate::name)).collect();
    let mut all = vec![
        Column::of(&special::CURVE, rows.iter().map(|row| row.0).collect()),
        Column::of(&special::POINT, rows.iter().map(|row| row.1).collect()),
        Column::of(&special::KIND, rows.iter().map(|row| row.2.kind.name()).collect()),
        Column::of(&special::CODIMENSION_2, degenerate),
    ];
    let meanings = ["the parameter across", "the parameter upwards"];
    for (side, (along, meaning)) in plan.computation.plane.iter().zip(meanings).enumerate() {
        let values = rows.iter().map(|row| row.3.parameters[side]).collect();
        all.push(Column::new(&along.name, meaning, values));
    }
    all.push(Column::of(&special::UNSTABLE, rows.iter().map(|row| row.3.unstable).collect()));
    all
}

/// A number, and how it is read; NaN where it has no meaning.
type Number = (&'static Quantity, fn(&CurveSample) -> f64);

const NUMBERS: [Number; 9] = [
    (&special::PERIOD, |s| s.period.unwrap_or(f64::NAN)),
    (&special::CRITICAL_RE, |s| s.critical.map_or(f64::NAN, |value| value.0)),
    (&special::CRITICAL_IM, |s| s.critical.map_or(f64::NAN, |value| value.1)),
    (&special::FIRST_LYAPUNOV, |s| first_lyapunov(s).map_or(f64::NAN, |found| found.value)),
    (&special::FIRST_LYAPUNOV_ERROR, |s| first_lyapunov(s).map_or(f64::NAN, |found| found.error)),
    (&special::RESIDUAL, |s| s.residual),
    (&special::TRANSVERSALITY, |s| s.transversality),
    (&special::ANGLE, |s| match s.special {
        Special::Torus { angle } => angle,
        _ => f64::NAN,
    }),
    (&special::ARCLENGTH, |s| s.arclength),
];

fn first_lyapunov(sample: &CurveSample) -> Option<Coefficient> {
    match sample.special {
        Special::Hopf(hopf) => hopf.first_lyapunov.coefficient(),
        _ => None,
    }
}

fn numbers(rows: &Rows<'_>) -> Vec<Column> {
    let of = |&(quantity, read): &Number| Column::of(quantity, rows.iter().map(|row| read(row.3)).collect());
    NUMBERS.iter().map(of).collect()
}
