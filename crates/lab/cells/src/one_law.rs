//! Cells of a joint fit that are handed by themselves.

use motiform_inference::{HANDED_RATE, HandedCell, PValue, Senses, Symmetry};

/// Cells that are listed.
const MOST_NAMES: usize = 6;

/// Why there is no law of these cells: some are handed by themselves, in both senses, or while all together are not. `names`: of the
/// cells, in their order; `joint`: what the test of all together says.
pub(crate) fn no_law(found: &Senses, names: &[&str], joint: Symmetry) -> Option<String> {
    let of = |opposite: bool| -> Vec<&HandedCell> {
        found.handed.iter().filter(|one| one.opposite == opposite).collect()
    };
    let largest = found.handed.iter().map(|one| one.p_value).reduce(f64::max)?;
    let p = PValue(largest);
    let [one, other] = [false, true].map(|opposite| listed(&of(opposite), names));
    if found.are_both() {
        return Some(format!(
            "cells of both senses are handed, each by itself ({p} or below): {one} in one, {other} in the other. In coefficients of all of \
             them the senses cancel, and no cell follows these; fit the cells one by one, or those of each sense together"
        ));
    }
    (joint != Symmetry::Handed).then(|| {
        format!(
            "cells do not follow one law: real coefficients are rejected in {one}, each by itself ({p} or below, number of cells counted), \
             and not in all together; fit the cells one by one, or those of one sense together"
        )
    })
}

/// That cells by themselves, taken together, reject real coefficients, although none does alone, and one law of all does not, as a doubt.
pub(crate) fn doubted(found: &Senses, joint: Symmetry) -> Option<String> {
    (joint != Symmetry::Handed && found.p_value < HANDED_RATE).then(|| {
        format!(
            "whether cells are handed is not decided: tests of each by itself, taken together, say so ({}), and imaginary parts that all \
             of them have do not; fit the cells one by one",
            PValue(found.p_value)
        )
    })
}

fn listed(cells: &[&HandedCell], names: &[&str]) -> String {
    let mut numbers: Vec<usize> = cells.iter().map(|one| one.cell).collect();
    numbers.sort_unstable();
    let words: Vec<&str> =
        numbers.iter().take(MOST_NAMES).filter_map(|&cell| names.get(cell).copied()).collect();
    match numbers.len().saturating_sub(MOST_NAMES) {
        0 => words.join(", "),
        more => format!("{} and {more} more", words.join(", ")),
    }
}
