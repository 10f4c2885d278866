//! The part of a polyline inside a rectangle.

use super::geometry::{Point, Rect};

/// The pieces of a polyline inside a rectangle, so that no far-away point reaches a renderer.
///
/// Source: Liang & Barsky (1984), ACM Trans. Graph. 3, 1.
pub(crate) fn clip(points: &[Point], frame: Rect) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    for pair in points.windows(2) {
        let Some([from, to]) = inside(pair[0], pair[1], frame) else { continue };
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&from) => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
    }
    pieces
}

/// The part of the segment `a`-`b` inside the frame.
fn inside(a: Point, b: Point, frame: Rect) -> Option<[Point; 2]> {
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    let sides = [(0, frame.x, frame.right()), (1, frame.y, frame.bottom())];
    for (axis, low, high) in sides {
        let step = b[axis] - a[axis];
        if step == 0.0 {
            if a[axis] < low || a[axis] > high {
                return None;
            }
            continue;
        }
        let (first, second) = ((low - a[axis]) / step, (high - a[axis]) / step);
        enter = enter.max(first.min(second));
        leave = leave.min(first.max(second));
    }
    let at = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
    (enter < leave)
        .then(|| [if enter > 0.0 { at(enter) } else { a }, if leave < 1.0 { at(leave) } else { b }])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FRAME: Rect = Rect { x: -1.0, y: -1.0, w: 2.0, h: 2.0 };

    #[test]
    fn a_line_through_the_frame_is_cut_at_its_edges() {
        assert_eq!(
            clip(&[[-9.0, 0.0], [0.0, 0.0], [0.0, 9e90]], FRAME),
            [[[-1.0, 0.0], [0.0, 0.0], [0.0, 1.0]]]
        );
        assert!(clip(&[[-9.0, 2.0], [9.0, 2.0]], FRAME).is_empty());
        assert_eq!(clip(&[[0.0, 0.0], [3.0, 0.0], [3.0, 0.5], [0.0, 0.5]], FRAME).len(), 2);
    }

    proptest! {
        #[test]
        fn pieces_stay_inside(points in prop::collection::vec([-5.0..5.0f64, -5.0..5.0f64], 0..30)) {
            for [x, y] in clip(&points, FRAME).into_iter().flatten() {
                prop_assert!(x.abs() < 1.0 + 1e-9 && y.abs() < 1.0 + 1e-9);
            }
        }
    }
}
