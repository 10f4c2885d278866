//! Populations of cells, as text.

use motiform_cells::{
    FittedPopulation, NameShare, ObservedPopulation, OverCells, PopulationNumbers, Units, Withheld,
};
use motiform_dynamics::in_words;
use motiform_statistics::{four_digits, with_interval};
use motiform_study::counted;
use std::fmt::{Result, Write};

/// Shares of names and numbers of observed cells.
pub(crate) fn observed(
    population: &ObservedPopulation,
    numbers: &PopulationNumbers,
    units: &Units,
) -> std::result::Result<String, std::fmt::Error> {
    let mut text = format!("population         {}\n", counted(population.cells, "cell"));
    shares(&mut text, &population.regimes)?;
    for number in &numbers.numbers {
        let quantity = number.quantity;
        line(&mut text, quantity.symbol, &number.over, &units.unit(quantity.dimension))?;
    }
    for Withheld { quantity, why } in &numbers.withheld {
        writeln!(text, "  {:<18} not given: {why}", quantity.symbol)?;
    }
    Ok(text)
}

/// Shares of names and coefficients of fitted cells.
pub(crate) fn fitted(
    population: &FittedPopulation,
    units: &Units,
) -> std::result::Result<String, std::fmt::Error> {
    let mut text = format!("population         {}\n", counted(population.cells, "cell"));
    shares(&mut text, &population.regimes)?;
    if population.fitted < 2 {
        text += "no means           coefficients: they need two cells of one motion whose fits with all terms \
         converged with bounded coefficients\n";
        return Ok(text);
    }
    let law = in_words(population.law.unwrap_or_default());
    writeln!(
        text,
        "                   coefficients {}, over {} ({law}):",
        population.of_which_fits(),
        counted(population.fitted, "cell")
    )?;
    for coefficient in &population.coefficients {
        line(&mut text, &coefficient.name(), &coefficient.over, "")?;
    }
    if let Some(why) = &population.no_intervals {
        writeln!(text, "  no intervals     {why}")?;
    }
    if let Some([velocity, shape]) = &population.noise {
        let Units { length, time, .. } = units;
        line(&mut text, "noise, velocity", velocity, &format!("{length}/{time}^1.5"))?;
        line(&mut text, "noise, shape", shape, &format!("{length}/{time}^0.5"))?;
    }
    Ok(text)
}

fn shares(text: &mut String, names: &[NameShare]) -> Result {
    for NameShare { name, share } in names {
        let name = in_words(name);
        let [value, low, high] = [share.value, share.lower, share.upper].map(|part| 100.0 * part);
        writeln!(
            text,
            "  {name:<18} {value:>5.1} % ({low:.1} to {high:.1}), {}",
            counted(share.count, "cell")
        )?;
    }
    Ok(())
}

fn line(text: &mut String, name: &str, over: &OverCells, unit: &str) -> Result {
    let number = |value: f64, interval: Option<[f64; 2]>| match interval {
        Some(ends) => with_interval(value, ends),
        None => four_digits(value),
    };
    let (mean, median) = (number(over.mean, over.mean_interval), number(over.median, over.median_interval));
    writeln!(
        text,
        "{}",
        format!("  {name:<18} mean {mean}, median {median} {unit}").trim_end().to_owned()
            + &format!(" ({})", counted(over.cells, "cell"))
    )
}
