//! The equations: statements of the paper before its simulations.

mod active;
mod couplings;
mod fields;
mod gradient;
mod long_waves;
mod minimal;
mod outlines;
mod rotation;
mod symmetries;
mod tensor_motion;
mod terms;
mod velocity;

use super::context::Context;
use motiform_figures::report::{ReportFigure, Section};
use motiform_study::Error;

const ABOUT: &str = "What can be said of the equations as they are written. The tensor form of the first model, with its indices as in the \
paper, is taken apart into monomials of the Fourier amplitudes by least squares, and compared with all couplings that rotations and \
the mirror allow. The equation of the active cell is evaluated term by term on a grid and held against its three symmetries; its \
terms are asked whether they derive from a potential. Where the paper says what a term does to the motion, runs with and \
without it are named by the classifier.";

pub(super) fn section(context: &Context<'_>) -> Result<Section, Error> {
    let mut claims = outlines::claims(context);
    claims.extend(couplings::claims(context)?);
    claims.extend(rotation::claims(context));
    claims.extend(tensor_motion::claims(context)?);
    context.watch.progress(0.3);
    claims.extend(symmetries::claims(context));
    claims.extend(gradient::claims(context));
    let (rest, figure) = active::claim_of(context)?;
    claims.extend(rest);
    context.watch.progress(0.6);
    claims.extend(long_waves::claims(context)?);
    claims.push(minimal::claim_of(context)?);
    claims.extend(velocity::claims(context));
    Ok(Section {
        title: "The equations".to_owned(),
        about: ABOUT.to_owned(),
        parameters: vec![
            ("states and coefficients".to_owned(), "random, from fixed seeds".to_owned()),
            ("runs".to_owned(), "from random starts, named by the classifier".to_owned()),
        ],
        figures: vec![ReportFigure::new(
            figure,
            "The variational nonlinearity *g*_4 alone: the shape comes to rest, its potential falls all the time. With *g*_5, which \
             is not variational, it does not.",
        )],
        claims,
        ..Section::default()
    })
}
