"""heyoka on the tensor model as a user's model: every coefficient is a parameter of the member; with compilation counted or not."""

import time

import numpy as np

import workload as w
from harness import Run
from rivals.heyoka_rival import FAST

PAPER = {"e11": w.E11, "e21": w.E21, "e22": w.E22, "e31": w.E31, "e32": w.E32, "d11": -1.0}
OTHERS = "d12 d13 d21 d22 d23 d31 d32 d33 e12 e13 e14 e23 e33".split()


def product(a, b):
    return a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]


def conj(a):
    return a[0], -a[1]


def total(*terms):
    """Sum of (coefficient, complex number); nothing where a coefficient is absent."""
    there = [(c, z) for c, z in terms if c is not None]
    return tuple(sum(c * z[part] for c, z in there) for part in (0, 1))


def field(u, c):
    """(Z1), (Z2), (Z3) with the coefficients `c` by name; an absent one has no term."""
    z1, z2, z3 = u[0:2], u[2:4], u[4:6]
    n1, n2, n3 = (z[0] * z[0] + z[1] * z[1] for z in (z1, z2, z3))
    z11, z22, c1 = product(z1, z1), product(z2, z2), conj(z1)
    get = c.get

    def damped(z, rate, *terms):
        factor = rate + sum(get(name) * n for name, n in zip(terms, (n1, n2, n3)) if get(name) is not None)
        return factor * z[0], factor * z[1]

    rates = [
        total(
            (1.0, damped(z1, c["gamma"], "d11", "d12", "d13")), (get("e11"), product(c1, z2)),
            (get("e12"), product(product(c1, c1), z3)), (get("e13"), product(conj(z2), z3)), (get("e14"), product(conj(z3), z22)),
        ),
        total(
            (1.0, damped(z2, -c["kappa2"], "d21", "d22", "d23")), (get("e21"), z11), (get("e22"), product(c1, z3)),
            (get("e23"), product(product(conj(z2), z1), z3)),
        ),
        total(
            (1.0, damped(z3, -c["kappa3"], "d31", "d32", "d33")), (get("e31"), product(z11, z1)), (get("e32"), product(z1, z2)),
            (get("e33"), product(c1, z22)),
        ),
    ]  # fmt: skip
    return [part for rate in rates for part in rate]


def values(terms):
    """Coefficients and their values: those of the paper, or all 22."""
    found = {"kappa2": None, "gamma": w.GAMMA, "kappa3": w.KAPPA3, **PAPER}
    return {**found, **dict.fromkeys(OTHERS, 0.0)} if terms == "all" else found


def integrator(rtol, terms, batch, options):
    import heyoka as hy

    hy.llvm_state.set_memcache_limit(0)  # every compilation is one
    hy.llvm_state.set_diskcache_enabled(False)
    names = list(values(terms))
    variables = hy.make_vars(*"a b c d x y".split())
    equations = field(variables, {name: hy.par[i] for i, name in enumerate(names)})
    start = np.zeros((6, batch))
    pars = np.zeros((len(names), batch))
    return hy.taylor_adaptive_batch(
        list(zip(variables, equations)), start, pars=pars, tol=rtol, high_accuracy=False, compact_mode=False, **options
    )


def adaptive(n, t, rtol, terms, counted, fast=True, batch=8):
    """Time units; `counted`: with the compilation."""
    kappa2, start = w.members(n)
    pars = np.array([np.full(n, value) if value is not None else kappa2 for value in values(terms).values()])
    options = FAST if fast else {}
    ready = None if counted else integrator(rtol, terms, batch, options)

    def run():
        end = np.empty_like(start)
        begin = time.perf_counter()
        ta = integrator(rtol, terms, batch, options) if counted else ready
        for m in range(0, n, batch):
            here = slice(m, m + batch)
            ta.state[:], ta.pars[:] = start[:, here], pars[:, here]
            ta.set_time(0.0)
            ta.propagate_until(t)
            end[:, here] = ta.state
        return Run(time.perf_counter() - begin, n * t, end[:, : w.SHOWN].T)

    return run
