"""Orbits of the active cell in NumPy: ETDRK4 (Cox and Matthews) with the weights of Kassam and Trefethen, all lengths at once."""

import numpy as np

from models import complex_parts

STEP = 0.1


def weights(z, points=32):
    """Contour means of the coefficients (Kassam and Trefethen 2005)."""
    r = np.exp(1j * np.pi * (np.arange(1, points + 1) - 0.5) / points)
    w = z[..., None] + r
    q = np.mean(((np.exp(w / 2) - 1) / w).real, axis=-1)
    f1 = np.mean(((-4 - w + np.exp(w) * (4 - 3 * w + w**2)) / w**3).real, axis=-1)
    f2 = np.mean(((2 + w + np.exp(w) * (w - 2)) / w**3).real, axis=-1)
    f3 = np.mean(((-4 - 3 * w - w**2 + np.exp(w) * (4 - w)) / w**3).real, axis=-1)
    return q, f1, f2, f3


class Etdrk4:
    def __init__(self, model, step=STEP):
        self.model, self.step, self.dim = model, step, 2 * model.modes
        self.every = round(model.sample / step)

    def stepper(self, cells, tangent):
        """One step of phi_n, n = 0..21, of these cells: array (cells, 22), or (2, cells, 22) with a tangent vector."""
        m, points, h = self.model.modes, self.model.points, self.step
        pad = [(0, 0), (1, 0)]
        k, linear = (np.pad(x[cells], pad) for x in (self.model.k, self.model.linear))
        q, f1, f2, f3 = weights(h * linear)
        e, e2 = np.exp(h * linear), np.exp(h * linear / 2)
        q, f1, f2, f3 = h * q, h * f1, 2 * h * f2, h * f3
        second, flux = -(k**2) * points, -0.5j * k / points

        def nonlinear(u):  # -1/2 d/ds phi_ss^2; zero padding to 33 bins by irfft
            x = np.fft.irfft(second * u, points)
            if tangent:
                x[1] *= 2 * x[0]
                x[0] *= x[0]
            else:
                x *= x
            return flux * np.fft.rfft(x)[..., : m + 1]

        def advance(u):
            nu = nonlinear(u)
            eu = e2 * u
            a = eu + q * nu
            na = nonlinear(a)
            nb = nonlinear(eu + q * na)
            nc = nonlinear(e2 * a + q * (2 * nb - nu))
            return e * u + f1 * nu + f2 * (na + nb) + f3 * nc

        return advance

    def phi(self, u):
        return np.pad(complex_parts(u) * self.model.phase, [(0, 0)] * (u.ndim - 1) + [(1, 0)])

    def amplitudes(self, phi):
        return np.ascontiguousarray(phi[..., 1:] / self.model.phase).view(float)

    def look(self, cells, state, span):
        advance, u = self.stepper(cells, tangent=False), self.phi(state)
        count = round(span / self.model.sample)
        samples = np.empty((len(cells), count + 1, self.dim))
        samples[:, 0] = state
        for i in range(1, count + 1):
            for _ in range(self.every):
                u = advance(u)
            samples[:, i] = self.amplitudes(u)
        return samples, ~np.all(np.isfinite(samples[:, -1]), axis=1)

    def exponent(self, cells, state, span):
        advance = self.stepper(cells, tangent=True)
        u = self.phi(np.stack([state, np.full_like(state, self.dim**-0.5)]))
        interval = self.model.segment / 5
        logs = np.zeros((len(cells), round(span / interval)))
        for i in range(logs.shape[1]):
            for _ in range(round(interval / self.step)):
                u = advance(u)
            lengths = np.sqrt((np.abs(u[1]) ** 2).sum(axis=1))
            logs[:, i] = np.log(lengths)
            u[1] /= lengths[:, None]
        ends = self.amplitudes(u[0])
        return logs, interval, ends, ~np.all(np.isfinite(ends), axis=1)
