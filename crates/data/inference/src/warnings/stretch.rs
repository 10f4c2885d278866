//! Outlines that are elongated along one direction of the images, whatever the heading: pixels that are not square, or a field.

use crate::Track;
use motiform_dynamics::Complex;

/// Blocks of a record.
const BLOCKS: usize = 24;
/// Fewest frames of a block.
const LEAST_IN_BLOCK: usize = 5;
/// Largest order of headings: the mean outline of a cell that keeps a direction, or has legs in two of them,
/// is elongated without a stretch.
const MOST_ORDER: f64 = 1.0 / 3.0;
/// Significance: rare enough for a thousand cells.
const LEVEL: f64 = 1e-4;
/// Smaller shares of the elongation are no matter.
const LEAST_SHARE: f64 = 0.05;

/// A mean elongation that does not turn with the cell: `c` in z2 = c + a exp(-2 i heading), by least squares.
/// Equations that keep their form under rotations have `c` = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// `|c|` over the root mean square of `|z2|`.
    pub share: f64,
    /// Direction of the elongation `c`, in degrees from the x axis, from -90 to 90.
    pub degrees: f64,
    /// Probability of such a `c`, or a larger one, without stretch: Hotelling's T^2 of 24 blocks of the record.
    pub p_value: f64,
    /// Largest modulus of the means of exp(i k heading), k = 1 to 4: above 1/3 the mean outline may be
    /// elongated without a stretch, because the cell keeps a direction.
    pub order: f64,
}

/// The heading as a unit vector, and z2.
type Frame = (Complex<f64>, Complex<f64>);

impl Stretch {
    /// The stretch of a track; `None` with fewer than 120 frames, or where all headings are one.
    ///
    /// # Checked by  `tests/all/stretch.rs`: simulated cells with y scaled, and without
    pub fn of(track: &Track) -> Option<Self> {
        let frames = frames(track);
        let order = order(&frames);
        if frames.len() < BLOCKS * LEAST_IN_BLOCK || order >= 1.0 {
            return None;
        }
        let (c, p_value) = constant(&frames);
        let square = frames.iter().map(|one| one.1.norm_sqr()).sum::<f64>() / frames.len() as f64;
        let share = (c.norm_sqr() / square).sqrt();
        Some(Self { share, degrees: -0.5 * libm::atan2(c.im, c.re).to_degrees(), p_value, order })
    }

    /// Returns `true` if there is a stretch, of the only or clearest one of so many cells: significant, not
    /// negligible, and of a cell whose headings take all directions.
    pub fn is_clear(&self, cells: usize) -> bool {
        self.is_possible(cells) && self.order <= MOST_ORDER
    }

    /// Returns `true` if there is one, or the directions that the cell keeps look like one.
    pub fn is_possible(&self, cells: usize) -> bool {
        self.p_value * cells as f64 <= LEVEL && self.share > LEAST_SHARE
    }
}

/// Frames between two others, whose displacement has the direction of the heading.
fn frames(track: &Track) -> Vec<Frame> {
    let point = |y: &[f64], k: usize| Complex::new(y[k], y[k + 1]);
    let three = track.0.windows(3).filter_map(|three| {
        let step = point(&three[2].y, 0) + -point(&three[0].y, 0);
        let length = step.norm_sqr().sqrt();
        (length > 0.0).then(|| (step.scale(1.0 / length), point(&three[1].y, 2)))
    });
    three.collect()
}

/// Largest modulus of the means of exp(i k heading), k = 1 to 4.
fn order(frames: &[Frame]) -> f64 {
    let power = |u: Complex<f64>, k: usize| (1..k).fold(u, |product, _| product * u);
    (1..=4).map(|k| mean(frames.iter().map(|one| power(one.0, k))).norm_sqr().sqrt()).fold(0.0, f64::max)
}

/// `c` of `z2 = c + a w` with `w = exp(-2 i heading)`, and the probability of such a value if `c = 0`: from
/// sums over blocks of the influence of each frame on `c`, `r (1 - <w> conj(w))/(n (1 - |<w>|^2))` with the
/// residual `r`.
fn constant(frames: &[Frame]) -> (Complex<f64>, f64) {
    let turned: Vec<Frame> = frames.iter().map(|&(u, z)| (u.square().conj(), z)).collect();
    let w = mean(turned.iter().map(|one| one.0));
    let z = mean(turned.iter().map(|one| one.1));
    let rest = 1.0 / (1.0 - w.norm_sqr());
    let together = mean(turned.iter().map(|one| one.0.conj() * one.1));
    let a = (together + -(w.conj() * z)).scale(rest);
    let c = z + -(a * w);
    let influence = |&(own, z): &Frame| {
        let residual = z + -c + -(a * own);
        (residual * (Complex::new(1.0, 0.0) + -(w * own.conj()))).scale(rest / frames.len() as f64)
    };
    let blocks = turned.chunks_exact(frames.len() / BLOCKS).take(BLOCKS);
    (c, hotelling(c, blocks.map(|block| sum(block.iter().map(influence)))))
}

/// Probability that a sum of two numbers is so far from 0, or farther, when its variance is known from its
/// independent parts alone. For two numbers the distribution of T^2 has a closed form.
fn hotelling(c: Complex<f64>, parts: impl Iterator<Item = Complex<f64>>) -> f64 {
    let free = BLOCKS as f64 - 1.0;
    let scale = BLOCKS as f64 / free;
    let [xx, xy, yy] = parts
        .fold([0.0; 3], |[xx, xy, yy], p| [xx + p.re * p.re, xy + p.re * p.im, yy + p.im * p.im])
        .map(|sum| scale * sum);
    let determinant = xx * yy - xy * xy;
    if determinant <= 0.0 {
        return 1.0; // all parts alike: they say nothing of the error
    }
    let t2 = (c.re * c.re * yy - 2.0 * c.re * c.im * xy + c.im * c.im * xx) / determinant;
    libm::pow(1.0 + t2 / free, -0.5 * (free - 1.0))
}

fn sum(all: impl Iterator<Item = Complex<f64>>) -> Complex<f64> {
    all.fold(Complex::new(0.0, 0.0), |sum, one| sum + one)
}

fn mean(all: impl ExactSizeIterator<Item = Complex<f64>>) -> Complex<f64> {
    let count = all.len() as f64;
    sum(all).scale(1.0 / count)
}
