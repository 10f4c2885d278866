//! The test that points of the plane lie on curves, and that these are closed.
//!
//! The shortest tree that joins the points of a curve is a path along it: its longest path meets nearly all of them, while it meets few of
//! points that fill an area. If the curve is closed, the two ends of that path are neighbours like any others.

/// The length at which the tree is cut: neighbours further apart than this part of the extent belong to
/// different pieces.
const CUT: f64 = 0.1;

/// Ends of a closed curve are at most this many times as far apart as the furthest neighbours along it.
const CLOSED: f64 = 1.5;

/// Fewest points of a piece that is called a curve.
const LEAST: usize = 10;

/// A piece of a set of points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// Its points.
    pub(super) points: usize,
    /// Those on the longest path through the tree.
    pub(super) along: usize,
    /// Distance of the ends of that path, and of the furthest neighbours on it, as parts of the extent of the whole set.
    pub(super) ends: f64,
    pub(super) widest: f64,
}

impl Piece {
    /// Returns `true` if nearly all of its points lie in a row.
    pub(super) fn is_curve(&self) -> bool {
        self.points >= LEAST && self.along as f64 >= 0.9 * self.points as f64
    }

    /// Returns `true` if the row returns to its start.
    pub(super) fn is_closed(&self) -> bool {
        self.is_curve() && self.ends <= CLOSED * self.widest
    }
}

/// The pieces of the points, the largest first.
pub(super) fn pieces(points: &[[f64; 2]]) -> Vec<Piece> {
    let tree = Tree::of(points);
    let mut seen = vec![false; points.len()];
    let mut pieces = Vec::new();
    for start in 0..points.len() {
        if !seen[start] {
            let reached = tree.from(start);
            reached.iter().for_each(|step| seen[step.at] = true);
            pieces.push(tree.piece(&reached));
        }
    }
    pieces.sort_by_key(|piece| std::cmp::Reverse(piece.points));
    pieces
}

/// The shortest tree, without its edges that are too long.
struct Tree<'p> {
    points: &'p [[f64; 2]],
    extent: f64,
    neighbours: Vec<Vec<usize>>,
}

/// A point reached along the tree: how far it is, over how many points, and the widest step to it.
#[derive(Clone, Copy)]
struct Step {
    at: usize,
    far: f64,
    points: usize,
    widest: f64,
}

impl<'p> Tree<'p> {
    /// Prim's algorithm.
    fn of(points: &'p [[f64; 2]]) -> Self {
        let extent = (0..2).map(|i| {
            let ends = points
                .iter()
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [low.min(p[i]), high.max(p[i])]);
            ends[1] - ends[0]
        });
        let extent = extent.fold(f64::MIN_POSITIVE, f64::max);
        let mut tree = Self { points, extent, neighbours: vec![Vec::new(); points.len()] };
        let mut nearest = vec![(f64::INFINITY, 0); points.len()];
        let mut left: Vec<usize> = (0..points.len()).collect();
        while let Some(place) =
            (0..left.len()).min_by(|a, b| nearest[left[*a]].0.total_cmp(&nearest[left[*b]].0))
        {
            let new = left.swap_remove(place);
            let (far, old) = nearest[new];
            if far <= CUT {
                tree.neighbours[new].push(old);
                tree.neighbours[old].push(new);
            }
            for &other in &left {
                let far = tree.apart(new, other);
                if far < nearest[other].0 {
                    nearest[other] = (far, new);
                }
            }
        }
        tree
    }

    fn apart(&self, a: usize, b: usize) -> f64 {
        let ([x, y], [u, v]) = (self.points[a], self.points[b]);
        libm::hypot(x - u, y - v) / self.extent
    }

    /// All points that are joined with one.
    fn from(&self, start: usize) -> Vec<Step> {
        let mut reached = vec![Step { at: start, far: 0.0, points: 1, widest: 0.0 }];
        let mut next = 0;
        let mut seen = vec![false; self.points.len()];
        seen[start] = true;
        while let Some(&here) = reached.get(next) {
            next += 1;
            for &other in &self.neighbours[here.at] {
                if !std::mem::replace(&mut seen[other], true) {
                    let step = self.apart(here.at, other);
                    reached.push(Step {
                        at: other,
                        far: here.far + step,
                        points: here.points + 1,
                        widest: here.widest.max(step),
                    });
                }
            }
        }
        reached
    }

    /// The point that is furthest along the tree from any is one end of its longest path.
    fn piece(&self, reached: &[Step]) -> Piece {
        let furthest = |steps: &[Step]| steps.iter().copied().max_by(|a, b| a.far.total_cmp(&b.far));
        let one = furthest(reached).map_or(0, |step| step.at);
        let end = furthest(&self.from(one)).unwrap_or(Step { at: one, far: 0.0, points: 1, widest: 0.0 });
        Piece { points: reached.len(), along: end.points, ends: self.apart(one, end.at), widest: end.widest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Points at a part `from..to` of an ellipse, in the order of a rotation by the golden mean.
    fn ellipse(count: usize, to: f64) -> Vec<[f64; 2]> {
        let at = |i: usize| to * (0.618_033_988_749_894_9 * i as f64).fract() * TAU;
        (0..count).map(|i| [3.0 + 0.3 * libm::cos(at(i)), 2.0 + 0.2 * libm::sin(at(i))]).collect()
    }

    #[test]
    fn a_closed_curve_is_told_from_an_open_one() {
        let whole = pieces(&ellipse(240, 1.0));
        assert!(whole.len() == 1 && whole[0].is_closed(), "{whole:?}");
        let open = pieces(&ellipse(240, 0.95));
        assert!(open.len() == 1 && open[0].is_curve() && !open[0].is_closed(), "{open:?}");
    }

    #[test]
    fn two_arcs_are_two_curves_and_a_cloud_is_none() {
        let mut arcs = ellipse(200, 0.4);
        arcs.extend(ellipse(200, 0.4).into_iter().map(|[x, y]| [6.0 - x, 3.5 - y]));
        let arcs = pieces(&arcs);
        assert!(arcs.len() == 2 && arcs.iter().all(|arc| arc.is_curve() && !arc.is_closed()), "{arcs:?}");
        let mut random = motiform_study::initial::Uniform::new(4, 0);
        let cloud: Vec<[f64; 2]> = (0..300).map(|_| [random.draw(), random.draw()]).collect();
        assert!(!pieces(&cloud)[0].is_curve());
    }

    #[test]
    fn a_few_points_are_no_curve() {
        let points: Vec<[f64; 2]> = (0..300).map(|i| [f64::from(i % 5), f64::from(i % 5 * 2)]).collect();
        assert!(pieces(&points).iter().all(|piece| !piece.is_curve() || piece.widest == 0.0));
        assert!(pieces(&[]).is_empty());
    }
}
