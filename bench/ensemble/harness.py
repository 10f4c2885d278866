"""Groups of contestants, run in turn: each timed run is verified, the error reached is kept beside the rate."""

import statistics
import time
from dataclasses import dataclass, field
from typing import Callable

import numpy as np


@dataclass
class Run:
    """One timed run: seconds, the work done in them, and what is verified."""

    seconds: float
    work: float
    check: object


@dataclass
class Contestant:
    """`prepare()` imports, compiles and returns the function of one timed run."""

    name: str
    prepare: Callable
    error: Callable = lambda check: 0.0  # the error reached by a run's check
    limit: float = 0.0
    unit: str = ""  # of the rate, where it is not the group's
    scale: float = 1.0  # of the rate, for printing


@dataclass
class Row:
    name: str
    unit: str
    rates: list = field(default_factory=list)
    error: float = 0.0
    limit: float = 0.0
    failed: str = ""

    @property
    def best(self):
        return max(self.rates)

    @property
    def median(self):
        return statistics.median(self.rates)


def relative(check, wanted):
    """Largest difference over the largest wanted number: the error that is printed."""
    check, wanted = np.asarray(check, dtype=float), np.asarray(wanted, dtype=float)
    if check.shape != wanted.shape:
        raise ValueError(f"check of shape {check.shape}, wanted {wanted.shape}")
    return float(np.max(np.abs(check - wanted)) / np.max(np.abs(wanted)))


def reason(error):
    text = str(error).strip().splitlines()
    return f"{type(error).__name__}: {text[-1][:110] if text else ''}"


def attempt(contestant, row, run):
    """One run, verified; a rival's failure is a line of the table, whatever it is."""
    try:
        result = run()
        error = contestant.error(result.check)
        if np.isfinite(error):
            row.error = max(row.error, error)
        if not error <= contestant.limit:
            row.failed = f"wrong result: error {error:.1e}, allowed {contestant.limit:.1e}"
        return result
    except Exception as error:  # noqa: BLE001
        row.failed = reason(error)
        return None


def compete(contestants, unit, repeats, patience=2.0, quiet=False):
    """Rows of one group. Runs alternate, because a shared machine is not equally busy all the time."""
    rows, ready, begun = [], [], time.perf_counter()
    for contestant in contestants:
        row = Row(contestant.name, contestant.unit or unit, limit=contestant.limit)
        rows.append(row)
        begin = time.perf_counter()
        try:
            run = contestant.prepare()
        except Exception as error:  # noqa: BLE001
            row.failed = reason(error)
            continue
        first = attempt(contestant, row, run)  # not counted: caches, lazy compilation
        if not row.failed:
            slow = first.seconds > patience
            ready.append((contestant, row, run, 2 if slow else repeats))
        if not quiet:
            print(f"    {row.name:40} ready in {time.perf_counter() - begin:5.1f} s {row.failed}", flush=True)
    for turn in range(repeats):
        for contestant, row, run, turns in ready:
            if turn < turns and not row.failed:
                result = attempt(contestant, row, run)
                if not row.failed:
                    row.rates.append(contestant.scale * result.work / result.seconds)
    print(f"    {time.perf_counter() - begun:.0f} s in all", flush=True)
    return rows
