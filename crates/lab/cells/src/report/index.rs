//! The page of the data set: all cells in a table, the population, all places.

use crate::Units;
use crate::report::numbers::estimate;
use crate::report::place::{self, PLANES, map, notation};
use crate::report::{Case, Setting, fitted, free, page_name, population, words};
use crate::{Agreement, CellFit, Fitted, Sample};
use motiform_analysis::regime::Regime;
use motiform_figures::literal;
use motiform_figures::report::{Cell, Report, Section, Table};
use motiform_inference::{Place, Placement};
use motiform_study::quantity::cell;
use motiform_study::titles::capital;
use motiform_study::{Error, Quantity};

/// The motion of a cell whose data leave several.
const UNDECIDED: &str = "undecided";

/// Numbers without a model in the table of all cells.
const FREE: [&Quantity; 4] = [&cell::SPEED, &cell::PERSISTENCE, &cell::AREA, &cell::ASPECT_RATIO];

pub(crate) fn report(
    sample: &Sample,
    cases: &[Case<'_>],
    together: Option<&CellFit>,
    names: &[String],
    setting: &Setting<'_>,
) -> Result<Report, Error> {
    let units = &setting.units;
    let mut sections = vec![Section {
        title: "Cells".to_owned(),
        tables: tables(cases, names, units),
        ..Section::default()
    }];
    if let Some(fit) = together {
        sections.extend(one_law(fit, setting)?);
    }
    sections.extend(field(sample, units));
    sections.extend(population::section(cases, setting)?);
    sections.extend(places(cases, setting)?);
    sections.extend(notes(sample));
    let about = format!(
        "{}; lengths in {}, times in {}. A name is given where the data leave no other; otherwise a motion is \
         'undecided', and the page of the cell says what is missing.",
        sample.tracks.size(),
        units.length,
        units.time
    );
    Ok(Report {
        title: "Tracked cells".to_owned(),
        about,
        sections,
        glossary: words::glossary(),
        ..Report::default()
    })
}

/// One fit of all cells: its equations, and their place.
fn one_law(fit: &CellFit, setting: &Setting<'_>) -> Result<Vec<Section>, Error> {
    let file = crate::file_names(std::iter::once(fit.name.as_str())).concat();
    let mut sections = vec![fitted::section(fit, &file, &setting.units)];
    sections[0].title = "One law for all cells".to_owned();
    if let Ok(found) = &fit.fitted {
        sections.push(place::section("all cells", found, setting)?);
    }
    Ok(sections)
}

/// The motion of the fitted equations, or the observed one.
pub(crate) fn verdict(case: &Case<'_>) -> String {
    match fitted_of(case).filter(|fitted| fitted.is_walk()) {
        Some(walk) => walk.motion_words(),
        None => motion(fitted_regime(case).or(case.observation.motion.regime)),
    }
}

/// A motion in words.
pub(crate) fn motion(regime: Option<Regime>) -> String {
    regime.map_or_else(|| UNDECIDED.to_owned(), Regime::words)
}

/// The motion of the fit in words.
pub(crate) fn motion_of_fit(case: &Case<'_>) -> String {
    fitted_of(case).map_or_else(|| UNDECIDED.to_owned(), Fitted::motion_words)
}

pub(crate) fn fitted_of<'c>(case: &Case<'c>) -> Option<&'c Fitted> {
    case.fit?.fitted.as_deref().ok()
}

pub(crate) fn fitted_regime(case: &Case<'_>) -> Option<Regime> {
    fitted_of(case)?.regime.as_ref()?.regime
}

