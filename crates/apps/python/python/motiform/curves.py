"""Special points followed over two parameters."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import pandas as pd

from . import plotting
from .branches import _points
from .equality import equal, hashed
from .units import Asked, Units, chosen, table_in

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Curve:
    """One curve, from one end to the other."""

    __eq__, __hash__ = equal, hashed

    kind: str
    """What is critical along it: hopf, fold, pitchfork, symmetry-breaking, period-doubling, torus."""
    points: pd.DataFrame
    """A row per point: both parameters, ``codimension_2``, ``unstable``, ``period``, the critical eigenvalue or multiplier,
    ``first_lyapunov`` and its error, what certifies it (``residual``, ``transversality``), the state."""
    codimension_2: pd.DataFrame
    """Points of codimension two: ``kind`` and both parameters."""
    not_found: tuple[str, ...]
    """Kinds of points of codimension two that were looked for and not found."""
    ends: tuple[str, ...]
    """Why it ended, in words: both ends, or one if it is closed."""
    start: Mapping[str, float]
    """The special point of a branch where it was begun."""


@dataclass(frozen=True)
class Curves:
    """Curves in the order in which they were found."""

    __eq__, __hash__ = equal, hashed

    parameters: tuple[str, str]
    """The parameters, across and upwards."""
    curves: tuple[Curve, ...]
    points: pd.DataFrame
    """The points of all curves; the column ``curve`` says which."""
    complete: bool
    """Whether nothing was interrupted."""
    units: Units | None = None
    """What a unit of length and one of time are, if the study says it."""
    in_model_units: bool = True
    """Whether the tables are in model units: false of what :meth:`in_units` returns."""

    def __len__(self) -> int:
        return len(self.curves)

    def __getitem__(self, number: int) -> Curve:
        return self.curves[number]

    @property
    def codimension_2(self) -> pd.DataFrame:
        """The points of codimension two of all curves, those of curve ``on`` in its order."""
        tables = [curve.codimension_2.assign(on=number) for number, curve in enumerate(self.curves)]
        filled = [table for table in tables if len(table)]
        return pd.concat(filled, ignore_index=True) if filled else pd.DataFrame(columns=["kind", *self.parameters])

    def in_units(self, units: Asked = True) -> Curves:
        """A copy with periods in the units of the study, or in others (``"20um,1min"``). Parameters, states, eigenvalues and coefficients
        stay in model units."""
        if not self.in_model_units:
            raise ValueError(f"the curves are in {self.units} already")
        shown = chosen(units, self.units)
        made = tuple(
            replace(curve, points=table_in(curve.points, shown), codimension_2=table_in(curve.codimension_2, shown))
            for curve in self.curves
        )
        points = table_in(self.points, shown)
        return replace(self, curves=made, points=points, units=shown, in_model_units=shown is None)

    def plot(self, ax: Axes | None = None) -> Axes:
        """The curves in their plane, on the axes of a diagram of regimes if that is given as `ax`."""
        return plotting.plot_curves(self, ax)

    def __repr__(self) -> str:
        kinds = ", ".join(curve.kind for curve in self.curves) or "none"
        return f"<{len(self)} curves over {' and '.join(self.parameters)}: {kinds}>"


def curves_of(text: str, table: bytes, units: Units | None = None) -> Curves:
    """The curves of the native module's JSON and CSV."""
    raw = json.loads(text)
    points = _points(table)

    def curve(number: int, entry: dict[str, Any]) -> Curve:
        rows = points[points["curve"] == number].reset_index(drop=True)
        codimension_2 = pd.DataFrame(entry["codimension_2"])
        return Curve(
            entry["kind"], rows, codimension_2, tuple(entry["not_found"]), tuple(entry["ends"]), entry.get("start", {})
        )

    across, upwards = (side["name"] for side in raw["in"])
    curves = tuple(curve(number, entry) for number, entry in enumerate(raw["curves"]))
    return Curves((across, upwards), curves, points, raw["complete"], units)
