//! The return map: the next crossing of the section against the present one.

use super::body::{Body, LENGTH};
use super::words;
use motiform_figures::ReturnMapFigure;

/// `None` without a return map, or with fewer than two crossings.
pub(super) fn figure(body: &Body<'_>) -> Option<ReturnMapFigure> {
    let xs = body.dataset.crossings.as_ref()?.get("x")?;
    let length = body.factor(LENGTH);
    let points: Vec<[f64; 2]> = xs.windows(2).map(|pair| [pair[0] * length, pair[1] * length]).collect();
    if points.is_empty() {
        return None;
    }
    let mut caption = vec![words::parameters(body)];
    caption.extend(words::section(body));
    caption.push(format!("{} crossings.", xs.len()));
    Some(ReturnMapFigure {
        title: format!("{}: return map", body.dataset.title()),
        caption,
        x_label: body.label("*x*_*n*", LENGTH),
        y_label: body.label("*x*_{*n*+1}", LENGTH),
        points,
    })
}
