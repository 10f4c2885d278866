"""CPU time of motiform where a limit is set: 300 points of the zigzag, curves of folds of cycles, 100 steady motions of the cell.

python bench/auto/limits.py target/release/motiform
"""

import json
import resource
import subprocess
import sys
from pathlib import Path

PROBLEMS = Path(__file__).parent / "problems"
ZIGZAG = ("tensor --preset fig4 --set kappa3=0.1 --set kappa2=0.9 --motion zigzag --along kappa2=0.3:1.6 --branches 1 "
          "--branch-step 0.0035 --points 150")
CELL = "cell --set length=9 --motion straight --along length=6:13 --branches 1 --points 100"
CURVES = {"bautin": "mu,a=0.5:2", "fhn": "I=0:2,e=0.07:0.2"}


def follow(words):
    """The summary, and seconds of CPU time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    printed = subprocess.run([sys.argv[1], "continue", *words, "--json"], check=True, capture_output=True, text=True).stdout
    return json.loads(printed), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def report(name, points, seconds):
    print(f"| {name} | {points} | {seconds:.2f} | {1e3 * seconds / points:.1f} |", flush=True)


def main():
    print("| | points | s | ms each |\n| --- | --- | --- | --- |")
    for name, words in (("zigzag, with its start", ZIGZAG), ("cell, with its start", CELL)):
        summary, seconds = follow(words.split())
        report(name, sum(branch["points"] for branch in summary["branches"]), seconds)
    for name, plane in CURVES.items():
        words = [str(PROBLEMS / f"{name}.toml")]
        _, branches = follow(words)
        summary, seconds = follow([*words, "--curve", "fold", "--in", plane])
        report(f"folds of cycles, {name}, without the branches", sum(curve["points"] for curve in summary["curves"]), seconds - branches)


if __name__ == "__main__":
    main()
