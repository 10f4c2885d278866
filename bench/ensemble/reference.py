"""What the end states and exponents must be, computed by none of the programs that are timed."""

from functools import cache

import numpy as np

import workload as w


@cache
def rk4(n, steps, dt):
    """End states (8, 6) of the first members under the same scheme, in plain NumPy."""
    kappa2, start = w.members(n)
    u = list(start[:, : w.SHOWN])
    for _ in range(steps):
        u = w.rk4_step(u, kappa2[: w.SHOWN], dt, dt / 2, dt / 3, dt / 6)
    return np.array(u).T


@cache
def end_states(n, t, h=0.05, order=24):
    """End states (8, 6) at t, by a Taylor series in extended precision: errors near 1e-17 on x86.

    With z_i = sum_k z_i[k] s^k every product is a Cauchy product; fixed step, far more terms than are needed.
    """
    kappa2, start = w.members(n)
    real = np.longdouble
    kappa2, start = kappa2[: w.SHOWN].astype(real), start[:, : w.SHOWN].astype(real)
    now = [start[0] + 1j * start[1], start[2] + 1j * start[3], start[4] + 1j * start[5]]
    steps = round(t / h)
    h = real(t) / steps
    series = lambda: np.zeros((order + 1, len(kappa2)), dtype=np.clongdouble)  # noqa: E731
    for _ in range(steps):
        z1, z2, z3, z11, norm = series(), series(), series(), series(), series()
        z1[0], z2[0], z3[0] = now
        for k in range(order):
            product = lambda p, q: (p[: k + 1] * q[k::-1]).sum(axis=0)  # noqa: B023, E731
            c1 = z1.conj()
            z11[k], norm[k] = product(z1, z1), product(z1, c1)
            z1[k + 1] = (w.GAMMA * z1[k] - product(norm, z1) + w.E11 * product(c1, z2)) / (k + 1)
            z2[k + 1] = (-kappa2 * z2[k] + w.E21 * z11[k] + w.E22 * product(c1, z3)) / (k + 1)
            rate = real(w.E31) * product(z11, z1) + real(w.E32) * product(z1, z2)
            z3[k + 1] = (rate - real(w.KAPPA3) * z3[k]) / (k + 1)
        powers = h ** np.arange(order + 1, dtype=real)[:, None]
        now = [(z * powers).sum(axis=0) for z in (z1, z2, z3)]
    return np.array([part for z in now for part in (z.real, z.imag)]).T.astype(float)


@cache
def exponents(n, t, interval=1.0):
    """Finite-time exponents (8, 6) from the identity frame, and the mean divergence (8,) of the same orbits.

    The triangular factors of a product of matrices are unique, so these numbers depend on t but not on how often the
    frame is made orthogonal again.
    """
    from scipy.integrate import solve_ivp

    kappa2, start = w.members(n)
    kappa2, start = kappa2[: w.SHOWN], start[:, : w.SHOWN]
    m = len(kappa2)

    def rates(_, flat):
        y = flat.reshape(43, m)
        tangent = np.einsum("ijm,jkm->ikm", w.jacobian(y[:6], kappa2), y[6:42].reshape(6, 6, m))
        return np.concatenate([w.field(y[:6], kappa2), tangent.reshape(36, m), [w.divergence(y[:6], kappa2)]]).ravel()

    y = np.concatenate([start, np.repeat(np.eye(6).reshape(36, 1), m, axis=1), np.zeros((1, m))])
    total = np.zeros((m, 6))
    for _ in range(round(t / interval)):
        end = solve_ivp(rates, (0, interval), y.ravel(), method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
        y = end.reshape(43, m)
        q, r = np.linalg.qr(np.moveaxis(y[6:42].reshape(6, 6, m), 2, 0))
        total += np.log(np.abs(np.diagonal(r, axis1=1, axis2=2)))
        y[6:42] = np.moveaxis(q, 0, 2).reshape(36, m)
    return total / t, y[42] / t