/// The cells, and in a table of its own, so that both are as wide as the page, what their fits say.
fn tables(cases: &[Case<'_>], names: &[String], units: &Units) -> Vec<Table> {
    let link = |case: &Case<'_>, file: &String| Cell::link(literal(&case.cell.name), page_name(file));
    let mut reasons: Vec<String> = Vec::new();
    let mut row = |(case, file): (&Case<'_>, &String)| {
        let mut row = vec![link(case, file), Cell::number(case.observation.numbers.seen.to_string())];
        for quantity in FREE {
            let shown = free::value(&case.observation.numbers, quantity);
            row.push(Cell::number(
                shown.unwrap_or_else(|reason| format!("none ({})", place_in(&mut reasons, reason))),
            ));
        }
        row.push(Cell::text(motion(case.observation.motion.regime)));
        row
    };
    let mut head = vec!["cell".to_owned(), "frames seen".to_owned()];
    head.extend(FREE.map(|quantity| units.axis(quantity)));
    head.push("observed motion".to_owned());
    let rows = cases.iter().zip(names).map(&mut row).collect();
    let why = reasons.iter().zip(1..).map(|(reason, number)| format!(" ({number}) {}.", capital(reason)));
    let caption = format!("Every cell has a page of its own.{}", why.collect::<String>());
    let cells = Table { caption, head, rows };
    let fitted = |(case, file): (&Case<'_>, &String)| {
        vec![
            link(case, file),
            Cell::number(case.cell.frames().to_string()),
            Cell::text(motion_of_fit(case)),
            Cell::text(fitted_of(case).map_or("no fit", |fitted| fitted.symmetry().name())),
            Cell::text(fitted_of(case).map_or_else(|| "none".to_owned(), place_words)),
            Cell::text(agreement(case)),
        ]
    };
    let fits = Table {
        caption: "The fit of each cell; where there is none, or no place, the page of the cell says why."
            .to_owned(),
        head: ["cell", "frames that count", "motion of the fit", "symmetry", "place", "simulated cells"]
            .map(str::to_owned)
            .to_vec(),
        rows: cases.iter().zip(names).map(fitted).collect(),
    };
    if cases.iter().any(|case| case.fit.is_some()) { vec![cells, fits] } else { vec![cells] }
}

/// The number of a reason in the list, from 1; a new one is added.
fn place_in(reasons: &mut Vec<String>, reason: String) -> usize {
    let known = reasons.iter().position(|one| *one == reason);
    known.unwrap_or_else(|| {
        reasons.push(reason);
        reasons.len() - 1
    }) + 1
}

fn placed(fitted: &Fitted, plane: usize) -> Option<&Place> {
    match &fitted.places[plane] {
        Placement::Placed(place) => Some(place),
        Placement::Refused { .. } => None,
    }
}

/// The coordinates of its place, none of them broken into lines.
pub(crate) fn place_words(fitted: &Fitted) -> String {
    let place = placed(fitted, 0).or(placed(fitted, 1));
    let words = |place: &Place| {
        let one = |name: &str, value: String| format!("{} = {value}", notation(name)).replace(' ', "\u{a0}");
        let both = place.coordinates.iter().map(|c| one(&c.name, estimate(&c.estimate)));
        both.collect::<Vec<_>>().join(", ")
    };
    place.map_or_else(|| "none".to_owned(), words)
}

pub(crate) fn agreement(case: &Case<'_>) -> String {
    match case.prediction() {
        None => "none were simulated".to_owned(),
        Some(found) if found.is_unstable() => "unstable".to_owned(),
        Some(found) => format!("{} of {} agree", found.count(Agreement::Agrees), found.comparisons.len()),
    }
}

/// All places on one map per plane.
fn places(cases: &[Case<'_>], setting: &Setting<'_>) -> Result<Option<Section>, Error> {
    let mut figures = Vec::new();
    for (number, (plane, name)) in PLANES.into_iter().enumerate() {
        let all: Vec<_> = cases
            .iter()
            .filter_map(|case| Some((case.cell.name.as_str(), placed(fitted_of(case)?, number)?, None)))
            .collect();
        let drawn = if all.is_empty() { None } else { map(&all, plane)? };
        if let Some(map) = drawn {
            figures.push(setting.figure(map, format!("The cells that have a place on the {name}."))?);
        }
    }
    let section = Section { title: "Places".to_owned(), figures, ..Section::default() };
    Ok((!section.figures.is_empty()).then_some(section))
}

/// Motion that stage and camera add to all cells.
fn field(sample: &Sample, units: &Units) -> Option<Section> {
    let found = sample.field.in_words(units).into_iter();
    let table = Table {
        caption: "What the outlines of all cells have in common, found in all of them together.".to_owned(),
        head: ["motion of the images", "found"].map(str::to_owned).to_vec(),
        rows: found.map(|(name, words)| vec![Cell::text(name), Cell::text(literal(&words))]).collect(),
    };
    (!table.rows.is_empty()).then(|| Section {
        title: "Field of view".to_owned(),
        tables: vec![table],
        ..Section::default()
    })
}

/// Notes from reading the files.
fn notes(sample: &Sample) -> Option<Section> {
    let rows: Vec<Vec<Cell>> = sample.notes().iter().map(|note| vec![Cell::text(literal(note))]).collect();
    let table =
        Table { caption: "What was noticed while reading.".to_owned(), head: vec!["note".to_owned()], rows };
    (!table.rows.is_empty()).then(|| Section {
        title: "Notes".to_owned(),
        tables: vec![table],
        ..Section::default()
    })
}
