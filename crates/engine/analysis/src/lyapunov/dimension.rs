//! The dimension that the exponents say.

use super::Lyapunov;
use crate::{Estimate, sort_by_number};

/// An exponent this near to the rate of a silent coordinate, against it, is that of this coordinate, beside its error.
const SAME: f64 = 1e-6;

impl Lyapunov {
    /// The Kaplan-Yorke dimension `j + (lambda_1 + .. + lambda_j) / |lambda_(j+1)|`, with j the largest number of leading exponents whose
    /// sum is not negative; its error is that of the exponents, to first order. Exponents that must be zero ([`Lyapunov::zeros`]) count
    /// as zero.
    ///
    /// Coordinates in which the motion rests, and on which the others do not act ([`Lyapunov::silent`]), are left out: the formula
    /// would count one that decays slowly as a dimension of the motion.
    ///
    /// It is the dimension of the set of shapes, all rotated copies included: the rotation of a body that turns counts as one.
    /// `None` where too few exponents were computed for their sum to become negative beyond its error, as in flows that keep volumes, or
    /// one has no error. 0 where all are negative.
    ///
    /// Source: Kaplan, Yorke (1979), Lecture Notes in Mathematics 730, 204; Frederickson et al. (1983), J. Differ. Equ. 49, 185.
    ///
    /// # Checked by  tests/all/lyapunov.rs: the published value of Lorenz-63
    pub fn dimension(&self) -> Option<Estimate> {
        let zeros = self.zeros();
        let exact = |x: &Estimate| if zeros.contains(x) { Estimate { value: 0.0, error: 0.0 } } else { *x };
        let mut exponents: Vec<Estimate> = self.exponents.iter().map(exact).collect();
        sort_by_number(&mut exponents, |a| -a.value);
        for rate in &self.silent {
            let off = |x: &Estimate| (x.value - rate).abs();
            let nearest =
                (0..exponents.len()).min_by(|&i, &j| off(&exponents[i]).total_cmp(&off(&exponents[j])));
            if let Some(place) =
                nearest.filter(|&i| off(&exponents[i]) <= exponents[i].error + SAME * rate.abs())
            {
                exponents.remove(place);
            }
        }
        if exponents.is_empty() || !exponents.iter().all(Estimate::has_error) {
            return None;
        }
        let (mut sum, mut square) = (0.0_f64, 0.0_f64);
        for (count, next) in exponents.iter().enumerate() {
            if sum + next.value < 0.0 {
                let rate = -next.value;
                if rate <= next.error || rate - sum <= libm::hypot(next.error, square.sqrt()) {
                    return None;
                }
                let error = libm::sqrt(square + (sum * next.error / rate).powi(2)) / rate;
                return Some(Estimate { value: count as f64 + sum / rate, error });
            }
            sum += next.value;
            square += next.error * next.error;
        }
        None
    }
}
