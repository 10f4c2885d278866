"""heyoka: Taylor series, compiled at run time; a batch of members per integrator. Its defaults, and its fast options."""

import time
from concurrent.futures import ThreadPoolExecutor
from copy import deepcopy
from functools import cache

import numpy as np

import workload as w
from harness import Run

FAST = {"fast_math": True, "force_avx512": True}


@cache
def system(variational=False):
    import heyoka as hy

    names = "a b c d x y".split()
    variables = hy.make_vars(*names)
    equations = list(zip(variables, w.field(variables, hy.par[0])))
    return hy.var_ode_sys(equations, hy.var_args.vars, order=1) if variational else equations


def integrator(rtol, batch, variational=False, **options):
    import heyoka as hy

    kappa2, start = w.members(max(batch, 2))
    options = {"tol": rtol, "high_accuracy": False, "compact_mode": False, **options}
    if batch == 1:
        return hy.taylor_adaptive(system(variational), start[:, 0].copy(), pars=[kappa2[0]], **options)
    start, kappa2 = np.ascontiguousarray(start[:, :batch]), kappa2[None, :batch].copy()
    return hy.taylor_adaptive_batch(system(variational), start, pars=kappa2, **options)


def orbits(ta, kappa2, start, t, batch, end):
    """The members one batch after the other, through one integrator, end states written into `end`."""
    for m in range(0, len(kappa2), batch):
        here = m if batch == 1 else slice(m, m + batch)
        ta.state[:] = start[:, here]
        ta.pars[...] = kappa2[here]
        if batch == 1:
            ta.time = 0.0
        else:
            ta.set_time(0.0)
        ta.propagate_until(t)
        end[:, here] = ta.state


def adaptive(n, t, rtol, batch=8, per_orbit=False, threads=1, **options):
    """Time units, or orbits; with threads, one integrator and one share of the members for each."""
    first = integrator(rtol, batch, **options)
    own = [first] + [deepcopy(first) for _ in range(threads - 1)]
    kappa2, start = w.members(n)
    work = n if per_orbit else n * t
    shares = np.array_split(np.arange(0, n, batch), threads)

    def part(ta, share, end):
        here = slice(share[0], share[-1] + batch)
        orbits(ta, kappa2[here], start[:, here], t, batch, end[:, here])

    def run():
        end = np.empty_like(start)
        begin = time.perf_counter()
        if threads == 1:
            part(own[0], np.arange(0, n, batch), end)
        else:
            with ThreadPoolExecutor(threads) as pool:
                list(pool.map(part, own, shares, [end] * threads))
        return Run(time.perf_counter() - begin, work, end[:, : w.SHOWN].T)

    return run


def ensemble(n, t, rtol, batch=8):
    """heyoka's own `ensemble_propagate_until_batch`: it copies the integrator for every batch."""
    import heyoka as hy

    ta = integrator(rtol, batch)
    kappa2, start = w.members(n)

    def member(copy, i):
        here = slice(i * batch, (i + 1) * batch)
        copy.state[:] = start[:, here]
        copy.pars[0, :] = kappa2[here]
        copy.set_time(0.0)
        return copy

    def run():
        begin = time.perf_counter()
        found = hy.ensemble_propagate_until_batch(ta, t, n // batch, member, algorithm="thread", max_workers=1)
        seconds = time.perf_counter() - begin
        return Run(seconds, n, found[0][0].state[:, : w.SHOWN].T)

    return run


def lyapunov(n, t, rtol, interval, batch=8, low=w.KAPPA2[0], high=w.KAPPA2[1], **options):
    """First-order variational equations beside the orbit; QR by NumPy every `interval`."""
    ta = integrator(rtol, batch, variational=True, **options)
    kappa2, start = w.members(n, low, high)
    if batch == 1:
        return lyapunov_alone(ta, kappa2, start, t, interval)
    frame = np.eye(6).reshape(36, 1)

    def run():
        found = np.empty((n, 6))
        begin = time.perf_counter()
        for m in range(0, n, batch):
            ta.state[:6], ta.state[6:] = start[:, m : m + batch], frame
            ta.pars[0, :] = kappa2[m : m + batch]
            ta.set_time(0.0)
            total = np.zeros((batch, 6))
            for k in range(round(t / interval)):
                ta.propagate_until(interval * (k + 1))
                q, r = np.linalg.qr(np.moveaxis(ta.state[6:].reshape(6, 6, batch), 2, 0))
                total += np.log(np.abs(np.diagonal(r, axis1=1, axis2=2)))
                ta.state[6:] = np.moveaxis(q, 0, 2).reshape(36, batch)
            found[m : m + batch] = total / t
        return Run(time.perf_counter() - begin, n * t, found[: w.SHOWN])

    return run


def lyapunov_alone(ta, kappa2, start, t, interval):
    """The same, one orbit at a time."""

    def run():
        n = len(kappa2)
        found = np.empty((n, 6))
        begin = time.perf_counter()
        for m in range(n):
            ta.state[:6], ta.state[6:] = start[:, m], np.eye(6).ravel()
            ta.pars[0], ta.time = kappa2[m], 0.0
            total = np.zeros(6)
            for k in range(round(t / interval)):
                ta.propagate_until(interval * (k + 1))
                q, r = np.linalg.qr(ta.state[6:].reshape(6, 6))
                total += np.log(np.abs(np.diagonal(r)))
                ta.state[6:] = q.ravel()
            found[m] = total / t
        return Run(time.perf_counter() - begin, n * t, found[: w.SHOWN])

    return run
