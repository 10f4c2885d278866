//! Fig. 4: the full tensor model over the plane of its two relaxation rates, and its largest Lyapunov exponent.

mod approach;
mod blow_up;
mod escape;
mod exponent;
mod map;
mod places;
mod schemes;

use super::context::Context;
use crate::branches::{self, at};
use crate::curves::Curves;
use motiform_figures::Drawn;
use motiform_figures::report::{ReportFigure, Section};
use motiform_study::{Error, Random, Study};

pub(super) fn section(context: &Context<'_>) -> Result<Section, Error> {
    let mut section = Section {
        title: "Fig. 4: velocity, ellipse and triangle".to_owned(),
        about: ABOUT.to_owned(),
        parameters: parameters(&at(context, 0.5, 0.1)?)?,
        ..Section::default()
    };
    let (plan, slow) = branches::slow(context)?;
    let curves = Curves::follow(context, &slow)?;
    map::add(context, &mut section, &curves)?;
    branches::add(context, &mut section, &plan, &slow)?;
    exponent::add(context, &mut section)?;
    blow_up::add(context, &mut section)?;
    escape::add(context, &mut section)?;
    schemes::add(context, &mut section)?;
    Ok(section)
}

const ABOUT: &str = "The full model for the velocity, the two-fold and the three-fold deformation, with the relaxation rates \
κ_2 and κ_3 varied. The paper finds straight and circular motion, zigzag at large κ_2 and small κ_3, chaos at small κ_2 \
and small κ_3, and a region marked × where a numerical instability leaves no conclusion. Here every cell is classified from \
several random initial states, the largest Lyapunov exponent is measured from the exact tangent flow with its error, and \
the instability is followed into its singularity.";

/// The parameters of a study, except the two rates.
fn parameters(study: &Study) -> Result<Vec<(String, String)>, Error> {
    let specs = study.info()?.parameters().iter().zip(study.values()?);
    let set = specs.filter(|(spec, value)| *value != 0.0 && !spec.name.starts_with("kappa"));
    let mut rows: Vec<(String, String)> =
        set.map(|(spec, value)| (spec.symbol.to_owned(), value.to_string())).collect();
    rows.push(("all other coefficients".to_owned(), "0".to_owned()));
    rows.push((
        "initial states".to_owned(),
        format!("random, {}", study.random.unwrap_or(Random::SMALL).words()),
    ));
    rows.push((
        "method".to_owned(),
        format!("{}, relative tolerance {}", study.run.stepper, power(study.run.rtol)),
    ));
    Ok(rows)
}

/// A drawing with its texts.
pub(super) fn figure(drawn: Drawn, caption: impl Into<String>) -> ReportFigure {
    ReportFigure::new(drawn, caption)
}

/// A number with two digits and a power of ten, in usual notation: `1.5×10^{-4}`, `10^{-9}`.
pub(super) fn power(x: f64) -> String {
    let text = format!("{x:.1e}");
    let Some((mantissa, exponent)) = text.split_once('e') else { return text };
    match mantissa.trim_end_matches(".0") {
        "0" => "0".to_owned(),
        "1" => format!("10^{{{exponent}}}"),
        "-1" => format!("−10^{{{exponent}}}"),
        mantissa => format!("{mantissa}×10^{{{exponent}}}"),
    }
}
