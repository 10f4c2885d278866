//! Numbers without a model over many cells: those of the walk of all together, or the reason why there are none.

use super::numbers::WALK;
use super::recordings::{Seen as _, Shape, Walker, tracks};
use super::samples::draws;
use motiform_cells::{Observation, Sample, observe, population_numbers};
use motiform_dynamics::Normal;
use motiform_statistics::furth;
use motiform_tracks::modes::ModeOptions;
use motiform_tracks::{Outline, centroid};

/// The mean-square displacement of many cells is that of the walk, and its intervals over cells hold it.
#[test]
fn displacements_over_cells_are_those_of_the_walk() {
    let cells = (0..16).map(|seed| WALK.outlines(100 + seed)).collect();
    let sample = Sample::of_tracks(tracks(cells).with_gaps(0.3, 5), &ModeOptions::default());
    let found: Vec<Observation> = sample.cells.iter().map(observe).collect();
    let population = population_numbers(&found);
    assert_eq!(population.displacement_cells, 16);
    let points = population.displacement.iter().filter(|at| at.lag <= 40.0);
    let inside = points.map(|at| {
        let exact = furth(WALK.speed * WALK.speed, WALK.persistence, at.lag);
        let [low, high] = at.value.interval.expect("16 cells");
        // the error of a centroid of 48 vertices is 0.003: 4 sigma^2 is below the interval
        u32::from(low < exact && exact < high)
    });
    let inside: Vec<u32> = inside.collect();
    // lags share their data: all of them are in or out together
    assert!(inside.iter().sum::<u32>() as usize * 10 >= 7 * inside.len(), "{:?}", population.displacement);
    let speed =
        population.numbers.iter().find(|number| number.quantity.name == "speed").expect("all have one");
    assert_eq!(speed.over.cells, 16);
}

/// Places without errors: roots of variances that are below 0 as often as above have a mean above 0; its interval holds 0.
#[test]
fn places_without_errors_have_an_error_that_may_be_0() {
    let walk = Walker { speed: 1.0, persistence: 4.0, shape: Shape::Round, frames: 200, noise: 0.0 };
    let sets = 30;
    let holds = |set: &u64| {
        let mut cells: Vec<_> = (0..12).map(|cell| walk.outlines(5000 + 12 * set + cell)).collect();
        for outline in cells.iter_mut().flatten() {
            outline.points = vec![centroid(&outline.points)];
        }
        let sample = Sample::of_tracks(tracks(cells), &ModeOptions::default());
        let found = population_numbers(&sample.cells.iter().map(observe).collect::<Vec<_>>());
        let error = found.numbers.iter().find(|number| number.quantity.name == "position_error");
        error.is_none_or(|error| error.over.mean_interval.is_none_or(|ends| ends[0] == 0.0 && ends[1] > 0.0))
    };
    let held = (0..sets).filter(holds).count();
    println!("held in {held} of {sets}");
    assert!(held >= 26, "{held}"); // 95 % of 30 are 28.5 -+ 1.2
}

/// Fractional Brownian motion (H = 0.35), by the recursion of Durbin and Levinson: 1 over each frame, and held back over longer times.
fn fractional(samples: usize, normal: &mut Normal) -> Vec<f64> {
    let power = |k: f64| libm::pow(k.abs(), 0.7);
    let rho = |k: usize| 0.5 * (power(k as f64 + 1.0) - 2.0 * power(k as f64) + power(k as f64 - 1.0));
    let (mut weights, mut variance): (Vec<f64>, f64) = (Vec::new(), 1.0);
    let (mut steps, mut place): (Vec<f64>, Vec<f64>) = (Vec::new(), vec![0.0]);
    for k in 0..samples {
        if k > 0 {
            let past: f64 = (0..k - 1).map(|j| weights[j] * rho(k - 1 - j)).sum();
            let last = (rho(k) - past) / variance;
            let before = weights.clone();
            weights = (0..k - 1).map(|j| before[j] - last * before[k - 2 - j]).chain([last]).collect();
            variance *= 1.0 - last * last;
        }
        let mean: f64 = (0..k).map(|j| weights[j] * steps[k - 1 - j]).sum();
        steps.push(mean + variance.sqrt() * normal.next());
        place.push(place[k] + steps[k]);
    }
    place
}

