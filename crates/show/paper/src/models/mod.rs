//! The discussion: what both models have in common, and what differs.

mod chaos;
mod correspondence;
mod reduction;
mod steady;
mod zigzags;

use super::context::Context;
use motiform_figures::report::Section;
use motiform_study::Error;

const ABOUT: &str = "The tensor model has a velocity, an ellipse and a triangle, and 21 parameters; the active cell has a closed \
boundary with many modes, and its length. The same motions are looked for in both and held against the terms of Armbruster, \
Guckenheimer and Holmes (1988): each term is a property of the reduced dynamics, checked by the same function in either model.";

pub(super) fn section(context: &Context<'_>) -> Result<Section, Error> {
    let mut claims = vec![reduction::exact(context)];
    claims.extend(correspondence::claims(context)?);
    claims.push(chaos::claim_of(context)?);
    context.watch.progress(0.4);
    let zigzags = zigzags::Zigzags::find(context)?;
    claims.extend(zigzags.claims(context));
    claims.extend(reduction::edges(context)?);
    Ok(Section {
        title: "Both models".to_owned(),
        about: ABOUT.to_owned(),
        parameters: correspondence::parameters(),
        figures: context.drawn(&|| Ok(vec![zigzags.figure(context)?]))?,
        claims,
        ..Section::default()
    })
}
