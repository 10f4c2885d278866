//! Numbers over cells.

use super::displacement;
use super::places::Places;
use crate::{AtLag, Observation, OverCells, over_cells};
use motiform_dynamics::order::ascending;
use motiform_study::Quantity;
use serde::{Serialize, Serializer};

/// A number over cells.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PopulationNumber {
    /// The number.
    #[serde(rename = "key", serialize_with = "by_name")]
    pub quantity: &'static Quantity,
    /// Over the cells that have it.
    #[serde(flatten)]
    pub over: OverCells,
}

fn by_name<S: Serializer>(quantity: &&'static Quantity, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(quantity.name)
}

/// Numbers over cells. Cells whose record sets no bound to a number are not in it: `cells` of each number says how many are.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PopulationNumbers {
    /// Each number over the cells that have it.
    pub numbers: Vec<PopulationNumber>,
    /// Mean-square displacement over the cells of the usual sampling interval; intervals are those over cells, from 8 on.
    pub displacement: Vec<AtLag>,
    /// Cells in it.
    pub displacement_cells: usize,
}

/// Numbers over these cells.
#[must_use]
pub fn population_numbers(found: &[Observation]) -> PopulationNumbers {
    let rows: Vec<_> = found.iter().map(|one| one.numbers.rows()).collect();
    let number = |place: usize| {
        let values: Vec<f64> = rows.iter().filter_map(|all| Some(all[place].value.known()?.value)).collect();
        Some(PopulationNumber { quantity: rows[0][place].quantity, over: over_cells(&values)? })
    };
    let count = rows.first().map_or(0, Vec::len);
    let places = usual(found);
    PopulationNumbers {
        numbers: (0..count).filter_map(number).collect(),
        displacement: displacement::of_cells(&places),
        displacement_cells: places.len(),
    }
}

/// Places of the cells of the median sampling interval.
fn usual(found: &[Observation]) -> Vec<&Places> {
    let all = || found.iter().map(|one| &one.numbers.places).filter(|places| places.interval > 0.0);
    let mut intervals: Vec<f64> = all().map(|places| places.interval).collect();
    ascending(&mut intervals);
    let Some(usual) = intervals.get(intervals.len() / 2).copied() else { return Vec::new() };
    all().filter(|places| (places.interval / usual - 1.0).abs() < 1e-3).collect()
}
