//! The page of an atlas: the map, its regions, its boundaries, what was followed.

use crate::atlas::boundary::{Boundary, boundaries};
use crate::atlas::courses::mixed_courses;
use crate::atlas::draw::atlas_map;
use crate::atlas::folder::AtlasFolder;
use crate::atlas::grid::Found;
use crate::atlas::points::special_points;
use crate::atlas::region::{Region, regions};
use crate::atlas::summary::words;
use crate::branches::draw::curve_words;
use crate::curves::curve_ends;
use motiform_figures::Style;
use motiform_figures::report::{Cell, Report, ReportFigure, Section, Table};
use motiform_lab::draw::{sheet_in, symbol};
use motiform_study::Error;
use motiform_study::titles::number;

/// Smaller regions, in cells, are counted and not listed: few initial states make regions of single cells.
const LISTED: usize = 3;

/// The page: HTML that refers to nothing outside itself, with the map in a style.
///
/// # Errors
/// An unknown model, or numbers that no axis can hold.
pub fn html(folder: &AtlasFolder, style: &Style) -> Result<String, Error> {
    let map = sheet_in(atlas_map(folder)?, style)?;
    let (all, short) = all_regions(folder);
    let sections = vec![
        Section {
            title: "The plane".to_owned(),
            about: "Colours: motions that were found. Lines: where a motion gains or loses its stability, by continuation.".to_owned(),
            figures: vec![ReportFigure::new(map, "The atlas.")],
            ..Section::default()
        },
        Section {
            title: "Regions".to_owned(),
            about: format!(
                "Connected cells with the same motions. {short} regions of fewer than {LISTED} cells are left out. \
                 Numbers are those of the cell farthest from the border.{}",
                mixed_courses(&folder.grid).iter().map(|words| format!(" {words}.")).collect::<String>()
            ),
            tables: vec![all],
            ..Section::default()
        },
        Section {
            title: "Boundaries".to_owned(),
            about: "Edges of neighbouring cells with different motions, and the bifurcations between them.".to_owned(),
            tables: vec![boundary_table(folder)],
            ..Section::default()
        },
        Section {
            title: "Points of codimension two, and ends of motions".to_owned(),
            tables: vec![point_table(folder)?],
            ..Section::default()
        },
        Section {
            title: "What was followed".to_owned(),
            about: "Each line begins with a motion on one side of a boundary and goes through it, over the whole range.".to_owned(),
            tables: vec![line_table(folder)?],
            ..Section::default()
        },
    ];
    let title = format!("Atlas: {}", folder.plan.title);
    Ok(Report { title, sections, without_captions: style.no_caption, ..Report::default() }.html())
}

fn heads(texts: &[&str]) -> Vec<String> {
    texts.iter().map(|text| (*text).to_owned()).collect()
}

fn places(folder: &AtlasFolder) -> Result<[String; 2], Error> {
    let info = folder.plan.info()?;
    Ok(folder.plan.plane().map(|side| symbol(info, &side.name)))
}

/// The regions, and how many are too small.
fn all_regions(folder: &AtlasFolder) -> (Table, usize) {
    let all = regions(&folder.plan, &folder.grid);
    let (listed, small): (Vec<&Region>, Vec<&Region>) = all.iter().partition(|region| region.cells >= LISTED);
    let row = |region: &&Region| {
        let place = &folder.grid.places[region.inner];
        let numbers = |pick: &dyn Fn(&Found) -> Option<String>| {
            let all = region.motions.iter().map(|motion| place.motion(*motion).and_then(pick));
            Cell::number(all.map(|one| one.unwrap_or_else(|| "-".to_owned())).collect::<Vec<_>>().join("; "))
        };
        let one = |at: usize| move |found: &Found| found.numbers[at].map(|value| format!("{value:.4}"));
        let exponent = |found: &Found| {
            let [.., value, error] = found.numbers;
            // exactly 0 where no deviation grows or decays: the rotations of a steady motion
            if (value, error) == (Some(0.0), Some(0.0)) {
                return Some("0".to_owned());
            }
            Some(format!("{:.4}\u{a0}±\u{a0}{:.1e}", value?, error?))
        };
        vec![
            Cell::text(words(&region.motions)),
            Cell::number(format!("{:.1}\u{a0}%", 100.0 * region.share)),
            Cell::number(format!("{}, {}", number(region.at[0]), number(region.at[1]))),
            numbers(&one(0)),
            numbers(&one(2)),
            numbers(&exponent),
        ]
    };
    let table = Table {
        caption: String::new(),
        head: heads(&["Motions", "Share of the plane", "Inside at", "Mean speed", "Period", "*λ*_1"]),
        rows: listed.iter().map(row).collect(),
    };
    (table, small.len())
}

