//! The numbers of a cell, one by one: text, page, table and population show the same ones.

use super::{FormNumber, Numbers};
use crate::Observation;
use motiform_inference::{Bounded, PersistentWalk};
use motiform_statistics::{Answer, Measured, four_digits};
use motiform_store::columns::{Column, Values};
use motiform_study::Quantity;
use motiform_study::quantity::cell;

/// Why there is no walk.
const TOO_FEW: &str = "fewer than 12 displacements, or none at all";

/// A number of a cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// The number.
    pub quantity: &'static Quantity,
    /// The value, or why there is none.
    pub value: Answer,
}

impl Numbers {
    /// All numbers, always in the same order.
    #[must_use]
    pub fn rows(&self) -> Vec<Row> {
        let steps = self.steps.as_ref();
        let no_step = || self.without_steps();
        let of_steps = |value: Option<Option<Measured>>| {
            value.flatten().map_or_else(|| Answer::unknown(no_step()), Answer::Known)
        };
        let bare = |value: Option<f64>| of_steps(value.map(|value| Some(Measured { value, interval: None })));
        let form = |number: Option<FormNumber>| {
            number.map_or_else(|| Answer::unknown("no frame is seen"), |number| Answer::Known(number.mean))
        };
        let row = |quantity, value| Row { quantity, value };
        let mut rows = vec![
            row(&cell::SPEED, of_steps(steps.map(|s| s.speed))),
            row(&cell::RMS_SPEED, self.rms_speed()),
            row(&cell::PATH, bare(steps.map(|s| s.path))),
            row(&cell::NET_DISPLACEMENT, bare(steps.map(|s| s.net))),
            row(&cell::DIRECTIONALITY, bare(steps.and_then(|s| s.directionality))),
            row(&cell::TURNING_COSINE, of_steps(steps.map(|s| s.turning_cosine))),
            row(&cell::TURNING_RATE, of_steps(steps.map(|s| s.turning_rate))),
            row(&cell::PERSISTENCE, self.of_walk(|walk| walk.persistence, "persistence time")),
            row(&cell::DIFFUSION, self.of_walk(|walk| walk.diffusion, "diffusion coefficient")),
            row(&cell::POSITION_ERROR, self.of_walk(|walk| walk.error, "error")),
        ];
        rows.extend([
            row(&cell::AREA, form(self.forms.area)),
            row(&cell::PERIMETER, form(self.forms.perimeter)),
            row(&cell::ASPECT_RATIO, form(self.forms.aspect_ratio)),
            row(&cell::SOLIDITY, form(self.forms.solidity)),
            row(&cell::CIRCULARITY, form(self.forms.circularity)),
        ]);
        rows
    }

    /// The speed without errors, or why these are not known.
    fn rms_speed(&self) -> Answer {
        match (self.steps.as_ref().and_then(|steps| steps.rms_speed), &self.walk) {
            (Some(speed), _) => Answer::Known(speed),
            (None, Some(walk)) if !walk.describes() => {
                Answer::unknown(format!("the errors of the places are not known: {}", undescribed(walk)))
            }
            (None, None) if self.seen > 1 => Answer::unknown(TOO_FEW),
            (None, _) => Answer::unknown(self.without_steps()),
        }
    }

    fn without_steps(&self) -> String {
        match self.seen {
            0 => "no frame is seen".to_owned(),
            1 => "one frame is seen".to_owned(),
            seen => format!("no such frames in a row among the {seen} that are seen"),
        }
    }

    /// A number of the walk. There is none where no walk describes the path, and where the record sets no bound to one side.
    fn of_walk(&self, number: impl Fn(&PersistentWalk) -> Bounded, name: &str) -> Answer {
        let Some(walk) = &self.walk else {
            return Answer::unknown(match self.seen {
                0 | 1 => self.without_steps(),
                _ => TOO_FEW.to_owned(),
            });
        };
        if !walk.describes() {
            return Answer::unknown(undescribed(walk));
        }
        let Bounded { value, low, high } = number(walk);
        match (low, high) {
            (Some(low), Some(high)) => {
                Answer::Known(Measured { value, interval: Some([low.min(value), high.max(value)]) })
            }
            (None, Some(high)) => Answer::unknown(format!(
                "below {}: the frames do not resolve a shorter {name}",
                four_digits(high)
            )),
            (Some(low), None) => Answer::unknown(format!(
                "above {}: the record sets no upper bound to the {name}",
                four_digits(low)
            )),
            (None, None) => Answer::unknown(format!("the record sets no bound to the {name}")),
        }
    }
}

/// The reason why a walk does not describe a path.
fn undescribed(walk: &PersistentWalk) -> String {
    let why = walk.misfit().map_or_else(String::new, |misfit| format!(": {misfit}"));
    format!("no persistent random walk describes the path{why}")
}

/// Numbers of all cells as a table: the value and the ends of its interval; empty where there is none.
#[must_use]
pub fn number_columns(found: &[Observation]) -> Vec<Column> {
    let rows: Vec<Vec<Row>> = found.iter().map(|one| one.numbers.rows()).collect();
    let names = Values::Text(found.iter().map(|one| one.cell.clone()).collect());
    let seen = found.iter().map(|one| i64::try_from(one.numbers.seen).unwrap_or(i64::MAX)).collect();
    let motion = |one: &Observation| one.motion.regime.map_or("undecided", |regime| regime.name()).to_owned();
    let mut columns = vec![
        Column::of_data(&cell::CELL, names),
        Column::of_data(&cell::MOTION, Values::Text(found.iter().map(motion).collect())),
        Column::of_data(&cell::SEEN, Values::Whole(seen)),
    ];
    for (place, row) in rows.first().into_iter().flatten().enumerate() {
        let value = |of: &dyn Fn(Measured) -> f64| {
            Values::Number(rows.iter().map(|all| all[place].value.known().map_or(f64::NAN, of)).collect())
        };
        let name = row.quantity.name;
        let end = |end: &str, meaning, values| Column::new(&format!("{name}_{end}"), meaning, values);
        columns.push(Column::of_data(row.quantity, value(&|found| found.value)));
        columns.push(end("low", "lower end of its 95 % interval", value(&|found| found.lower())));
        columns.push(end("high", "upper end of its 95 % interval", value(&|found| found.upper())));
    }
    columns
}
