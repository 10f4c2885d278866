//! The parameters of the active cell model.

use super::names;
use crate::parameters::parameters;
use motiform_dynamics::model::Coordinate;

parameters! {
    /// Parameters of the active cell model, named as in the paper, eqs. (C) and (VEL). All dimensionless.
    ///
    /// The default is the paper's irregular motion, `length = 21.6`. The last four set the resolution and
    /// the closure of the boundary; they are parameters so that every result records them.
    CellParameters for "cell" {
        length = 21.6 in 6.0 .. 32.0 within 0.01 .. 200.0, "*L*", "(C)",
            "length of the closed boundary; mode n of the shape is unstable for length > 2 pi n.";
        g1 = 0.0 in -1.0 .. 1.0, "*g*_1", "(C)", "g1 phi_ss: damps long waves for g1 > 0.";
        g2 = 1.0 in 0.0 .. 2.0, "*g*_2", "(C)", "g2 phi_ssss: makes the circle unstable for g2 > 0.";
        g3 = 1.0 in 0.1 .. 2.0 within 1e-6 .. 1e6, "*g*_3", "(C)",
            "g3 phi_ssssss: damps short waves; above 0, or the equation has no solutions.";
        g4 = 0.0 in -1.0 .. 1.0, "*g*_4", "(C)", "g4 phi_s phi_ss: the variational quadratic term.";
        g5 = -1.0 in -2.0 .. 2.0, "*g*_5", "(C)", "g5 phi_ss phi_sss: the quadratic term that is not variational and makes the shape move.";
        alpha2 = 0.0 in -0.1 .. 0.1, "*α*_2", "(VEL)", "alpha2 phi_s^2 n: pushes along the normal where the boundary is curved.";
        alpha3 = 0.0 in -0.1 .. 0.1, "*α*_3", "(VEL)",
            "alpha3 phi_ss^2 n: pushes along the normal where the curvature changes (added to alpha3_per_length times length).";
        alpha3_per_length = -4e-4 in -1e-3 .. 1e-3, "*α*_3/*L*", "(VEL)",
            "the same as a multiple of the length, as the paper gives it: alpha3 = -4e-4 length.";
        modes = 21.0 in 8.0 .. 64.0 within 1.0 .. 128.0 as whole, "*M*", "modes",
            "number of modes of phi that are computed (a whole number): 21 are a grid of 64 points, 42 one of 128.";
        closure_modes = 8.0 in 0.0 .. 12.0 within 0.0 .. 12.0 as whole, "*m*", "(CLOSE)",
            "number of modes of the error function that closes the boundary (a whole number); 0 leaves it open, 1 changes mode 1 alone.";
        prior = 4.0 in 0.0 .. 6.0 within 0.0 .. 8.0, "*p*", "(CLOSE)",
            "how smooth the error function is expected to be: prior width n^-prior of its mode n; 0 is a flat prior.";
        feedback = 0.0 in 0.0 .. 1.0 within 0.0 .. 1.0 as whole, "*f*", "(CLOSE)",
            "1 adds the error function to phi after every step (a whole number); then nothing moves up to a \
            length of about 15 (measured: 16), which is why it is off.";
    }
}

impl CellParameters {
    /// `k_1 = 2 pi / length`.
    pub fn wavenumber(&self) -> f64 {
        std::f64::consts::TAU / self.length
    }

    /// `alpha3` with its part per length.
    pub fn alpha3_total(&self) -> f64 {
        self.alpha3 + self.alpha3_per_length * self.length
    }

    /// Fewest modes for this length: the shortest wave has `k = 3`, where the damping `k^6 - k^4 = 648` is far beyond
    /// the largest growth rate, 4/27. (At `k = 4` the spectrum has fallen to about 1e-8 of its top.)
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
    pub fn fewest_modes(&self) -> usize {
        (3.0 / self.wavenumber()).ceil() as usize
    }

    /// The names of the state, in file order: `c1, s1, c2, s2, ..` for `modes` modes.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturates: few names of few modes"
    )]
    pub fn coordinates(&self) -> &'static [Coordinate] {
        names::coordinates(self.modes as usize)
    }
}
