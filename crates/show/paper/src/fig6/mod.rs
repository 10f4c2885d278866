//! Fig. 6: the active cell, whose only parameter is its length.

mod atlas;
mod boundary;
mod branches;
mod codimension;
mod edges;
mod exponents;
mod first_window;
mod lengths;
mod onset;
mod pictures;
mod priors;
mod quasi;
mod scheme;
mod succession;
mod tracks;
mod tracks_claims;
mod windows;
mod zigzags;

pub(super) use branches::Branch;
pub(super) use lengths::{modes_for, study};
pub(super) use tracks::Track;

use super::context::Context;
use atlas::Atlas;
use edges::Edges;
use exponents::Exponents;
use lengths::Lengths;
use motiform_figures::report::Section;
use motiform_study::Error;
use onset::Onsets;
use priors::Priors;
use quasi::Search;
use zigzags::Zigzags;

const ABOUT: &str = "The active cell model has one parameter, the length *L* of its boundary. Shapes that stay as they are \
(motionless, straight, circular) are followed in *L* and their stability is computed, which gives the edges of the motions to \
five digits; random starts are classified in between. The paper's windows *W*_1, *W*_2 and *W*_3 are drawn as brackets. \n\n\
Two things about the error function that closes the boundary are our inference, not the paper's words. The paper does not say whether it \
acts back on the shape: here it does not, because with feedback nothing moves up to *L* = 15 and the paper's motions are absent; it acts \
on the velocity and on the drawn boundary. And the paper maximises a likelihood with a prior distribution that it does not state. Here \
closure is an exact constraint, which replaces the likelihood. Among all error functions that satisfy it, the one with the largest prior \
density is taken; mode *n* of the prior has the standard deviation *n*^{-4}. The table shows how speeds and turns depend on that choice.";

pub(super) fn section(context: &Context<'_>) -> Result<Section, Error> {
    let edges = Edges::find(context)?;
    let atlas = Atlas::follow(context)?;
    let onsets = Onsets::find(context)?;
    let lengths = Lengths::scan(context)?;
    context.watch.progress(0.5);
    let quasi = Search::make(context)?;
    let exponents = Exponents::find(context)?;
    context.watch.progress(0.7);
    let tracks = tracks::all(context)?;
    let zigzags = Zigzags::follow(context, &tracks[2])?;
    context.watch.progress(0.8);
    let priors = Priors::find(context, &tracks)?;
    let mut claims = windows::claims(context, &edges, &lengths, &zigzags, &quasi, &onsets);
    claims.extend(succession::claims(&lengths, &tracks));
    claims.extend(tracks_claims::claims(context, &tracks, &exponents));
    claims.push(zigzags.elsewhere(context, &lengths));
    claims.push(priors.claim(&tracks));
    claims.push(scheme::claim_of(context, &tracks)?);
    claims.extend(atlas.claims(context));
    let mut figures = pictures::all(context, &lengths, &exponents, &tracks)?;
    figures.extend(context.drawn(&|| atlas.figures(context))?);
    Ok(Section {
        title: "Fig. 6: the active cell".to_owned(),
        about: ABOUT.to_owned(),
        parameters: parameters(context, &lengths),
        tables: vec![priors.table()],
        figures,
        claims,
        ..Section::default()
    })
}

fn parameters(context: &Context<'_>, lengths: &Lengths) -> Vec<(String, String)> {
    let text = |name: &str, value: &str| (name.to_owned(), value.to_owned());
    vec![
        text("*g*_2, *g*_3, *g*_5", "1, 1, -1 (*g*_1 = *g*_4 = 0)"),
        text("*α*_2, *α*_3", "0, -4·10^{-4} *L*"),
        text(
            "modes",
            "10 up to *L* = 15, 15 up to 22.8, 20 up to 31 (the shortest wave has *k* ≥ 4; the paper: *N* = 128)",
        ),
        text("stepper", "krogstad4 (exponential, order 4), relative tolerance 10^{-6}, absolute 10^{-7}"),
        (
            "scan".to_owned(),
            format!(
                "{} lengths, {} each",
                lengths.0.len(),
                context.choose("two random starts", "one random start")
            ),
        ),
    ]
}
