"""Verdicts per second over the planes of Figs. 1, 4 and 6: motiform, the same at an earlier commit, SciPy, heyoka.

    python3 bench/classify/bench.py --binary target/release/motiform --before OLD/motiform

Compares all verdicts; exits with code 1 if more than one in twenty of a rival's decided verdicts differ. See README.md.
"""

import argparse
import json
import os
import platform
import resource
import subprocess
import sys
import tempfile
import time
from collections import Counter
from importlib import metadata
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGES = ("numpy", "scipy", "numba", "heyoka", "pyarrow")
ALLOWED = 0.05  # of the verdicts that both have decided
RIVALS = {
    "fig1": ("heyoka", "scipy-odeint", "scipy-solve_ivp"),
    "fig4": ("heyoka", "scipy-odeint", "scipy-solve_ivp"),
    "fig6": ("numpy-etdrk4",),
}


LARGE = ("heyoka", "numpy-etdrk4")  # rivals that also do the larger grid


def enter_venv():
    """Run again inside the benchmark's own virtual environment, made on the first call (or $BENCH_PYTHON's)."""
    python = Path(os.environ.get("BENCH_PYTHON") or HERE / ".venv" / "bin" / "python")
    if os.environ.get("BENCH_INSIDE"):
        return
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", HERE / ".venv"], check=True)
        for package in PACKAGES:
            done = subprocess.run([python, "-m", "pip", "install", "-q", package])
            print(f"  {package}: {'installed' if done.returncode == 0 else 'cannot be installed'}", flush=True)
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[name] = "1"
    os.environ["BENCH_INSIDE"] = "1"
    os.execv(python, [str(python), *sys.argv])


def user_seconds(who):
    return resource.getrusage(who).ru_utime


def timed(who, work):
    """(user CPU seconds, wall seconds, result)."""
    user, wall = user_seconds(who), time.perf_counter()
    result = work()
    return user_seconds(who) - user, time.perf_counter() - wall, result


def run_motiform(binary, plane, count, limit):
    """One scan on one thread, with start of the program and writing of the data set; the rows in order of the cells.

    A run that needs more than `limit` CPU seconds is stopped: `TimeoutError`.
    """
    import pyarrow.parquet as parquet

    from planes import study

    with tempfile.TemporaryDirectory() as folder:
        file, out = Path(folder) / "study.toml", Path(folder) / "scan"
        file.write_text(study(plane, count))
        command = [binary, "scan", file, "--threads", "1", "--no-figures", "--json", "--out", out]
        limited = lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))  # noqa: E731
        call = lambda: subprocess.run(command, capture_output=True, text=True, preexec_fn=limited)  # noqa: E731
        user, wall, done = timed(resource.RUSAGE_CHILDREN, call)
        if done.returncode < 0:
            raise TimeoutError(f"stopped after {user:.0f} CPU seconds")
        if done.returncode not in (0, 1):  # 1: some cells are undetermined
            raise RuntimeError(done.stderr.strip())
        rows = [row for part in sorted(out.glob("part-*.parquet")) for row in parquet.read_table(part).to_pylist()]
    rows.sort(key=lambda row: row["cell"])
    return user, wall, [(row["regime"], row["why"], row["time"]) for row in rows]


def run_rival(name, plane, count):
    """The rival's classification of the plane in this process; compilation is not counted."""
    from planes import rival_model
    from rounds import classify

    model, start = rival_model(plane, count)
    if name == "heyoka":
        from heyoka_flow import Heyoka

        flow = Heyoka(model)
    elif name == "numpy-etdrk4":
        from etdrk4_flow import Etdrk4

        flow = Etdrk4(model)
    else:
        from scipy_flow import Scipy

        flow = Scipy(model, {"scipy-odeint": "LSODA", "scipy-solve_ivp": "DOP853"}[name])
    user, wall, motions = timed(resource.RUSAGE_SELF, lambda: classify(model, flow, start))
    return user, wall, [(motion.regime, motion.evidence, motion.spent) for motion in motions]


def measure(name, plane, count, run, repeats):
    """Repeats a run, fewer times if it is long; the runs must give the same verdicts."""
    runs = []
    for _ in range(repeats):
        runs.append(run())
        if runs[0][0] > 5:
            break
    regimes = [row[0] for row in runs[0][2]]
    assert all([row[0] for row in other[2]] == regimes for other in runs), f"{name}: verdicts differ between runs"
    cells = len(regimes)
    user = [round(one[0], 4) for one in runs]
    print(f"{plane} {name:16} {cells:6} cells {cells / min(user):9.2f} per CPU second", flush=True)
    return {
        "plane": plane,
        "program": name,
        "count": count,
        "cells": cells,
        "user_seconds": user,
        "wall_seconds": [round(one[1], 4) for one in runs],
        "model_time": sum(row[2] for row in runs[0][2]),
        "regimes": regimes,
        "evidence": [row[1] for row in runs[0][2]],
    }


def rate(run):
    return run["cells"] / min(run["user_seconds"])


