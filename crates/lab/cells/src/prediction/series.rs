//! A vector at each frame, where it is there.

/// Vectors in the order of their frames, and 1 where one is there, 0 where it is not: sums over pairs of frames have no branches.
pub(super) struct Series {
    at: Vec<[f64; 2]>,
    there: Vec<f64>,
}

impl Series {
    pub(super) fn of(vectors: impl Iterator<Item = Option<[f64; 2]>>) -> Self {
        let (at, there) =
            vectors.map(|vector| vector.map_or(([0.0; 2], 0.0), |vector| (vector, 1.0))).unzip();
        Self { at, there }
    }

    /// Number of frames.
    pub(super) fn len(&self) -> usize {
        self.at.len()
    }

    /// The vector of a frame.
    pub(super) fn get(&self, frame: usize) -> Option<[f64; 2]> {
        (*self.there.get(frame)? > 0.0).then(|| self.at[frame])
    }

    /// The vectors that are there.
    pub(super) fn iter(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.at.iter().zip(&self.there).filter(|(_, there)| **there > 0.0).map(|(at, _)| *at)
    }

    /// The same with this function of each vector.
    pub(super) fn map(&self, of: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        Self { at: self.at.iter().map(|at| of(*at)).collect(), there: self.there.clone() }
    }

    /// The mean of `of(a, b)` over all frames `a` of this series and `b` of another, so many frames later, that are both there; NaN where
    /// there are none.
    pub(super) fn mean_with(&self, other: &Self, lag: isize, of: impl Fn([f64; 2], [f64; 2]) -> f64) -> f64 {
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

    /// Mean square of the change over so many frames.
    pub(super) fn mean_square(&self, lag: usize) -> f64 {
        self.mean_with(self, lag.cast_signed(), |a, b| {
            let [x, y] = [b[0] - a[0], b[1] - a[1]];
            x * x + y * y
        })
    }

    /// `<a(t) . a(t + lag)> / <a^2>` at each of these lags.
    pub(super) fn correlations(&self, lags: &[usize]) -> Vec<f64> {
        let product = |lag: usize| self.mean_with(self, lag.cast_signed(), dot);
        let square = product(0);
        lags.iter().map(|&lag| product(lag) / square).collect()
    }
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
