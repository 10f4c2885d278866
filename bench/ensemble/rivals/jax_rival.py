"""JAX: RK4 in one jitted fori_loop over a structure of arrays; diffrax: Dopri8 under vmap."""

import time

import numpy as np

import workload as w
from harness import Run


def rk4(n, steps, dt):
    import jax
    import jax.numpy as jnp

    kappa2, start = map(jnp.asarray, w.members(n))

    @jax.jit
    def loop(u):
        one = lambda _, u: tuple(w.rk4_step(u, kappa2, dt, dt / 2, dt / 3, dt / 6))  # noqa: E731
        return jax.lax.fori_loop(0, steps, one, tuple(u))

    return timed(loop, start, n * steps)


def timed(loop, start, work):
    import jax

    def run():
        begin = time.perf_counter()
        end = jax.block_until_ready(loop(start))
        return Run(time.perf_counter() - begin, work, np.array(end)[:, : w.SHOWN].T)

    run()  # compile
    return run


def diffrax_adaptive(n, t, rtol, per_orbit=False):
    import diffrax as dx
    import jax
    import jax.numpy as jnp

    kappa2, start = map(jnp.asarray, w.members(n))
    term = dx.ODETerm(lambda _, u, k2: jnp.stack(w.field(tuple(u), k2)))
    control = dx.PIDController(rtol=rtol, atol=rtol * 1e-2)

    def one(u, k2):
        found = dx.diffeqsolve(
            term, dx.Dopri8(), 0.0, t, 0.01, u, args=k2, stepsize_controller=control,
            saveat=dx.SaveAt(t1=True), max_steps=None, adjoint=dx.ForwardMode(),
        )  # fmt: skip
        return found.ys[0]

    loop = jax.jit(lambda start: jax.vmap(one, in_axes=(1, 0), out_axes=1)(start, kappa2))
    return timed(loop, start, n if per_orbit else n * t)
