"""What a scan costs, and what follows for large ones: `python bench/python/scaling.py [--page docs/records/scaling.md]`.

Measures seconds per cell, bytes per row, memory and the overhead of executors; asserts that the results are right, and
never a time. Prints the tables, and with `--page` puts them into the page between its two marks.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

import motiform
from motiform import _motiform, executors

PLANES = {
    "fig1": ("reduced tensor model, plane of Fig. 1", {"kappa2": "-0.22:0.22:24", "gamma": "-0.16:0.12:16"}),
    "fig4": ("full tensor model, plane of Fig. 4", {"kappa2": "0.1:1.6:24", "kappa3": "0.1:1.0:16"}),
    "fig6a": ("active cell, lengths of Fig. 6", {"length": "6.25:31:100"}),
}
FINE = {
    "fig1": {"kappa2": "-0.22:0.22:1000", "gamma": "-0.16:0.12:1000"},
    "fig4": {"kappa2": "0.1:1.6:1000", "kappa3": "0.1:1.0:1000"},
}
QUIET = {"kappa2": "0.05:0.22:100", "gamma": "-0.16:-0.05:{}"}  # at rest everywhere: cheap rows, for the memory
ROWS = (10_000, 100_000)
CELLS, CORES, NODES = 1_000_000, 64, 100  # what is asked of the numbers

MEMORY = """
import json, pathlib, resource, sys
import motiform

def peak():
    status = pathlib.Path("/proc/self/status")
    if status.exists():  # ru_maxrss would begin with that of the process that started this one
        return next(int(line.split()[1]) * 1024 for line in status.read_text().splitlines() if line.startswith("VmHWM"))
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)

