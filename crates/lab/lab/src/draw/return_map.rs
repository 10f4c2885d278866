//! The return map: the next crossing of the section against the present one.

use super::body::Body;
use super::words;
use motiform_figures::Chart;
use motiform_study::Dimension;

/// `None` without a return map, or with fewer than two crossings.
pub(super) fn figure(body: &Body<'_>) -> Option<Chart> {
    let xs = body.dataset.crossings.as_ref()?.get("x")?;
    let length = body.units().factor(Dimension::LENGTH);
    let points: Vec<[f64; 2]> = xs.windows(2).map(|pair| [pair[0] * length, pair[1] * length]).collect();
    if points.is_empty() {
        return None;
    }
    let mut caption = vec![words::parameters(body)];
    caption.extend(words::section(body));
    caption.push(format!("{} crossings.", xs.len()));
    let names = ["*x*_*n*", "*x*_{*n*+1}"].map(|name| body.units().label(name, Dimension::LENGTH));
    Some(Chart {
        title: format!("{}: return map", body.dataset.title()),
        caption,
        ..Chart::return_map(names, points)
    })
}
