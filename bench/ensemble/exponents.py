"""Long run, apart from the timing: the largest exponent at kappa2 = 0.5, and the sum against the mean divergence."""

import numpy as np

import workload as w
from harness import reason
from rivals import heyoka_rival, lyapunov_rivals, program

KAPPA2, NEAR, ALLOWED = 0.5, 0.087, 0.01


def mean_divergence(members=512, dt=0.02, transient=100.0, t=200.0):
    """Over an ensemble of orbits on the attractor, by RK4 in NumPy: none of the programs that are verified."""
    kappa2, start = w.members(members, KAPPA2, KAPPA2)
    u, means = list(start), []
    for step in range(round((transient + t) / dt)):
        u = w.rk4_step(u, kappa2, dt, dt / 2, dt / 3, dt / 6)
        if step * dt >= transient and step % 10 == 0:
            means.append(w.divergence(u, kappa2).mean())
    return float(np.mean(means))


def verify(scale, quick):
    """Lines of text, and the same as data."""
    at = {"low": KAPPA2, "high": KAPPA2}
    long, short = max(1000.0, round(10000 * scale)), max(200.0, round(1000 * scale))
    keys = {"members": 8, "interval": 5.0, "rtol": 1e-9, "threads": 1, "kappa2_low": KAPPA2, "kappa2_high": KAPPA2}
    runs = {
        "motiform": (long, lambda: program.motiform("lyapunov", t=long, **keys)),
        "heyoka batch 8": (long, lambda: heyoka_rival.lyapunov(8, long, 1e-9, 5.0, **at)),
        "jitcode_lyap": (short, lambda: lyapunov_rivals.jitcode(8, short, 1e-9, 1.0, **at)),
        "pynamicalsys RK4": (short, lambda: lyapunov_rivals.pynamicalsys(8, short, **at)),
    }
    if quick:
        del runs["pynamicalsys RK4"]
    divergence = mean_divergence()
    title = f"Verification: exponents at kappa2 = {KAPPA2}, 8 orbits each"
    lines = ["", title, "=" * len(title), f"mean divergence (NumPy RK4, 512 orbits): {divergence:.4f}"]
    data = {"mean_divergence": divergence}
    for name, (t, prepare) in runs.items():
        try:
            found = np.array(prepare()().check)
            first, total = found[:, 0], found.sum(axis=1).mean()
            spread = first.std(ddof=1) / np.sqrt(len(first))
            good = abs(first.mean() - NEAR) < ALLOWED + 3 * spread and abs(total - divergence) < ALLOWED
            data[name] = {"t": t, "exponents": found.mean(axis=0).tolist(), "sum": total, "good": bool(good)}
            lines.append(
                f"{name:18} t = {t:6g}: largest {first.mean():.4f} +- {spread:.4f}, sum {total:.4f}"
                f"  {'as expected' if good else 'NOT AS EXPECTED'}"
            )
        except Exception as error:  # noqa: BLE001
            data[name] = {"failed": reason(error)}
            lines.append(f"{name:18} - {reason(error)}")
    return "\n".join(lines), data