fn boundary_table(folder: &AtlasFolder) -> Table {
    let row = |boundary: Boundary| {
        let kinds = boundary.kinds.iter().map(|(kind, edges)| format!("{kind} ({edges})"));
        let mut named: Vec<String> = kinds.collect();
        if boundary.unnamed > 0 {
            named.push(format!("not named ({})", boundary.unnamed));
        }
        vec![
            Cell::text(format!("{} | {}", words(&boundary.between[0]), words(&boundary.between[1]))),
            Cell::number(boundary.edges.to_string()),
            Cell::text(named.join(", ")),
            Cell::text(boundary.why.unwrap_or_default()),
        ]
    };
    Table {
        caption: String::new(),
        head: heads(&["Between", "Edges", "Bifurcations", "Why not all are named"]),
        rows: boundaries(&folder.plan, &folder.grid, &folder.lines).into_iter().map(row).collect(),
    }
}

fn point_table(folder: &AtlasFolder) -> Result<Table, Error> {
    let [x, y] = places(folder)?;
    let row = |kind: String, motion: &str, at: [f64; 2], period: Option<f64>| {
        vec![
            Cell::text(kind),
            Cell::text(motion),
            Cell::number(format!("{:.6}", at[0])),
            Cell::number(format!("{:.6}", at[1])),
            Cell::number(period.map_or_else(|| "-".to_owned(), |period| format!("{period:.4}"))),
        ]
    };
    let marks = special_points(folder).into_iter().map(|point| {
        row(point.words(), point.on.motion.name(), point.sample.parameters, point.sample.period)
    });
    let ends = folder.lines.iter().flat_map(|line| &line.ends);
    let ends = ends.map(|end| row(end.kind.words().to_owned(), end.motion.name(), end.at, None));
    Ok(Table {
        caption: String::new(),
        head: vec!["What".into(), "Motion".into(), x, y, "Period".into()],
        rows: marks.chain(ends).collect(),
    })
}

fn line_table(folder: &AtlasFolder) -> Result<Table, Error> {
    let (symbols, scan) = (places(folder)?, folder.plan.scan());
    let mut rows = Vec::new();
    for line in &folder.lines {
        let plan = folder.plan.line(&scan, line.start, line.side)?;
        let curves = line.curves.iter().map(|one| {
            let ends = curve_ends(&plan, &one.curve).join("; ");
            let refused =
                one.curve.refused.as_ref().map_or(String::new(), |why| format!(", not followed: {why}"));
            format!("{} of {} motion (ends: {ends}{refused})", curve_words(one.curve.kind), one.motion)
        });
        rows.push(vec![
            Cell::number(format!("{}, {}", number(line.at[0]), number(line.at[1]))),
            Cell::text(symbols[line.side].clone()),
            Cell::text(line.motion.name()),
            Cell::number(line.branches.to_string()),
            Cell::text(curves.chain(line.refused.clone()).collect::<Vec<_>>().join("; ")),
        ]);
    }
    let head = heads(&["Begins at", "Along", "With", "Branches", "New curves"]);
    Ok(Table { caption: String::new(), head, rows })
}
