"""Ctrl-C in a long call: answered at once, with the result so far."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import motiform

LONG = {
    "simulate": "motiform.preset('fig5b').simulate(1e7, dt_out=1e3, transient=0.0)",
    "transient": "motiform.preset('fig5b').simulate(1.0, transient=1e7)",
    "classify": "motiform.Cell(length=21.5).classify(budget=1e8)",
    "lyapunov": "motiform.preset('fig5b').lyapunov(6, t_end=1e7)",
    "equilibria": "motiform.preset('fig6a').equilibria(starts=100000)",
    "section": "motiform.preset('fig5b').section('y', 0.0, t_end=1e7)",
    "statistics": "motiform.Tensor(gamma=1, kappa2=2, kappa3=2).statistics(20000, t_end=20.0, noise=0.1)",
    "scan": "motiform.scan(motiform.preset('fig5b'), {'kappa2': '0.4:0.6:2000'}, samples=50)",
}

PROGRAM = """
import motiform, time, xarray
xarray.Dataset({{"first": ("x", [0])}})  # imports for up to a second, in which nothing is computed
print("ready", flush=True)
try:
    {call}
except KeyboardInterrupt as stop:
    print("stopped", time.time(), type(getattr(stop, "result", None)).__name__, flush=True)
else:
    print("done")
"""


def stopped(name: str, after: float) -> tuple[list[str], float]:
    """What a long call says that is interrupted after so many seconds, and when that was."""
    program = PROGRAM.format(call=LONG[name])
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None and process.stdout.readline() == "ready\n"
        time.sleep(after)
        pressed = time.time()
        process.send_signal(signal.SIGINT)
        return process.stdout.read().split(), pressed


@pytest.mark.parametrize("name", list(LONG))
def test_ctrl_c_is_answered(name: str) -> None:
    kinds = {"simulate": "Trajectory", "transient": "Trajectory", "statistics": "Statistics", "scan": "Dataset"}
    for after in (0.7, 3.0, 12.0):  # on a busy machine nothing may be there of which there is a result
        words, pressed = stopped(name, after)
        assert words and words[0] == "stopped", words
        print(f"{name}: {float(words[1]) - pressed:.3f} s")
        assert float(words[1]) - pressed < 5.0  # 0.2 s where nothing else runs; a machine may be busy
        if words[2] == kinds.get(name, "NoneType"):
            return
    raise AssertionError(words)


FIRST = """
import motiform, signal, sys
def press(event, arguments, names=[]):
    if event == "import" and not names:
        names.append(arguments[0])
        print("imports", names[0], flush=True)
        signal.raise_signal(signal.SIGINT)
sys.addaudithook(press)
try:
    motiform.scan(motiform.preset("fig5b"), {{'kappa2': '0.4:0.6:2000'}}, samples=50, out={out!r})
except motiform.Interrupted as stop:
    print("stopped", *stop.result.regime.shape, int((stop.result.regime < 0).sum()), flush=True)
"""


@pytest.mark.parametrize("out", [None, "line"])
def test_ctrl_c_at_the_first_scan_waits_for_its_imports(out: str | None, tmp_path: Path) -> None:
    program = FIRST.format(out=out)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, cwd=tmp_path)
    words = done.stdout.split()
    assert words[:1] + words[2:5] == ["imports", "stopped", "2000", "50"] and int(words[5]) > 0, done


def test_ctrl_c_is_not_lost_if_the_scan_is_over_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("motiform.scans._first_dataset", KeyboardInterrupt)
    with pytest.raises(motiform.Interrupted) as stopped:
        motiform.scan(motiform.Tensor(gamma=1.0), {"kappa2": [0.5]}, progress=False)
    assert stopped.value.result.regime.shape == (1, 1)
