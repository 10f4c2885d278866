//! Populations of cells, as text.

use motiform_cells::{FittedPopulation, NameShare, ObservedPopulation, OverCells};
use std::fmt::{Result, Write};

/// Shares of names and numbers of observed cells.
pub(crate) fn observed(population: &ObservedPopulation) -> std::result::Result<String, std::fmt::Error> {
    let mut text = format!("population     {} cells\n", population.cells);
    shares(&mut text, &population.regimes)?;
    let numbers = [
        ("speed", &population.speed),
        ("turning rate", &population.turning),
        ("directness", &population.directness),
    ];
    for (name, number) in numbers {
        if let Some(over) = number {
            line(&mut text, name, over)?;
        }
    }
    Ok(text)
}

/// Shares of names and coefficients of fitted cells.
pub(crate) fn fitted(population: &FittedPopulation) -> std::result::Result<String, std::fmt::Error> {
    let mut text = format!("population     {} cells\n", population.cells);
    shares(&mut text, &population.regimes)?;
    if population.fitted == 0 {
        text += "               no fit with all terms converged with bounded coefficients\n";
        return Ok(text);
    }
    writeln!(text, "               coefficients of fits with all terms, over {} cells:", population.fitted)?;
    for coefficient in &population.coefficients {
        line(&mut text, &coefficient.term, &coefficient.over)?;
    }
    if let Some([velocity, shape]) = &population.noise {
        line(&mut text, "noise, velocity", velocity)?;
        line(&mut text, "noise, shape", shape)?;
    }
    Ok(text)
}

fn shares(text: &mut String, names: &[NameShare]) -> Result {
    for NameShare { name, share } in names {
        let [value, low, high] = [share.value, share.lower, share.upper].map(|part| 100.0 * part);
        writeln!(text, "  {name:<16} {value:>5.1} % ({low:.1} to {high:.1}), {} cells", share.count)?;
    }
    Ok(())
}

fn line(text: &mut String, name: &str, over: &OverCells) -> Result {
    write!(text, "  {name:<16} mean {:.4e}", over.mean)?;
    if let Some([low, high]) = over.mean_interval {
        write!(text, " ({low:.4e} to {high:.4e})")?;
    }
    write!(text, ", median {:.4e}", over.median)?;
    if let Some([low, high]) = over.median_interval {
        write!(text, " ({low:.4e} to {high:.4e})")?;
    }
    text.push('\n');
    Ok(())
}
