"""The groups of the table: who competes in which, with how much work, verified against what."""

import environment
import reference
from harness import Contestant, compete, relative
from exponents import KAPPA2, mean_divergence
from rivals import heyoka_rival, jax_rival, lyapunov_rivals, numba_rival, program, scipy_rival

DT, STEPS, T, T_SHORT = 0.01, 1000, 20.0, 10.0
ALLOWED = 100  # error at the end of an adaptive orbit, as a multiple of the tolerance


def against(wanted, *arguments):
    """The error function of a contestant: its check against a reference that is computed when first asked."""
    return lambda check: relative(check, wanted(*arguments))


def orbits(task, t, rtol, scale, repeats, per_orbit):
    """Rows 1 and 3: adaptive orbits to t, in time units or in orbits per second."""
    n = lambda full: max(8, int(full * scale) // 8 * 8)  # noqa: E731

    def entry(name, members, prepare):
        return Contestant(name, lambda: prepare(members), against(reference.end_states, members, t), ALLOWED * rtol)

    def mine(method):
        keys = {"t": t, "rtol": rtol, "threads": 1}
        return entry(f"motiform {method}", n(16384), lambda m: program.motiform(task, members=m, **keys))

    heyoka = lambda **options: lambda m: heyoka_rival.adaptive(m, t, rtol, per_orbit=per_orbit, **options)  # noqa: E731
    list_ = [
        mine("dop853"),
        entry("heyoka batch 8", n(16384), heyoka()),
        entry("heyoka batch 8 fast_math, avx512", n(16384), heyoka(**heyoka_rival.FAST)),
        entry("heyoka scalar", n(4096), heyoka(batch=1)),
    ]
    if per_orbit:
        list_.append(entry("heyoka ensemble, batch 8", n(2048), lambda m: heyoka_rival.ensemble(m, t, rtol)))
    else:
        list_.append(entry("Rust differential-equations DOP853", n(4096), lambda m: program.rust(m, t, rtol)))
    list_ += [
        entry("diffrax Dopri8, vmap of 256", 256, lambda m: jax_rival.diffrax_adaptive(m, t, rtol, per_orbit)),
        entry("SciPy DOP853", 8, lambda m: scipy_rival.adaptive(m, t, rtol, per_orbit)),
    ]
    rows = compete(list_, "orbits/s" if per_orbit else "time units/s", repeats)
    return rows, [f"error at t = {t:g}, relative; allowed: {ALLOWED} times the tolerance"]


def lyapunov(scale, repeats, quick):
    """Row 2: all six exponents."""
    rtol, n = 1e-9, lambda full: max(8, int(full * scale) // 8 * 8)

    def entry(name, members, prepare, limit=1e-6):
        wanted = lambda check: relative(check, reference.exponents(members, T)[0])  # noqa: E731
        return Contestant(name, prepare, wanted, limit)

    def total(name, members, prepare, limit):
        """Where the first frame is random, the sum is what can be compared."""

        def error(check):
            return relative([sum(row) for row in check], reference.exponents(members, T)[1])

        return Contestant(name, prepare, error, limit)

    # Long orbits, so that the intervals are those of real use; kappa2 = 0.5 for all, where the sum is known.
    t = max(400.0, 2000.0 * scale)
    keys = {"members": n(256), "t": t, "rtol": rtol, "threads": 1, "kappa2_low": KAPPA2, "kappa2_high": KAPPA2}
    mean = lambda check: relative([sum(row) for row in check], [mean_divergence()] * len(check))  # noqa: E731
    list_ = [Contestant("motiform QR by growth", lambda: program.motiform("lyapunov", **keys), mean, 0.05)]
    for interval in (1.0, 5.0):
        start = lambda i=interval, **options: heyoka_rival.lyapunov(n(512), T, rtol, i, **options)  # noqa: E731
        list_.append(entry(f"heyoka batch 8, QR every {interval:g}", n(512), start))
        start = lambda i=interval: heyoka_rival.lyapunov(n(64), T, rtol, i, batch=1)  # noqa: E731
        list_.append(entry(f"heyoka one by one, QR every {interval:g}", n(64), start))
        start = lambda i=interval: lyapunov_rivals.jitcode(n(64), T, rtol, i)  # noqa: E731
        list_.append(entry(f"jitcode_lyap dop853, QR every {interval:g}", n(64), start))
    if not quick:  # it compiles for half a minute
        list_.append(total("pynamicalsys RK4 dt 0.01", 8, lambda: lyapunov_rivals.pynamicalsys(8, T), 1e-5))
        list_.append(total("pynamicalsys RK45", 8, lambda: lyapunov_rivals.pynamicalsys(8, T, rtol), 1e-5))
    rows = compete(list_, "time units/s", repeats)
    return rows, [
        f"rtol {rtol:g}; error of the exponents at t = {T:g} from the identity frame (pynamicalsys: of their sum, its"
        " frame is random; motiform: of their sum over the whole run against the mean divergence)"
    ]


def threads(scale, repeats):
    """Row 4: pairs (name, one thread, two threads), on all cores."""
    n = lambda full: max(64, int(full * scale) // 64 * 64)  # noqa: E731
    m, few, rtol = n(32768), n(8192), 1e-9
    states = against(reference.end_states, m, T)
    motiform = program.motiform
    makers = [
        (
            "motiform dop853, rtol 1e-9", "time units/s", states, ALLOWED * rtol,
            lambda k: motiform("adaptive", members=m, t=T, rtol=rtol, threads=k),
        ),
        (
            "heyoka batch 8, tol 1e-9", "time units/s", states, ALLOWED * rtol,
            lambda k: heyoka_rival.adaptive(m, T, rtol, threads=k),
        ),
        (
            "numba rk4", "steps/s", against(reference.rk4, few, STEPS, DT), 1e-12,
            lambda k: numba_rival.rk4(few, STEPS, DT, False, threads=k),
        ),
    ]  # fmt: skip
    list_ = [
        Contestant(f"{name}, {k} thread{'s' * (k > 1)}", lambda make=make, k=k: make(k), error, limit, unit)
        for name, unit, error, limit, make in makers
        for k in (1, environment.THREADS)
    ]
    environment.pin(environment.ALL_CORES)
    try:
        rows = compete(list_, "", repeats)
    finally:
        environment.pin()
    names = [name for name, *_ in makers]
    return rows, list(zip(names, rows[::2], rows[1::2]))
