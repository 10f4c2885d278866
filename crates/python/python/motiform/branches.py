"""Motions followed along a parameter, stable or not."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import pandas as pd

from . import plotting

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Branch:
    """One branch, in its order."""

    motion: str
    """The kind of motion that most of its points have."""
    form: str | None
    """The symmetry of a motion that repeats: mirror-zigzag, rotating-zigzag, ... (docs/regimes.md)."""
    points: pd.DataFrame
    """A row per point: the parameter, ``motion``, ``special``, ``stable``, ``unstable``, ``period``, ``turning_rate``,
    ``speed``, leading eigenvalue or multiplier, the state."""
    stable: tuple[tuple[float, float], ...]
    """Ranges of the parameter over which it is stable."""
    special: pd.DataFrame
    """Special points: ``kind``, the parameter and its ``error``, ``period``, ``criticality`` (``undecided`` with its reason), the leading
    ``coefficient`` of the ``normal_form`` (``l1``, ``quadratic`` or ``cubic``) with ``coefficient_error``, and the ``branch`` that begins there."""
    ends: tuple[str, ...]
    """Why it ended, in words: one end, or both."""
    origin: Mapping[str, Any]
    """What it was followed from."""

    def to_xarray(self) -> xr.Dataset:
        """The points along a dimension ``point``."""
        table: xr.Dataset = self.points.set_index("point").to_xarray()
        return table


@dataclass(frozen=True)
class Branches:
    """Branches in the order in which they were found; the first is the motion of the start."""

    along: str
    """The parameter."""
    branches: tuple[Branch, ...]
    points: pd.DataFrame
    """The points of all branches; the column ``branch`` says which."""
    complete: bool
    """Whether nothing was interrupted."""

    def __len__(self) -> int:
        return len(self.branches)

    def __getitem__(self, number: int) -> Branch:
        return self.branches[number]

    @property
    def special(self) -> pd.DataFrame:
        """The special points of all branches, those of branch ``on`` in its order."""
        tables = [branch.special.assign(on=number) for number, branch in enumerate(self.branches)]
        filled = [table for table in tables if len(table)]
        return pd.concat(filled, ignore_index=True) if filled else pd.DataFrame(columns=["kind", self.along])

    def plot(self, y: str = "speed", ax: Axes | None = None) -> Axes:
        """The bifurcation diagram: the size of the column `y` against the parameter."""
        return plotting.plot_branches(self, y, ax)

    def __repr__(self) -> str:
        motions = ", ".join(branch.motion for branch in self.branches)
        return f"<{len(self)} branches along {self.along}: {motions}>"


_READ: dict[str, Callable[[str], Any]] = {
    "motion": str, "form": str, "special": str, "kind": str, "codimension_2": str, "branch": int, "curve": int,
    "point": int, "unstable": int, "stable": lambda text: text == "1",
    "regime": str, "cell": int, "rows": int, "computed": lambda text: text == "1",
}


def _number(text: str) -> float:
    return float(text) if text else math.nan


def _points(table: bytes) -> pd.DataFrame:
    """The table of points with every digit; NaN where there is no number. (Readers of pandas round differently from version to version.)"""
    names, *rows = csv.reader(io.StringIO(table.decode()))
    columns = {name: [row[place] for row in rows] for place, name in enumerate(names)}
    return pd.DataFrame({name: [_READ.get(name, _number)(text) for text in column] for name, column in columns.items()})


def branches_of(text: str, table: bytes) -> Branches:
    """The branches of the native module's JSON and CSV."""
    raw = json.loads(text)
    points = _points(table)

    def branch(number: int, entry: dict[str, Any]) -> Branch:
        rows = points[points["branch"] == number].reset_index(drop=True)
        stable = tuple((low, high) for low, high in entry["stable"])
        special = pd.DataFrame(entry["special"])
        return Branch(
            entry["motion"], entry.get("form"), rows, stable, special, tuple(entry["ends"]), entry["origin"]
        )

    all_branches = tuple(branch(number, entry) for number, entry in enumerate(raw["branches"]))
    return Branches(raw["along"]["name"], all_branches, points, raw["complete"])
