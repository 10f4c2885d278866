//! The view of the film, and its static background.

use super::ground::Ground;
use super::{Animation, Camera};
use crate::axes::{Axes, BELOW, Scale};
use crate::error::Result;
use crate::geometry::{Point, Range, Rect};
use crate::paint::Paint;
use crate::palette::INK;
use crate::sheet::Sheet as _;
use crate::svg::Anchor;
use crate::text::Label;
use crate::ticks::Ticks;
use tiny_skia::Pixmap;

/// Strip above the frame, for the time.
pub(super) const HEAD: f64 = 30.0;
const RIGHT: f64 = 18.0;
/// Room assumed for the y axis when the frame is sized.
const LEFT: f64 = 70.0;
const FOLLOW_MARGIN: f64 = 14.0;
const FOLLOW_FOOT: f64 = 38.0;

/// The view of a film: how its first picture maps, and whether the picture goes along with the body.
pub(super) struct View {
    /// Data to pixels; for a following camera, at the moment when the body is at the origin.
    pub(super) scale: Scale,
    /// `true` if the body stays in the middle.
    pub(super) follow: bool,
    /// Distance of grid lines under a following camera, in data units.
    pub(super) grid: f64,
    /// Everything that never changes.
    pub(super) ground: Pixmap,
}

impl View {
    /// Chooses camera and scale.
    pub(super) fn of(film: &Animation) -> Result<Self> {
        let trail = film.trail();
        let outlines = || film.frames.iter().flat_map(|f| f.outline.iter().copied().chain([f.centre]));
        let places = || trail.iter().map(|p| [p.x, p.y]).chain(outlines());
        let range =
            |i: usize| Range::of(places().map(|p: Point| p[i])).unwrap_or(Range { min: 0.0, max: 0.0 });
        let (x, y, body) = (range(0), range(1), 2.0 * film.body_radius());
        let extent = x.span().max(y.span());
        let follow = match film.camera {
            Camera::Fixed => false,
            Camera::Follow => true,
            Camera::Auto => body > 0.0 && extent > 14.0 * body,
        };
        if follow {
            let side = if body > 0.0 { 5.0 * body } else { (0.2 * extent).max(1e-9) };
            following(film, side)
        } else {
            fixed(film, x, y)
        }
    }
}

fn fixed(film: &Animation, x: Range, y: Range) -> Result<View> {
    let size = [x, y].iter().flat_map(|r| [r.min.abs(), r.max.abs()]).fold(0.0, f64::max);
    let extent = x.span().max(y.span());
    let extent =
        if extent > 0.0 { extent.max(1e-9 * size) } else { x.padded(0.0).span().max(y.padded(0.0).span()) };
    let (x, y) = (x.with_span(x.span() + 0.12 * extent), y.with_span(y.span() + 0.12 * extent));
    let left = (fixed_axes(film, x, y, LEFT).left_margin() + 8.0).ceil() + 0.5;
    let axes = fixed_axes(film, x, y, left).moved_to(left);
    let Rect { w, h, .. } = axes.scale.frame;
    let mut sheet = Ground::new(left + w + RIGHT, HEAD + h + BELOW)?;
    axes.draw_grid(&mut sheet);
    axes.draw(&mut sheet);
    Ok(View { scale: axes.scale, follow: false, grid: 0.0, ground: sheet.finish() })
}

/// Axes whose frame fits into the picture when its left edge is at `left`.
fn fixed_axes(film: &Animation, x: Range, y: Range, left: f64) -> Axes {
    let aspect = (x.span() / y.span()).clamp(0.5, 2.0);
    let longest = f64::from(film.size);
    let w = (longest - left - RIGHT).min((longest - HEAD - BELOW) * aspect).floor();
    let frame = Rect { x: 0.0, y: HEAD + 0.5, w, h: (w / aspect).floor() };
    Axes::new(Scale::equal(frame, x, y), Some(&film.x_label), &film.y_label)
}

fn following(film: &Animation, side: f64) -> Result<View> {
    let w = f64::from(film.size) - 2.0 * FOLLOW_MARGIN;
    let h = f64::from(film.size) - HEAD - FOLLOW_FOOT;
    let frame = Rect { x: FOLLOW_MARGIN + 0.5, y: HEAD + 0.5, w: w - 1.0, h: h - 1.0 };
    let range = Range { min: -0.5 * side, max: 0.5 * side };
    let scale = Scale::equal(frame, range, range);
    let ticks = Ticks::new(Range { min: 0.0, max: scale.x.span() }, 6);
    let grid = ticks.values[1] - ticks.values[0];
    let mut sheet = Ground::new(f64::from(film.size), f64::from(film.size))?;
    sheet.rect(frame, &Paint::stroke(INK, 1.0));
    let (bar, y) = (grid / scale.x.span() * frame.w, frame.bottom() + 20.0);
    let ends = [[frame.x, y], [frame.x + bar, y]];
    let caps = ends.map(|[x, y]| [[x, y - 4.0], [x, y + 4.0]]);
    sheet.lines(&[ends, caps[0], caps[1]], &Paint::stroke(INK, 1.4));
    let power = if ticks.exponent == 0 { String::new() } else { format!(" × 10^{{{}}}", ticks.exponent) };
    let label = Label::parse(&format!("{}{power} ({})", ticks.labels[1], film.unit));
    sheet.text([ends[1][0] + 10.0, y + 4.5], 13.0, Anchor::Start, &label);
    Ok(View { scale, follow: true, grid, ground: sheet.finish() })
}
