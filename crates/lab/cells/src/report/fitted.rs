//! The fitted equations: coefficients, noise, what the data determine, the motion, what is doubtful.

use crate::Units;
use crate::report::numbers::{interval, plain, with_error};
use crate::report::place::notation;
use crate::report::terms::{typeset, unit};
use crate::{CellFit, Fitted};
use motiform_figures::literal;
use motiform_figures::report::{Cell, Section, Table};
use motiform_inference::{Coefficient, EquationKnowledge, Rung, paper};
use motiform_statistics::to_error;
use motiform_study::Dimension;
use motiform_study::titles::capital;

/// Of a fit whose search did not end.
const NOT_CONVERGED: &str = "not converged";

/// Of an interval whose reason stands above the table.
const NOT_STATED: &str = "not stated (reason above)";

/// Of an error of a term that the best set does not have.
const OF_NO_SET: &str = "not in the best set";

pub(crate) fn section(fit: &CellFit, name: &str, units: &Units) -> Section {
    let title = "Fitted equations".to_owned();
    let fitted = match &fit.fitted {
        Ok(fitted) => fitted,
        Err(why) => {
            return Section { title, about: format!("No fit: {}.", literal(why)), ..Section::default() };
        }
    };
    let why = capital(&literal(&fitted.why()));
    let regime = fitted.motion_words();
    let about = format!(
        "Motion of the fitted equations, without their noise: {regime}. {why}.\n\nThe equations are the study file \
         {name}.toml in the folder of this page: every command of motiform takes it as a model."
    );
    let mut tables = vec![coefficients(fitted, units)];
    tables.extend(sets(fitted));
    tables.extend(ladder(fitted));
    tables.extend(motions(fitted));
    tables.extend(bifurcations(fit));
    tables.extend(determined(fitted));
    tables.extend(warnings(fit));
    Section { title, about, parameters: parameters(fitted, units), tables, ..Section::default() }
}

fn parameters(fitted: &Fitted, units: &Units) -> Vec<(String, String)> {
    let model = fitted.model();
    vec![
        ("symmetry".to_owned(), format!("{}, {}", fitted.symmetry().name(), fitted.handed_test_in_words())),
        ("frames with a likelihood".to_owned(), model.frames.to_string()),
        ("log-likelihood".to_owned(), plain(model.log_likelihood)),
        ("factor of the stated errors".to_owned(), fitted.factor_of_errors()),
        (
            "noise of the velocity".to_owned(),
            fitted.noise_of_velocity(&format!("{}/√{}", units.unit(Dimension::SPEED), units.time)),
        ),
        (
            "noise of the shape".to_owned(),
            fitted.noise_of_shape(&format!("{}/√{}", units.length, units.time)),
        ),
        ("noise of the centre, beside the contour's".to_owned(), centre(fitted, units)),
        ("velocity of the stage, subtracted".to_owned(), stage(fitted, units)),
        ("sets of terms that are as good".to_owned(), fitted.selection.subsets.ties.len().to_string()),
        ("natural time".to_owned(), units.of_time(&plain(model.scales.time))),
    ]
}

/// The noise that all outlines of a frame may have together, as the fit of one cell sees it.
fn centre(fitted: &Fitted, units: &Units) -> String {
    match fitted.model().noise.is_of_centre() {
        true => fitted.noise_of_centre(units.lengths()),
        false => "none is seen".to_owned(),
    }
}

fn stage(fitted: &Fitted, units: &Units) -> String {
    let one = |v: &[f64; 2]| format!("({}, {}) {}", plain(v[0]), plain(v[1]), units.unit(Dimension::SPEED));
    let all: Vec<String> = fitted.stage.iter().map(one).collect();
    if all.is_empty() { "none".to_owned() } else { all.join("; ") }
}

fn coefficients(fitted: &Fitted, units: &Units) -> Table {
    let between = fitted.between.as_ref();
    let (sound, stated) = (fitted.model().converged(), fitted.no_intervals().is_none());
    let held = |text: String| match (sound, stated) {
        (false, _) => NOT_CONVERGED.to_owned(),
        (true, false) => NOT_STATED.to_owned(),
        (true, true) => text,
    };
    let row = |(place, c): (usize, &Coefficient)| {
        let (name, factor) = paper(&c.term, c.imaginary);
        let part = if c.imaginary { "imaginary part of " } else { "" };
        let over = fitted.over_sets(&c.name).filter(|_| !c.imaginary);
        let (value, ends) = over.map_or((c.estimate.value, c.estimate.interval), |o| (o.value, o.interval));
        let mut row = vec![
            Cell::text(format!("{part}{}", typeset(&c.name))),
            Cell::number(match (sound, stated) {
                (false, _) => plain(c.estimate.value),
                (true, false) => to_error(c.estimate.value, c.estimate.error),
                (true, true) => with_error(c.estimate.value, c.estimate.error),
            }),
            Cell::text(unit(&c.term, units)),
            Cell::number(held(to_error(c.estimate.robust, c.estimate.robust))),
            Cell::number(held(interval(value, ends))),
            Cell::text(literal(&format!("{name} = {}", plain(c.estimate.value / factor)))),
        ];
        if let Some(between) = between {
            row.insert(
                4,
                Cell::number(held(
                    between.errors.get(place).map_or_else(|| "not computed".to_owned(), |e| plain(*e)),
                )),
            );
        }
        row
    };
    let mut head =
        vec!["term", "coefficient", "unit", "robust error", "95 % interval", "parameter of the study file"];
    if between.is_some() {
        head.insert(4, "error between cells");
    }
    let mut rows: Vec<Vec<Cell>> = fitted.model().coefficients.iter().enumerate().map(row).collect();
    for one in fitted.in_other_sets() {
        let mut row = vec![
            Cell::text(format!("{} (other sets)", typeset(&one.name))),
            Cell::number(format!("{}, mean over sets", plain(one.value))),
            Cell::text(
                fitted.whole.coefficient(&one.name).map_or_else(String::new, |c| unit(&c.term, units)),
            ),
            Cell::number(OF_NO_SET),
            Cell::number(if stated { interval(one.value, one.interval) } else { NOT_STATED.to_owned() }),
            Cell::text(format!(
                "not in the file: in {:.0} % of the weight of all tied sets",
                100.0 * one.weight
            )),
        ];
        if between.is_some() {
            row.insert(4, Cell::number(OF_NO_SET));
        }
        rows.push(row);
    }
    let intervals = fitted.no_intervals().map_or_else(
        || "Intervals are those over all sets of terms that the data do not tell apart".to_owned(),
        |reason| format!("No intervals are stated: {reason}"),
    );
    Table {
        caption: format!(
            "Coefficients in the units of the data; a term stands in the equation of the amplitude before the colon. \
             {intervals}; the errors are those of the best set alone."
        ),
        head: head.into_iter().map(str::to_owned).collect(),
        rows,
    }
}

