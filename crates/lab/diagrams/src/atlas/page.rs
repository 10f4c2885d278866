//! The page of an atlas: the map, its regions, its boundaries, what was followed.

use crate::atlas::boundary::{Boundary, boundaries};
use crate::atlas::courses::mixed_courses;
use crate::atlas::draw::atlas_map;
use crate::atlas::folder::AtlasFolder;
use crate::atlas::grid::Found;
use crate::atlas::line::EndKind;
use crate::atlas::points::special_points;
use crate::atlas::region::{Region, regions};
use crate::atlas::summary::words;
use crate::curves::curve_ends;
use motiform_analysis::Regime;
use motiform_dynamics::digits::{four_digits, value_and_error, with_error};
use motiform_dynamics::in_words;
use motiform_figures::Style;
use motiform_figures::report::{Cell, Report, ReportFigure, Section, Table};
use motiform_lab::draw::{sheet_in, symbol};
use motiform_study::titles::number;
use motiform_study::{AtlasPlan, Error, counted};

/// Part of the plane to which points are stated.
const PLACE: f64 = 1e-5;

/// Smaller regions, in cells, are counted and not listed: few initial states make regions of single cells.
const LISTED: usize = 3;

/// The page: HTML that refers to nothing outside itself, with the map in a style.
///
/// # Errors
/// An unknown model, or numbers that no axis can hold.
pub fn html(folder: &AtlasFolder, style: &Style) -> Result<String, Error> {
    let map = sheet_in(atlas_map(folder)?, style)?;
    let plane = Section {
        title: "The plane".to_owned(),
        about: "Colours: motions that were found. Lines: where a motion gains or loses its stability, by continuation.".to_owned(),
        figures: vec![ReportFigure::new(map, "The atlas.")],
        ..Section::default()
    };
    let (all, about) = all_regions(folder);
    let no_points = match folder.lines.iter().any(|line| !line.curves.is_empty()) {
        true => "The curves and branches that were followed have none.",
        false => "No curve was followed that could have one.",
    };
    let sections = vec![
        plane,
        section("Regions", about, "No region has so many cells.", all),
        section(
            "Boundaries",
            "Edges of neighbouring cells with different motions, and the bifurcations between them.".to_owned(),
            "There are none: all cells have the same motions.",
            boundary_table(folder),
        ),
        section(
            "Points of codimension two, and ends of motions",
            String::new(),
            no_points,
            point_table(folder)?,
        ),
        section(
            "What was followed",
            "Each line begins with a motion on one side of a boundary and goes through it, over the whole range.".to_owned(),
            why_no_line(&folder.plan),
            line_table(folder)?,
        ),
    ];
    let title = format!("Atlas: {}", folder.plan.title);
    Ok(Report { title, sections, without_captions: style.no_caption, ..Report::default() }.html())
}

/// A section with a table; without rows a sentence that says so.
fn section(title: &str, about: String, none: &str, table: Table) -> Section {
    let title = title.to_owned();
    match table.rows.is_empty() {
        true => {
            Section { title, about: format!("{about} {none}").trim_start().to_owned(), ..Section::default() }
        }
        false => Section { title, about, tables: vec![table], ..Section::default() },
    }
}

fn heads(texts: &[&str]) -> Vec<String> {
    texts.iter().map(|text| (*text).to_owned()).collect()
}

fn places(folder: &AtlasFolder) -> Result<[String; 2], Error> {
    let info = folder.plan.info()?;
    Ok(folder.plan.plane().map(|side| symbol(info, &side.name)))
}

