//! Return maps: pairs of consecutive values, and the dimension of a set of section points.

use crate::{Error, Result, checks};

/// Fewest points of a section.
const LEAST: usize = 200;

/// Boxes of ln r per octave.
const PER_OCTAVE: i32 = 4;

/// Neighbours per point, on average, at the smallest scale.
const NEIGHBOURS: f64 = 8.0;

/// Largest scale over the radius of the set: at half of it a circle's chords are 1 % short of its arcs.
const LARGEST: f64 = 0.5;

/// Most octaves of scales, from the smallest up.
const OCTAVES: i32 = 5;

/// Octaves over which a local slope is taken.
const LOCAL: i32 = 1;

/// Fewest octaves that make a slope.
const LEAST_OCTAVES: f64 = 1.5;

/// Pairs (x_n, x_(n+1)): the graph of the return map.
pub fn return_pairs(values: &[f64]) -> Vec<[f64; 2]> {
    values.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// The dimension of a set of points, by its correlation sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dimension {
    /// D2: near 0 a finite set, near 1 a curve, above 1.2 more than a curve.
    pub value: f64,
    /// Half the range of the slopes over single octaves: how well one number describes all scales.
    pub spread: f64,
    /// Smallest distance used.
    pub smallest: f64,
    /// Largest distance used; equal to `smallest` where the whole set is one point.
    pub largest: f64,
}

/// Correlation dimension D2 of a set of section points: what the attractor of the return map is.
///
/// C(r) = share of the pairs of points closer than r;   D2 = d ln C / d ln r by least squares over the scales r
///
/// For the returns of an orbit to a section: 0, the orbit is periodic (as many points as crossings per period, any
/// number of times); 1, it fills a closed curve, so the motion is quasi-periodic on a 2-torus; above 1.2, it is more:
/// chaotic, or a torus of higher dimension.
///
/// Scales, from below: distances under `resolution` count as 0; on average 8 neighbours per point (C = 8/n); at most 5
/// octaves up from there, and at most half the root mean square distance of the points from their mean. The correlation
/// dimension is chosen over an ordering of the points by angle, as it needs no plane in which the curve has no double
/// points, and tells all three cases by one number.
///
/// Source: Grassberger and Procaccia (1983), Phys. Rev. Lett. 50, 346.
///
/// # Shapes    n points of equal length; costs n^2/2 distances
/// # Units     `resolution` (accuracy of the points) in those of the points
/// # Errors    [`Error::TooFew`] below 200 points, [`Error::Shape`], [`Error::NotFinite`], [`Error::OutOfRange`];
/// [`Error::Scales`] where less than 1.5 octaves are left: sets of dimension 2 need more points than curves
/// # Not       for points along a flow, which is a curve by itself: use a section; not for short or drifting runs
/// # Checked by  tests/all/returns.rs: circle, ellipse in 6 dimensions, finite sets, Henon map, a square
pub fn correlation_dimension(points: &[Vec<f64>], resolution: f64) -> Result<Dimension> {
    check(points, resolution)?;
    let radius = radius(points)?;
    if radius <= resolution {
        return Ok(Dimension { value: 0.0, spread: 0.0, smallest: resolution, largest: resolution });
    }
    let top = scale_below(LARGEST * radius);
    let sums = Sums::new(points, top, scale_below(resolution));
    let bottom = sums.first_above(NEIGHBOURS / points.len() as f64);
    let end = top.min(bottom + OCTAVES * PER_OCTAVE);
    if f64::from(end - bottom) < LEAST_OCTAVES * f64::from(PER_OCTAVE) {
        return Err(Error::Scales { points: points.len(), smallest: size(bottom), largest: size(top) });
    }
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for from in bottom..=end - LOCAL * PER_OCTAVE {
        let slope = sums.slope(from, from + LOCAL * PER_OCTAVE);
        (least, most) = (least.min(slope), most.max(slope));
    }
    let value = sums.slope(bottom, end).max(0.0); // C grows: below 0 is rounding
    Ok(Dimension { value, spread: 0.5 * (most - least), smallest: size(bottom), largest: size(end) })
}

