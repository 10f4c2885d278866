//! The 21 parameters of the tensor model.

use crate::parameters::parameters;

parameters! {
    /// Parameters of the tensor model, named as in the paper, eqs. (V), (S), (U). All dimensionless.
    ///
    /// The default is a circle that swims straight: `gamma = kappa2 = kappa3 = 1`, no couplings.
    TensorParameters for "tensor" {
        gamma = 1.0 in -0.5 .. 2.0, "*γ*", "(V)", "gamma v: self-propulsion; a circle moves by itself where gamma > 0.";
        kappa2 = 1.0 in -0.5 .. 2.0, "*κ*_2", "(S)",
            "-kappa2 S: relaxation rate of the elliptic deformation; negative, the circle is unstable to an ellipse.";
        kappa3 = 1.0 in -0.5 .. 2.0, "*κ*_3", "(U)",
            "-kappa3 U: relaxation rate of the three-fold deformation; negative, the circle is unstable to a triangle.";
        a1 = 0.0 in -2.0 .. 2.0, "*a*_1", "(V)",
            "-a1 S v: the ellipse steers the velocity, across its long axis for a1 > 0 and along it for a1 < 0.";
        a2 = 0.0 in -2.0 .. 2.0, "*a*_2", "(V)", "-a2 U v v: the triangle steers the velocity.";
        a3 = 0.0 in -2.0 .. 2.0, "*a*_3", "(V)", "-a3 U S: ellipse and triangle together propel the body.";
        a4 = 0.0 in -2.0 .. 2.0, "*a*_4", "(V)", "-a4 (S:S) v: the ellipse slows the body down for a4 > 0.";
        a5 = 0.0 in -2.0 .. 2.0, "*a*_5", "(V)", "-a5 (U:U) v: the triangle slows the body down for a5 > 0.";
        a6 = 0.0 in -2.0 .. 2.0, "*a*_6", "(V)", "+a6 S_ij S_kl U_jkl: propulsion by the square of the ellipse with the triangle.";
        b1 = 0.0 in -2.0 .. 2.0, "*b*_1", "(S)",
            "+b1 (v v - v^2/2): motion stretches the body, along the velocity for b1 > 0 and across it for b1 < 0.";
        b2 = 0.0 in -2.0 .. 2.0, "*b*_2", "(S)", "+b2 U v: a moving triangle becomes elliptic.";
        b3 = 0.0 in 0.0 .. 2.0, "*b*_3", "(S)", "-b3 (S:S) S: saturation of the ellipse; needed where kappa2 < 0.";
        b4 = 0.0 in -2.0 .. 2.0, "*b*_4", "(S)", "-b4 v^2 S: motion damps the ellipse for b4 > 0.";
        b5 = 0.0 in -2.0 .. 2.0, "*b*_5", "(S)", "-b5 (U:U) S: the triangle damps the ellipse for b5 > 0.";
        b6 = 0.0 in -2.0 .. 2.0, "*b*_6", "(S)", "+b6 U S v: a moving triangle turns the ellipse.";
        d1 = 0.0 in -2.0 .. 2.0, "*d*_1", "(U)", "+d1 (v v v - trace): motion alone makes the body three-fold.";
        d2 = 0.0 in -2.0 .. 2.0, "*d*_2", "(U)", "+d2 (S v - trace): a moving ellipse becomes three-fold (head and tail differ).";
        d3 = 0.0 in 0.0 .. 2.0, "*d*_3", "(U)", "-d3 (U:U) U: saturation of the triangle; needed where kappa3 < 0.";
        d4 = 0.0 in -2.0 .. 2.0, "*d*_4", "(U)", "-d4 v^2 U: motion damps the triangle for d4 > 0.";
        d5 = 0.0 in -2.0 .. 2.0, "*d*_5", "(U)", "-d5 (S:S) U: the ellipse damps the triangle for d5 > 0.";
        d6 = 0.0 in -2.0 .. 2.0, "*d*_6", "(U)",
            "+2 d6 (S S v - trace): the square of the ellipse with the velocity makes the body three-fold.";
    }
}

impl TensorParameters {
    /// The paper's full model (Simulations II): gamma = 1, a1 = -1, b1 = -0.5, b2 = 0.3, d1 = 0.1, d2 = 0.8; the plane of
    /// its Fig. 4 is `(kappa2, kappa3)`.
    pub fn full(kappa2: f64, kappa3: f64) -> Self {
        Self { gamma: 1.0, kappa2, kappa3, a1: -1.0, b1: -0.5, b2: 0.3, d1: 0.1, d2: 0.8, ..Self::default() }
    }
}
