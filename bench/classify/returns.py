"""Returns of the shape: rotation invariants, maxima of the size, the rotation between two shapes."""

import numpy as np

from models import complex_parts


def invariants(u):
    """Complex numbers that rotations leave alone, and that a mirror image has conjugate."""
    z = complex_parts(u)[..., :6]
    chain = z[..., 1:] * np.conj(z[..., :-1] * z[..., :1])
    return np.concatenate([np.abs(z) ** 2 + 0j, chain], axis=-1)


def maxima(model, cell, u):
    """Times and states of the maxima of the size, between samples by Hermite's cubic."""
    cells, h = np.array([cell]), model.sample
    rate = model.field(cells, u[None])[0]
    growth = np.einsum("ij,ij->i", u, rate)
    at = np.flatnonzero((growth[:-1] > 0) & (growth[1:] <= 0))
    a, b, da, db = u[at], u[at + 1], h * rate[at], h * rate[at + 1]
    low, high = np.zeros(len(at)), np.ones(len(at))
    values = [growth[at], growth[at + 1]]
    for _ in range(4):
        s = low + (high - low) * values[0] / (values[0] - values[1] + 1e-300)
        s = np.clip(s, 0.0, 1.0)
        x = s[:, None]
        state = (1 + 2 * x) * (1 - x) ** 2 * a + x * (1 - x) ** 2 * da + x * x * (3 - 2 * x) * b + x * x * (x - 1) * db
        here = np.einsum("ij,ij->i", state, model.field(cells, state[None])[0])
        up = here > 0
        low, high = np.where(up, s, low), np.where(up, high, s)
        values = [np.where(up, here, values[0]), np.where(up, values[1], here)]
    return h * (at + s), state


def rotation(model, before, now):
    """The rotation that takes one shape to the other best."""
    product = np.conj(complex_parts(now)) * complex_parts(before)
    angles = np.linspace(-np.pi, np.pi, 721)
    best = angles[np.argmax((product * np.exp(-1j * model.numbers * angles[:, None])).real.sum(axis=1))]
    for _ in range(5):
        terms = product * np.exp(-1j * model.numbers * best)
        slope, bend = (-1j * model.numbers * terms).real.sum(), (-(model.numbers**2) * terms).real.sum()
        best -= slope / bend
    return best