/// The terms that are not in all sets that are as good as the best.
fn sets(fitted: &Fitted) -> Option<Table> {
    let subsets = &fitted.selection.subsets;
    let all = subsets.ties.len();
    let best = subsets.best()?;
    let row = |(name, count): (String, usize)| {
        let chosen = if best.names.contains(&name) { "yes" } else { "no" };
        vec![Cell::text(typeset(&name)), Cell::number(format!("{count} of {all}")), Cell::text(chosen)]
    };
    let rows: Vec<Vec<Cell>> =
        subsets.counts().into_iter().filter(|(_, count)| *count < all).map(row).collect();
    let real = if fitted.model().handed { " Sets are compared with real coefficients." } else { "" };
    (!rows.is_empty()).then(|| Table {
        caption: format!(
            "Terms that some of the sets that are as good as the best have, and others do not: the data do not tell \
             whether they are there.{real}"
        ),
        head: ["term", "sets of terms that are as good", "in the set above"].map(str::to_owned).to_vec(),
        rows,
    })
}

/// The models by what they say of frames that their fits did not see.
fn ladder(fitted: &Fitted) -> Option<Table> {
    let found = fitted.ladder.as_ref()?;
    let row = |rung: &Rung| {
        vec![
            Cell::text(literal(rung.model.words())),
            Cell::number(rung.coefficients.to_string()),
            Cell::number(rung.gain.map_or_else(|| "not computed".to_owned(), plain)),
            Cell::text(rung.in_words()),
        ]
    };
    let (caption, rows) = match found {
        Err(why) => (format!("Models are not compared: {}.", literal(why)), Vec::new()),
        Ok(found) => (
            format!(
                "Models compared by {} frames that their fits did not see: {}. The record is cut into {} blocks, each \
                 left out of a fit in turn; the gain is log-likelihood per frame above the first model, the error that \
                 of the differences between blocks.",
                found.frames,
                literal(&found.sentence()),
                found.blocks
            ),
            found.rungs.iter().map(row).collect(),
        ),
    };
    let head = ["model", "coefficients", "gain per frame", "frames not seen"].map(str::to_owned).to_vec();
    Some(Table { caption, head, rows })
}

/// The motions of the models that the data allow.
fn motions(fitted: &Fitted) -> Option<Table> {
    let found = fitted.regime.as_ref()?;
    let row = |(regime, count): &(motiform_analysis::regime::Regime, usize)| {
        let share = 100.0 * *count as f64 / found.draws as f64;
        vec![
            Cell::text(regime.words()),
            Cell::number(count.to_string()),
            Cell::number(format!("{share:.0} %")),
        ]
    };
    Some(Table {
        caption: format!(
            "Motions of {} models drawn from the estimate. A motion is named if 90 % agree, with the best model among them.",
            found.draws
        ),
        head: ["motion", "models", "share"].map(str::to_owned).to_vec(),
        rows: found.counts.iter().map(row).collect(),
    })
}

/// The nearest changes of the motion.
fn bifurcations(fit: &CellFit) -> Option<Table> {
    let rows: Vec<Vec<Cell>> =
        fit.bifurcations.iter().map(|near| vec![Cell::text(notation(&near.sentence()))]).collect();
    (!rows.is_empty()).then(|| Table {
        caption: "The nearest bifurcations of the motion, all other parameters being those of the fit."
            .to_owned(),
        head: vec!["bifurcation".to_owned()],
        rows,
    })
}

/// The combinations that the motion fixes, where it does not fix everything.
fn determined(fitted: &Fitted) -> Option<Table> {
    let (known, of) = fitted.determined();
    let equations = &known.equations;
    let row = |of: &EquationKnowledge| {
        vec![Cell::text(format!("*z*_{}", of.equation + 1)), Cell::text(notation(&of.text))]
    };
    let rows: Vec<Vec<Cell>> = equations.iter().map(row).collect();
    let whole = equations.iter().all(|of| of.fixed() == of.combinations.len());
    (!whole).then(|| Table {
        caption: format!("What the data determine, equation by equation: combinations {of}."),
        head: vec!["equation".to_owned(), "determined".to_owned()],
        rows,
    })
}

fn warnings(fit: &CellFit) -> Option<Table> {
    let rows: Vec<Vec<Cell>> =
        fit.warnings().iter().map(|warning| vec![Cell::text(literal(warning))]).collect();
    (!rows.is_empty()).then(|| Table {
        caption: "What makes the fit doubtful.".to_owned(),
        head: vec!["warnings".to_owned()],
        rows,
    })
}