/// The distance number `scale`: 2^(scale/4).
fn size(scale: i32) -> f64 {
    libm::exp2(f64::from(scale) / f64::from(PER_OCTAVE))
}

/// The largest scale up to `distance`; distances of 0 are below all others.
#[allow(clippy::cast_possible_truncation, reason = "exponents of doubles are within -1075 .. 1024")]
fn scale_below(distance: f64) -> i32 {
    (f64::from(PER_OCTAVE) * libm::log2(distance.max(f64::MIN_POSITIVE))).floor() as i32
}

/// ln C(r) at the scales from `first` to the largest, counting pairs.
struct Sums {
    first: i32,
    logs: Vec<f64>,
}

impl Sums {
    fn new(points: &[Vec<f64>], top: i32, bottom: i32) -> Self {
        // 60 octaves are more than doubles resolve
        let first = bottom.max(top - 60 * PER_OCTAVE).min(top) + 1;
        let boxes = usize::try_from(top - first + 1).unwrap_or(0);
        let mut counts = vec![0_u64; boxes + 1];
        for (i, point) in points.iter().enumerate() {
            for other in &points[..i] {
                // the first scale above the distance
                let above = scale_below(distance_squared(point, other).sqrt()).saturating_add(1) - first;
                let place = usize::try_from(above).unwrap_or(0); // below the first scale
                counts[place.min(boxes)] += 1; // above the last one
            }
        }
        let pairs = (points.len() * (points.len() - 1) / 2) as f64;
        let mut sum = 0;
        let cumulated = counts[..boxes].iter().map(|count| {
            sum += count;
            sum as f64 / pairs
        });
        Self { first, logs: cumulated.map(libm::log).collect() }
    }

    /// The first scale at which C(r) is at least `share`; one past the last if there is none.
    fn first_above(&self, share: f64) -> i32 {
        let log = libm::log(share);
        let below = self.logs.iter().take_while(|c| **c < log).count();
        self.first + i32::try_from(below).unwrap_or(i32::MAX)
    }

    /// d ln C / d ln r by least squares over the scales `from ..= to`.
    fn slope(&self, from: i32, to: i32) -> f64 {
        let middle = 0.5 * f64::from(from + to);
        let (mut along, mut square) = (0.0, 0.0);
        for scale in from..=to {
            let x = f64::from(scale) - middle;
            let place = usize::try_from(scale - self.first).unwrap_or(0);
            along += x * self.logs[place];
            square += x * x;
        }
        along / square * f64::from(PER_OCTAVE) / std::f64::consts::LN_2
    }
}

fn distance_squared(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum()
}

/// Root mean square distance from the mean.
fn radius(points: &[Vec<f64>]) -> Result<f64> {
    let count = points.len() as f64;
    let mut mean = vec![0.0; points[0].len()];
    for point in points {
        for (sum, (x, origin)) in mean.iter_mut().zip(point.iter().zip(&points[0])) {
            *sum += (x - origin) / count;
        }
    }
    for (middle, origin) in mean.iter_mut().zip(&points[0]) {
        *middle += origin;
    }
    let square: f64 = points.iter().map(|point| distance_squared(point, &mean) / count).sum();
    let all = || points.iter().flatten().copied().collect::<Vec<f64>>();
    if square.is_finite() { Ok(square.sqrt()) } else { Err(checks::overflow(&all())) }
}

fn check(points: &[Vec<f64>], resolution: f64) -> Result<()> {
    checks::at_least("a correlation dimension, in points,", LEAST, points.len())?;
    checks::argument("the resolution", resolution, resolution > 0.0, "above 0")?;
    checks::at_least("a point, in coordinates,", 1, points[0].len())?;
    checks::points(points.iter(), points[0].len())
}
