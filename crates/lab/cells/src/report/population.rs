//! The population: names and numbers over cells.

use crate::Units;
use crate::report::numbers::measured;
use crate::report::terms::{typeset, unit};
use crate::report::{Case, Setting, motion};
use crate::{
    CellFit, FittedPopulation, NameShare, Observation, OverCells, PopulationCoefficient, PopulationNumbers,
    fitted_population, observed_population, population_numbers, population_statistics,
};
use motiform_dynamics::in_words;
use motiform_figures::report::{Cell, Section, Table};
use motiform_statistics::Measured;
use motiform_study::{Error, counted};

/// Nothing for a single cell.
pub(crate) fn section(cases: &[Case<'_>], setting: &Setting<'_>) -> Result<Option<Section>, Error> {
    let units = &setting.units;
    if cases.len() < 2 {
        return Ok(None);
    }
    let found: Vec<Observation> = cases.iter().map(|case| case.observation.clone()).collect();
    let fits: Vec<CellFit> = cases.iter().filter_map(|case| case.fit.cloned()).collect();
    let mut about = "Intervals are those of resampling whole cells, which needs 8 of them.".to_owned();
    let observed = observed_population(&found);
    let free = population_numbers(&found);
    let mut tables = vec![names(&observed.regimes, "observed motion"), numbers(&free, units)];
    if fits.len() > 1 {
        let fitted = fitted_population(&fits);
        tables.push(names(&fitted.regimes, "motion of the fit"));
        if fitted.fitted > 1 {
            tables.push(coefficients(&fitted, &fits, units));
        }
    }
    let mut figures = Vec::new();
    if let Some((count, statistics)) = population_statistics(&found) {
        about += &format!(
            " Displacements and correlations are over {} with enough frames at one sampling interval; with \
             fewer than 8 their intervals are over blocks of the records.",
            counted(count, "cell")
        );
        tables.push(motion::memories(&statistics, units));
        figures = motion::figures(&statistics, setting)?;
    }
    tables.retain(|table| !table.rows.is_empty());
    Ok(Some(Section {
        title: "Population".to_owned(),
        about,
        tables,
        small_figures: figures,
        ..Section::default()
    }))
}

fn names(shares: &[NameShare], head: &str) -> Table {
    let row = |one: &NameShare| {
        let share = &one.share;
        let [low, high] = [share.lower, share.upper].map(|end| 100.0 * end);
        vec![
            Cell::text(in_words(one.name)),
            Cell::number(share.count.to_string()),
            Cell::number(format!("{:.0} %", 100.0 * share.value)),
            Cell::number(format!("{low:.0} to {high:.0} %")),
        ]
    };
    Table {
        caption: "Cells with each motion.".to_owned(),
        head: [head, "cells", "share", "95 % interval of the share"].map(str::to_owned).to_vec(),
        rows: shares.iter().map(row).collect(),
    }
}

fn numbers(found: &PopulationNumbers, units: &Units) -> Table {
    let rows = found.numbers.iter().map(|one| row(units.axis(one.quantity), &one.over));
    let withheld = found.withheld.iter().map(|one| format!("No {}: {}.", one.quantity.symbol, one.why));
    let caption = std::iter::once(
        "Numbers over the cells that have them; in brackets 95 % intervals, from 8 cells on.".to_owned(),
    )
    .chain(withheld);
    table(&caption.collect::<Vec<_>>().join(" "), rows.collect())
}

fn coefficients(found: &FittedPopulation, fits: &[CellFit], units: &Units) -> Table {
    let terms =
        || fits.iter().filter_map(|fit| Some(&fit.fitted.as_ref().ok()?.whole.library.terms)).flatten();
    let named = |one: &PopulationCoefficient| {
        let unit = terms().find(|term| term.name() == one.term).map(|term| unit(term, units));
        format!("{} ({})", typeset(&one.name()), unit.unwrap_or_default())
    };
    let rows = found.coefficients.iter().map(|one| row(named(one), &one.over));
    let without =
        found.no_intervals.as_ref().map_or_else(String::new, |why| format!(" No intervals: {why}."));
    let caption = format!(
        "Coefficients {}, over the cells whose fit is {}; in brackets 95 % intervals, from 8 cells on. Cells with other motions have other \
         laws, and are in no mean.{without}",
        found.of_which_fits(),
        in_words(found.law.unwrap_or("named"))
    );
    table(&caption, rows.collect())
}

fn table(caption: &str, rows: Vec<Vec<Cell>>) -> Table {
    let head = ["quantity", "cells", "mean over cells", "median over cells"];
    Table { caption: caption.to_owned(), head: head.map(str::to_owned).to_vec(), rows }
}

fn row(name: String, over: &OverCells) -> Vec<Cell> {
    let number = |value, interval| Cell::number(measured(&Measured { value, interval }));
    vec![
        Cell::text(name),
        Cell::number(over.cells.to_string()),
        number(over.mean, over.mean_interval),
        number(over.median, over.median_interval),
    ]
}