/// Cells that subdiffuse have no diffusion coefficient: of single ones it hardly shows, of all together it does.
#[test]
fn subdiffusion_of_a_population_has_no_coefficient() {
    let withheld = |set: &u64| {
        let cell = |number: u64| {
            let mut normal = Normal::new(8000 + set, number);
            let [x, y] = [0; 2].map(|_| fractional(120, &mut normal));
            let outline = |k: usize| Outline {
                frame: i64::try_from(k).expect("small"),
                t: k as f64,
                points: vec![[x[k] + 40.0 * number as f64, y[k]]],
                missing: 0,
            };
            (0..x.len()).map(outline).collect()
        };
        let sample = Sample::of_tracks(tracks((0..20).map(cell).collect()), &ModeOptions::default());
        let found = population_numbers(&sample.cells.iter().map(observe).collect::<Vec<_>>());
        found.numbers.iter().all(|number| number.quantity.name != "diffusion")
    };
    let count = (0..10).filter(withheld).count();
    println!("withheld in {count} of 10");
    assert!(count >= 8, "{count}");
}

/// A mean of the persistence over cells holds the truth where there is one. There is none where it is nearly as long as the records, so
/// that each cell knows it poorly, or shorter than the time between frames, so that most cells only bound it.
#[test]
fn means_over_cells_that_would_be_biased_are_withheld() {
    let found = |persistence: f64, frames: usize| {
        let walker = Walker { persistence, frames, shape: Shape::Round, ..WALK };
        let cells = (0..draws(12, 30)).map(|seed| walker.outlines(300 + seed)).collect();
        let sample = Sample::of_tracks(tracks(cells), &ModeOptions::default());
        population_numbers(&sample.cells.iter().map(observe).collect::<Vec<_>>())
    };
    for (persistence, reason) in
        [(80.0, ["within a factor of", "only bound it"]), (0.15, ["only bound it"; 2])]
    {
        let found = found(persistence, 120);
        let why = found.withheld.iter().find(|one| one.quantity.name == "persistence").map(|one| &*one.why);
        assert!(why.is_some_and(|why| reason.iter().any(|one| why.contains(one))), "{persistence}: {why:?}");
        assert!(found.numbers.iter().all(|one| one.quantity.name != "persistence"));
    }
    let long = found(3.0, 600);
    assert!(long.withheld.is_empty(), "{:?}", long.withheld);
    let stated =
        long.numbers.iter().find(|one| one.quantity.name == "persistence").expect("all cells have one");
    let [low, high] = stated.over.mean_interval.expect("many cells");
    assert!(low < 3.0 && 3.0 < high && high < draws(1.5, 1.3) * low, "{:?}", stated.over);
}

/// The place of a frame, from all places of a path.
type Change = dyn Fn(&[[f64; 2]], usize) -> [f64; 2];

/// Cells in reflecting squares have no diffusion coefficient, neither each nor together, and the reason says that they are held back; the
/// same walkers without walls have one. So are walkers that rest from the middle on without one: the record is not stationary.
#[test]
fn cells_that_are_held_or_come_to_rest_have_no_diffusion() {
    let walker = Walker { speed: 1.0, persistence: 8.0, shape: Shape::Round, frames: 400, noise: 0.01 };
    let changed = |change: &Change| {
        let cell = |seed: u64| {
            let mut outlines = walker.outlines(600 + seed);
            let path: Vec<[f64; 2]> = outlines.iter().map(|outline| centroid(&outline.points)).collect();
            for (k, outline) in outlines.iter_mut().enumerate() {
                let to = change(&path, k);
                outline
                    .points
                    .iter_mut()
                    .for_each(|point| *point = [0, 1].map(|c| point[c] + to[c] - path[k][c]));
            }
            outlines
        };
        let sample = Sample::of_tracks(tracks((0..12).map(cell).collect()), &ModeOptions::default());
        sample.cells.iter().map(observe).collect::<Vec<Observation>>()
    };
    let why = |found: &[Observation]| -> Vec<String> {
        found.iter().filter_map(|one| one.numbers.stated_walk.diffusion.reason.clone()).collect()
    };
    // reflected by a square: coordinates are folded at its sides
    let held = changed(&|path, k| path[k].map(|x| (libm::remainder(x - 10.0, 40.0)).abs() - 10.0));
    let reasons = why(&held);
    assert!(reasons.len() >= 11 && reasons.iter().any(|why| why.contains("held back")), "{reasons:?}");
    let together = population_numbers(&held);
    assert!(together.numbers.iter().all(|one| one.quantity.name != "diffusion"), "{:?}", together.withheld);
    let rests = why(&changed(&|path, k| path[k.min(200)]));
    assert!(rests.len() >= 11 && rests.iter().any(|why| why.contains("stationary")), "{rests:?}");
    let free = why(&changed(&|path, k| path[k]));
    assert!(free.len() <= 2, "{free:?}");
}
