//! The numbers of a cell, one by one: text, page, table and population show the same ones.

use super::walk::{OfWalk, TOO_FEW};
use super::{FormNumber, Numbers};
use crate::Observation;
use motiform_analysis::regime::Regime;
use motiform_statistics::{Answer, Measured, four_digits};
use motiform_store::columns::Column;
use motiform_study::Quantity;
use motiform_study::quantity::cell;

/// A number of a cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// The number.
    pub quantity: &'static Quantity,
    /// The value, or why there is none.
    pub value: Answer,
    /// The lower and the upper bound that the record sets to a number without a value.
    pub bounds: [Option<f64>; 2],
}

impl Row {
    fn new(quantity: &'static Quantity, value: Answer) -> Self {
        Self { quantity, value, bounds: [None; 2] }
    }

    /// A number of the walk.
    fn of_walk(quantity: &'static Quantity, found: &OfWalk) -> Self {
        let bounds = if found.value.is_some() { [None; 2] } else { [found.low, found.high] };
        Self { quantity, value: found.answer(), bounds }
    }

    /// The reason why there is no value, after the bound that is known; `None` where there is a value.
    pub fn reason(&self, unit: &str) -> Option<String> {
        let reason = self.value.reason()?;
        let bound = match self.bounds {
            [Some(low), None] => format!("above {} {unit}", four_digits(low)),
            [None, Some(high)] => format!("below {} {unit}", four_digits(high)),
            _ => return Some(reason.to_owned()),
        };
        Some(format!("{}: {reason}", bound.trim_end()))
    }
}

impl Numbers {
    /// All numbers, always in the same order.
    pub fn rows(&self) -> Vec<Row> {
        let steps = self.steps.as_ref();
        let no_step = || self.without_steps();
        let of_steps = |value: Option<Option<Measured>>| {
            value.flatten().map_or_else(|| Answer::unknown(no_step()), Answer::Known)
        };
        let bare = |value: Option<f64>| of_steps(value.map(|value| Some(Measured { value, interval: None })));
        let form = |number: Option<FormNumber>| {
            let why = if self.seen > 0 { "there are positions and no outlines" } else { "no frame is seen" };
            number.map_or_else(|| Answer::unknown(why), |number| Answer::Known(number.mean))
        };
        let row = Row::new;
        let mut rows = vec![
            row(&cell::SPEED, of_steps(steps.map(|s| s.speed))),
            row(&cell::RMS_SPEED, self.rms_speed()),
            row(&cell::PATH, bare(steps.map(|s| s.path))),
            row(&cell::NET_DISPLACEMENT, bare(steps.map(|s| s.net))),
            row(&cell::DIRECTIONALITY, bare(steps.and_then(|s| s.directionality))),
            row(&cell::TURNING_COSINE, of_steps(steps.map(|s| s.turning_cosine))),
            row(&cell::TURNING_RATE, of_steps(steps.map(|s| s.turning_rate))),
            Row::of_walk(&cell::PERSISTENCE, &self.stated_walk.persistence),
            Row::of_walk(&cell::DIFFUSION, &self.stated_walk.diffusion),
            Row::of_walk(&cell::POSITION_ERROR, &self.stated_walk.error),
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
        match (self.steps.as_ref().and_then(|steps| steps.rms_speed), &self.stated_walk.reason) {
            (Some(speed), _) => Answer::Known(speed),
            (None, Some(_)) if self.walk.is_some() => {
                Answer::unknown("it needs the localisation error, which is not given")
            }
            (None, Some(_)) if self.seen > 1 && self.mixed.is_none() => Answer::unknown(TOO_FEW),
            (None, _) => Answer::unknown(self.without_steps()),
        }
    }

    fn without_steps(&self) -> String {
        if let Some(mixed) = &self.mixed {
            return mixed.clone();
        }
        match &self.steps {
            Some(steps) if steps.path == 0.0 => "every displacement is 0".to_owned(),
            _ => without_steps(self.seen),
        }
    }
}

/// The reason why there is no displacement among so many frames.
pub(super) fn without_steps(seen: usize) -> String {
    match seen {
        0 => "no frame is seen".to_owned(),
        1 => "one frame is seen".to_owned(),
        seen => format!("no such frames in a row among the {seen} that are seen"),
    }
}

/// Numbers of all cells as a table: the value and the ends of its interval; empty where there is none.
pub fn number_columns(found: &[Observation]) -> Vec<Column> {
    let rows: Vec<Vec<Row>> = found.iter().map(|one| one.numbers.rows()).collect();
    let motion = |one: &Observation| one.motion.regime.map_or("undecided", Regime::name);
    let mut columns = vec![
        Column::of_data(&cell::CELL, found.iter().map(|one| one.cell.clone()).collect()),
        Column::of_data(&cell::MOTION, found.iter().map(motion).collect()),
        Column::of_data(&cell::SEEN, found.iter().map(|one| one.numbers.seen).collect()),
    ];
    for (place, row) in rows.first().into_iter().flatten().enumerate() {
        let value =
            |of: fn(Measured) -> f64| rows.iter().map(|all| all[place].value.known().map(of)).collect();
        let name = row.quantity.name;
        let end = |end: &str, meaning, values| Column::new(&format!("{name}_{end}"), meaning, values);
        columns.push(Column::of_data(row.quantity, value(|found| found.value)));
        columns.push(end("low", "lower end of its 95 % interval", value(|found| found.lower())));
        columns.push(end("high", "upper end of its 95 % interval", value(|found| found.upper())));
    }
    columns
}
