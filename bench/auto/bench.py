"""Branches of the full tensor model at kappa3 = 0.1 by AUTO-07p and by motiform: special points and time per point.

python3 bench/auto/bench.py target/release/examples/branches
"""

import os
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

HERE = Path(__file__).parent
LIBRARY = Path("/usr/lib/auto-07p/lib")
KAPPA3 = 0.1
AGREE = 1e-7  # relative

EQUILIBRIA = dict(NDIM=5, IPS=1, IRS=0, ILP=1, ICP="[1]", NTST=20, NCOL=4, IAD=3, ISP=1, ISW=1, IPLT=0, NMX=400,
                  RL0=0.3, RL1=3.0, NPR=100000, ITMX=8, ITNW=5, NWTN=3, JAC=0, EPSL=1e-11, EPSU=1e-11, EPSS=1e-10,
                  DS=-0.01, DSMIN=1e-8, DSMAX=0.0324, IADS=1, MXBF=5)
ORBITS = dict(NDIM=5, IPS=2, IRS=0, ILP=1, ICP="[1, 11]", NTST=150, NCOL=4, IAD=3, ISP=2, ISW=1, IPLT=0, NMX=300,
              RL0=0.5, RL1=1.3, NPR=100000, ITMX=30, ITNW=5, NWTN=3, JAC=0, EPSL=1e-10, EPSU=1e-10, EPSS=1e-7,
              DS=0.01, DSMIN=1e-7, DSMAX=0.12, IADS=1, MXBF=0, PAR="{1: 0.9, 2: 0.1}", dat="'zigzag'")


def field(u, kappa2):
    r, w2, w3 = u[0], u[1] + 1j * u[2], u[3] + 1j * u[4]
    turning = 2.0 * w2.imag
    f2 = -kappa2 * w2 - 0.125 * r * r + 0.3 * r * w3 - 2j * turning * w2
    f3 = -KAPPA3 * w3 + 0.0125 * r**3 + 0.4 * r * w2 - 3j * turning * w3
    return [r * (1 - r * r + 2.0 * w2.real), f2.real, f2.imag, f3.real, f3.imag]


def zigzag(folder):
    """One period at kappa2 = 0.9, from a simulation: rows of time and state."""
    law = lambda t, u: field(u, 0.9)
    options = dict(method="DOP853", rtol=1e-11, atol=1e-13)
    settled = solve_ivp(law, (0, 3000), [0.5, 0.01, 0.02, 0.0, 0.01], **options).y[:, -1]
    section = lambda t, u: u[2]
    section.direction = 1.0
    path = solve_ivp(law, (0, 120), settled, events=section, dense_output=True, **options)
    begin, end = path.t_events[0][:2]
    times = np.linspace(begin, end, 401)
    np.savetxt(folder / "zigzag.dat", np.column_stack([times - begin, path.sol(times).T]), fmt="%.15e")


def auto(folder, name, constants):
    """One run of AUTO: special points as (type, parameter), number of points, seconds of CPU time."""
    text = "\n".join(f"{key} = {value}" for key, value in constants.items())
    (folder / "fort.2").write_text(text + "\n")
    (folder / "fort.3").write_text("")
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(["./tensor"], cwd=folder, check=True, capture_output=True)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    table = (folder / "fort.7").read_text()
    (HERE / "runs" / f"{name}.txt").write_text(table)
    rows = [line.split() for line in table.splitlines() if re.match(r"\s*[1-9-]", line)]
    kinds = {1: "branch point", 3: "Hopf", 6: "branch point", 7: "period doubling", 8: "torus"}
    special = [(kinds[abs(int(row[2]))], float(row[4])) for row in rows if abs(int(row[2])) in kinds]
    return special, rows, seconds


def build(folder):
    guess = fsolve(field, [1.0, -0.04, 0.0, 0.0, 0.0], args=(3.0,), xtol=1e-12)
    lines = ["par(1) = 3.0d0", f"par(2) = {KAPPA3}d0"]
    lines += [f"u({n + 1}) = {value:.17e}".replace("e-", "d-").replace("e+", "d+") for n, value in enumerate(guess)]
    (folder / "start.inc").write_text("\n".join(lines) + "\n")
    objects = [str(path) for path in sorted(LIBRARY.glob("*.o"))]
    subprocess.run(["gfortran", "-O3", "-fopenmp", "-I", str(folder), str(HERE / "tensor.f90"), *objects,
                    "-o", str(folder / "tensor")], check=True, cwd=folder)


def motiform(program):
    """The output of the example, and its seconds of CPU time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    text = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    (HERE / "runs" / "motiform.txt").write_text(text)
    return text, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def nearest(found, kind, value):
    return min((abs(at - value) / value, at) for name, at in found if name == kind)


def main():
    os.environ["OMP_NUM_THREADS"] = "1"
    (HERE / "runs").mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        build(folder)
        zigzag(folder)
        runs = {"equilibria": auto(folder, "equilibria", EQUILIBRIA),
                "zigzag up": auto(folder, "zigzag-up", ORBITS),
                "zigzag down": auto(folder, "zigzag-down", {**ORBITS, "DS": -0.01})}
    found = [entry for special, _, _ in runs.values() for entry in special]
    text, spent = motiform(sys.argv[1])
    points = sum(map(int, re.findall(r": (\d+) points in", text)))
    print("AUTO-07p:")
    for name, (special, rows, seconds) in runs.items():
        count = len(rows)
        print(f"  {name}: {count} points, {1e3 * seconds / count:.3f} ms each;", special)
    print(f"motiform (wall clock; {points} points in {spent:.2f} s of CPU time):")
    for line in re.findall(r"^\S.*points in.*$", text, re.MULTILINE):
        print("  " + line)
    names = {"Pitchfork": "branch point", "Hopf": "Hopf"}
    ours = re.findall(r"^  (\S+)  period \S+  unstable \d+  (Pitchfork|Hopf)", text, re.MULTILINE)
    ours = sorted({(round(float(value), 9), names[kind]) for value, kind in ours})
    for value, kind in ours:
        off, at = nearest(found, kind, value)
        print(f"  {kind}: {value:.9f}, AUTO {at:.9f}, relative difference {off:.1e}")
        assert off < AGREE, (kind, value, at)
    assert len(ours) == 2, ours
    period = float(re.search(r"zigzag at 0.9: period (\S+)", text)[1])
    theirs = float(runs["zigzag up"][1][0][-1])
    print(f"  period of the zigzag at 0.9: {period:.9f}, AUTO {theirs:.9f}, relative difference {abs(theirs / period - 1):.1e}")
    assert abs(theirs / period - 1) < AGREE


if __name__ == "__main__":
    main()
