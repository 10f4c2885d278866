"""One orbit of the active cell model, one core: motiform against a NumPy ETDRK4 and exponax (JAX).

Same equation, same ETDRK4 (Cox and Matthews), N = 128 points, 2/3 rule, double precision, same step, same start, one
run. The end states must agree, or nothing is printed. See README.md.
"""

import os

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"
os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
if hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})

import platform
import statistics
import subprocess
import sys
import time

import numpy as np

LENGTH, N, MODES, STEP = 21.6, 128, 42, 0.02
K1 = 2 * np.pi / LENGTH


def weights(z, points=32):
    """Contour means of the ETDRK4 coefficients (Kassam and Trefethen 2005)."""
    r = np.exp(1j * np.pi * (np.arange(1, points + 1) - 0.5) / points)
    w = z[:, None] + r[None, :]
    q = np.mean(((np.exp(w / 2) - 1) / w).real, axis=1)
    f1 = np.mean(((-4 - w + np.exp(w) * (4 - 3 * w + w**2)) / w**3).real, axis=1)
    f2 = np.mean(((2 + w + np.exp(w) * (w - 2)) / w**3).real, axis=1)
    f3 = np.mean(((-4 - 3 * w - w**2 + np.exp(w) * (4 - w)) / w**3).real, axis=1)
    return q, f1, f2, f3


def start():
    """phi = 0.1 cos(k s) + 0.1 sin(2 k s) + 0.05 cos(3 k s), as rfft of N points divided by N."""
    u = np.zeros(N // 2 + 1, dtype=complex)
    u[1], u[2], u[3] = 0.05, -0.05j, 0.025
    return u


def numpy_run(steps):
    n = np.arange(N // 2 + 1)
    k = K1 * n
    lam = k**4 - k**6
    q, f1, f2, f3 = weights(STEP * lam)
    e, e2 = np.exp(STEP * lam), np.exp(STEP * lam / 2)
    q, f1, f2, f3 = STEP * q, STEP * f1, 2 * STEP * f2, STEP * f3
    mask = n <= MODES
    second = np.where(mask, -(k**2), 0) * N
    flux = np.where(mask, -0.5j * k, 0) / N
    rfft, irfft = np.fft.rfft, np.fft.irfft

    def nonlinear(u):  # -1/2 d/ds (phi_ss^2)
        x = irfft(second * u, N)
        return flux * rfft(x * x)

    u = start()
    begin = time.perf_counter()
    for _ in range(steps):
        nu = nonlinear(u)
        eu = e2 * u
        a = eu + q * nu
        na = nonlinear(a)
        b = eu + q * na
        nb = nonlinear(b)
        c = e2 * a + q * (2 * nb - nu)
        u = e * u + f1 * nu + f2 * (na + nb) + f3 * nonlinear(c)
    return time.perf_counter() - begin, u[1 : MODES + 1]


def exponax_run(steps):
    import jax

    jax.config.update("jax_enable_x64", True)
    jax.config.update("jax_platforms", "cpu")
    import exponax as ex
    import jax.numpy as jnp

    class Bending(ex.nonlin_fun.BaseNonlinearFun):
        second: jax.Array
        flux: jax.Array

        def __init__(self, derivative):
            super().__init__(1, N, dealiasing_fraction=2 / 3)
            # exponax's mask rounds down to 41 modes: use the same 42 as the others
            self.dealiasing_mask = (jnp.arange(N // 2 + 1) <= MODES)[None, :]
            self.second = derivative**2
            self.flux = -0.5 * derivative

        def __call__(self, u_hat):
            return self.flux * self.fft(self.ifft(self.second * u_hat) ** 2)

    class Cell(ex.BaseStepper):
        def __init__(self):
            super().__init__(1, LENGTH, N, STEP, num_channels=1, order=4, num_circle_points=32)

        def _build_linear_operator(self, derivative):
            return derivative**4 + derivative**6

        def _build_nonlinear_fun(self, derivative):
            return Bending(derivative)

    cell = Cell()

    @jax.jit
    def loop(u):
        return jax.lax.scan(lambda u, _: (cell.step_fourier(u), None), u, None, length=steps)[0]

    u = jnp.asarray(start() * N)[None, :]
    loop(u).block_until_ready()  # compile
    begin = time.perf_counter()
    u = loop(u).block_until_ready()
    return time.perf_counter() - begin, np.asarray(u)[0, 1 : MODES + 1] / N


def motiform_run(binary, steps, stepper="etdrk4"):
    command = [binary, stepper, str(LENGTH), str(MODES), str(STEP), str(steps)]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    values = np.array(lines[1:], dtype=float)
    return float(lines[0]), values[0::2] + 1j * values[1::2]


def processor():
    try:
        with open("/proc/cpuinfo") as file:
            return next(line.split(":")[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def main(binary, repeats=5):
    import exponax
    import jax

    runs = {
        "motiform": lambda steps: motiform_run(binary, steps),
        "numpy": numpy_run,
        "exponax": exponax_run,
    }
    # One short run each: the same numbers (the orbit is irregular, so round-off grows later).
    ends = {name: run(2000)[1] for name, run in runs.items()}
    for name, end in ends.items():
        difference = np.max(np.abs(end - ends["motiform"])) / np.max(np.abs(ends["motiform"]))
        assert difference < 1e-9, f"{name} differs by {difference:.1e}"
        print(f"{name:9} agrees at t = {2000 * STEP:g} to {difference:.1e}")
    rates = {name: [] for name in runs}
    for _ in range(repeats):  # in turn, so that a busy machine is busy for all
        for name, run in runs.items():
            steps = 10000 if name == "numpy" else 50000
            seconds, end = run(steps)
            assert np.isfinite(end).all()
            rates[name].append(steps / seconds)
    print(f"processor: {processor()}, one core")
    print(f"numpy {np.__version__}, jax {jax.__version__}, exponax {exponax.__version__}, python {platform.python_version()}")
    print(f"length {LENGTH}, N = {N} ({MODES} modes after the 2/3 rule), step {STEP}, ETDRK4, double precision")
    best = {name: max(each) for name, each in rates.items()}
    for name, each in rates.items():
        print(
            f"{name:9} best {best[name]:10.0f} steps/s, median {statistics.median(each):10.0f},"
            f" motiform is {best['motiform'] / best[name]:6.1f} times as fast"
            f"   all: {' '.join(f'{rate:.0f}' for rate in each)}"
        )


if __name__ == "__main__":
    main(sys.argv[1])
