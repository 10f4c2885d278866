"""Work and precision: time per orbit against the error reached at t = 20, over tolerances; a table and a figure."""

import numpy as np

import environment
import reference
from harness import Contestant, compete, relative
from rivals import heyoka_rival, program, scipy_rival
from table import number

T = 20.0
AT = (1e-8, 1e-10, 1e-12)  # errors at which the times are compared


def makers(scale):
    """name -> (members, prepare(rtol))."""
    n, few = max(64, int(4096 * scale) // 8 * 8), max(64, int(1024 * scale) // 8 * 8)

    def mine():
        keys = {"members": n, "t": T, "threads": 1}
        return n, lambda rtol: program.motiform("adaptive", rtol=rtol, **keys)

    return {
        "motiform dop853": mine(),
        "heyoka batch 8": (n, lambda rtol: heyoka_rival.adaptive(n, T, rtol)),
        "Rust differential-equations": (few, lambda rtol: program.rust(few, T, rtol)),
        "SciPy DOP853": (8, lambda rtol: scipy_rival.adaptive(8, T, rtol)),
    }


def measure(scale, repeats, quick):
    """[{program, rtol, error, milliseconds, every}] of all that worked, and the failures."""
    tolerances = [10.0**-k for k in (range(6, 14, 2) if quick else range(6, 14))]
    entries, where = [], []
    for rtol in tolerances:
        for name, (n, prepare) in makers(scale).items():
            error = lambda check, n=n: relative(check, reference.end_states(n, T))  # noqa: E731
            entries.append(
                Contestant(f"{name} {rtol:.0e}", lambda p=prepare, r=rtol: p(r), error, 1e5 * rtol, scale=1e-3 / T)
            )
            where.append((name, rtol))
    rows = compete(entries, "orbits/ms", repeats, quiet=True)
    points, failed = [], {}
    for (name, rtol), row in zip(where, rows):
        if row.failed:
            failed.setdefault(name, f"{rtol:.0e}: {row.failed}")
        else:
            point = {"program": name, "rtol": rtol, "error": row.error, "milliseconds": 1 / row.best}
            points.append({**point, "median": 1 / row.median, "orbits_per_ms": row.rates})
    return points, failed


def at_error(points, name, error):
    """Milliseconds per orbit at an error, by a straight line between the neighbours in the log-log plane."""
    mine = sorted((p["error"], p["milliseconds"]) for p in points if p["program"] == name)
    x, y = np.log([max(e, 1e-17) for e, _ in mine]), np.log([ms for _, ms in mine])
    if len(mine) < 2 or not x[0] <= np.log(error) <= x[-1]:
        return None
    return float(np.exp(np.interp(np.log(error), x, y)))


def table(points, failed):
    title = f"Work and precision: milliseconds per orbit to t = {T:g}, at equal error"
    lines = ["", title, "=" * len(title), f"{'':30}" + "".join(f"   error {error:.0e}" for error in AT)]
    for name in dict.fromkeys(p["program"] for p in points):
        times = [at_error(points, name, error) for error in AT]
        lines.append(f"{name:30}" + "".join(f"{number(ms) if ms else '-':>14}" for ms in times))
    lines += [f"{name:30} - {text}" for name, text in failed.items()]
    return "\n".join(lines)


def draw(points, stem):
    """Colours of Okabe and Ito, a marker each: readable without colour too."""
    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    colours = ["#0072B2", "#56B4E9", "#009E73", "#8FC9A9", "#CC79A7", "#D55E00", "#E69F00", "#000000"]
    figure, axes = plt.subplots(figsize=(9, 6.5))
    for name, colour, marker in zip(makers(1.0), colours, "osD^vXPh"):
        mine = sorted((p["rtol"], p["error"], p["milliseconds"]) for p in points if p["program"] == name)
        if mine:
            line = "--" if "fast" in name else "-"
            axes.loglog(
                [max(e, 1e-17) for _, e, _ in mine], [ms for *_, ms in mine],
                line, color=colour, marker=marker, markersize=7, linewidth=1.8, label=name,
            )  # fmt: skip
    axes.invert_xaxis()
    axes.set_xlabel(f"relative error reached at t = {T:g} (largest of 8 orbits)", fontsize=13)
    axes.set_ylabel("milliseconds per orbit, best run", fontsize=13)
    model = environment.processor()[0]
    axes.set_title(f"Tensor model, adaptive orbits, one core\n{model}", fontsize=13)
    axes.tick_params(labelsize=12)
    axes.grid(True, which="major", alpha=0.3)
    axes.legend(fontsize=11)
    figure.tight_layout()
    for kind in ("svg", "png"):
        figure.savefig(f"{stem}.{kind}", dpi=150)
    plt.close(figure)
