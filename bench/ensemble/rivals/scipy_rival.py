"""SciPy: solve_ivp with DOP853, one orbit at a time."""

import time

import workload as w
from harness import Run


def adaptive(n, t, rtol, per_orbit=False):
    from scipy.integrate import solve_ivp

    kappa2, start = w.members(n)

    def run():
        ends = []
        begin = time.perf_counter()
        for k2, u in zip(kappa2, start.T.tolist()):
            found = solve_ivp(
                lambda _, v: w.field(v, k2),  # noqa: B023
                (0, t), u, method="DOP853", rtol=rtol, atol=rtol * 1e-2, t_eval=[t],
            )  # fmt: skip
            ends.append(found.y[:, -1])
        return Run(time.perf_counter() - begin, n if per_orbit else n * t, ends[: w.SHOWN])

    return run
