"""Programs made for Lyapunov exponents, one orbit at a time: jitcode_lyap (compiled C, SciPy's dop853), pynamicalsys."""

import time
from functools import cache

import numpy as np

import workload as w
from harness import Run


@cache
def compiled(rtol):
    import symengine
    from jitcode import jitcode as plain
    from jitcode import jitcode_lyap, y

    k2 = symengine.Symbol("k2")
    ode = jitcode_lyap(w.field([y(i) for i in range(6)], k2), n_lyap=6, control_pars=[k2], verbose=False)
    ode.compile_C(verbose=False, extra_compile_args=["-O3", "-march=native"])
    ode.set_parameters(1.0)
    plain.set_integrator(ode, "dop853", rtol=rtol, atol=rtol * 1e-2)  # jitcode_lyap's own sets nsteps to False
    return ode, plain


def jitcode(n, t, rtol, interval, low=w.KAPPA2[0], high=w.KAPPA2[1]):
    ode, plain = compiled(rtol)
    kappa2, start = w.members(n, low, high)

    def run():
        found = []
        begin = time.perf_counter()
        for k2, u in zip(kappa2, start.T):
            ode.set_parameters(k2)
            # from the identity, not from random vectors that are not orthogonal: the sum is then that of the orbit
            plain.set_initial_value(ode, np.hstack([u, np.eye(6).ravel()]), 0.0)
            total = sum(ode.integrate(interval * (k + 1))[1] for k in range(round(t / interval)))
            found.append(total * interval / t)
        return Run(time.perf_counter() - begin, n * t, found[: w.SHOWN])

    return run


def pynamicalsys(n, t, rtol=None, low=w.KAPPA2[0], high=w.KAPPA2[1]):
    """With a tolerance its RK45, without one its default RK4 at dt = 0.01; QR after every step."""
    import numba
    from pynamicalsys import ContinuousDynamicalSystem

    p_gamma, p_kappa3, e11, e21, e22, e31, e32 = w.COEFFICIENTS

    @numba.njit
    def flow(_, u, p):
        a, b, c, d, x, y = u
        aa, bb = a * a, b * b
        q, re, im = p_gamma - (aa + bb), aa - bb, 2.0 * (a * b)
        wr, wi = e31 * re + e32 * c, e31 * im + e32 * d
        f = np.empty(6)
        f[0], f[1] = q * a + e11 * (a * c + b * d), q * b + e11 * (a * d - b * c)
        f[2], f[3] = e21 * re + e22 * (a * x + b * y) - p[0] * c, e21 * im + e22 * (a * y - b * x) - p[0] * d
        f[4], f[5] = a * wr - b * wi - p_kappa3 * x, a * wi + b * wr - p_kappa3 * y
        return f

    @numba.njit
    def jacobian(_, u, p):
        a, b, c, d, x, y = u
        J = np.zeros((6, 6))
        J[0, 0], J[1, 1] = p_gamma - 3 * a * a - b * b + e11 * c, p_gamma - a * a - 3 * b * b - e11 * c
        J[0, 1] = J[1, 0] = -2 * a * b + e11 * d
        J[0, 2], J[0, 3], J[1, 2], J[1, 3] = e11 * a, e11 * b, -e11 * b, e11 * a
        J[2, 0], J[2, 1] = 2 * e21 * a + e22 * x, -2 * e21 * b + e22 * y
        J[3, 0], J[3, 1] = 2 * e21 * b + e22 * y, 2 * e21 * a - e22 * x
        J[2, 2] = J[3, 3] = -p[0]
        J[2, 4], J[2, 5], J[3, 4], J[3, 5] = e22 * a, e22 * b, -e22 * b, e22 * a
        real, imag = 3 * e31 * (a * a - b * b) + e32 * c, 6 * e31 * a * b + e32 * d
        J[4, 0], J[4, 1], J[5, 0], J[5, 1] = real, -imag, imag, real
        J[4, 2], J[4, 3], J[5, 2], J[5, 3] = e32 * a, -e32 * b, e32 * b, e32 * a
        J[4, 4] = J[5, 5] = -p_kappa3
        return J

    system = ContinuousDynamicalSystem(
        equations_of_motion=flow, jacobian=jacobian, system_dimension=6, number_of_parameters=1
    )
    if rtol is None:
        system.integrator("rk4", time_step=0.01)
    else:
        system.integrator("rk45", rtol=rtol, atol=rtol * 1e-2)
    kappa2, start = w.members(n, low, high)

    def run():
        begin = time.perf_counter()
        found = [system.lyapunov(u, t, parameters=[k2], endpoint=False) for k2, u in zip(kappa2, start.T)]
        return Run(time.perf_counter() - begin, n * t, found[: w.SHOWN])

    return run
