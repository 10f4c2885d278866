//! Directions of motions that a map does not tell apart.

use crate::atlas::grid::Grid;
use motiform_analysis::{Course, Regime};

/// The motions that have several courses in a plane (along a field and across it, or of both hands), in sentences with the number of
/// cells of each: regions and boundaries have names of motions alone.
pub fn mixed_courses(grid: &Grid) -> Vec<String> {
    let cells = |regime: Regime, course: Course| {
        let computed = grid.places.iter().filter(|place| place.like.is_none());
        let here = computed.filter_map(|place| place.motion(regime));
        here.filter(|found| found.courses.contains(&course)).count()
    };
    let mixed = |regime: Regime| {
        let counts: Vec<String> = Course::ALL
            .into_iter()
            .map(|course| (cells(regime, course), course.words()))
            .filter(|(cells, _)| *cells > 0)
            .map(|(cells, words)| format!("{words} in {cells} computed cells"))
            .collect();
        let remedy = "regions do not tell these apart, the column 'course' of a scan does";
        (counts.len() > 1)
            .then(|| format!("Motion '{}' goes {}; {remedy}", regime.words(), counts.join(", ")))
    };
    Regime::ALL.into_iter().filter_map(mixed).collect()
}
