//! The map of an atlas: regions with their names, curves with their kinds, ends of motions, points of codimension two.

use crate::atlas::folder::AtlasFolder;
use crate::atlas::inset::insets;
use crate::atlas::points::special_points;
use crate::branches::draw::{curve_mark, curve_stretches, marks_together, unlocated};
use crate::curves::CurveSample;
use motiform_continuation::Degenerate;
use motiform_figures::{Cell, CurveMap, MapEnd, PhaseDiagram};
use motiform_lab::draw::{FigureFormat, Picture, files, symbol, words};
use motiform_lab::scan::motion_mark;
use motiform_study::{Error, counted};

/// Draws `atlas`: as SVG and PNG, with its numbers as CSV.
///
/// # Errors
/// An unknown model, or numbers that no axis can hold.
pub fn draw_atlas(folder: &AtlasFolder, format: &FigureFormat) -> Result<Vec<Picture>, Error> {
    files(vec![("atlas", Box::new(atlas_map(folder)?))], true, format)
}

/// The map of an atlas: its regions by colour, with the curves and points that bound them.
///
/// # Errors
/// An unknown model.
pub fn atlas_map(folder: &AtlasFolder) -> Result<CurveMap, Error> {
    let AtlasFolder { plan, lines, .. } = folder;
    let (info, plane) = (plan.info()?, plan.plane());
    let [x, y] = plane.each_ref().map(|side| [side.from, side.to]);
    let curves = || lines.iter().flat_map(|line| &line.curves).map(|one| &one.curve);
    let stretches = curves().flat_map(curve_stretches).filter(|stretch| stretch.bounds);
    let ends = lines.iter().flat_map(|line| &line.ends);
    let insets = insets(folder)?;
    Ok(CurveMap {
        title: plan.title.clone(),
        caption: caption(folder, !insets.is_empty())?,
        x_label: symbol(info, &plane[0].name),
        y_label: symbol(info, &plane[1].name),
        x,
        y,
        under: Some(cells(folder)),
        named: true,
        insets,
        curves: stretches.collect(),
        ends: ends.map(|end| MapEnd { label: end.kind.words().to_owned(), at: end.at }).collect(),
        marks: marks_together(points(folder).into_iter().filter_map(curve_mark), [x, y]),
    })
}

/// The points of codimension two on curves that bound regions.
fn points(folder: &AtlasFolder) -> Vec<(Degenerate, &CurveSample)> {
    let all = special_points(folder).into_iter();
    all.filter(|point| point.sample.unstable == 0).map(|point| (point.kind, point.sample)).collect()
}

/// The motions of the cells.
fn cells(folder: &AtlasFolder) -> PhaseDiagram {
    let scan = folder.plan.scan();
    let cell = |(cell, place): (usize, &crate::atlas::Place)| {
        let at = scan.axis_values(cell);
        let rows: usize = place.motions.iter().map(|found| found.rows).sum();
        let share = |found: &crate::atlas::Found| {
            let course = match found.courses[..] {
                [one] => Some(one),
                _ => None,
            };
            (motion_mark(found.regime, course).name.to_owned(), found.rows as f64 / rows as f64)
        };
        Cell { x: at[0], y: at[1], shares: place.motions.iter().map(share).collect() }
    };
    PhaseDiagram {
        x: scan.computation.axes[0].values.clone(),
        y: scan.computation.axes[1].values.clone(),
        cells: folder.grid.places.iter().enumerate().map(cell).collect(),
        ..PhaseDiagram::default()
    }
}

/// Words below the map; `paths`: regions have paths.
fn caption(folder: &AtlasFolder, paths: bool) -> Result<Vec<String>, Error> {
    let AtlasFolder { plan, grid, lines } = folder;
    let c = &plan.computation.scan;
    let varied: Vec<&str> = c.axes.iter().map(|axis| axis.name.as_str()).collect();
    let curves: usize = lines.iter().map(|line| line.curves.len()).sum();
    let limits = match curves {
        0 => "No stability limit was followed".to_owned(),
        _ => format!("Stability limits: {} by pseudo-arclength continuation", counted(curves, "curve")),
    };
    let below = if paths {
        " Below the names of wide regions: one path for each course of a motion, not to one scale."
    } else {
        ""
    };
    let mut all = vec![
        words::named(plan.info()?, &c.parameters, &varied, &c.ties),
        format!(
            "Motions of {} each ({}, seed {}) in {} of {} cells; the others lie between cells with the same motions. {limits}.{below}",
            counted(c.samples, "initial state"),
            c.random.words(),
            c.seed,
            grid.computed(),
            grid.places.len(),
        ),
    ];
    all.extend(unlocated(points(folder).into_iter()));
    Ok(all)
}
