"""Orbits by heyoka.py: Taylor series compiled at run time, eight orbits side by side."""

import heyoka as hy
import numpy as np


class Heyoka:
    batch = 8

    def __init__(self, model, tol=1e-12):
        self.model, self.dim = model, 2 * model.modes
        self.orbit = self.integrator(tol, tangent=False)
        self.with_tangent = self.integrator(tol, tangent=True)

    def integrator(self, tol, tangent):
        u = hy.make_vars(*(f"u{i}" for i in range(self.dim)))
        w = hy.make_vars(*(f"w{i}" for i in range(self.dim)))
        p = [hy.par[i] for i in range(self.model.parameters.shape[1])]
        equations = list(zip(u, self.model.rates(u, p)))
        if tangent:
            equations += list(zip(w, self.model.change(u, w, p)))
        gone = hy.t_event_batch(u[0] ** 2 + u[1] ** 2 - self.model.escape**2)
        return hy.taylor_adaptive_batch(
            equations,
            np.zeros((len(equations), self.batch)),
            pars=np.zeros((len(p), self.batch)),
            t_events=[gone],
            tol=tol,
            fast_math=True,
            force_avx512=True,
            compact_mode=False,
        )

    def propagate(self, integrator, cells, state, grid):
        """States (cells, times, dim) of up to eight cells, and which of them left every bound.

        An orbit that leaves stops all eight; the others then start again without it.
        """
        states, gone = np.zeros((len(cells), len(grid), state.shape[1])), np.zeros(len(cells), dtype=bool)
        while not gone.all():
            lanes = np.resize(np.flatnonzero(~gone), self.batch)  # empty lanes repeat the others
            integrator.set_time(0.0)
            integrator.state[:] = state[lanes].T
            integrator.pars[:] = self.model.parameters[cells[lanes]].T
            found = integrator.propagate_grid(np.repeat(grid[:, None], self.batch, axis=1))[1]
            if all(result[0] == hy.taylor_outcome.time_limit for result in integrator.propagate_res):
                states[lanes] = np.moveaxis(found, 2, 0)
                break
            size = np.hypot(integrator.state[0], integrator.state[1])
            left = ~(size < 0.999 * self.model.escape)
            if not left.any():
                raise RuntimeError(f"heyoka stopped: {integrator.propagate_res}")
            gone[lanes[left]] = True
        return states, gone

    def in_batches(self, integrator, cells, state, grid):
        parts = [np.arange(i, min(i + self.batch, len(cells))) for i in range(0, len(cells), self.batch)]
        found = [self.propagate(integrator, cells[part], state[part], grid) for part in parts]
        return np.concatenate([states for states, _ in found]), np.concatenate([gone for _, gone in found])

    def look(self, cells, state, span):
        grid = np.arange(round(span / self.model.sample) + 1) * self.model.sample
        return self.in_batches(self.orbit, cells, state, grid)

    def exponent(self, cells, state, span):
        grid = np.linspace(0.0, self.model.segment, 6)
        logs = np.zeros((len(cells), 5 * round(span / self.model.segment)))
        tangent = np.full_like(state, self.dim**-0.5)
        gone, state, on = np.zeros(len(cells), dtype=bool), state.copy(), np.arange(len(cells))
        for k in range(0, logs.shape[1], 5):
            both = np.concatenate([state[on], tangent[on]], axis=1)
            found, left = self.in_batches(self.with_tangent, cells[on], both, grid)
            gone[on[left]] = True
            on, found = on[~left], found[~left]
            if not len(on):
                break
            lengths = np.sqrt((found[:, :, self.dim :] ** 2).sum(axis=2))
            logs[on, k : k + 5] = np.diff(np.log(lengths), axis=1)
            state[on], tangent[on] = found[:, -1, : self.dim], found[:, -1, self.dim :] / lengths[:, -1:]
        return logs, grid[1], state, gone
