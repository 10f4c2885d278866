"""The two programs: motiform's classifier and the long run, which share no line."""

import json
import os
import subprocess
import tempfile
from pathlib import Path

from samples import NAMES, STATE

HERE = Path(__file__).parent
RTOL = 1e-10
NICE = int(os.environ.get("VERDICTS_NICE", "10"))  # other people work on the machine


def build():
    """Compiles all; returns the path of the classifier and of the long runs' programs by model."""
    folder = Path(os.environ.get("CARGO_TARGET_DIR", HERE / "runner" / "target"))
    if os.environ.get("VERDICTS_BUILD", "1") != "0":
        subprocess.run(["cargo", "build", "--release", "--quiet"], cwd=HERE / "runner", check=True,
                       env={**os.environ, "CARGO_TARGET_DIR": str(folder)})
    programs = {"tensor": folder / "long_run", "cell": folder / "long_cell"}
    for program in programs.values():
        subprocess.run(["gcc", "-O3", "-march=native", "-fno-math-errno", "-fcx-limited-range", "-o", str(program),
                        str(HERE / "long_run" / f"{program.name}.c"), "-lm"], check=True)
    return folder / "release" / "motiform-verdicts", programs


def ask(program, lines, jobs):
    """Lines in, lines out, in order, with `jobs` processes."""
    parts = [lines[i::jobs] for i in range(jobs)]
    running = []
    gently = ["nice", "-n", str(NICE)]
    for part in parts:
        files = [tempfile.TemporaryFile("w+") for _ in range(2)]
        files[0].write("\n".join(part) + "\n")
        files[0].seek(0)
        running.append((subprocess.Popen([*gently, str(program)], stdin=files[0], stdout=files[1]), files[1]))
    answers = []
    try:
        for process, out in running:
            if process.wait():
                raise SystemExit(f"{program} failed")
            out.seek(0)
            answers.append(out.read().splitlines())
    finally:
        for process, _ in running:
            process.kill()  # those that still run, if this was interrupted
    return [json.loads(answers[i % jobs][i // jobs]) for i in range(len(lines))]


def verdicts(program, cases, jobs):
    """What motiform calls these motions."""
    lines = [json.dumps({key: case[key] for key in ("id", "model", "parameters", "start")}) for case in map(complete, cases)]
    answers = ask(program, lines, jobs)
    for answer in answers:
        if "error" in answer:
            raise SystemExit(f"{answer['id']}: {answer['error']}")
    return [answer["verdict"] for answer in answers]


def complete(case):
    """The tensor model has all its 21 parameters: what a case leaves out is 0, whatever motiform's default is."""
    if case["model"] == "cell":
        return case
    return {**case, "parameters": {name: case["parameters"].get(name, 0.0) for name in NAMES}}


def long_line(case, total, period=0.0, kick=0.0, seed=1):
    """A long run as its program reads it."""
    start = case["start"]
    if case["model"] == "cell":
        numbers = [case["parameters"]["length"], *(start.get(f"{wave}{n}", 0.0) for n in range(1, 22) for wave in "cs")]
    else:
        numbers = [RTOL, *complete(case)["parameters"].values(), *(start[name] for name in STATE)]
    return f"{case['id']} {total!r} {period!r} {kick!r} {seed} " + " ".join(map(repr, numbers))
