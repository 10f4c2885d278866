//! Small paths of the motions of the largest regions.

use crate::atlas::folder::AtlasFolder;
use crate::atlas::grid::Found;
use crate::atlas::region::regions;
use motiform_analysis::{Course, Regime};
use motiform_figures::MapInset;
use motiform_lab::simulate::simulate;
use motiform_study::study::FigureSettings;
use motiform_study::{Error, Plan};
use std::f64::consts::TAU;

/// Regions that have paths.
const MOST: usize = 10;

/// Motions of a region that have paths.
const MOTIONS: usize = 2;

/// Looks of the model before a path: the way onto the motion; onto a straight one, of which any bend is seen, [`LONGEST`].
const SETTLED: f64 = 3.0;

/// Most looks of a path: of a body that turns too slowly to close its circle in them a part is shown.
const LONGEST: f64 = 20.0;

/// Rows of a path.
const ROWS: f64 = 600.0;

/// A path of each motion of the largest regions, from the start that led to it in the cell farthest from the border of the region; where a
/// motion has several courses (along a field and across it, of both senses) one of each.
pub(crate) fn insets(folder: &AtlasFolder) -> Result<Vec<MapInset>, Error> {
    let AtlasFolder { plan, grid, .. } = folder;
    let scan = plan.scan();
    let mut all = Vec::new();
    for region in regions(plan, grid).iter().filter(|region| region.motions.len() <= MOTIONS).take(MOST) {
        let place = &grid.places[region.inner];
        let cells: Vec<usize> = match &region.courses[..] {
            [] => vec![place.like.unwrap_or(region.inner)],
            courses => courses.iter().map(|(_, cell)| *cell).collect(),
        };
        let mut paths = Vec::new();
        for cell in &cells {
            let found = region.motions.iter().filter_map(|motion| grid.places[*cell].motion(*motion));
            let here = found.map(|found| path(folder, *cell, found)).collect::<Result<Vec<_>, Error>>()?;
            paths.push(here.into_iter().flatten().collect::<Vec<_>>());
        }
        // senses have regions of their own on the map, other courses are beside each other
        let by_sense = |(course, cell): &(Course, usize)| {
            let values = scan.axis_values(*cell);
            matches!(course, Course::Anticlockwise | Course::Clockwise).then_some([values[0], values[1]])
        };
        let places: Option<Vec<[f64; 2]>> = region.courses.iter().map(by_sense).collect();
        match places.filter(|places| !places.is_empty()) {
            Some(places) => {
                all.extend(places.into_iter().zip(paths).map(|(cell, paths)| MapInset { cell, paths }));
            }
            None => all.push(MapInset { cell: region.at, paths: paths.concat() }),
        }
    }
    all.retain(|inset| !inset.paths.is_empty());
    Ok(all)
}

/// The path of a motion; nothing of one that goes nowhere.
fn path(folder: &AtlasFolder, cell: usize, found: &Found) -> Result<Option<Vec<[f64; 2]>>, Error> {
    let (plan, scan) = (&folder.plan, folder.plan.scan());
    let look = scan.look_of(cell)?;
    let Some(t_end) = time(found, look).map(|time| time.min(LONGEST * look)) else { return Ok(None) };
    let computation = motiform_study::plan::Computation {
        transient: if found.regime == Regime::Straight { LONGEST } else { SETTLED } * look,
        t_end,
        dt_out: t_end / ROWS,
        ..plan.start(&scan, (cell, found.sample))?
    };
    let plan =
        Plan { name: String::new(), title: String::new(), computation, figure: FigureSettings::default() };
    let run = simulate(&plan, &())?;
    let column = |name| run.trajectory.get(name).unwrap_or(&[]);
    let whole = run.manifest.outcome.outcome.is_complete();
    Ok(whole.then(|| column("x").iter().zip(column("y")).map(|(x, y)| [*x, *y]).collect()))
}

/// Time for which a motion is shown: some of its periods, or a look at it.
fn time(found: &Found, look: f64) -> Option<f64> {
    let [_, turning, period, ..] = found.numbers;
    let periods = |count: f64| Some(period.map_or(look, |period| count * period));
    match found.regime {
        Regime::Straight | Regime::Rectangular | Regime::Chaotic => Some(look),
        Regime::Circular => turning.filter(|rate| *rate != 0.0).map(|rate| 0.9 * TAU / rate.abs()),
        Regime::Zigzag | Regime::PulsatingStraight => periods(2.5),
        Regime::QuasiPeriodic => periods(6.0),
        _ => None,
    }
}
