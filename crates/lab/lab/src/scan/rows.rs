//! A row of a scan: one cell, one initial state, its verdict.

use super::ScanPlan;
use motiform_analysis::regime::{Attractor, Course, Regime, Verdict};
use motiform_store::columns::{Column, Values, to_csv};
use motiform_study::quantity::motion;
use motiform_study::{Error, Quantity};

/// The numbers of a row, in file order.
pub const NUMBERS: [&Quantity; 15] = [
    &motion::MARGIN,
    &motion::SPEED_MEAN,
    &motion::SPEED_MIN,
    &motion::SPEED_MAX,
    &motion::TURNING_RATE,
    &motion::PERIOD,
    &motion::NET_ROTATION,
    &motion::DRIFT,
    &motion::HEADING,
    &motion::SWING,
    &motion::LAMBDA_1,
    &motion::LAMBDA_1_ERROR,
    &motion::ESCAPE_TIME,
    &motion::TIME,
    &motion::RESOLUTION,
];

/// The place of a number by its name.
pub(super) fn place(name: &str) -> Option<usize> {
    NUMBERS.iter().position(|known| known.name == name)
}

/// One initial state of one cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The cell.
    pub cell: usize,
    /// The initial state.
    pub sample: usize,
    /// The motion.
    pub regime: Regime,
    /// The kind of reduced attractor.
    pub attractor: Attractor,
    /// The direction, which tells several motions of this name apart where the model does: left or right,
    /// along or across a field.
    pub course: Option<Course>,
    /// As in [`NUMBERS`]; NaN if it is not defined (null in files).
    pub numbers: [f64; NUMBERS.len()],
    /// The evidence in one sentence.
    pub why: String,
}

impl Row {
    /// The row of a verdict.
    pub fn new(cell: usize, sample: usize, verdict: Verdict) -> Self {
        let v = &verdict;
        let lambda = v.exponents.first();
        let numbers = [
            v.margin,
            v.speed.map(|speed| speed.mean),
            v.speed.map(|speed| speed.min),
            v.speed.map(|speed| speed.max),
            v.turning_rate,
            v.period,
            v.net_rotation,
            v.drift,
            v.heading,
            v.swing,
            lambda.map(|exponent| exponent.value),
            lambda.map(|exponent| exponent.error).filter(|error| error.is_finite()),
            v.escape_time,
            Some(v.time),
            v.resolution.as_ref().map(|resolution| resolution.change),
        ];
        // One undefined number: the sign and payload of a NaN mean nothing.
        let numbers = numbers.map(|number| number.filter(|value| !value.is_nan()).unwrap_or(f64::NAN));
        Self {
            cell,
            sample,
            regime: v.regime,
            attractor: v.attractor,
            course: v.course,
            numbers,
            why: verdict.why,
        }
    }

    /// The row of an evaluation: `None` if it was stopped; if the numerics reject the input, the row states this.
    pub fn of_evaluation(
        cell: usize,
        sample: usize,
        verdict: Result<Option<Verdict>, Error>,
    ) -> Option<Self> {
        let verdict = verdict.unwrap_or_else(|error| {
            let why = format!("refused: {error}");
            Some(Verdict::new(Regime::Undetermined, Attractor::Unknown, why, 0.0))
        });
        verdict.map(|verdict| Self::new(cell, sample, verdict))
    }

    /// A number by its name in [`NUMBERS`]; `None` if it is not defined.
    pub fn number(&self, name: &str) -> Option<f64> {
        Some(self.numbers[place(name)?]).filter(|value| !value.is_nan())
    }
}

/// Equality of bits, so that an undefined number equals itself.
pub(super) fn same_rows(a: &[Row], b: &[Row]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.is_same(b))
}

impl Row {
    /// Returns `true` if two rows are the same to the last bit.
    pub fn is_same(&self, other: &Self) -> bool {
        self.numbers.map(f64::to_bits) == other.numbers.map(f64::to_bits)
            && (self.cell, self.sample, self.regime, self.attractor, self.course, &self.why)
                == (other.cell, other.sample, other.regime, other.attractor, other.course, &other.why)
    }
}

/// The columns of a part, in file order.
pub(super) fn to_columns(plan: &ScanPlan, rows: &[Row]) -> Vec<Column> {
    let mut columns = vec![
        Column::of(&motion::CELL, rows.iter().map(|row| row.cell).collect()),
        Column::of(&motion::SAMPLE, rows.iter().map(|row| row.sample).collect()),
    ];
    for (place, axis) in plan.computation.axes.iter().enumerate() {
        let values = rows.iter().map(|row| plan.axis_values(row.cell)[place]).collect();
        columns.push(Column::new(&axis.name, "the parameter, or the coordinate of the start", values));
    }
    columns.extend([
        Column::of(&motion::REGIME, rows.iter().map(|row| row.regime.name()).collect()),
        Column::of(&motion::ATTRACTOR, rows.iter().map(|row| row.attractor.name()).collect()),
        Column::of(&motion::COURSE, rows.iter().map(|row| row.course.map_or("", Course::name)).collect()),
    ]);
    for (place, quantity) in NUMBERS.into_iter().enumerate() {
        columns.push(Column::of(quantity, rows.iter().map(|row| row.numbers[place]).collect()));
    }
    columns.push(Column::of(&motion::WHY, rows.iter().map(|row| row.why.clone()).collect()));
    columns
}

/// Rows of a plan as the text of a CSV file, with the columns of a part.
pub fn rows_to_csv(plan: &ScanPlan, rows: &[Row]) -> Vec<u8> {
    to_csv(&to_columns(plan, rows))
}

/// The inverse of [`to_columns`]; `None` where the columns are not those of a part of this plan.
pub(super) fn from_columns(plan: &ScanPlan, columns: Vec<Column>) -> Option<Vec<Row>> {
    let axes = plan.computation.axes.len();
    let (mut whole, mut numbers, mut texts) = (Vec::new(), Vec::new(), Vec::new());
    for column in columns {
        match column.values {
            Values::Whole(values) => whole.push(values),
            Values::Number(values) => numbers.push(values),
            Values::Text(values) => texts.push(values),
        }
    }
    let ([cells, samples], [regimes, attractors, courses, whys]) = (&whole[..], &mut texts[..]) else {
        return None;
    };
    let numbers = numbers.get(axes..).filter(|numbers| numbers.len() == NUMBERS.len())?;
    let row = |place: usize| {
        let mut row = Row {
            cell: usize::try_from(cells[place]).ok()?,
            sample: usize::try_from(samples[place]).ok()?,
            regime: Regime::find(&regimes[place])?,
            attractor: Attractor::find(&attractors[place])?,
            course: match courses[place].as_str() {
                "" => None,
                name => Some(Course::find(name)?),
            },
            numbers: [f64::NAN; NUMBERS.len()],
            why: std::mem::take(&mut whys[place]),
        };
        for (number, column) in row.numbers.iter_mut().zip(numbers) {
            *number = column[place];
        }
        Some(row)
    };
    (0..cells.len()).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attractors_are_called_as_in_json() {
        for attractor in Attractor::ALL {
            assert_eq!(serde_json::to_value(attractor).unwrap(), attractor.name());
        }
    }
}
