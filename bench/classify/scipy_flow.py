"""Orbits by SciPy, one at a time; the right-hand side is compiled by Numba."""

import warnings

import numba
import numpy as np
from scipy.integrate import odeint, solve_ivp


def compiled(model):
    """Right-hand sides f(t, u, p) of the orbit, and of the orbit with one tangent vector."""
    rates, change, dim = numba.njit(model.rates), numba.njit(model.change), 2 * model.modes
    unpack = {4: lambda u: (u[0], u[1], u[2], u[3]), 6: lambda u: (u[0], u[1], u[2], u[3], u[4], u[5])}
    tuple_of = numba.njit(unpack[dim])

    @numba.njit
    def orbit(t, u, p):
        return np.array(rates(tuple_of(u), p))

    @numba.njit
    def with_tangent(t, u, p):
        out = np.empty(2 * dim)
        state = tuple_of(u)
        out[:dim] = np.array(rates(state, p))
        out[dim:] = np.array(change(state, tuple_of(u[dim:]), p))
        return out

    return orbit, with_tangent


class Scipy:
    """method: 'DOP853' is solve_ivp's; 'LSODA' is odeint's, whose loop over steps is compiled."""

    def __init__(self, model, method, rtol=1e-9, atol=1e-12):
        self.model, self.method, self.tolerances = model, method, {"rtol": rtol, "atol": atol}
        self.orbit, self.with_tangent = compiled(model)
        self.dim = 2 * model.modes
        p = model.parameters[0]
        self.orbit(0.0, np.ones(self.dim), p), self.with_tangent(0.0, np.ones(2 * self.dim), p)  # compiles

    def integrate(self, field, u, p, times):
        """States at `times`, or None for an orbit that left every bound."""
        if self.method == "LSODA":
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                found, info = odeint(field, u, times, args=(p,), tfirst=True, full_output=True, mxstep=100000, **self.tolerances)
            ok = info["message"] == "Integration successful."
        else:
            run = solve_ivp(field, (times[0], times[-1]), u, method="DOP853", t_eval=times, args=(p,),
                            events=self.bound, **self.tolerances)  # fmt: skip
            found, ok = run.y.T, run.status == 0
        ok = ok and np.all(np.isfinite(found)) and np.max(np.abs(found[:, : self.dim])) < self.model.escape
        return found if ok else None

    def bound(self, t, u, p):
        return max(abs(u[0]), abs(u[1])) - self.model.escape

    bound.terminal = True

    def look(self, cells, state, span):
        times = np.arange(round(span / self.model.sample) + 1) * self.model.sample
        samples = np.zeros((len(cells), len(times), self.dim))
        gone = np.zeros(len(cells), dtype=bool)
        for i, cell in enumerate(cells):
            found = self.integrate(self.orbit, state[i], self.model.parameters[cell], times)
            gone[i] = found is None
            if not gone[i]:
                samples[i] = found
        return samples, gone

    def exponent(self, cells, state, span):
        times = np.linspace(0.0, self.model.segment, 6)
        logs = np.zeros((len(cells), 5 * round(span / self.model.segment)))
        ends, gone = state.copy(), np.zeros(len(cells), dtype=bool)
        for i, cell in enumerate(cells):
            u = np.concatenate([state[i], np.full(self.dim, self.dim**-0.5)])
            for k in range(0, logs.shape[1], 5):
                found = self.integrate(self.with_tangent, u, self.model.parameters[cell], times)
                if found is None:
                    gone[i] = True
                    break
                lengths = np.sqrt((found[:, self.dim :] ** 2).sum(axis=1))
                logs[i, k : k + 5] = np.diff(np.log(lengths))
                u = found[-1]
                u[self.dim :] /= lengths[-1]
            ends[i] = u[: self.dim]
        return logs, times[1], ends, gone
