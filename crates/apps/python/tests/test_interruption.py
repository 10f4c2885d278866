"""Ctrl-C in a long call: answered at once, with the result so far."""

from __future__ import annotations

import signal
import subprocess
import sys
import time

import pytest

LONG = {
    "simulate": "motiform.preset('fig5b').simulate(1e7, dt_out=1e3, transient=0.0)",
    "transient": "motiform.preset('fig5b').simulate(1.0, transient=1e7)",
    "classify": "motiform.Cell(length=21.5).classify(budget=1e8)",
    "lyapunov": "motiform.preset('fig5b').lyapunov(6, t_end=1e7)",
    "equilibria": "motiform.preset('fig6a').equilibria(starts=100000)",
    "section": "motiform.preset('fig5b').section('y', 0.0, t_end=1e7)",
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


@pytest.mark.parametrize("name", list(LONG))
def test_ctrl_c_is_answered(name: str) -> None:
    program = PROGRAM.format(call=LONG[name])
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None and process.stdout.readline() == "ready\n"
        time.sleep(0.7)
        pressed = time.time()
        process.send_signal(signal.SIGINT)
        words = process.stdout.read().split()
    assert words and words[0] == "stopped", words
    kinds = {"simulate": "Trajectory", "transient": "Trajectory", "scan": "Dataset"}
    assert words[2] == kinds.get(name, "NoneType")
    print(f"{name}: {float(words[1]) - pressed:.3f} s")
    assert float(words[1]) - pressed < 5.0  # 0.2 s where nothing else runs; a machine may be busy
