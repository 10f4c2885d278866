"""A plane of two parameters: which motions happen where, and by which bifurcation each begins or ends."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from . import _motiform, plotting
from .branches import _points
from .calls import real
from .equality import equal, hashed
from .units import Asked, Units, chosen, table_in

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Region:
    """Connected cells with the same motions."""

    __eq__, __hash__ = equal, hashed

    motions: tuple[str, ...]
    """Its motions: more than one where motions coexist."""
    share: float
    """Its share of the plane."""
    inside: Mapping[str, float]
    """The parameters of a cell in it, the one farthest from its border."""


@dataclass(frozen=True)
class Boundary:
    """All edges between cells with one set of motions and cells with another."""

    __eq__, __hash__ = equal, hashed

    between: tuple[tuple[str, ...], tuple[str, ...]]
    """The motions on both sides."""
    edges: int
    """How many pairs of neighbouring cells it parts."""
    kinds: Mapping[str, int]
    """The bifurcations on it, and on how many edges each lies."""
    unnamed: int
    """Edges on which none was found."""
    why: str | None
    """Why not all are named."""


@dataclass(frozen=True)
class Atlas:
    """Regions, boundaries and special points of a plane of two parameters."""

    __eq__, __hash__ = equal, hashed

    parameters: tuple[str, str]
    """The parameters, across and upwards."""
    regions: tuple[Region, ...]
    """The regions, the largest first."""
    boundaries: tuple[Boundary, ...]
    """The boundaries, the longest first."""
    special: pd.DataFrame
    """Points of codimension two on the curves, and connections in which motions end: ``kind``, ``motion``, the ``curve`` (-1 for an end), both parameters, ``period``."""
    cells: pd.DataFrame
    """A row per cell and motion: the parameters, ``regime``, the ``rows`` (initial states) that lead to it, ``computed``, and its numbers."""
    curves: pd.DataFrame
    """A row per point of each curve: ``curve``, ``kind``, ``motion``, ``codimension_2``, ``unstable``, both parameters, ``period``."""
    summary: Mapping[str, Any]
    """Everything that ``motiform atlas --json`` prints."""
    _native: _motiform.Atlas = field(compare=False)
    units: Units | None = None
    """What a unit of length and one of time are, if the study says it."""
    in_model_units: bool = True
    """Whether the tables are in model units: false of what :meth:`in_units` returns."""

    def in_units(self, units: Asked = True) -> Atlas:
        """A copy with the speeds, rates and times of its tables in the units of the study, or in others (``"20um,1min"``). Parameters and
        `summary` stay in model units."""
        if not self.in_model_units:
            raise ValueError(f"the atlas is in {self.units} already")
        shown = chosen(units, self.units)
        cells, curves, special = (table_in(table, shown) for table in (self.cells, self.curves, self.special))
        return replace(self, cells=cells, curves=curves, special=special, units=shown, in_model_units=shown is None)

    def grid(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.object_]]:
        """The values across, the values upwards, and the motions of each cell as text (``circular + zigzag``), upwards and across."""
        names = self.cells.groupby("cell")["regime"].agg(lambda motions: " + ".join(sorted(motions)))
        first = self.cells.drop_duplicates("cell").set_index("cell").sort_index()
        across, upwards = (np.unique(first[name].to_numpy(float)) for name in self.parameters)
        return across, upwards, names.sort_index().to_numpy(object).reshape(len(upwards), len(across))

    def figure(
        self, format: str = "svg", *, width: str | None = None, title: str | None = None, caption: bool = True
    ) -> bytes:
        """The figure of ``motiform atlas``: ``svg``, ``png`` or ``pdf``, or its numbers as ``csv``.

        `width` is that of the sheet, such as ``"86mm"`` or ``"slide"``.
        """
        drawn = self._native.figure(format, width, title, caption)
        if drawn is None:
            raise ValueError(f"format = {format!r}: give 'svg', 'png', 'pdf' or 'csv'")
        return drawn

    def save(
        self, path: str | os.PathLike[str], *, width: str | None = None, title: str | None = None, caption: bool = True
    ) -> None:
        """Writes :meth:`figure` to a file; its ending is the format."""
        path = Path(path)
        path.write_bytes(self.figure(path.suffix.removeprefix("."), width=width, title=title, caption=caption))

    def plot(self, ax: Axes | None = None) -> Axes:
        """The curves and special points over the motions of the cells."""
        return plotting.plot_atlas(self, ax)

    def _repr_svg_(self) -> str:
        return self.figure().decode()

    def __repr__(self) -> str:
        count = self.curves["curve"].nunique()
        over = " and ".join(self.parameters)
        return f"<atlas over {over}: {len(self.regions)} regions, {len(self.boundaries)} boundaries, {count} curves>"


def axis_text(name: str, values: Any) -> str:
    """An axis of a plane as the command line writes it."""
    if isinstance(values, str):
        return f"{name}={values}"
    parts = real(values, name).ravel()
    if len(parts) not in (2, 3):
        raise ValueError(f"{name} = {values!r}: give (low, high), (low, high, count), or text such as '0.1:1.6'")
    low, high = (repr(float(part)) for part in parts[:2])
    return ":".join([f"{name}={low}", high, *(str(int(part)) for part in parts[2:])])


def atlas_of(native: _motiform.Atlas, units: Units | None = None) -> Atlas:
    """The atlas of the native module's summary and tables."""
    raw = json.loads(native.summary())
    across, upwards = (side["name"] for side in raw["plane"])
    points = [
        {"kind": mark["kind"], "motion": curve["motion"], "curve": number, **mark["at"], "period": mark["period"]}
        for number, curve in enumerate(raw["curves"])
        for mark in curve["codimension_2"]
    ]
    points += [{"kind": end["kind"], "motion": end["motion"], "curve": -1, **end["at"]} for end in raw["ends"]]
    cells, curves = (_points(table) for table in native.tables())
    return Atlas(
        (across, upwards),
        tuple(Region(tuple(one["motions"]), one["share"], one["inside"]) for one in raw["regions"]),
        tuple(_boundary(one) for one in raw["boundaries"]),
        pd.DataFrame(points, columns=["kind", "motion", "curve", across, upwards, "period"]),
        cells,
        curves,
        raw,
        native,
        units,
    )


def _boundary(entry: dict[str, Any]) -> Boundary:
    one, other = (tuple(side) for side in entry["between"])
    kinds = {named["kind"]: named["edges"] for named in entry["kinds"]}
    return Boundary((one, other), entry["edges"], kinds, entry["unnamed"], entry["why"])
