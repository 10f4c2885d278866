//! The room for the words beside a mark.

use super::geometry::{Point, Rect};

/// The place of words of a size beside a mark: to the right and above, or the next of the four corners that
/// lies in the frame and hides no words that are there (`taken`); to the right and above if there is none.
pub(super) fn beside([x, y]: Point, [w, h]: [f64; 2], gap: f64, frame: Rect, taken: &[Rect]) -> Rect {
    let corners = [(gap, -gap - h), (gap, gap), (-gap - w, -gap - h), (-gap - w, gap)];
    let places = corners.map(|(dx, dy)| Rect { x: x + dx, y: y + dy, w, h });
    let inside = |r: &Rect| {
        r.x >= frame.x && r.right() <= frame.right() && r.y >= frame.y && r.bottom() <= frame.bottom()
    };
    let free = |r: &&Rect| inside(r) && taken.iter().all(|other| apart(r, other));
    places.iter().find(free).copied().unwrap_or(places[0])
}

fn apart(a: &Rect, b: &Rect) -> bool {
    a.right() < b.x || b.right() < a.x || a.bottom() < b.y || b.bottom() < a.y
}