rows, axes = int(sys.argv[1]), json.loads(sys.argv[2])
motiform.scan(motiform.preset("fig1"), {"kappa2": "0.1:0.2:4", "gamma": "-0.1:-0.05:4"}, progress=False)
before = peak()
data = motiform.scan(motiform.preset("fig1"), axes, threads=1, progress=False)
assert data.regime.size == rows and (data.regime == 0).all()
print(json.dumps([before, peak(), data.nbytes]))
"""


def plan_of(preset: str, axes: dict[str, str]) -> _motiform.ScanPlan:
    return _motiform.ScanPlan(motiform.preset(preset)._study, list(axes.items()))


def cost(preset: str, axes: dict[str, str]) -> dict[str, Any]:
    """Seconds of one core per cell: many cells together, and each alone. Time of the processor, not of the clock."""
    plan = plan_of(preset, axes)
    plan.task(0, 1, 0.0, False)
    each, rows = [], []
    for cell in range(plan.cells):
        begun = time.process_time()
        arrays, end, _ = plan.task(cell, cell + 1, 1e9, False)
        each.append(time.process_time() - begun)
        assert end == cell + 1
        rows.append(arrays)
    together = None
    if sum(each) < 60.0:  # cells share lanes where a model has them; too long else to do it twice
        begun = time.process_time()
        (regimes, _, numbers, _), raised = plan.compute(1, False)
        together = (time.process_time() - begun) / plan.cells
        assert raised is None and [row[0][0] for row in rows] == list(regimes)
        for place, column in enumerate(numbers):
            np.testing.assert_array_equal(column, [row[2][place][0] for row in rows])
    dearest = each.index(max(each))
    place, where = dearest, []
    for name, values in plan.axes():  # the first axis runs fastest
        place, index = divmod(place, len(values))
        where.append(f"{name} = {values[index]:.4g}")
    return {
        "cells": plan.cells, "together": together, "mean": together or statistics.mean(each), "alone_mean": statistics.mean(each),
        "alone_median": statistics.median(each), "longest": max(each), "where": ", ".join(where),
        "regime": motiform.REGIMES[rows[dearest][0][0]].name, "tenth": sum(sorted(each)[-(len(each) // 10) :]) / sum(each),
    }  # fmt: skip


def files(preset: str, folder: Path, shards: int = 500) -> dict[str, Any]:
    """Bytes per row of a share of a scan of a million cells, and the seconds to read a row."""
    out = folder / preset
    data = motiform.scan(motiform.preset(preset), FINE[preset], out=out, shard=f"1/{shards}", progress=False)
    known = int((data.regime >= 0).sum())
    parts = list(out.glob("part-*.parquet"))
    assert parts and known > 0
    return {
        "rows": known, "parts": len(parts), "bytes": sum(part.stat().st_size for part in parts) / known,
        "all_parts": plan_of(preset, FINE[preset]).parts,
    }  # fmt: skip


def memory() -> dict[str, Any]:
    """Resident bytes per row of a scan's result: the slope between two sizes, each in a process of its own."""
    found = []
    for rows in ROWS:
        axes = {"kappa2": QUIET["kappa2"], "gamma": QUIET["gamma"].format(rows // 100)}
        made = subprocess.run([sys.executable, "-c", MEMORY, str(rows), json.dumps(axes)], capture_output=True, text=True, check=True)
        found.append(json.loads(made.stdout.splitlines()[-1]))
    (base, small, _), (_, large, data) = found
    return {"base": base, "small": small, "large": large, "slope": (large - small) / (ROWS[1] - ROWS[0]), "data": data / ROWS[1]}


def overhead(workers: int, rounds: int) -> dict[str, Any]:
    """A scan on a pool of processes against the same one on as many threads, in turn."""
    body, axes = motiform.preset("fig1"), {"kappa2": "-0.22:0.22:64", "gamma": "-0.16:0.12:48"}
    tasks: list[float] = []

    class Counted(ProcessPoolExecutor):
        def submit(self, fn, /, *args, **kwargs):  # type: ignore[no-untyped-def]
            future = super().submit(fn, *args, **kwargs)
            if fn is executors.task:
                future.add_done_callback(lambda done: tasks.append(done.result()[2]))
            return future

    local, pooled, own = [], [], []
    with Counted(workers, mp_context=multiprocessing.get_context("spawn")) as pool:
        motiform.scan(body, {"kappa2": [0.1], "gamma": "-0.1:-0.05:8"}, executor=pool, progress=False)
        for _ in range(rounds):
            begun = time.perf_counter()
            first = motiform.scan(body, axes, threads=workers, progress=False)
            local.append(time.perf_counter() - begun)
            tasks.clear()
            begun, spent = time.perf_counter(), time.process_time()
            second = motiform.scan(body, axes, executor=pool, progress=False)
            pooled.append(time.perf_counter() - begun)
            own.append((time.process_time() - spent, len(tasks), sum(tasks)))
            xr.testing.assert_identical(first, second)
    spent, count, busy = min(own)
    return {
        "workers": workers, "local": min(local), "pool": min(pooled), "python": spent, "tasks": count, "busy": busy,
        "per_task": spent / count,
    }  # fmt: skip


def processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def span(seconds: float) -> str:
    for size, name in ((86400.0, "days"), (3600.0, "h"), (60.0, "min"), (1.0, "s")):
        if seconds >= 2.0 * size or (name == "s" and seconds >= 0.1):
            return f"{seconds / size:.2g} {name}" if seconds / size < 100 else f"{seconds / size:.0f} {name}"
    return f"{1e3 * seconds:.2g} ms"


def size(count: float) -> str:
    for unit, name in ((1e9, "GB"), (1e6, "MB"), (1e3, "kB")):
        if count >= unit:
            return f"{count / unit:.3g} {name}"
    return f"{count:.3g} B"


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def page(found: dict[str, Any]) -> str:
    costs, written = found["cost"], found["files"]
    held, tasks = found["memory"], found["overhead"]
    text = [f"Measured on {found['processor']}, {found['cores']} cores, motiform {found['motiform']}, Python {found['python']}.\n"]

    text.append("**Seconds of one core per cell**, one initial state each, default budget.\n")
    text.append(table(
        ["scan", "cells", "mean, together", "mean, one by one", "median, one by one", "slowest cell", "slowest tenth of the cells"],
        [[PLANES[name][0], str(c["cells"]), span(c["together"]) if c["together"] else "not measured", span(c["alone_mean"]),
          span(c["alone_median"]), f"{span(c['longest'])}: {c['where']}, {c['regime']}", f"{100 * c['tenth']:.0f} % of the time"]
         for name, c in costs.items()],
    ))  # fmt: skip
    text.append("**Bytes per row**: Parquet parts of a share of a scan of a million cells; result in memory.\n")
    rows = [[PLANES[name][0], f"{f['rows']:.0f}", f"{f['bytes']:.0f}", f"{f['all_parts']:.0f}"] for name, f in written.items()]
    text.append(table(["scan", "rows examined", "bytes per row on disk", "files of the whole scan"], rows))
    text.append(table(
        ["memory of a scan (resident)", ""],
        [["before it, package loaded", size(held["base"])],
         [f"{ROWS[0]:,} rows", size(held["small"])],
         [f"{ROWS[1]:,} rows", size(held["large"])],
         ["slope, bytes per row", f"{held['slope']:.0f}"],
         ["of which the dataset itself", f"{held['data']:.0f}"]],
    ))  # fmt: skip
    text.append("**Overhead of an executor**: a pool of processes compared with the same number of threads, the same scan, the best of interleaved rounds.\n")
    text.append(table(
        ["", ""],
        [["workers", str(tasks["workers"])],
         ["threads, wall time", span(tasks["local"])],
         ["pool, wall time", f"{span(tasks['pool'])} ({100 * (tasks['pool'] / tasks['local'] - 1):+.1f} %)"],
         ["tasks, mean duration", f"{tasks['tasks']}, {span(tasks['busy'] / tasks['tasks'])}"],
         ["work of the calling process (Python, pickling, merging)",
          f"{span(tasks['python'])}, {100 * tasks['python'] / tasks['busy']:.2f} % of the workers' time"],
         ["of which per task", span(tasks["per_task"])],
         [f"workers that one process can supply, with tasks of {executors.TASK_SECONDS:g} s",
          f"about {executors.TASK_SECONDS / tasks['per_task']:.0f}"]],
    ))  # fmt: skip

    text.append(f"**Estimate for {CELLS:,} cells**, computed from the numbers above. Assumed: nodes of {CORES} such cores, all busy.\n")
    most = max(f["bytes"] for f in written.values())
    rows = []
    for name, c in costs.items():
        seconds = c["mean"] * CELLS
        disk = written.get(name, {"bytes": most})["bytes"] * CELLS
        rows.append([
            PLANES[name][0], f"{seconds / 3600:.3g}", span(seconds / CORES), span(seconds / CORES / NODES),
            size(disk) + ("" if name in written else " (bytes per row assumed as above)"),
        ])  # fmt: skip
    text.append(table(["scan", "core hours", "1 node", f"{NODES} nodes", "on disk"], rows))
    text.append(
        f"Memory: {size(held['base'] + held['slope'] * CELLS)} in the process that holds the result, {size(held['base'])} in each worker"
        f" process ({size(CORES * held['base'])} on a node of {CORES}).\n"
    )
    return "\n".join(text)


def measure(workers: int, rounds: int) -> dict[str, Any]:
    with tempfile.TemporaryDirectory() as folder:
        found: dict[str, Any] = {
            "processor": processor(), "cores": os.cpu_count(), "motiform": motiform.__version__, "python": platform.python_version(),
        }  # fmt: skip
        found["overhead"] = overhead(workers, rounds)
        found["memory"] = memory()
        found["files"] = {name: files(name, Path(folder)) for name in FINE}
        found["cost"] = {}
        for name, (_, axes) in PLANES.items():
            found["cost"][name] = cost(name, axes)
            print(name, found["cost"][name], file=sys.stderr, flush=True)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--page", type=Path, help="a page with the marks <!-- measured --> and <!-- end -->")
    parser.add_argument("--raw", type=Path, default=Path(__file__).with_name("scaling.json"), help="the numbers, kept")
    parser.add_argument("--again", action="store_true", help="measure nothing: the page from the numbers kept")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    options = parser.parse_args()
    if not options.again:
        found = measure(options.workers, options.rounds)
        options.raw.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    text = page(json.loads(options.raw.read_text(encoding="utf-8")))
    print(text)
    if options.page:
        old = options.page.read_text(encoding="utf-8")
        head, rest = old.split("<!-- measured -->\n")
        tail = rest.split("<!-- end -->", 1)[1]
        options.page.write_text(f"{head}<!-- measured -->\n{text}<!-- end -->{tail}", encoding="utf-8")


if __name__ == "__main__":
    main()
