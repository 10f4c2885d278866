"""Motions followed along a parameter, stable or not."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import pandas as pd

from . import plotting
from .equality import equal, hashed
from .units import Asked, Dimension, Units, chosen, factor, scaled, table_in

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Branch:
    """One branch, in its order."""

    __eq__, __hash__ = equal, hashed

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

    __eq__, __hash__ = equal, hashed

    along: str
    """The parameter."""
    branches: tuple[Branch, ...]
    points: pd.DataFrame
    """The points of all branches; the column ``branch`` says which."""
    complete: bool
    """Whether nothing was interrupted."""
    units: Units | None = None
    """What a unit of length and one of time are, if the study says it."""
    in_model_units: bool = True
    """Whether the tables are in model units: false of what :meth:`in_units` returns."""

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

    def in_units(self, units: Asked = True) -> Branches:
        """A copy with speeds, turning rates and periods in the units of the study, or in others (``"20um,1min"``), and so the rates and saddles
        of connections in `special`. Parameters, states, coefficients, amplitudes, and ``leading_re`` and ``leading_im`` of points, which are
        eigenvalues or multipliers, stay in model units."""
        if not self.in_model_units:
            raise ValueError(f"the branches are in {self.units} already")
        shown = chosen(units, self.units)
        made = tuple(
            replace(branch, points=table_in(branch.points, shown), special=_special_in(branch.special, shown))
            for branch in self.branches
        )
        points = table_in(self.points, shown)
        return replace(self, branches=made, points=points, units=shown, in_model_units=shown is None)

    def plot(self, y: str = "speed", ax: Axes | None = None, *, units: Asked = None) -> Axes:
        """The bifurcation diagram: the size of the column `y` against the parameter, in the units of the study, or in those that are given."""
        if not self.in_model_units:
            raise ValueError("plot the branches from which these were converted, with units")
        shown = self.units if units is None else chosen(units, self.units)
        return plotting.plot_branches(self.in_units(shown or False), y, ax)

    def __repr__(self) -> str:
        motions = ", ".join(branch.motion for branch in self.branches)
        return f"<{len(self)} branches along {self.along}: {motions}>"


_RATE: Dimension = (0, -1)
_OF_CONNECTIONS: dict[str, Dimension] = {
    "period_error": (0, 1), "rate": _RATE, "rate_error": _RATE, "frequency": _RATE, "saddle_quantity": _RATE, "saddle_quantity_error": _RATE,
    "leading_growing": _RATE, "leading_decaying": _RATE
}  # fmt: skip
_OF_SADDLES = {**_OF_CONNECTIONS, "eigenvalues": _RATE, "turning_rate": (0, -1, True), "speed": (1, -1)}


def _special_in(table: pd.DataFrame, units: Units | None) -> pd.DataFrame:
    """A copy of a table of special points in other units."""
    made = table_in(table, units)
    for name in (name for name in _OF_CONNECTIONS if name in table):
        by = factor(units, _OF_CONNECTIONS[name])
        made[name] = [scaled(value, by) for value in table[name]]
    for name in (name for name in ("saddle", "saddles") if name in table):
        made[name] = [_saddles_in(value, units) for value in table[name]]
    return made


def _saddles_in(value: Any, units: Units | None) -> Any:
    """A saddle, or a list of them; what is none is left as it is."""
    if isinstance(value, list):
        return [_saddles_in(saddle, units) for saddle in value]
    if not isinstance(value, Mapping):
        return value
    by = {name: factor(units, dimension) for name, dimension in _OF_SADDLES.items()}
    return {name: scaled(number, by[name]) if name in by else number for name, number in value.items()}


_READ: dict[str, Callable[[str], Any]] = {
    "motion": str, "form": str, "course": str, "special": str, "kind": str, "codimension_2": str, "branch": int, "curve": int,
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


def branches_of(text: str, table: bytes, units: Units | None = None) -> Branches:
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
    return Branches(raw["along"]["name"], all_branches, points, raw["complete"], units)
