//! The points of curves as a table.

use super::family::PlaneBodies;
use super::follow::{CurveSample, Curves, FollowedCurve};
use motiform_continuation::Special;
use motiform_store::columns::{Column, Values};
use motiform_study::{CurvePlan, Error};

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
        all.push(Column::new(coordinate.name, coordinate.meaning, Values::Number(values)));
    }
    Ok(all)
}

fn places(plan: &CurvePlan, rows: &Rows<'_>) -> Vec<Column> {
    let whole = |values: Vec<usize>| {
        Values::Whole(values.into_iter().map(|value| i64::try_from(value).unwrap_or(i64::MAX)).collect())
    };
    let text = |read: &dyn Fn(&FollowedCurve, &CurveSample) -> &'static str| {
        Values::Text(rows.iter().map(|row| read(row.2, row.3).to_owned()).collect())
    };
    let mut all = vec![
        Column::new("curve", "number of the curve, from 0", whole(rows.iter().map(|row| row.0).collect())),
        Column::new(
            "point",
            "number of the point along the curve, from 0",
            whole(rows.iter().map(|row| row.1).collect()),
        ),
        Column::new("kind", "what is critical along the curve", text(&|curve, _| curve.kind.name())),
        Column::new(
            "codimension_2",
            "what else happens here, empty at ordinary points",
            text(&|_, sample| sample.degenerate.map_or("", |kind| kind.name())),
        ),
    ];
    for (side, (along, meaning)) in
        plan.computation.plane.iter().zip(["the parameter across", "the parameter upwards"]).enumerate()
    {
        let values = rows.iter().map(|row| row.3.parameters[side]).collect();
        all.push(Column::new(&along.name, meaning, Values::Number(values)));
    }
    all.push(Column::new(
        "unstable",
        "number of growing directions of the reduced motion, without the critical ones",
        whole(rows.iter().map(|row| row.3.unstable).collect()),
    ));
    all
}

/// Name, meaning, and how it is read; NaN where it has no meaning.
type Number = (&'static str, &'static str, fn(&CurveSample) -> f64);

const NUMBERS: [Number; 9] = [
    (
        "period",
        "period of the reduced motion, at a Hopf bifurcation of the one that begins (model time)",
        |s| s.period.unwrap_or(f64::NAN),
    ),
    ("critical_re", "the eigenvalue, or multiplier of an orbit, that is critical: real part", |s| {
        s.critical.map_or(f64::NAN, |value| value.0)
    }),
    ("critical_im", "its imaginary part", |s| s.critical.map_or(f64::NAN, |value| value.1)),
    (
        "first_lyapunov",
        "first Lyapunov coefficient of a Hopf bifurcation: below 0 supercritical",
        |s| match s.special {
            Special::Hopf(hopf) => hopf.first_lyapunov.coefficient().map_or(f64::NAN, |found| found.value),
            _ => f64::NAN,
        },
    ),
    ("first_lyapunov_error", "its error", |s| match s.special {
        Special::Hopf(hopf) => hopf.first_lyapunov.coefficient().map_or(f64::NAN, |found| found.error),
        _ => f64::NAN,
    }),
    ("residual", "what is left of the condition that holds along the curve", |s| s.residual),
    (
        "transversality",
        "slope of the condition across the curve: residual / transversality is the distance from where it holds",
        |s| s.transversality,
    ),
    ("angle", "angle of the critical multipliers of a torus (rad)", |s| match s.special {
        Special::Torus { angle } => angle,
        _ => f64::NAN,
    }),
    ("arclength", "length along the curve from where it was begun, in the units of the continuation", |s| {
        s.arclength
    }),
];

fn numbers(rows: &Rows<'_>) -> Vec<Column> {
    let values = |read: fn(&CurveSample) -> f64| Values::Number(rows.iter().map(|row| read(row.3)).collect());
    NUMBERS.iter().map(|&(name, meaning, read)| Column::new(name, meaning, values(read))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_models::amplitudes;

    /// The parameter along a branch becomes a column.
    #[test]
    fn no_parameter_has_the_name_of_a_column() {
        for (name, ..) in NUMBERS {
            assert!(amplitudes::reserved(name).is_some(), "{name} can be a parameter of amplitude equations");
        }
        for name in ["curve", "point", "kind", "codimension_2", "unstable"] {
            assert!(amplitudes::reserved(name).is_some(), "{name} can be a parameter of amplitude equations");
        }
    }
}
