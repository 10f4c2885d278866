//! Fig. 5: zigzag and chaos, at two places of the plane of Fig. 4.

mod chaos;
mod parting;
mod spectra;
mod zigzag;

use super::context::Context;
use super::fig4::power;
use motiform_figures::report::{ReportFigure, Section};
use motiform_lab::draw;
use motiform_study::{Dataset, Error};

pub(super) fn section(context: &Context<'_>) -> Result<Section, Error> {
    let mut section = Section {
        title: "Fig. 5: zigzag and chaotic motion".to_owned(),
        about: ABOUT.to_owned(),
        parameters: parameters(context)?,
        ..Section::default()
    };
    zigzag::add(context, &mut section)?;
    chaos::add(context, &mut section)?;
    spectra::add(context, &mut section)?;
    parting::add(context, &mut section)?;
    Ok(section)
}

const ABOUT: &str = "Two motions that need the three-fold deformation. (a) At κ_2 = 0.9, κ_3 = 0.1 the body runs on while its \
heading swings to the left and to the right in turn. (b) At κ_2 = 0.5, κ_3 = 0.1 it loops and turns without a period. Whether \
a motion is a zigzag is decided by its return: half a period later it must be its own mirror image. Whether it is chaotic is \
decided by four independent witnesses: the Lyapunov exponent, the parting of neighbours, the 0-1 test and the spectrum.";

/// The parameters that both presets set.
fn parameters(context: &Context<'_>) -> Result<Vec<(String, String)>, Error> {
    let (a, b) = (context.preset("fig5a", |_| Ok(()))?, context.preset("fig5b", |_| Ok(()))?);
    let values = a.values()?.into_iter().zip(b.values()?);
    let set = a.info()?.parameters().iter().zip(values).filter(|(_, (x, y))| *x != 0.0 || *y != 0.0);
    let words = |(x, y): (f64, f64)| if x == y { x.to_string() } else { format!("{x} in (a), {y} in (b)") };
    let mut rows: Vec<(String, String)> =
        set.map(|(spec, pair)| (spec.symbol.to_owned(), words(pair))).collect();
    rows.push(("all other coefficients".to_owned(), "0".to_owned()));
    rows.push(("time before the recording".to_owned(), words((a.run.transient, b.run.transient))));
    rows.push(("method".to_owned(), format!("{}, relative tolerance {}", a.run.stepper, power(a.run.rtol))));
    Ok(rows)
}

/// The drawings of a dataset by name (`motion` is the animation), with the words below each; the path is the paper's figure `name`.
pub(super) fn drawings(
    context: &Context<'_>,
    name: &str,
    dataset: &Dataset,
    wanted: &[(&str, &str)],
) -> Result<Vec<ReportFigure>, Error> {
    context.drawn(&|| {
        let mut figures = draw_all(context, dataset, wanted)?;
        let path = wanted.iter().position(|(known, _)| *known == "path");
        if let Some(figure) = path.and_then(|place| figures.get_mut(place)) {
            figure.of_paper = Some(name.to_owned());
        }
        Ok(figures)
    })
}

fn draw_all(
    context: &Context<'_>,
    dataset: &Dataset,
    wanted: &[(&str, &str)],
) -> Result<Vec<ReportFigure>, Error> {
    let mut drawn = draw::drawn(dataset, context.style)?;
    let mut figures = Vec::new();
    for &(name, caption) in wanted {
        if name == "motion" {
            figures.extend(draw::film(dataset)?.map(|film| ReportFigure::film(film, caption)));
        } else if let Some(place) = drawn.iter().position(|(known, _)| *known == name) {
            figures.push(ReportFigure::new(drawn.swap_remove(place).1, caption));
        }
    }
    Ok(figures)
}
