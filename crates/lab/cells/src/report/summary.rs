//! The first section of a cell's page: what was found, and whether observed motion and fit agree.

use crate::Fitted;
use crate::report::Case;
use crate::report::index::{agreement, fitted_of, fitted_regime, motion, motion_of_fit, place_words};
use motiform_analysis::regime::Regime;
use motiform_figures::report::Section;

pub(crate) fn section(case: &Case<'_>) -> Section {
    let mut parameters = vec![("observed motion".to_owned(), motion(case.observation.motion.regime))];
    if let Some(fit) = case.fit {
        parameters.push(("motion of the fit".to_owned(), motion_of_fit(case)));
        let place = fitted_of(case).map_or_else(|| "none".to_owned(), place_words);
        parameters.push(("place".to_owned(), place));
        parameters.push(("simulated cells".to_owned(), agreement(case)));
        parameters.push(("warnings".to_owned(), fit.warnings().len().to_string()));
        parameters.retain(|(_, value)| !value.is_empty());
    }
    Section { title: "Summary".to_owned(), about: sentence(case), parameters, ..Section::default() }
}

/// Agreement of the name from the samples with the name from the equations.
fn sentence(case: &Case<'_>) -> String {
    let words = |regime: Option<Regime>| regime.map(Regime::words);
    let Some(fit) = case.fit else {
        return "Observed only: no equations were fitted to this cell.".to_owned();
    };
    match (words(case.observation.motion.regime), words(fitted_regime(case))) {
        _ if fitted_of(case).is_some_and(Fitted::is_walk) => {
            "The fitted equations rest without their noise, or nearly, and the cell moves: noise carries its displacement, a \
             persistent random walk. Speed, persistence and diffusion are below.".to_owned()
        }
        _ if fit.fitted.is_err() => "No equations were fitted to this cell; the reason is below.".to_owned(),
        (Some(a), Some(b)) if a == b => {
            format!(
                "The samples alone and the fitted equations, without their noise, give the same motion: {b}."
            )
        }
        (Some(a), Some(b)) => format!(
            "The samples alone say {a}, the fitted equations without their noise {b}. They need not contradict each \
             other: with noise, or in a transient, a cell can move in another way than the equations settle to. \
             Compare the simulated cells below."
        ),
        (None, Some(b)) => format!(
            "The samples alone do not decide the motion; the fitted equations, without their noise, do: {b}. The name \
             rests on the fit; the checks and the simulated cells below show how far it holds."
        ),
        (Some(a), None) => format!(
            "The samples alone say {a}; the fitted equations do not decide their motion, for the reasons below."
        ),
        (None, None) => {
            "Neither the samples nor the fitted equations decide the motion; the reasons are below."
                .to_owned()
        }
    }
}
