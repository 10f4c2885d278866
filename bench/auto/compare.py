"""AUTO-07p and motiform on the problems of the folder `problems`, in one run: values, points missed or invented, CPU time per point.

python bench/auto/compare.py target/release/motiform [case ...]
"""

import os
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import auto
import numpy as np
import ours
from problem import problem

import reference
from reference import Found

RUNS = Path(__file__).parent / "runs"
SAME = 1e-4  # of the range: two reports of one point
SOLVED = ("fold", "hopf")  # of equilibria
LEAST = 0.5  # seconds of CPU time that a short case is repeated for


@dataclass
class Case:
    """A problem and its start: an equilibrium next to `guess`, or an orbit on which the simulation from there settles.

    `mesh`: AUTO's intervals for orbits.
    """

    name: str
    guess: list
    problem: str = ""
    changed: dict = field(default_factory=dict)
    options: list = field(default_factory=list)
    orbit: bool = False
    mesh: int = 100


CASES = [
    Case("cusp", [1.2, 0]),
    Case("transcrit", [0, 0]),
    Case("transcrit-above", [0.5, 0], "transcrit", {"mu": 0.5}, ["--initial", "v1=0.3"]),
    Case("lv", [0.5, 0.5]),
    Case("lv-above", [1, 0], "lv", {"d": 1.2}, ["--initial", "v1=0.9", "--initial", "v2=-0.1"]),
    Case("isola", [1.5, 0]),
    Case("snic", [0.7, 0.7], "", {"mu": 0.7}),
    Case("snic-orbit", [1, 0], "snic", orbit=True),
    Case("lor84", [0.9, 0.3, 0.3, 0]),
    Case("fhn", [-1.2, -0.6]),
    Case("lorenz", [7, 7, 19, 0]),
    Case("rossler", [1, 1, 0, 0], orbit=True, mesh=400),
]


def cpu(work):
    """The work's answer and its seconds of CPU time, as the mean over repetitions of a short one."""
    answer, seconds = work()
    total, count = seconds, 1
    while total < LEAST and count < 20:
        total += work()[1]
        count += 1
    return answer, total / count


def by_auto(case, model, folder):
    start = np.array(case.guess, float)
    value = model.parameters[model.along]
    if case.orbit:
        rows = reference.settled(model, value, start)
        np.savetxt(folder / "start.dat", rows, fmt="%.15e")
        start = rows[0, 1:]
    else:
        start = reference.equilibrium(model, start, value)
    (folder / "auto.f90").write_text(model.fortran(start))
    auto.build(folder / "auto.f90", folder)

    def work():
        tree = auto.Tree(folder, model, case.mesh).follow("start" if case.orbit else None)
        return tree, tree.seconds

    tree, seconds = cpu(work)
    (RUNS / f"{case.name}-auto.txt").write_text(tree.table)
    return tree, seconds


def by_motiform(program, case, folder):
    options = [word for key, value in case.changed.items() for word in ("--set", f"{key}={value}")] + case.options

    followed, seconds = cpu(lambda: ours.follow(program, folder / "ours", case.problem or case.name, options))
    (RUNS / f"{case.name}-motiform.txt").write_text(followed.printed)
    return followed, seconds


def nearest(found, kind, value, close):
    """The report of this kind that is closest to a value, if it is close."""
    reports = [point for point in found if point.kind == kind and abs(point.value - value) < close]
    return min(reports, key=lambda point: abs(point.value - value), default=None)


def truths(case, model, found, close):
    """Points that exist (known ones, and others that SciPy finds next to a report), and reports beside which there is none.

    A report beside a known point of another kind is neither: the point's row shows the name.
    """
    known = reference.KNOWN.get(case.name, reference.KNOWN.get(model.name, []))
    true, invented = [Found(kind, value, None) for kind, value in known], []
    for point in found:
        if nearest(true + invented, point.kind, point.value, close) or any(abs(point.value - value) < close for _, value in known):
            continue
        value = reference.solved(model, point) if point.kind in SOLVED and not point.period else None
        if value is None:
            invented.append(point)
        else:
            true.append(Found(point.kind, value, None))
    return sorted(true, key=lambda point: point.value), invented


def cell(found, point, close):
    """What a program says of a point that exists."""
    report = nearest(found, point.kind, point.value, close)
    if report:
        return f"{report.value:.9f} ({report.value - point.value:+.0e})"
    other = next((report for report in found if abs(report.value - point.value) < close), None)
    return f"{other.value:.9f}, named {other.kind}" if other else "missed"


def visits(steady, place, model):
    """Whether a branch passes a known equilibrium, within twice the longest step."""
    size = np.array([model.span[1] - model.span[0], *(1 + np.abs(place[1:]))])
    return any((np.abs(point - place) < 0.05 * size).all() for point in steady)


def rows(case, model, theirs, mine):
    """Lines of the table: points that exist, reports beside which there is none, and branches that are missed."""
    close = SAME * (model.span[1] - model.span[0])
    true, invented = truths(case, model, mine.found + theirs.found, close)
    for point in true:
        yield [case.name, point.kind, f"{point.value:.9f}", *(cell(run.found, point, close) for run in (theirs, mine))]
    for point in invented:
        reports = [nearest(run.found, point.kind, point.value, close) for run in (theirs, mine)]
        yield [case.name, point.kind, "none", *(f"{report.value:.9f}: invented" if report else "" for report in reports)]
    for place in () if case.orbit else reference.VISITS.get(model.name, ()):
        followed = [visits(run.steady, np.array(place), model) for run in (theirs, mine)]
        if not all(followed):
            where = "branch through " + ", ".join(f"{number:.3g}" for number in place)
            yield [case.name, where, "", *("followed" if well else "missed" for well in followed)]


def table(heads, lines):
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in [heads, ["---"] * len(heads), *lines]) + "\n"


def times(case, theirs, auto_seconds, mine, seconds):
    each = 1e3 * auto_seconds / theirs.points, 1e3 * seconds / mine.points
    return [case.name, theirs.points, f"{auto_seconds:.3f}", f"{each[0]:.3f}", mine.points, f"{seconds:.3f}", f"{each[1]:.3f}",
            f"{each[1] / each[0]:.1f}", f"{seconds / auto_seconds:.1f}"]


def main():
    program, chosen = str(Path(sys.argv[1]).resolve()), sys.argv[2:]
    os.environ["OMP_NUM_THREADS"] = "1"
    RUNS.mkdir(exist_ok=True)
    found, spent = [], []
    for case in CASES:
        if chosen and case.name not in chosen:
            continue
        model = problem(case.problem or case.name, **case.changed)
        with tempfile.TemporaryDirectory() as name:
            theirs, auto_seconds = by_auto(case, model, Path(name))
            mine, seconds = by_motiform(program, case, Path(name))
        found += rows(case, model, theirs, mine)
        spent.append(times(case, theirs, auto_seconds, mine, seconds))
    text = table(["case", "kind", "true", "AUTO-07p", "motiform"], found) + "\n" + table(
        ["case", "AUTO points", "s", "ms each", "motiform points", "s", "ms each", "ratio each", "ratio of all"], spent)
    print(text)
    if not chosen:
        (RUNS / "table.md").write_text(text)


if __name__ == "__main__":
    main()
