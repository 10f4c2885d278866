"""The two models as the rival programs see them: rates, tangent, rotation, for arrays of many motions at once.

A state is an array (..., 2m) of real and imaginary parts of m complex amplitudes; amplitude n turns by exp(-i n a) with the
body, and a mirror image has the complex conjugate amplitudes.
"""

import numpy as np

# (gamma, kappa2, kappa3, e11, d22, e21, e22, e31, e32) of the equations below.
FIG1 = {"kappa3": 1.0, "e11": -2.0, "d22": -8.0, "e21": 0.125, "e22": 0.0, "e31": 0.0, "e32": 0.0}
FIG4 = {"gamma": 1.0, "e11": 2.0, "d22": 0.0, "e21": -0.125, "e22": 0.3, "e31": 0.0125, "e32": 0.4}
NAMES = ("gamma", "kappa2", "kappa3", "e11", "d22", "e21", "e22", "e31", "e32")


def tensor2(u, p):
    """Velocity and ellipse alone (Fig. 1): z1' = (gamma - |z1|^2) z1 + e11 z1* z2, z2' = (-kappa2 + d22 |z2|^2) z2 + e21 z1^2."""
    a, b, c, d = u
    gamma, kappa2, e11, d22, e21 = p[0], p[1], p[3], p[4], p[5]
    q = gamma - a * a - b * b
    s = d22 * (c * c + d * d) - kappa2
    return (
        q * a + e11 * (a * c + b * d),
        q * b + e11 * (a * d - b * c),
        s * c + e21 * (a * a - b * b),
        s * d + e21 * (2.0 * (a * b)),
    )


def tensor2_tangent(u, w, p):
    """The derivative of `tensor2` along w."""
    (a, b, c, d), (ta, tb, tc, td) = u, w
    gamma, kappa2, e11, d22, e21 = p[0], p[1], p[3], p[4], p[5]
    q, tq = gamma - a * a - b * b, -2.0 * (a * ta + b * tb)
    s, ts = d22 * (c * c + d * d) - kappa2, 2.0 * d22 * (c * tc + d * td)
    return (
        q * ta + tq * a + e11 * (ta * c + a * tc + tb * d + b * td),
        q * tb + tq * b + e11 * (ta * d + a * td - tb * c - b * tc),
        s * tc + ts * c + 2.0 * e21 * (a * ta - b * tb),
        s * td + ts * d + 2.0 * e21 * (ta * b + a * tb),
    )


def tensor3(u, p):
    """The full model of Fig. 4 (b3 = d3 = 0): z3' = -kappa3 z3 + e31 z1^3 + e32 z1 z2, and e22 z1* z3 in z2'."""
    a, b, c, d, x, y = u
    gamma, kappa2, kappa3, e11, _, e21, e22, e31, e32 = p
    q = gamma - a * a - b * b
    re, im = a * a - b * b, 2.0 * (a * b)
    wr, wi = e31 * re + e32 * c, e31 * im + e32 * d
    return (
        q * a + e11 * (a * c + b * d),
        q * b + e11 * (a * d - b * c),
        e21 * re + e22 * (a * x + b * y) - kappa2 * c,
        e21 * im + e22 * (a * y - b * x) - kappa2 * d,
        a * wr - b * wi - kappa3 * x,
        a * wi + b * wr - kappa3 * y,
    )


def tensor3_tangent(u, w, p):
    """The derivative of `tensor3` along w."""
    (a, b, c, d, x, y), (ta, tb, tc, td, tx, ty) = u, w
    gamma, kappa2, kappa3, e11, _, e21, e22, e31, e32 = p
    q, tq = gamma - a * a - b * b, -2.0 * (a * ta + b * tb)
    re, im = a * a - b * b, 2.0 * (a * b)
    tre, tim = 2.0 * (a * ta - b * tb), 2.0 * (ta * b + a * tb)
    wr, wi = e31 * re + e32 * c, e31 * im + e32 * d
    twr, twi = e31 * tre + e32 * tc, e31 * tim + e32 * td
    return (
        q * ta + tq * a + e11 * (ta * c + a * tc + tb * d + b * td),
        q * tb + tq * b + e11 * (ta * d + a * td - tb * c - b * tc),
        e21 * tre + e22 * (ta * x + a * tx + tb * y + b * ty) - kappa2 * tc,
        e21 * tim + e22 * (ta * y + a * ty - tb * x - b * tx) - kappa2 * td,
        ta * wr + a * twr - tb * wi - b * twi - kappa3 * tx,
        ta * wi + a * twi + tb * wr + b * twr - kappa3 * ty,
    )


