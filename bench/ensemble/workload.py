"""The workload that every program shares: the tensor model in Fourier form, full model of the paper.

    z1' = (gamma - |z1|^2) z1 + e11 z1* z2
    z2' = -kappa2 z2 + e21 z1^2 + e22 z1* z3
    z3' = -kappa3 z3 + e31 z1^3 + e32 z1 z2

State (Re z1, Im z1, Re z2, Im z2, Re z3, Im z3). Member i of n has its own kappa2 and its own start. See
crates/engine/models/src/tensor/fourier.rs; the terms whose coefficients are 0 in the paper's full model are left out.
"""

import numpy as np

A1, B1, B2, D1, D2 = -1.0, -0.5, 0.3, 0.1, 0.8
GAMMA, KAPPA3 = 1.0, 0.1
E11, E21, E22, E31, E32 = -2 * A1, B1 / 4, B2, D1 / 8, D2 / 2
COEFFICIENTS = (GAMMA, KAPPA3, E11, E21, E22, E31, E32)
KAPPA2 = (0.45, 0.65)
BASE = (0.5, 0.1, 0.1, -0.2, 0.05, 0.1)
SHOWN = 8  # members whose end states are compared


def members(n, low=KAPPA2[0], high=KAPPA2[1]):
    """kappa2, shape (n,), and the starts, shape (6, n)."""
    i = np.arange(n)
    kappa2 = low + (high - low) * i / max(n - 1, 1)
    factor = 1 + 0.1 * np.sin(1.0 + 0.7 * i[None, :] + 1.3 * np.arange(6)[:, None])
    return kappa2, np.array(BASE)[:, None] * factor


def field(u, kappa2, coefficients=COEFFICIENTS):
    """The six rates, for anything with + - *: arrays, symbols, traced numbers, counted numbers."""
    gamma, kappa3, e11, e21, e22, e31, e32 = coefficients
    a, b, c, d, x, y = u
    aa, bb = a * a, b * b
    q = gamma - (aa + bb)
    re, im = aa - bb, 2.0 * (a * b)  # z1^2
    wr, wi = e31 * re + e32 * c, e31 * im + e32 * d  # e31 z1^2 + e32 z2
    return [
        q * a + e11 * (a * c + b * d),
        q * b + e11 * (a * d - b * c),
        e21 * re + e22 * (a * x + b * y) - kappa2 * c,
        e21 * im + e22 * (a * y - b * x) - kappa2 * d,
        a * wr - b * wi - kappa3 * x,
        a * wi + b * wr - kappa3 * y,
    ]


def divergence(u, kappa2):
    """Trace of the Jacobian: the sum of the six Lyapunov exponents is its mean."""
    return 2 * GAMMA - 4 * (u[0] * u[0] + u[1] * u[1]) - 2 * kappa2 - 2 * KAPPA3


def jacobian(u, kappa2):
    """J[i, j] = d rate_i / d u_j, written out; array of shape (6, 6) + the shape of u[0]."""
    a, b, c, d, x, y = u
    o = 0 * a
    k2, k3 = o + kappa2, o + KAPPA3
    return np.array([
        [GAMMA - 3 * a * a - b * b + E11 * c, -2 * a * b + E11 * d, E11 * a, E11 * b, o, o],
        [-2 * a * b + E11 * d, GAMMA - a * a - 3 * b * b - E11 * c, -E11 * b, E11 * a, o, o],
        [2 * E21 * a + E22 * x, -2 * E21 * b + E22 * y, -k2, o, E22 * a, E22 * b],
        [2 * E21 * b + E22 * y, 2 * E21 * a - E22 * x, o, -k2, -E22 * b, E22 * a],
        [3 * E31 * (a * a - b * b) + E32 * c, -6 * E31 * a * b - E32 * d, E32 * a, -E32 * b, -k3, o],
        [6 * E31 * a * b + E32 * d, 3 * E31 * (a * a - b * b) + E32 * c, E32 * b, E32 * a, o, -k3],
    ])  # fmt: skip


def rk4_step(u, kappa2, h, h2, h3, h6):
    """One classical Runge-Kutta step (h, h/2, h/3, h/6 given), for the same kinds of numbers as `field`."""
    k = field(u, kappa2)
    total, v = [p + h6 * r for p, r in zip(u, k)], [p + h2 * r for p, r in zip(u, k)]
    k = field(v, kappa2)
    total, v = [p + h3 * r for p, r in zip(total, k)], [p + h2 * r for p, r in zip(u, k)]
    k = field(v, kappa2)
    total, v = [p + h3 * r for p, r in zip(total, k)], [p + h * r for p, r in zip(u, k)]
    k = field(v, kappa2)
    return [p + h6 * r for p, r in zip(total, k)]
