"""The cell model: NumPy, vectorised over members, one length each; exponax (JAX) under vmap, equal lengths."""

import time
from functools import cache

import numpy as np

import cell
from cell import MODES, N, STEP
from harness import Run


def numpy_cell(n, steps, low, high):
    modes = np.arange(N // 2 + 1)
    k = 2 * np.pi / cell.lengths(n, low, high)[:, None] * modes
    linear = k**4 - k**6
    q, f1, f2, f3 = (STEP * f for f in cell.weights(STEP * linear))
    e, e2 = np.exp(STEP * linear), np.exp(STEP * linear / 2)
    f2 = 2 * f2
    mask = modes <= MODES
    second, flux = np.where(mask, -(k**2), 0) * N, np.where(mask, -0.5j * k, 0) / N
    rfft, irfft = np.fft.rfft, np.fft.irfft

    def nonlinear(u):  # -1/2 d/ds (phi_ss^2)
        x = irfft(second * u, N)
        return flux * rfft(x * x)

    def run():
        u = cell.start(n)
        begin = time.perf_counter()
        for _ in range(steps):
            nu = nonlinear(u)
            eu = e2 * u
            a = eu + q * nu
            na = nonlinear(a)
            nb = nonlinear(eu + q * na)
            c = e2 * a + q * (2 * nb - nu)
            u = e * u + f1 * nu + f2 * (na + nb) + f3 * nonlinear(c)
        return Run(time.perf_counter() - begin, n * steps, cell.shown(u))

    return run


@cache
def wanted(n, steps, low, high):
    """End states of the first eight members alone (all, if there are fewer), by the NumPy program."""
    lengths = cell.lengths(n, low, high)
    few = min(8, n)
    return numpy_cell(few, steps, lengths[0], lengths[few - 1])().check


def exponax_cell(n, steps, length=cell.EQUAL[0]):
    import exponax as ex
    import jax
    import jax.numpy as jnp

    class Bending(ex.nonlin_fun.BaseNonlinearFun):
        second: jax.Array
        flux: jax.Array

        def __init__(self, derivative):
            super().__init__(1, N, dealiasing_fraction=2 / 3)
            # exponax's mask rounds down to 41 modes: use the same 42 as the others
            self.dealiasing_mask = (jnp.arange(N // 2 + 1) <= MODES)[None, :]
            self.second, self.flux = derivative**2, -0.5 * derivative

        def __call__(self, u_hat):
            return self.flux * self.fft(self.ifft(self.second * u_hat) ** 2)

    class Cell(ex.BaseStepper):
        def __init__(self):
            super().__init__(1, length, N, STEP, num_channels=1, order=4, num_circle_points=32)

        def _build_linear_operator(self, derivative):
            return derivative**4 + derivative**6

        def _build_nonlinear_fun(self, derivative):
            return Bending(derivative)

    step = jax.vmap(Cell().step_fourier)
    loop = jax.jit(lambda u: jax.lax.fori_loop(0, steps, lambda _, u: step(u), u))
    start = jnp.asarray(cell.start(n) * N)[:, None, :]

    def run():
        begin = time.perf_counter()
        end = jax.block_until_ready(loop(start))
        return Run(time.perf_counter() - begin, n * steps, cell.shown(np.array(end)[:, 0] / N))

    run()  # compile
    return run
