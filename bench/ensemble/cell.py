"""The active cell model as in bench/cell, for an ensemble: lengths, starts, step and weights that all programs share.

phi_t = phi_ssss + g5 phi_ssssss ..., that is sigma_n = k^4 - k^6 and the term -1/2 d/ds (phi_ss^2); ETDRK4 of Cox and
Matthews, N = 128 points, 42 modes after the 2/3 rule. Member i starts from 1 + 0.1 sin(1 + 0.7 i) times the start of
bench/cell: phi = 0.1 cos(k s) + 0.1 sin(2 k s) + 0.05 cos(3 k s). Compared: real and imaginary parts of modes 1, 2, 3.
"""

import numpy as np

N, MODES, STEP = 128, 42, 0.02
LENGTHS = (21.0, 21.9)  # one per member, evenly spread; a program that cannot do this has EQUAL for all
EQUAL = (21.6, 21.6)


def weights(z, points=32):
    """Contour means of the ETDRK4 coefficients (Kassam and Trefethen 2005), for an array of any shape."""
    r = np.exp(1j * np.pi * (np.arange(1, points + 1) - 0.5) / points)
    w = z[..., None] + r
    q = np.mean(((np.exp(w / 2) - 1) / w).real, axis=-1)
    f1 = np.mean(((-4 - w + np.exp(w) * (4 - 3 * w + w**2)) / w**3).real, axis=-1)
    f2 = np.mean(((2 + w + np.exp(w) * (w - 2)) / w**3).real, axis=-1)
    f3 = np.mean(((-4 - 3 * w - w**2 + np.exp(w) * (4 - w)) / w**3).real, axis=-1)
    return q, f1, f2, f3


def lengths(n, low, high):
    return low + (high - low) * np.arange(n) / max(n - 1, 1)


def start(n):
    """rfft of the N points divided by N, shape (n, N/2 + 1)."""
    u = np.zeros((n, N // 2 + 1), dtype=complex)
    u[:, 1], u[:, 2], u[:, 3] = 0.05, -0.05j, 0.025
    return u * (1 + 0.1 * np.sin(1 + 0.7 * np.arange(n)))[:, None]


def shown(u):
    """(8, 6) numbers of the first members, from modes (members, modes) with mode 0 in front."""
    return np.array([[part for z in row[1:4] for part in (z.real, z.imag)] for row in u[:8]])
