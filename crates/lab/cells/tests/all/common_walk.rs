//! Numbers over cells: the order of cells, views that cells leave, stages that drift.

use super::recordings::{Shape, Walker, tracks};
use motiform_cells::{Observation, Sample, observe, population_numbers, population_statistics};
use motiform_tracks::modes::ModeOptions;
use motiform_tracks::{Outline, centroid};

const WALK: Walker = Walker { speed: 0.6, persistence: 4.0, shape: Shape::Round, frames: 120, noise: 0.01 };

fn observed(cells: Vec<Vec<Outline>>) -> Vec<Observation> {
    Sample::of_tracks(tracks(cells), &ModeOptions::default()).cells.iter().map(observe).collect()
}

/// The same cells in the opposite order: every number over cells, with its interval, is the same.
#[test]
fn the_order_of_cells_changes_nothing() {
    let mut cells: Vec<Vec<Outline>> = (0..9).map(|seed| WALK.outlines(40 + seed)).collect();
    let one = observed(cells.clone());
    cells.reverse();
    let other = observed(cells);
    assert_eq!(population_numbers(&one), population_numbers(&other));
    let [one, other] = [one, other].map(|found| population_statistics(&found).expect("long enough").1);
    assert_eq!((one.walk, one.displacement), (other.walk, other.displacement));
}

/// Walkers whose tracks end where they leave a square have no walk over cells and no intervals of displacements, with the reason; the same
/// walkers whose tracks end at the same times have both.
#[test]
fn tracks_that_end_where_cells_leave_the_view_are_seen() {
    let placed = |seed: u64| {
        let mut cell = WALK.outlines(700 + seed);
        let [x, y] = [seed % 5, seed / 5].map(|k| 4.0 * k as f64 - 8.0);
        cell.iter_mut().flat_map(|outline| &mut outline.points).for_each(|p| *p = [p[0] + x, p[1] + y]);
        cell
    };
    let all: Vec<Vec<Outline>> = (0..25).map(placed).collect();
    let inside = |outline: &Outline| centroid(&outline.points).iter().all(|x| x.abs() < 10.0);
    let left: Vec<Vec<Outline>> =
        all.iter().map(|cell| cell.iter().take_while(|one| inside(one)).cloned().collect()).collect();
    let cut: Vec<Vec<Outline>> =
        all.iter().zip(left.iter().rev()).map(|(cell, left)| cell[..left.len()].to_vec()).collect();
    let why = |cells: Vec<Vec<Outline>>| {
        let found = population_numbers(&observed(cells));
        let reasons: String = found.withheld.into_iter().map(|one| one.why).collect();
        let banded = found.displacement.first().is_some_and(|at| at.value.interval.is_some());
        (reasons.contains("side of the view"), banded)
    };
    let long = |cells: &[Vec<Outline>]| cells.iter().filter(|cell| cell.len() > 2).cloned().collect();
    assert_eq!(why(long(&left)), (true, false));
    assert_eq!(why(long(&cut)), (false, true));
}

/// Cells on a stage that drifts are no walks, alone or together; where the drift is subtracted they are.
#[test]
fn cells_that_drift_together_are_no_walks() {
    let drifting = |seed: u64| {
        let mut cell = WALK.outlines(900 + seed);
        for outline in &mut cell {
            let by = 0.3 * outline.t;
            outline.points.iter_mut().for_each(|p| p[0] += by);
        }
        cell
    };
    let found = observed((0..12).map(drifting).collect());
    let reasons = found.iter().filter_map(|one| one.numbers.stated_walk.reason.as_deref());
    // others may be no walks for a reason of their own
    assert!(reasons.filter(|why| why.contains("drift together")).count() >= 10);
    let walk = population_statistics(&found).expect("long enough").1.walk;
    assert!(walk.diffusion.reason().is_some_and(|why| why.contains("drift")), "{walk:?}");
}
