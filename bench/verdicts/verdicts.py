"""Verdicts of motiform against long independent runs. `python3 bench/verdicts/verdicts.py --help`."""

import argparse
import json
import sys
from collections import Counter
from pathlib import Path

import programs
import samples
from judge import judge

CONFIDENT = 3.0
COLUMNS = ["agrees", "moved", "transient", "undecided", "contradicted", "weak"]
LIGHT = (300.0, 60000)  # a motion that needs more steps than these in this time is left out: naming it would take many minutes
SHOWN = 20  # contradictions printed
KICKS = [1e-6, 1e-6, 1e-4]


def confident(verdict):
    """Blow-up and a stay at an unstable shape have no margin, but are said without reserve."""
    if verdict["attractor"] in ("escape", "unstable"):
        return True
    return verdict["regime"] != "undetermined" and verdict.get("margin", 0.0) >= CONFIDENT


def name(verdict):
    """The row of the table."""
    return verdict["regime"] + (" (unstable)" if verdict["attractor"] == "unstable" else "")


def how_long(verdict, cap):
    """Several times what the decision took."""
    if verdict["attractor"] == "escape":
        return min(5.0 * verdict["escape_time"] + 10.0, cap)
    return min(max(10.0 * verdict["time"], 8000.0), cap)


def long_runs(program, cases, found, options, kick=0.0, seed=1):
    lines = [programs.long_line(case, how_long(verdict, options.cap), verdict.get("period", 0.0), kick, seed)
             for case, verdict in zip(cases, found)]
    return programs.ask(program, lines, options.jobs) if lines else []


def check(cases, found, long_run, options):
    """A status and a reason for each case. What disagrees is run again from starts moved a little: a start in an
    invariant subspace may be named after what it does or after what a typical start does."""
    results = [("weak", "") for _ in cases]
    sure = [i for i, verdict in enumerate(found) if confident(verdict)]
    runs = long_runs(long_run, [cases[i] for i in sure], [found[i] for i in sure], options)
    for i, run in zip(sure, runs):
        results[i] = judge(found[i], run)
    for seed, kick in enumerate(KICKS, 1):
        again = [i for i in sure if results[i][0] in ("contradicted", "undecided") and found[i]["attractor"] != "unstable"]
        runs = long_runs(long_run, [cases[i] for i in again], [found[i] for i in again], options, kick, seed)
        for i, run in zip(again, runs):
            status, reason = judge(found[i], run)
            if status in ("agrees", "transient"):
                results[i] = ("moved", f"{results[i][1]}; agrees from a start moved by {kick:g}")
    return results


def in_parts(title, cases, classifier, long_run, options):
    """The motions that were named, verdicts and results, a hundred at a time: what is done is said on standard error."""
    named, found, results = [], [], []
    for at in range(0, len(cases), 100):
        try:
            part = light(cases[at:at + 100], long_run, options)
            verdicts = programs.verdicts(classifier, part, options.jobs)
            checked = check(part, verdicts, long_run, options)
        except KeyboardInterrupt:
            print(f"{title}: interrupted after {len(found)} of {len(cases)}", file=sys.stderr)
            break
        named += part
        found += verdicts
        results += checked
        against = sum(status == "contradicted" for status, _ in results)
        print(f"{title}: {min(at + 100, len(cases))} of {len(cases)}, {against} contradicted", file=sys.stderr, flush=True)
    return named, found, results


def light(cases, long_run, options):
    """Those of the tensor model's motions that can be followed in reasonable time."""
    if cases[0]["model"] == "cell":
        return cases
    runs = programs.ask(long_run, [programs.long_line(case, LIGHT[0]) for case in cases], options.jobs)
    return [case for case, run in zip(cases, runs) if run["steps"] < LIGHT[1]]


def table(title, found, results):
    print(f"\n{title}\n{'':24}" + "".join(f"{column:>14}" for column in COLUMNS))
    for row in sorted({name(verdict) for verdict in found}):
        counts = Counter(result[0] for verdict, result in zip(found, results) if name(verdict) == row)
        print(f"{row:24}" + "".join(f"{counts[column]:14}" for column in COLUMNS))
    counts = Counter(result[0] for result in results)
    print(f"{'all':24}" + "".join(f"{counts[column]:14}" for column in COLUMNS), flush=True)
    return counts


def kept(case, verdict, result):
    fields = {key: verdict[key] for key in ("regime", "attractor", "form", "why", "margin", "period", "time") if key in verdict}
    return {**case, "status": result[0], "reason": result[1], "verdict": fields}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=14)
    parser.add_argument("--per-set", type=int, default=100, help="starts for each of the ten sets (default 100)")
    parser.add_argument("--points", type=int, default=2000, help="points of the 21-parameter space (default 2000)")
    parser.add_argument("--cells", type=int, choices=(0, 1), default=1, help="also the active cell at 28 lengths (default 1)")
    parser.add_argument("--cap", type=float, default=60000.0, help="longest run (model time)")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path, help="folder for the results (JSON lines of all that neither agrees nor is weak)")
    options = parser.parse_args()
    classifier, long_run = programs.build()
    contradicted, report = 0, []
    for title, cases in [("Invariant subspaces", list(samples.from_subspaces(options.seed, options.per_set))),
                         ("21 parameters", list(samples.anywhere(options.seed, options.points))),
                         ("Active cell", list(samples.cells(options.seed)) if options.cells else [])]:
        if not cases:
            continue
        cases, found, results = in_parts(title, cases, classifier, long_run[cases[0]["model"]], options)
        counts = table(f"{title}: {len(cases)} motions, seed {options.seed}", found, results)
        contradicted += counts["contradicted"]
        report += [kept(*row) for row in zip(cases, found, results) if row[2][0] not in ("agrees", "weak")]
    shown = [row for row in report if row["status"] == "contradicted"]
    for row in shown[:SHOWN]:
        print(f"\n{row['id']}: {row['verdict']['regime']} ({row['verdict']['why']})\n  long run: {row['reason']}")
    if len(shown) > SHOWN:
        print(f"\nand {len(shown) - SHOWN} more, see --out")
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
        with open(options.out / "open.jsonl", "w") as file:
            file.writelines(json.dumps(row) + "\n" for row in report)
    sys.exit(1 if contradicted else 0)


if __name__ == "__main__":
    main()