def complex_parts(u):
    return np.ascontiguousarray(u).view(complex)


class Tensor:
    """Many motions of the tensor model, each with its own parameters: `parameters` has one row of numbers for each."""

    first_look, budget, escape = 200.0, 4e4, 1e3
    arrived = 3e-5  # of the size: as near to an equilibrium as orbits of the tolerances hover
    segment = 50.0  # an exponent's tangent vector is rescaled this often, its length noted five times as often

    def __init__(self, plane, points):
        fixed = FIG1 if plane == "fig1" else FIG4
        self.modes, self.sample = (2, 0.2) if plane == "fig1" else (3, 0.1)
        self.rates, self.change = (tensor2, tensor2_tangent) if plane == "fig1" else (tensor3, tensor3_tangent)
        self.names = NAMES[:6] if plane == "fig1" else NAMES
        self.parameters = np.array([[{**fixed, **point}[name] for name in self.names] for point in points])
        self.numbers = np.arange(1, self.modes + 1)

    def _p(self, cells, like):
        return np.moveaxis(self.parameters[cells].reshape(len(cells), *[1] * (like.ndim - 2), len(self.names)), -1, 0)

    def field(self, cells, u):
        """Rates of states u (cells, ..., 2m)."""
        return np.stack(self.rates(np.moveaxis(u, -1, 0), self._p(cells, u)), axis=-1)

    def jacobian(self, cells, u):
        """(cells, 2m, 2m) at states u (cells, 2m)."""
        dim = u.shape[-1]
        u = np.broadcast_to(u[:, None, :], (len(u), dim, dim))
        basis = np.broadcast_to(np.eye(dim), u.shape)
        columns = self.change(np.moveaxis(u, -1, 0), np.moveaxis(basis, -1, 0), self._p(cells, u))
        return np.stack(columns, axis=1)

    def speed(self, cells, u):
        return np.hypot(u[..., 0], u[..., 1])


class Cell:
    """Many active cells, each of its own length. Amplitudes are w_n = phi_n / i^(n-1), so that a mirror image is the conjugate.

    phi_n' = (k_n^4 - k_n^6) phi_n - 1/2 (d/ds phi_ss^2)_n, 21 modes; products on 64 points, which is exact for them.
    """

    first_look, budget, escape = 1500.0, 3e4, 1e3
    arrived = 3e-4  # the same, at the fixed step
    segment, sample, modes, points = 250.0, 0.5, 21, 64

    def __init__(self, lengths):
        self.lengths = np.asarray(lengths)
        self.numbers = np.arange(1, self.modes + 1)
        self.phase = 1j ** (self.numbers - 1)
        self.k = 2 * np.pi / self.lengths[:, None] * self.numbers
        self.linear = self.k**4 - self.k**6

    def _bend(self, cells, w):
        """phi_ss on the points."""
        k = self.k[cells].reshape(len(cells), *[1] * (w.ndim - 2), self.modes)
        hat = np.zeros((*w.shape[:-1], self.points // 2 + 1), dtype=complex)
        hat[..., 1 : self.modes + 1] = -(k**2) * self.phase * w * self.points
        return np.fft.irfft(hat, self.points), k

    def _rates(self, cells, w, product, k):
        hat = np.fft.rfft(product)[..., 1 : self.modes + 1] / self.points
        linear = self.linear[cells].reshape(k.shape)
        return (linear * w - 0.5j * k * hat / self.phase).view(float)

    def field(self, cells, u):
        w = complex_parts(u)
        bend, k = self._bend(cells, w)
        return self._rates(cells, w, bend * bend, k)

    def jacobian(self, cells, u):
        w = complex_parts(u)[:, None, :]
        dim = u.shape[-1]
        basis = np.broadcast_to(np.eye(dim), (len(u), dim, dim)).copy().view(complex)
        (bend, k), (change, _) = self._bend(cells, w), self._bend(cells, basis)
        return np.swapaxes(self._rates(cells, basis, 2 * bend * change, k), 1, 2)

    def speed(self, cells, u):
        """|v| with the bare normal of eq. (VEL), without the closure of the boundary: zero for the same shapes."""
        w = complex_parts(u)
        bend, k = self._bend(cells, w)
        hat = np.zeros((*w.shape[:-1], self.points // 2 + 1), dtype=complex)
        hat[..., 1 : self.modes + 1] = self.phase * w * self.points
        angle = (np.arange(self.points) / self.points) * 2 * np.pi + k[..., :1] * np.fft.irfft(hat, self.points)
        return 4e-4 * (2 * np.pi) ** 2 / self.lengths[cells] * np.abs(np.mean(bend**2 * np.exp(1j * angle), axis=-1))