def compare(ours, other):
    """Lines about the verdicts of another program on the same grid, and whether they agree well enough."""
    from planes import points

    pairs = list(zip(ours["regimes"], other["regimes"]))
    open_ = sum(b == "undetermined" for _, b in pairs)
    decided = [(a, b) for a, b in pairs if "undetermined" not in (a, b)]
    differ = [i for i, (a, b) in enumerate(pairs) if a != b]
    wrong = sum(a != b for a, b in decided)
    title = f"{ours['plane']}, {len(pairs)} cells, {other['program']}"
    lines = [f"{title}: {len(decided) - wrong} of {len(decided)} agree; it leaves {open_} undetermined"]
    for i in differ:
        where = ", ".join(f"{name} = {value:.4g}" for name, value in points(ours["plane"], ours["count"])[i].items())
        lines.append(f"  {where}: {pairs[i][0]} ({ours['evidence'][i]}); {other['program']}: {pairs[i][1]} ({other['evidence'][i]})")
    return lines, wrong <= ALLOWED * len(decided)


def of_plane(plane, options):
    """All measurements of one plane, and the text about them."""
    count, large = (options.lengths, options.large_lengths) if plane == "fig6" else (options.grid, options.large)
    runs, lines, good = [], [], True

    def add(name, size, run):
        try:
            runs.append(measure(name, plane, size, run, options.repeats))
        except (ImportError, TimeoutError) as error:
            lines.append(f"{plane} {name}, {size} values on each axis: {error}")

    for name, binary in (("motiform", options.binary), ("motiform-before", options.before)):
        for size in sorted({count, large}) if binary else ():
            add(name, size, lambda: run_motiform(binary, plane, size, options.limit))  # noqa: B023
    for name in RIVALS[plane]:
        for size in sorted({count, large}) if name in LARGE else (count,):
            add(name, size, lambda: run_rival(name, plane, size))  # noqa: B023
    ours = runs[0]
    lines.append(f"\n{plane}: {dict(Counter(ours['regimes']))}")
    lines.append("| program | cells | cells per CPU second | model time per cell | motiform is faster by |")
    lines.append("| --- | --- | --- | --- | --- |")
    for run in runs:
        same = next(one for one in runs if one["program"] == "motiform" and one["count"] == run["count"])
        ratio = f"{rate(same) / rate(run):.3g}"
        per_cell = run["model_time"] / run["cells"]
        lines.append(f"| {run['program']} | {run['cells']} | {rate(run):.3g} | {per_cell:.0f} | {ratio} |")
    for first in {run["count"]: run for run in reversed(runs)}.values():  # motiform's run on each grid
        for run in runs:
            if run["count"] == first["count"] and run is not first:
                text, fine = compare(first, run)
                lines, good = lines + text, good and fine
    return runs, lines, good


def kept(run):
    """What a file keeps of a run: the regimes as one string, evidence of small grids only."""
    evidence = run["evidence"] if run["cells"] <= 144 else []
    return {**run, "regimes": " ".join(run["regimes"]), "evidence": evidence}


def description():
    """Processor and versions."""
    model = platform.processor() or platform.machine()
    try:
        text = Path("/proc/cpuinfo").read_text()
        model = next(line.split(":")[1].strip() for line in text.splitlines() if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    versions = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            versions[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            versions[package] = "not installed"
    return {"processor": model, "versions": versions, "load_at_start": [round(x, 2) for x in os.getloadavg()]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", default="target/release/motiform", help="motiform")
    parser.add_argument("--before", help="motiform at an earlier commit")
    parser.add_argument("--grid", type=int, default=12, help="values on each axis of Figs. 1 and 4 (default 12)")
    parser.add_argument("--large", type=int, default=32, help="the same, larger, for the fast programs (default 32)")
    parser.add_argument("--lengths", type=int, default=25, help="lengths of Fig. 6 (default 25)")
    parser.add_argument("--large-lengths", type=int, default=49, help="the same, larger (default 49)")
    parser.add_argument("--limit", type=int, default=300, help="CPU seconds after which a scan is stopped (default 300)")
    parser.add_argument("--only", choices=RIVALS, help="one plane")
    parser.add_argument("--repeats", type=int, default=3, help="runs of which the fastest counts; one if it takes over 5 s")
    parser.add_argument("--name", help="name of the files in runs/ (default: nothing is kept)")
    options = parser.parse_args()
    about, good = description(), True
    for plane in [options.only] if options.only else RIVALS:
        runs, lines, fine = of_plane(plane, options)
        good = good and fine
        print("\n".join(lines), flush=True)
        if options.name:
            (HERE / "runs").mkdir(exist_ok=True)
            stem = HERE / "runs" / f"{options.name}-{plane}"
            stem.with_suffix(".json").write_text(json.dumps({**about, "runs": [kept(run) for run in runs]}, indent=1) + "\n")
            stem.with_suffix(".txt").write_text("\n".join([str(about), *lines]) + "\n")
    if not good:
        sys.exit("too many verdicts differ")


if __name__ == "__main__":
    enter_venv()
    main()
