//! The numbers of a cell, one by one, with name and unit: text, page, table and population show the same ones.

use super::{FormNumber, Numbers};
use crate::{Observation, Units};
use motiform_inference::{Bounded, PersistentWalk};
use motiform_statistics::{Answer, Measured, four_digits};
use motiform_store::columns::{Column, Values};

/// Why there is no walk.
const TOO_FEW: &str = "fewer than 12 displacements, or none at all";

/// What a number measures: its unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// No unit.
    Plain,
    /// Length.
    Length,
    /// Length squared.
    Area,
    /// Time.
    Time,
    /// Length over time.
    Speed,
    /// Length squared over time.
    Diffusion,
    /// Radians over time.
    Rate,
}

impl Dimension {
    /// The unit in the units of the data; empty for numbers without one.
    #[must_use]
    pub fn unit(self, units: &Units) -> String {
        let Units { length, time, .. } = units;
        match self {
            Self::Plain => String::new(),
            Self::Length => length.clone(),
            Self::Area => format!("{length}^2"),
            Self::Time => time.clone(),
            Self::Speed => units.speed(),
            Self::Diffusion => units.diffusion(),
            Self::Rate => format!("rad/{time}"),
        }
    }
}

/// A number of a cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Its name in tables and JSON.
    pub key: &'static str,
    /// Its name for people.
    pub name: &'static str,
    /// Its unit.
    pub dimension: Dimension,
    /// The value, or why there is none.
    pub value: Answer,
}

impl Numbers {
    /// All numbers, always in the same order.
    #[must_use]
    pub fn rows(&self) -> Vec<Row> {
        use Dimension::{Area, Diffusion, Length, Plain, Rate, Speed, Time};
        let steps = self.steps.as_ref();
        let no_step = || self.without_steps();
        let of_steps = |value: Option<Option<Measured>>| {
            value.flatten().map_or_else(|| Answer::unknown(no_step()), Answer::Known)
        };
        let bare = |value: Option<f64>| of_steps(value.map(|value| Some(Measured { value, interval: None })));
        let form = |number: Option<FormNumber>| {
            number.map_or_else(|| Answer::unknown("no frame is seen"), |number| Answer::Known(number.mean))
        };
        let row = |key, name, dimension, value| Row { key, name, dimension, value };
        let mut rows = vec![
            row("speed", "speed", Speed, of_steps(steps.map(|s| s.speed))),
            row("rms_speed", "rms speed", Speed, self.rms_speed()),
            row("path", "path", Length, bare(steps.map(|s| s.path))),
            row("net_displacement", "displacement", Length, bare(steps.map(|s| s.net))),
            row("directionality", "directionality", Plain, bare(steps.and_then(|s| s.directionality))),
            row("turning_cosine", "turning cosine", Plain, of_steps(steps.map(|s| s.turning_cosine))),
            row("turning_rate", "turning rate", Rate, of_steps(steps.map(|s| s.turning_rate))),
            row(
                "persistence",
                "persistence",
                Time,
                self.of_walk(|walk| walk.persistence, "persistence time"),
            ),
            row(
                "diffusion",
                "diffusion",
                Diffusion,
                self.of_walk(|walk| walk.diffusion, "diffusion coefficient"),
            ),
            row("position_error", "place error", Length, self.of_walk(|walk| walk.error, "error")),
        ];
        rows.extend([
            row("area", "area", Area, form(self.forms.area)),
            row("perimeter", "perimeter", Length, form(self.forms.perimeter)),
            row("aspect_ratio", "aspect ratio", Plain, form(self.forms.aspect_ratio)),
            row("solidity", "solidity", Plain, form(self.forms.solidity)),
            row("circularity", "circularity", Plain, form(self.forms.circularity)),
        ]);
        rows
    }

    /// The speed without errors, or why these are not known.
    fn rms_speed(&self) -> Answer {
        match (self.steps.as_ref().and_then(|steps| steps.rms_speed), &self.walk) {
            (Some(speed), _) => Answer::Known(speed),
            (None, Some(walk)) if !walk.describes() => Answer::unknown(
                "the errors of the places are not known: no persistent random walk describes the path",
            ),
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
            return Answer::unknown("no persistent random walk describes the path");
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

/// Numbers of all cells as a table: the value and the ends of its interval; empty where there is none.
#[must_use]
pub fn number_columns(found: &[Observation]) -> Vec<Column> {
    let rows: Vec<Vec<Row>> = found.iter().map(|one| one.numbers.rows()).collect();
    let names = Values::Text(found.iter().map(|one| one.cell.clone()).collect());
    let seen = found.iter().map(|one| i64::try_from(one.numbers.seen).unwrap_or(i64::MAX)).collect();
    let motion = |one: &Observation| one.motion.regime.map_or("undecided", |regime| regime.name()).to_owned();
    let mut columns = vec![
        Column::new("cell", "name of the cell", names),
        Column::new("motion", "observed motion", Values::Text(found.iter().map(motion).collect())),
        Column::new("seen", "frames whose outline is seen", Values::Whole(seen)),
    ];
    for (place, row) in rows.first().into_iter().flatten().enumerate() {
        let value = |of: &dyn Fn(Measured) -> f64| {
            Values::Number(rows.iter().map(|all| all[place].value.known().map_or(f64::NAN, of)).collect())
        };
        columns.push(Column::new(row.key, row.name, value(&|found| found.value)));
        columns.push(Column::new(
            &format!("{}_low", row.key),
            "lower end of its 95 % interval",
            value(&|found| found.lower()),
        ));
        columns.push(Column::new(
            &format!("{}_high", row.key),
            "upper end of its 95 % interval",
            value(&|found| found.upper()),
        ));
    }
    columns
}
