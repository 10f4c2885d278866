//! A vector at each frame, where it is there.

/// Vectors in the plane in the order of their frames, some of which may be missing: sums over pairs of frames that are both there.
///
/// A missing frame has the weight 0, so that sums have no branches. Means over no pair at all are NaN: their callers know how many frames
/// there are.
///
/// # Checked by  tests/all/gaps.rs: sums over pairs written out, with and without gaps
///
/// ```
/// use motiform_statistics::GappedVectors;
/// let line = GappedVectors::of([Some([0.0, 0.0]), None, Some([2.0, 0.0]), Some([3.0, 0.0])].into_iter());
/// assert_eq!(line.mean_square(1), 1.0); // one pair of neighbours
/// assert_eq!(line.mean_square(2), 4.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct GappedVectors {
    at: Vec<[f64; 2]>,
    there: Vec<f64>,
}

impl GappedVectors {
    /// The vectors of all frames, in their order.
    pub fn of(vectors: impl Iterator<Item = Option<[f64; 2]>>) -> Self {
        let (at, there) =
            vectors.map(|vector| vector.map_or(([0.0; 2], 0.0), |vector| (vector, 1.0))).unzip();
        Self { at, there }
    }

    /// Number of frames, missing ones included.
    pub fn len(&self) -> usize {
        self.at.len()
    }

    /// Returns `true` if there is no frame.
    pub fn is_empty(&self) -> bool {
        self.at.is_empty()
    }

    /// The vector of a frame.
    pub fn get(&self, frame: usize) -> Option<[f64; 2]> {
        (*self.there.get(frame)? > 0.0).then(|| self.at[frame])
    }

    /// The lengths of the vectors that are there.
    pub fn lengths(&self) -> Vec<f64> {
        let there = self.at.iter().zip(&self.there).filter(|(_, there)| **there > 0.0);
        there.map(|(at, _)| libm::hypot(at[0], at[1])).collect()
    }

    /// Displacements over so many frames, divided by `time`: that of each frame to the later one, where both are there.
    pub fn displacements(&self, frames: usize, time: f64) -> Self {
        let velocity = |at: usize| {
            let (a, b) = (self.get(at)?, self.get(at + frames)?);
            Some([(b[0] - a[0]) / time, (b[1] - a[1]) / time])
        };
        Self::of((0..self.len().saturating_sub(frames)).map(velocity))
    }

    /// Twice the angle of each vector, as a vector of length 1, mirrored at the x axis: with it [`GappedVectors::mean_dot`] is the mean of
    /// `Re z exp(2 i angle)`.
    pub fn doubled(&self) -> Self {
        let at = self.at.iter().map(|v| {
            let square = dot(*v, *v).max(f64::MIN_POSITIVE);
            [(v[0] * v[0] - v[1] * v[1]) / square, -2.0 * v[0] * v[1] / square]
        });
        Self { at: at.collect(), there: self.there.clone() }
    }

    /// Angles from each vector to that of so many frames later (rad, anticlockwise positive).
    pub fn turns(&self, frames: usize) -> Vec<f64> {
        let angle = |at: usize| {
            let (a, b) = (self.get(at)?, self.get(at + frames)?);
            Some(libm::atan2(a[0] * b[1] - a[1] * b[0], dot(a, b)))
        };
        (0..self.len()).filter_map(angle).collect()
    }

    /// The mean of `a . b` over all frames `a` of this series and `b` of another, `lag` frames later, that are both there; NaN where there
    /// are none.
    pub fn mean_dot(&self, other: &Self, lag: isize) -> f64 {
        self.mean_with(other, lag, dot)
    }

    /// The mean square of the change over `lag` frames; NaN where no two frames are so far apart.
    pub fn mean_square(&self, lag: usize) -> f64 {
        self.mean_with(self, lag.cast_signed(), |a, b| {
            let [x, y] = [b[0] - a[0], b[1] - a[1]];
            x * x + y * y
        })
    }

    /// `<a(t) . a(t + lag)> / <a^2>` at each of these lags (frames).
    pub fn correlations(&self, lags: &[usize]) -> Vec<f64> {
        let product = |lag: usize| self.mean_dot(self, lag.cast_signed());
        let square = product(0);
        lags.iter().map(|&lag| product(lag) / square).collect()
    }

    fn mean_with(&self, other: &Self, lag: isize, of: impl Fn([f64; 2], [f64; 2]) -> f64) -> f64 {
        let (before, after) = ((-lag).max(0) as usize, lag.max(0) as usize);
        let own = self.at.iter().zip(&self.there).skip(before);
        let others = other.at.iter().zip(&other.there).skip(after);
        let (mut sum, mut count) = (0.0, 0.0);
        for ((a, one), (b, two)) in own.zip(others) {
            let both = one * two;
            sum += both * of(*a, *b);
            count += both;
        }
        sum / count
    }
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
