"""motiform on a problem: its command line, and the special points of the branches it writes."""

import json
import resource
import subprocess
from dataclasses import dataclass

import numpy as np
from problem import FOLDER

from reference import Found

KINDS = {"Fold": "fold", "BranchPoint": "branch-point", "PeriodDoubling": "period-doubling", "Hopf": "hopf", "Torus": "torus"}


def special(sample):
    """What motiform calls special about a point, or None."""
    point = sample["point"]
    name = point["special"]
    if not name:
        return None
    name = name if isinstance(name, str) else next(iter(name))
    motion = point["motion"]
    if "Equilibrium" in motion:
        return Found(KINDS.get(name, name.lower()), point["parameter"], np.array(motion["Equilibrium"]["shape"]))
    orbit = motion["Orbit"]["orbit"]
    return Found(KINDS.get(name, name.lower()), point["parameter"], np.array(orbit["shape"]), orbit["time"])


def steady(sample):
    """Parameter and state of an equilibrium, else nothing."""
    point = sample["point"]
    motion = point["motion"].get("Equilibrium")
    return [np.array([point["parameter"], *motion["shape"]])] if motion else []


@dataclass
class Followed:
    """What one run found: special points, parameter and state of equilibria, the number of points, what was printed."""

    found: list
    steady: list
    points: int
    printed: str


def follow(program, folder, name, options):
    """All branches from the start of the problem's file, and seconds of CPU time."""
    command = [program, "continue", str(FOLDER / f"{name}.toml"), *options, "--out", str(folder), "--force", "--no-figures"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    legs = [leg for branch in json.loads((folder / "branches.json").read_text())["branches"] for leg in branch["legs"]]
    samples = [sample for leg in legs for sample in leg["samples"]]
    ends = [leg["end"]["Homoclinic"] for leg in legs if "Homoclinic" in leg["end"]]
    found = [point for point in map(special, samples) if point]
    found += [Found("homoclinic", end["parameter"], None) for end in ends]
    return Followed(found, [point for sample in samples for point in steady(sample)], len(samples), printed), seconds
