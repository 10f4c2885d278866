"""A recorded motion."""

from __future__ import annotations

import json
import re
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from . import _motiform
from .equality import same
from .results import Outcome, outcome_of
from .units import Asked, Dimension, Units, chosen, factor, units_of
from .units import name as unit_name

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

Floats = npt.NDArray[np.float64]


def _unit(meaning: str) -> str:
    """The unit in brackets at the end of a meaning."""
    start, end = meaning.rfind("("), meaning.rfind(")")
    return meaning[start + 1 : end] if 0 <= start < end else ""


def _unpickled(manifest: str, table: Any, crossings: Any) -> Trajectory:
    return Trajectory(_motiform.Run.of(manifest, table, crossings))


class Trajectory:
    """A recorded motion: columns over time, in one block of memory.

    ``trajectory["s11"]`` and the properties below are views of that block if possible. All quantities are in
    model units of time and length; `units` of :meth:`to_pandas`, :meth:`to_xarray`, :meth:`values` and :meth:`plot` converts them.
    """

    def __init__(self, run: _motiform.Run) -> None:
        self._run = run
        self._block = run.block()

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self._run.manifest(), self._run.table(), self._run.crossings())

    @cached_property
    def _place(self) -> dict[str, int]:
        return {name: place for place, name in enumerate(self._run.table()[0])}

    @cached_property
    def _meanings(self) -> dict[str, str]:
        names, meanings, _ = self._run.table()
        return dict(zip(names, meanings, strict=True))

    @property
    def names(self) -> list[str]:
        """The columns."""
        return list(self._place)

    def meaning(self, name: str) -> str:
        """The meaning of a column, with its unit."""
        return self._meanings[name]

    @property
    def units(self) -> Units | None:
        """What a unit of length and one of time are, if the study says it."""
        return units_of(self.manifest["plan"].get("figure", {}).get("units", ""))

    def dimension(self, name: str) -> Dimension:
        """The powers of length and time in the unit of a column, and ``True`` for an angle.

        (1, -1) for a speed, (0, -1, True) for a turning rate.
        """
        return self._dimensions[name]

    @cached_property
    def _dimensions(self) -> dict[str, Dimension]:
        all_ = ((length, time, True) if angle else (length, time) for length, time, angle in self._run.dimensions())
        return dict(zip(self._place, all_, strict=True))

    def values(self, name: str, units: Asked = True) -> Floats:
        """A column in the units of the study, or in others (``"20um,1min"``); ``False``: those of the model."""
        return self[name] * factor(chosen(units, self.units), self.dimension(name))

    def __getitem__(self, name: str) -> Floats:
        try:
            column: Floats = self._block[self._place[name]]
        except KeyError:
            raise KeyError(f"no column {name!r}: the columns are {', '.join(self._place)}") from None
        return column

    def __len__(self) -> int:
        return int(self._block.shape[1])

    @property
    def t(self) -> Floats:
        """Times of the rows (model time), (rows,)."""
        return self["t"]

    @property
    def position(self) -> Floats:
        """Centre of mass (model length), (rows, 2); a view."""
        position: Floats = self._block[1:3].T
        return position

    @cached_property
    def velocity(self) -> Floats:
        """Velocity of the centre of mass (model length per model time), (rows, 2); a view for the tensor model."""
        if "v1" in self._place:
            first = self._place["v1"]
            return self._block[first : first + 2].T
        shapes = np.ascontiguousarray(self.shape)
        return self._flow.velocities(shapes)

    @property
    def shape(self) -> Floats:
        """The coordinates of the shape, (rows, coordinates); a view."""
        shape: Floats = self._block[3 : 3 + len(self.coordinates)].T
        return shape

    @cached_property
    def coordinates(self) -> list[str]:
        """Names of the shape's coordinates."""
        return list(self.manifest["state"])

    @property
    def S(self) -> Floats:
        """The tensor S_ij of the elliptic deformation (tensor model), (rows, 2, 2)."""
        a, b = self["s11"], self["s12"]
        return np.stack((np.stack((a, b), axis=-1), np.stack((b, -a), axis=-1)), axis=-2)

    @property
    def U(self) -> Floats:
        """The tensor U_ijk of the three-fold deformation (tensor model), (rows, 2, 2, 2)."""
        a, b = self["u111"], self["u222"]
        tensor = np.empty((len(self), 2, 2, 2))
        tensor[:, 0, 0, 0], tensor[:, 1, 1, 1] = a, b
        for place in ((0, 0, 1), (0, 1, 0), (1, 0, 0)):
            tensor[(slice(None), *place)] = -b
        for place in ((0, 1, 1), (1, 0, 1), (1, 1, 0)):
            tensor[(slice(None), *place)] = -a
        return tensor

    @property
    def modes(self) -> Floats:
        """The modes c_n, s_n of the cell's phi = sum c_n cos(k_n s) + s_n sin(k_n s), (rows, modes, 2); a view."""
        if "c1" not in self._place:
            raise AttributeError("the tensor model has no modes: see S and U")
        count = len(self.coordinates) // 2
        return self._block[3 : 3 + 2 * count].reshape(count, 2, len(self)).transpose(2, 0, 1)

    @cached_property
    def manifest(self) -> dict[str, Any]:
        """Provenance: the complete plan, its hash, how the run ended, the final state."""
        manifest: dict[str, Any] = json.loads(self._run.manifest())
        return manifest

    @cached_property
    def outcome(self) -> Outcome:
        """How the run ended."""
        return outcome_of(self.manifest["outcome"], self._run.complete, self._run.ended)

    @property
    def tolerances(self) -> dict[str, float]:
        """``rtol`` and ``atol`` of the run, or its fixed ``step``."""
        return dict(self.manifest["plan"]["computation"]["control"])

    @cached_property
    def regime(self) -> str | None:
        """The regime of the motion, if a short integration from the end of the run is conclusive; ``None`` under noise and for runs that
        ended early. :meth:`Model.classify` integrates for longer and gives the evidence."""
        return self._run.regime()

    @cached_property
    def crossings(self) -> pd.DataFrame | None:
        """The crossings of the return map's segment, if the study has one: ``t``, ``x``, ``y``, ``rising``."""
        found = self._run.crossings()
        return None if found is None else crossing_frame(*found)

    def to_pandas(self, units: Asked = False) -> pd.DataFrame:
        """A data frame of all columns; meanings in ``frame.attrs``, and the names of units where `units` are given.

        `units`: ``True`` for those of the study, others by their text (``"20um,1min"``).
        """
        shown = chosen(units, self.units)
        if shown is None:
            return _frame(self.names, [self._meanings[name] for name in self.names], self._block)
        block = self._block * np.array([[factor(shown, self.dimension(name))] for name in self.names])
        frame = _frame(self.names, [self._meaning_in(name, shown) for name in self.names], block)
        frame.attrs["units"] = {name: unit_name(shown, self.dimension(name)) for name in self.names}
        return frame

    def to_xarray(self, units: Asked = False) -> xr.Dataset:
        """A dataset over the dimension ``t``, with ``long_name`` and ``units``; `units` as for :meth:`to_pandas`."""
        import xarray as xr

        shown = chosen(units, self.units)

        def attrs(name: str) -> dict[str, str]:
            if shown is None:
                meaning = self._meanings[name]
                return {"long_name": meaning, "units": _unit(meaning)}
            return {"long_name": self._meaning_in(name, shown), "units": unit_name(shown, self.dimension(name))}

        columns = {name: self[name] if shown is None else self.values(name, shown) for name in self._place}
        variables = {name: ("t", columns[name], attrs(name)) for name in self._place if name != "t"}
        times = {"t": ("t", columns["t"], {"long_name": "time", "units": unit_name(shown, (0, 1))})}
        return xr.Dataset(variables, times, {"outcome": str(self.outcome), "plan_hash": self.manifest["plan_hash"]})

    def _meaning_in(self, name: str, units: Units) -> str:
        """The meaning of a column with its unit instead of that of the model."""
        if name == "t":
            return f"time ({unit_name(units, (0, 1))})"
        return re.sub(r"\([^()]*model [^()]*\)", f"({unit_name(units, self.dimension(name))})", self._meanings[name])

    @cached_property
    def radius(self) -> float:
        """Radius of the undeformed body (model length): that of the model, or a round number at which the deformation is visible."""
        return self._run.radius()

    def row(self, t: float) -> int:
        """The row nearest to a time."""
        times = self.t
        if not len(self) or not times[0] <= t <= times[-1]:
            span = f"the recording is from {times[0]:g} to {times[-1]:g}" if len(self) else "nothing is recorded"
            raise ValueError(f"t = {t}: {span}")
        after = int(np.searchsorted(times, t))
        return after - 1 if after and t - times[after - 1] <= times[min(after, len(self) - 1)] - t else after

    def outline(self, t: float, *, radius: float | None = None, scale: float = 1.0, points: int = 200) -> Floats | None:
        """The boundary in the plane at the recorded time nearest to `t`, (points, 2) in model lengths.

        `radius`, above 0, is that of the undeformed body (:attr:`radius`); `scale` enlarges the body about its centre. ``None``
        if the shape is not a closed curve.
        """
        if not isinstance(points, (int, np.integer)) or points < 3:
            raise ValueError(f"points = {points}: give a whole number of at least 3")
        if radius is not None and not 0.0 < radius < np.inf:
            raise ValueError(f"radius = {radius}: give a length above 0; by default it is {self.radius:g}")
        row = self.row(t)
        curve = self._run.outline(row, self.radius if radius is None else radius, points)
        return None if curve is None else scale * curve + self.position[row]

    def plot(self, ax: Axes | None = None, *, outlines: int = 12, units: Asked = None) -> Axes:
        """Plots the path, with `outlines` of the body along it, in the units of the study, or in those that are given."""
        from .plotting import plot_path

        return plot_path(self, ax, outlines, self._drawn(units))

    def animate(self, *, frames: int = 120, interval: float = 40.0, units: Asked = None) -> FuncAnimation:
        """An animation of the moving body; in a notebook show it with ``HTML(film.to_jshtml())``. `interval` in ms."""
        from .plotting import animate

        return animate(self, frames, interval, self._drawn(units))

    def _drawn(self, units: Asked) -> Units | None:
        return self.units if units is None else chosen(units, self.units)

    @cached_property
    def _flow(self) -> _motiform.Flow:
        computation = self.manifest["plan"]["computation"]
        study = _motiform.Study.of_model(computation["model"])
        return _motiform.Flow(study.with_(parameters=computation["parameters"]))

    def __eq__(self, other: object) -> bool:
        """The same plan, the same end, and the same numbers, NaN equal to NaN."""
        if not isinstance(other, Trajectory):
            return NotImplemented
        if (self.manifest["plan_hash"], self.names, self.outcome) != (other.manifest["plan_hash"], other.names, other.outcome):
            return False
        return same(self._block, other._block) and same(self.crossings, other.crossings)

    def __hash__(self) -> int:
        return hash(self.manifest["plan_hash"])

    def __repr__(self) -> str:
        return f"<Trajectory: {len(self)} rows of {', '.join(self._place)}; {self._run.ended}>"


def crossing_frame(names: list[str], meanings: list[str], block: Floats) -> pd.DataFrame:
    """A frame of crossings; ``rising`` is true or false."""
    frame = _frame(names, meanings, block)
    return frame.assign(rising=frame["rising"] == 1.0)


def _frame(names: list[str], meanings: list[str], block: Floats) -> pd.DataFrame:
    frame = pd.DataFrame(block.T, columns=names, copy=False)
    frame.attrs["meanings"] = dict(zip(names, meanings, strict=True))
    return frame