/// The regions, and what is said above them.
fn all_regions(folder: &AtlasFolder) -> (Table, String) {
    let all = regions(&folder.plan, &folder.grid);
    let (listed, small): (Vec<&Region>, Vec<&Region>) = all.iter().partition(|region| region.cells >= LISTED);
    let row = |region: &&Region| {
        let place = &folder.grid.places[region.inner];
        let numbers = |pick: &dyn Fn(&Found) -> String| {
            let all = region
                .motions
                .iter()
                .map(|motion| place.motion(*motion).map_or("not in this cell".to_owned(), pick));
            Cell::number(all.collect::<Vec<_>>().join("; "))
        };
        vec![
            Cell::text(words(&region.motions)),
            Cell::number(format!("{:.1}\u{a0}%", 100.0 * region.share)),
            Cell::number(format!("{}, {}", number(region.at[0]), number(region.at[1]))),
            numbers(&|found| found.numbers[0].map_or_else(|| "not measured".to_owned(), four_digits)),
            numbers(&period),
            numbers(&exponent),
        ]
    };
    let table = Table {
        caption: String::new(),
        head: heads(&["Motions", "Share of the plane", "Inside at", "Mean speed", "Period", "*λ*_1"]),
        rows: listed.iter().map(row).collect(),
    };
    let left_out = match small.len() {
        0 => String::new(),
        count => format!(" {} of fewer than {LISTED} cells are left out.", counted(count, "region")),
    };
    let mixed: String = mixed_courses(&folder.grid).iter().map(|words| format!(" {words}.")).collect();
    let about = format!(
        "Connected cells with the same motions.{left_out} Numbers, in model units, are those of the cell farthest from the border.{mixed}"
    );
    (table, about)
}

/// The period, or why there is none.
fn period(found: &Found) -> String {
    let none = match found.regime {
        Regime::Motionless | Regime::Straight | Regime::Circular | Regime::Spinning => "steady",
        Regime::Rectangular => "rests without a fixed length",
        Regime::Chaotic | Regime::BlowUp => "none",
        Regime::PulsatingStraight | Regime::QuasiPeriodic | Regime::Zigzag | Regime::Undetermined => {
            "not determined"
        }
    };
    found.numbers[2].map_or_else(|| none.to_owned(), four_digits)
}

/// The largest exponent, or why there is none.
fn exponent(found: &Found) -> String {
    let [.., value, error] = found.numbers;
    match (value, error) {
        // exactly 0 where no deviation grows or decays: the rotations of a steady motion
        (Some(0.0), Some(0.0)) => "0".to_owned(),
        (Some(value), Some(error)) => with_error(value, error).replace(' ', "\u{a0}"),
        _ => "not computed".to_owned(),
    }
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
            Cell::text(boundary.why.unwrap_or("all are named")),
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
    let plane = folder.plan.plane();
    let row = |kind: String, motion: Regime, at: [f64; 2], period: String| {
        let place = |side: usize| {
            let [value, _] = value_and_error(at[side], PLACE * (plane[side].to - plane[side].from).abs(), 1);
            Cell::number(value)
        };
        vec![Cell::text(kind), Cell::text(motion.words()), place(0), place(1), Cell::number(period)]
    };
    let marks = special_points(folder).into_iter().map(|point| {
        let period = point.sample.period.map_or_else(|| "steady".to_owned(), four_digits);
        row(point.words(), point.on.motion, point.sample.parameters, period)
    });
    let ends = folder.lines.iter().flat_map(|line| &line.ends).map(|end| {
        let period = match end.kind {
            EndKind::Connection(_) => "grows without bound",
            EndKind::Crossing(_) => "not stated",
        };
        row(end.kind.words().to_owned(), end.motion, end.at, period.to_owned())
    });
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
            format!(
                "{} of {} motion (ends: {ends}{refused})",
                in_words(one.curve.kind.name()),
                one.motion.words()
            )
        });
        let curves: Vec<String> = curves.chain(line.refused.clone()).collect();
        rows.push(vec![
            Cell::number(format!("{}, {}", number(line.at[0]), number(line.at[1]))),
            Cell::text(symbols[line.side].clone()),
            Cell::text(line.motion.words()),
            Cell::number(line.branches.to_string()),
            Cell::text(if curves.is_empty() { "none".to_owned() } else { curves.join("; ") }),
        ]);
    }
    let head = heads(&["Begins at", "Along", "With", "Branches", "New curves"]);
    Ok(Table { caption: String::new(), head, rows })
}

/// The reason why there is no line across a boundary, where there is none.
pub fn why_no_line(plan: &AtlasPlan) -> &'static str {
    match plan.computation.lines {
        0 => "No lines were asked for.",
        _ => "No line was followed: there is no boundary that one could go through.",
    }
}
