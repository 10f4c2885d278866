"""What Python adds to a run, and how soon Ctrl-C is answered: `python bench/python/overhead.py`.

The run alone is timed inside the native module, without Python; both in turn, many rounds. Asserts that the results are
right, and never a time. The goal is below 20 us for a short orbit of the tensor model. What a run of the cell takes more
is native, too: its model is built a second time, for outlines.
"""

from __future__ import annotations

import argparse
import signal
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import motiform
from motiform import _motiform

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "crates/apps/python/tests"))
from test_interruption import LONG, PROGRAM  # noqa: E402

COUNT = 200  # runs in a row, per round


def seconds(call: Callable[[], object]) -> float:
    begun = time.perf_counter()
    for _ in range(COUNT):
        call()
    return (time.perf_counter() - begun) / COUNT


def orbits() -> dict[str, tuple[motiform.Model, dict[str, float]]]:
    """Short runs: settings in the body, and given to the call."""
    tensor = motiform.preset("fig5a").replace(t_end=1.0, transient=0.0, dt_out=0.1)
    cell = motiform.preset("fig6a").replace(t_end=1.0, transient=0.0, dt_out=0.5)
    return {
        "tensor, 11 rows": (tensor, {}),
        "tensor, 11 rows, settings in the call": (tensor.replace(t_end=2.0), {"t_end": 1.0, "transient": 0.0, "dt_out": 0.1}),
        "cell, 3 rows": (cell, {}),
    }


def overhead(rounds: int) -> None:
    print(f"| a short run, {rounds} rounds of {COUNT} | native, least (us) | Python, least (us) | difference, least | difference, median |")
    print("| --- | --- | --- | --- | --- |")
    for name, (body, settings) in orbits().items():
        same = body.replace(**settings)
        run = body.simulate(**settings)
        assert run.outcome.complete and np.array_equal(run._block, same.simulate()._block)
        native, python = [], []
        for _ in range(rounds):
            native.append(_motiform.seconds_of_run(same._study, COUNT))
            python.append(seconds(lambda: body.simulate(**settings)))
        least = min(python) - min(native)
        median = statistics.median(p - n for p, n in zip(python, native, strict=True))
        print(f"| {name} | {1e6 * min(native):.1f} | {1e6 * min(python):.1f} | {1e6 * least:.1f} | {1e6 * median:.1f} |")


def latency(rounds: int) -> None:
    print(f"\n| Ctrl-C during, {rounds} rounds | least (ms) | median (ms) | largest (ms) |")
    print("| --- | --- | --- | --- |")
    for name, call in LONG.items():
        waits = []
        for _ in range(rounds):
            with subprocess.Popen([sys.executable, "-c", PROGRAM.format(call=call)], stdout=subprocess.PIPE, text=True) as process:
                assert process.stdout is not None and process.stdout.readline() == "ready\n"
                time.sleep(0.7)
                pressed = time.time()
                process.send_signal(signal.SIGINT)
                words = process.stdout.read().split()
            assert words and words[0] == "stopped", (name, words)
            waits.append(float(words[1]) - pressed)
        print(f"| {name} | {1e3 * min(waits):.0f} | {1e3 * statistics.median(waits):.0f} | {1e3 * max(waits):.0f} |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--presses", type=int, default=3)
    options = parser.parse_args()
    overhead(options.rounds)
    latency(options.presses)


if __name__ == "__main__":
    main()
