"""AUTO-07p on a problem: the branch of the start, what begins at its Hopf points, and the orbits that begin there, each once."""

import re
import resource
import subprocess
from math import ceil
from pathlib import Path

import numpy as np

from reference import Found

LIBRARY = Path("/usr/lib/auto-07p/lib")
KINDS = {1: "branch-point", 2: "fold", 3: "hopf", 5: "fold", 6: "branch-point", 7: "period-doubling", 8: "torus"}
ORBIT_KINDS = ("branch-point", "period-doubling")
COMMON = dict(IRS=0, ILP=1, NCOL=4, IAD=3, ISW=1, IPLT=0, NPR=100000, ITNW=5, NWTN=3, JAC=0, IADS=1)
STEADY = dict(COMMON, IPS=1, ICP="[1]", NTST=20, ISP=1, NMX=2000, ITMX=8, EPSL=1e-11, EPSU=1e-11, EPSS=1e-7, DSMIN=1e-8, MXBF=5)
ORBIT = dict(COMMON, IPS=2, ICP="[1, 11]", ISP=2, NMX=500, ITMX=30, EPSL=1e-10, EPSU=1e-10, EPSS=1e-7, DSMIN=1e-9, MXBF=0,
             UZSTOP="{11: 300.0}")
MOST_RUNS = 12

def build(source, folder):
    """Compiles a problem's equations with AUTO's object files, as `folder/auto`."""
    objects = [str(path) for path in sorted(LIBRARY.glob("*.o"))]
    subprocess.run(["gfortran", "-O3", "-fopenmp", "-I", str(folder), str(source), *objects, "-o", str(folder / "auto")],
                   check=True, cwd=folder)


def once(folder, constants):
    """One run: the rows of AUTO's table, its seconds of CPU time. The solutions stay in fort.8."""
    (folder / "fort.2").write_text("".join(f"{key} = {value}\n" for key, value in constants.items()))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(["./auto"], cwd=folder, check=True, capture_output=True)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    lines = (folder / "fort.7").read_text().splitlines()
    return [line.split() for line in lines if re.match(r"\s*[1-9-]", line)], seconds


def solutions(text):
    """The solutions of fort.8 by label: state at time 0, period (11th parameter)."""
    lines, found, at = text.splitlines(), {}, 0
    while at < len(lines):
        head = [int(word) for word in lines[at].split()]
        label, columns, rows, parameters = head[3], head[7], head[8], head[11]
        block = lines[at + 1:at + 1 + rows]
        state = [float(word) for word in " ".join(block).split()[1:columns]]
        tail = " ".join(block[-ceil(parameters / 7):]).split()
        found[label] = np.array(state), float(tail[10])
        at += 1 + rows
    return found


def special(rows, text, orbits):
    """The special points of a run, with their labels."""
    states, found = solutions(text), []
    for row in rows:
        kind = KINDS.get(abs(int(row[2])))
        if kind:
            state, period = states[int(row[3])]
            found.append((int(row[3]), Found(kind, float(row[4]), state, period if orbits else 0.0)))
    return found


class Tree:
    """All runs from one start, until no special point is left from which orbits begin.

    `found`: special points. `steady`: parameter and state of every equilibrium. `table`: the labelled rows (branch, point, type, label,
    parameter, norm, state or its maxima, period).
    """

    def __init__(self, folder, problem, mesh):
        low, high = problem.span
        size = high - low
        self.folder, self.points, self.seconds = folder, 0, 0.0
        self.found, self.steady, self.table = [], [], ""
        self.fixed = dict(NDIM=2 * len(problem.texts), RL0=low, RL1=high)
        self.steps = dict(DS=5e-3 * size, DSMAX=2e-2 * size)
        self.orbit_steps = dict(NTST=mesh, DS=1e-3 * size, DSMAX=0.2 * size)
        self.close = 1e-6 * size

    def known(self, point):
        return any(old.kind == point.kind and abs(old.value - point.value) < self.close
                   and abs(old.period - point.period) < 1e-3 * (1 + point.period) for old in self.found)

    def run(self, constants, orbits, sides):
        """Runs to these sides. Returns where orbits begin: label, special point, the solutions."""
        begins = []
        for sign in sides:
            rows, seconds = once(self.folder, {**constants, **self.fixed, "DS": sign * constants["DS"]})
            self.points += len(rows)
            self.seconds += seconds
            self.table += "".join(" ".join(row) + "\n" for row in rows if row[3] != "0")
            if not orbits:
                self.steady += [np.array([row[4], *row[6:6 + self.fixed["NDIM"]]], float) for row in rows]
            text = (self.folder / "fort.8").read_text()
            for label, point in special(rows, text, orbits):
                if not self.known(point) and (point.kind == "hopf" or orbits and point.kind in ORBIT_KINDS):
                    begins.append((label, point, text))
                self.found.append(point)
        return begins

    def follow(self, orbit=None):
        """From the start of the equations, or from the orbit in the file `orbit`.dat."""
        (self.folder / "fort.3").write_text("")
        first = {**ORBIT, **self.orbit_steps, "dat": f"'{orbit}'"} if orbit else {**STEADY, **self.steps}
        waiting = self.run(first, bool(orbit), (1, -1))
        for _ in range(MOST_RUNS):
            if not waiting:
                break
            label, point, text = waiting.pop(0)
            (self.folder / "fort.3").write_text(text)
            branch = {**ORBIT, **self.orbit_steps, "IRS": label, "ISW": 1 if point.kind == "hopf" else -1}
            waiting += self.run(branch, True, (1, -1) if point.kind == "branch-point" else (1,))
        return self
