"""Programs that are run from the command line and answer with one JSON object."""

import json
import os
import shlex
import subprocess

import numpy as np

import workload as w
from environment import HERE
from harness import Run, reason


class Failed(Exception):
    pass


def call(command, limit=300):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=limit)
    if done.returncode:
        raise Failed((done.stderr.strip() or f"exit {done.returncode}").splitlines()[-1])
    return json.loads(done.stdout)


def answer(command):
    found = call(command)
    check = found.get("check")
    return Run(found["seconds"], found["work"], None if check is None else np.array(check, dtype=float))


def cargo_binary(manifest, flags=""):
    """The program that `cargo build --release` makes of a manifest, with compiler flags where given."""
    command = ["cargo", "build", "--release", "--manifest-path", str(manifest), "--message-format=json-render-diagnostics"]
    if not manifest.exists():
        raise Failed(f"no {manifest.relative_to(HERE)}")
    environment = {**os.environ, "RUSTFLAGS": flags} if flags else None
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    if done.returncode:
        raise Failed(done.stderr.strip().splitlines()[-1])
    found = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    return [entry["executable"] for entry in found if entry.get("executable")][-1]


_built = {}


def built(name, build):
    """Build once; a failure is told to every row that needs the program."""
    if name not in _built:
        try:
            _built[name] = build()
        except Exception as error:  # noqa: BLE001
            _built[name] = Failed(f"{name} cannot be built: {reason(error)}")
    if isinstance(_built[name], Exception):
        raise _built[name]
    return _built[name]


def rust(n, t, rtol):
    """The crate differential-equations, DOP853."""
    program = built("rivals-rust", lambda: cargo_binary(HERE / "rivals-rust" / "Cargo.toml", "-C target-cpu=native"))
    numbers = [n, t, rtol, rtol * 1e-2, *w.COEFFICIENTS, *w.KAPPA2, *w.BASE]
    return lambda: answer([program, *numbers])


def motiform(task, **keys):
    """motiform's runner, or the command in $MOTIFORM_BENCH."""
    given = os.environ.get("MOTIFORM_BENCH")
    build = lambda: shlex.split(given) if given else [cargo_binary(HERE / "runner" / "Cargo.toml")]  # noqa: E731
    command = [*built("motiform", build), task, *(f"{key}={value}" for key, value in keys.items())]
    return lambda: answer(command)
