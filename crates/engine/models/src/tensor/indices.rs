//! The tensor model written with indices, as printed in the paper: the oracle of the Fourier form.
//!
//! Slow and plain on purpose: loops over i, j, k = 1, 2 and nothing simplified, one term per line. Only tests use it.
//! Source: paper, eqs. (V), (S), (U).

use super::TensorParameters;

type Vector = [f64; 2];
type Matrix = [[f64; 2]; 2];
type Tensor3 = [[[f64; 2]; 2]; 2];

const AXES: [usize; 2] = [0, 1];

/// Velocity, elliptic and three-fold deformation as full tensors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tensors {
    /// v_i.
    pub v: Vector,
    /// S_ij, symmetric and traceless.
    pub s: Matrix,
    /// U_ijk, totally symmetric and traceless.
    pub u: Tensor3,
}

impl Tensors {
    /// From the independent components `v1, v2, S11, S12, U111, U222`.
    pub fn from_components([v1, v2, s11, s12, u111, u222]: [f64; 6]) -> Self {
        let mut u = [[[0.0; 2]; 2]; 2];
        for (i, j, k) in triples() {
            u[i][j][k] = match i + j + k {
                0 => u111,
                1 => -u222, // U112 = -U222
                2 => -u111, // U122 = -U111
                _ => u222,
            };
        }
        Self { v: [v1, v2], s: [[s11, s12], [s12, -s11]], u }
    }

    /// The independent components `v1, v2, S11, S12, U111, U222`.
    pub fn components(&self) -> [f64; 6] {
        [self.v[0], self.v[1], self.s[0][0], self.s[0][1], self.u[0][0][0], self.u[1][1][1]]
    }

    /// Largest violation of symmetry and tracelessness: zero for a state, and for its rate of change.
    pub fn defect(&self) -> f64 {
        let mut worst = (self.s[0][1] - self.s[1][0]).abs().max((self.s[0][0] + self.s[1][1]).abs());
        for (i, j, k) in triples() {
            let u = self.u;
            for other in [u[j][i][k], u[i][k][j], u[k][j][i]] {
                worst = worst.max((u[i][j][k] - other).abs());
            }
            worst = worst.max((u[i][0][0] + u[i][1][1]).abs());
        }
        worst
    }
}

fn triples() -> impl Iterator<Item = (usize, usize, usize)> {
    AXES.into_iter()
        .flat_map(|i| AXES.into_iter().flat_map(move |j| AXES.into_iter().map(move |k| (i, j, k))))
}

fn delta(i: usize, j: usize) -> f64 {
    if i == j { 1.0 } else { 0.0 }
}

/// d/dt of (v, S, U): eqs. (V), (S), (U).
pub fn rate(p: &TensorParameters, state: &Tensors) -> Tensors {
    Tensors { v: rate_v(p, state), s: rate_s(p, state), u: rate_u(p, state) }
}

/// v_i v_i, S_mn S_mn, U_lmn U_lmn.
fn squares(Tensors { v, s, u }: &Tensors) -> (f64, f64, f64) {
    let vv = AXES.iter().map(|&i| v[i] * v[i]).sum();
    let ss = s.iter().flatten().map(|x| x * x).sum();
    let uu = u.iter().flatten().flatten().map(|x| x * x).sum();
    (vv, ss, uu)
}

fn rate_v(p: &TensorParameters, state: &Tensors) -> Vector {
    let (vv, ss, uu) = squares(state);
    let Tensors { v, s, u } = *state;
    AXES.map(|i| {
        let mut dv = p.gamma * v[i]; // (V), gamma
        dv -= vv * v[i]; // (V), v^2 v
        dv -= p.a4 * ss * v[i]; // (V), a4
        dv -= p.a5 * uu * v[i]; // (V), a5
        for j in AXES {
            dv -= p.a1 * s[i][j] * v[j]; // (V), a1
            for k in AXES {
                dv -= p.a2 * u[i][j][k] * v[j] * v[k]; // (V), a2
                dv -= p.a3 * u[i][j][k] * s[j][k]; // (V), a3
            }
        }
        for (l, m, n) in triples() {
            dv += p.a6 * s[i][l] * s[n][m] * u[l][n][m]; // (V), a6
        }
        dv
    })
}

fn rate_s(p: &TensorParameters, state: &Tensors) -> Matrix {
    let (vv, ss, uu) = squares(state);
    let Tensors { v, s, u } = *state;
    AXES.map(|i| {
        AXES.map(|j| {
            let mut ds = -p.kappa2 * s[i][j]; // (S), kappa2
            ds += p.b1 * (v[i] * v[j] - 0.5 * vv * delta(i, j)); // (S), b1
            ds -= p.b3 * ss * s[i][j]; // (S), b3
            ds -= p.b4 * vv * s[i][j]; // (S), b4
            ds -= p.b5 * uu * s[i][j]; // (S), b5
            for k in AXES {
                ds += p.b2 * u[i][j][k] * v[k]; // (S), b2
            }
            for l in AXES {
                for m in AXES {
                    ds += p.b6 * u[i][j][l] * s[l][m] * v[m]; // (S), b6
                }
            }
            ds
        })
    })
}

fn rate_u(p: &TensorParameters, state: &Tensors) -> Tensor3 {
    let (vv, ss, uu) = squares(state);
    let Tensors { v, s, u } = *state;
    let sv: Vector = AXES.map(|i| AXES.iter().map(|&l| s[i][l] * v[l]).sum()); // S_il v_l
    let ssv: Vector = AXES.map(|i| AXES.iter().map(|&n| s[n][i] * sv[n]).sum()); // S_ni S_nl v_l
    AXES.map(|i| {
        AXES.map(|j| {
            AXES.map(|k| {
                let mut du = -p.kappa3 * u[i][j][k]; // (U), kappa3
                du -= p.d3 * uu * u[i][j][k]; // (U), d3
                du += p.d1
                    * (v[i] * v[j] * v[k]
                        - 0.25 * vv * (delta(i, j) * v[k] + delta(i, k) * v[j] + delta(j, k) * v[i])); // (U), d1
                du += p.d2 / 3.0
                    * (s[i][j] * v[k] + s[i][k] * v[j] + s[j][k] * v[i]
                        - 0.5 * (delta(i, j) * sv[k] + delta(j, k) * sv[i] + delta(k, i) * sv[j])); // (U), d2
                du -= p.d4 * vv * u[i][j][k]; // (U), d4
                du -= p.d5 * ss * u[i][j][k]; // (U), d5
                du += 2.0 * p.d6 / 3.0
                    * (s[i][j] * sv[k] + s[j][k] * sv[i] + s[k][i] * sv[j]
                        - 0.5 * (delta(i, j) * ssv[k] + delta(j, k) * ssv[i] + delta(k, i) * ssv[j])); // (U), d6
                du
            })
        })
    })
}
