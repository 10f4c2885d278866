"""Cells with their outlines and modes."""

from __future__ import annotations

import csv
import io
import json
import math
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np
import pandas as pd

from .. import _motiform
from ..calls import known_whole, raised_with
from ..equations import Amplitudes
from ..progress import Bar, Progress
from ..trajectory import Floats
from .results import CellFit, Found, Observation, Place, fit_of, observation_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


class Cells(Sequence["Cell"]):
    """Cells, by number and by name.

    >>> cells = motiform.cells.read("track.xml")
    >>> cells[0], cells["12"], cells.names, len(cells)
    """

    def __init__(self, native: _motiform.Sample) -> None:
        raw = json.loads(native.summary())
        self._native = native
        self.length_unit: str = raw["units"]["length"]
        """Unit of lengths; ``pixel`` where the scale is unknown."""
        self.time_unit: str = raw["units"]["time"]
        """Unit of times; ``frame`` where the interval is unknown."""
        self.y_down: bool | None = raw["y_down"]
        """Whether y points down, as in images; ``None`` where nobody says so."""
        self.notes: tuple[str, ...] = tuple(raw["notes"])
        """What was noticed about the data."""
        self._units = (self.length_unit, self.time_unit)
        self._cells = [Cell(self, entry) for entry in raw["cells"]]
        self._table: pd.DataFrame | None = None

    @property
    def names(self) -> list[str]:
        """The names of the cells, in the order of the files."""
        return [cell.name for cell in self._cells]

    @property
    def modes(self) -> pd.DataFrame:
        """The modes of all cells, a row per frame, with the columns of ``modes.parquet``."""
        return self._modes().copy()

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the outlines of all cells with all digits, in their units: ``.csv`` is a table with the columns cell, frame, i, x, y.

        An existing file is replaced. ``read(path, pixel_size=1, interval=...)`` reads it. One cell may also be written as the text of AmoePy
        (:meth:`Cell.write`).
        """
        self._native.write(self.names, os.fspath(path))

    def observe(self, *, progress: Progress = None) -> Found[Observation]:
        """How each cell moves, from its samples alone, by name; ``population`` has shares and numbers over cells. Ctrl-C raises ``Interrupted`` with those that are done."""
        return self._observe(self.names, progress)

    def fit(
        self,
        order: int = 3,
        *,
        modes: int = 3,
        draws: int = 160,
        seed: int = 1,
        simulations: int = 199,
        ladder: bool = False,
        threads: int | None = None,
        progress: Progress = None,
    ) -> Found[CellFit]:
        """The equations of each cell, by name; ``population`` has shares and coefficients over cells. The result does not depend on `threads`.

        Parameters
        ----------
        order
            Highest order of the terms, 1 to 5.
        modes
            Amplitudes of the model: 3 (velocity, z2, z3), or 4 with z4.
        draws
            Most models drawn from the estimate; the motion is named if 90 % of them share it. Fewer where the first ones decide, 23 at least.
        seed
            Seed of the draws and of the simulated cells.
        simulations
            Most cells simulated by each fit, to be compared with the observed one (``CellFit.simulated``); 0 for none. Of up to
            199 the first 99 where these leave no doubt.
        ladder
            Also compare models, from a persistent random walk on, by frames that their fits did not see (``CellFit.ladder``).

        Ctrl-C raises :class:`motiform.Interrupted` with the fits that are done.
        """
        known_whole(seed=seed, threads=threads)
        settings = (order, modes, draws, seed, simulations, ladder, threads or os.cpu_count() or 1)
        return self._fit(self.names, settings, progress)

    def _observe(self, names: list[str], progress: Progress) -> Found[Observation]:
        with Bar(progress, len(names), "cells") as bar:
            text, raised = self._native.observe(names, bar.callable())
        raw = json.loads(text)
        cells = {one["cell"]: observation_of(one, self._units) for one in raw["cells"]}
        found = Found(cells, raw.get("population", {}))
        if raised is not None:
            raise raised_with(raised, found)
        return found

    def _fit(
        self, names: list[str], settings: tuple[int, int, int, int, int, bool, int], progress: Progress
    ) -> Found[CellFit]:
        with Bar(progress, len(names), "cells") as bar:
            text, table, models, raised = self._native.fit(names, settings, bar.callable())
        rows, bodies = _frame(table), {name: Amplitudes._of(study) for name, study in models}
        raw = json.loads(text)
        found: Found[CellFit] = Found({}, raw.get("population", {}))
        for one in raw["cells"]:
            own = rows[rows["cell"] == one["cell"]].drop(columns="cell").reset_index(drop=True)
            found[one["cell"]] = fit_of(one, own, bodies.get(one["cell"]), self._units)
        if raised is not None:
            raise raised_with(raised, found)
        return found

    def _modes(self) -> pd.DataFrame:
        if self._table is None:
            self._table = _frame(self._native.modes())
        return self._table

    @overload
    def __getitem__(self, key: int | str) -> Cell: ...
    @overload
    def __getitem__(self, key: slice) -> list[Cell]: ...
    def __getitem__(self, key: int | str | slice) -> Cell | list[Cell]:
        if isinstance(key, str):
            for cell in self._cells:
                if cell.name == key:
                    return cell
            raise KeyError(f"{key!r}; the cells are {', '.join(self.names[:12])}")
        return self._cells[key]

    def __len__(self) -> int:
        return len(self._cells)

    def __iter__(self) -> Iterator[Cell]:
        return iter(self._cells)

    def __contains__(self, key: object) -> bool:
        return key in (self.names if isinstance(key, str) else self._cells)

    def __repr__(self) -> str:
        frames = sum(cell.frames for cell in self)
        return f"<{len(self)} cells, {frames} outlines; lengths in {self.length_unit}, times in {self.time_unit}>"


class Cell:
    """One tracked cell. (:class:`motiform.Cell` is the active cell, a model.)"""

    def __init__(self, cells: Cells, raw: Mapping[str, Any]) -> None:
        self._cells = cells
        self.name: str = raw["name"]
        """Its name in the file."""
        self.frames: int = raw["frames"]
        """Number of frames."""
        self.counting: int = raw["counting"]
        """Number of frames that count."""
        self.radius: float = raw["radius"]
        """Mean radius over these frames; 0 without any."""
        self.flags: dict[str, int] = raw["flags"]
        """How many frames have each flag of quality."""
        self.left_out: list[int] = raw["left_out"]
        """Numbers of the frames that do not count."""
        self.notes: tuple[str, ...] = tuple(raw["notes"])
        """What was noticed about this cell."""
        self._last: CellFit | None = None

    @property
    def modes(self) -> xr.Dataset:
        """Centre, mean radius, modes z2 to z5 with errors, area and flags along ``frame``; NaN where a frame has none.

        ``z2_re`` and ``z2_im`` are the parts of the complex z2; ``left_out`` says which frames do not count.
        """
        table = self._cells._modes()
        own = table[table["cell"] == self.name].drop(columns="cell")
        data: xr.Dataset = own.set_index("frame").to_xarray().set_coords("t")
        lengths = ["x", "y", "r0", "sigma", "z2_error", "z3_error"]
        for name in lengths + [f"z{n}_{part}" for n in range(2, 6) for part in ("re", "im")]:
            data[name].attrs["units"] = self._cells.length_unit
        data["area"].attrs["units"] = f"{self._cells.length_unit}^2"
        data["t"].attrs["units"] = self._cells.time_unit
        data.attrs["cell"] = self.name
        return data

    @property
    def outlines(self) -> list[tuple[float, Floats]]:
        """Time and vertices, (n, 2), of all frames."""
        return [(t, points) for _, t, points in self._cells._native.outlines(self.name)]

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes its outlines with all digits: ``.csv`` is a table (:meth:`Cells.write`), ``.txt`` the text of AmoePy, which needs um and s."""
        self._cells._native.write([self.name], os.fspath(path))

    def observe(self, *, progress: Progress = None) -> Observation:
        """How it moves, from its samples alone."""
        return self._cells._observe([self.name], progress)[self.name]

    def fit(
        self,
        order: int = 3,
        *,
        modes: int = 3,
        draws: int = 160,
        seed: int = 1,
        simulations: int = 199,
        ladder: bool = False,
        progress: Progress = None,
    ) -> CellFit:
        """The equations that describe it; :meth:`Cells.fit` explains the settings."""
        known_whole(seed=seed)
        settings = (order, modes, draws, seed, simulations, ladder, 1)
        found = self._cells._fit([self.name], settings, progress)[self.name]
        self._last = found
        return found

    def place(self, plane: str = "fig4") -> Place:
        """Where it lies on the plane of Fig. 4 (``"fig4"``) or of Fig. 1 (``"fig1"``), or why it has no place there.

        That of the last ``fit()``; without one, of a fit with its default settings.
        """
        if plane not in ("fig4", "fig1"):
            raise ValueError(f"plane = {plane!r}: give 'fig4' or 'fig1'")
        found = self._last or self.fit()
        return found.place if plane == "fig4" else found.place_reduced

    def plot(self, outlines: int = 12) -> Figure:
        """A film strip of `outlines` outlines at equal times, and the path below, both coloured by time."""
        from .drawing import plot_cell

        return plot_cell(self, outlines, (self._cells.length_unit, self._cells.time_unit), bool(self._cells.y_down))

    def __repr__(self) -> str:
        return f"<cell {self.name}: {self.counting} of {self.frames} frames count>"


_READ: dict[str, Callable[[str], Any]] = {
    "cell": str, "flags": str, "term": str, "frame": int, "left_out": lambda text: text == "1",
    "imaginary": lambda text: text == "1",
}  # fmt: skip


def _number(text: str) -> float:
    return float(text) if text else math.nan


def _frame(table: bytes) -> pd.DataFrame:
    """A table with every digit; NaN where there is no number."""
    names, *rows = csv.reader(io.StringIO(table.decode()))
    columns: dict[str, Any] = {}
    for place, name in enumerate(names):
        read = _READ.get(name, _number)
        values = [read(row[place]) for row in rows]
        columns[name] = values if read is str else np.array(values, dtype=None if values else float)
    return pd.DataFrame(columns)
