"""What is measured on tracks of many bodies."""

from __future__ import annotations

import csv
import io
import json
import math
import os
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any

import pandas as pd

from . import _motiform, plotting
from .calls import left_out, paths_of, real
from .equality import equal, hashed
from .units import Asked, Units, chosen, converted, dimensions, factor

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

Threshold = str | tuple[str, float] | None
"""The quantity of residence times (``"speed"`` or a mode), and its threshold: the median, if only the quantity is given."""


@dataclass(frozen=True)
class Measured:
    """A number with its 95 % interval, or the reason why there is none."""

    __eq__, __hash__ = equal, hashed

    value: float
    """The number; NaN if it is not known."""
    lower: float
    """Lower end of the interval; NaN if there is none."""
    upper: float
    """Upper end."""
    reason: str = ""
    """Why the number is not known; empty if it is."""

    @property
    def known(self) -> bool:
        """Whether there is a number."""
        return not self.reason

    def __float__(self) -> float:
        return self.value

    def __str__(self) -> str:
        return f"unknown: {self.reason}" if self.reason else f"{self.value:.5g} ({self.lower:.5g} to {self.upper:.5g})"


@dataclass(frozen=True)
class Statistics:
    """Statistics of many bodies. Definitions and formulas: docs/statistics.md."""

    __eq__, __hash__ = equal, hashed

    bodies: int
    """Bodies that were measured."""
    complete: bool
    """Whether none was left out because of an interruption; ``summary["notes"]`` says which were left out because they ended early."""
    mean_speed: Measured
    """Mean speed."""
    persistence: Measured
    """Persistence time of the persistent random walk fitted to the mean-square displacement."""
    walk_speed: Measured
    """Its speed."""
    diffusion: Measured
    """Its diffusion coefficient."""
    late_diffusion: Measured
    """Diffusion coefficient from the slope of the mean-square displacement, whatever the motion."""
    green_kubo: Measured
    """Diffusion coefficient from the correlation of the velocity."""
    correlation_times: Mapping[str, Measured]
    """Integral correlation times by quantity; of one that oscillates, ``summary["autocorrelations"]`` has frequency and decay."""
    msd: pd.DataFrame
    """``lag``, ``msd``, ``lower``, ``upper``, ``exponent`` with its interval, ``fit``, ``windows``."""
    autocorrelations: pd.DataFrame
    """``quantity``, ``lag``, ``correlation``, ``lower``, ``upper``."""
    distributions: pd.DataFrame
    """``quantity`` (speed, turning_angle), ``lag``, bin edges ``from`` and ``to``, ``count``, ``density``, ``lower``, ``upper``."""
    spectra: pd.DataFrame
    """``quantity``, ``frequency``, ``power``, ``lower``, ``upper``."""
    first_passage: pd.DataFrame
    """``radius``, ``mean``, ``lower``, ``upper``, ``restricted``, ``limit``, ``censored``, ``starts``."""
    summary: Mapping[str, Any]
    """Everything that is not a curve, as ``motiform statistics --json`` prints it: in model units."""
    units: Units | None = None
    """What a unit of length and one of time are, if the study says it."""
    in_model_units: bool = True
    """Whether numbers and tables are in model units: false of what :meth:`in_units` returns."""
    doubt: str | None = None
    """Why the records are not those of a stationary motion, or the diffusion coefficients may not be those of long times; ``None`` where
    nothing says so."""

    def to_xarray(self) -> xr.Dataset:
        """Displacements along ``lag``, and the correlations of each quantity along ``time_lag``."""
        named = self.msd.rename(columns={"lower": "msd_lower", "upper": "msd_upper"})
        displacements: xr.Dataset = named.set_index("lag").to_xarray()
        table = self.autocorrelations.pivot(index="lag", columns="quantity", values="correlation")
        table = table.rename_axis(index="time_lag").stack().rename("correlation")
        return displacements.merge(table.to_frame().to_xarray())

    def in_units(self, units: Asked = True) -> Statistics:
        """A copy with numbers and tables in the units of the study, or in others (``"20um,1min"``). `summary` and the powers of spectra,
        which are of several quantities, stay in model units, and so do the numbers in `doubt` and in the reasons why a number is not known,
        which then say so."""
        if not self.in_model_units:
            raise ValueError(f"the statistics are in {self.units} already")
        shown = chosen(units, self.units)
        made = converted(self, shown, dimensions("answer"))
        tables: dict[str, Any] = {name: _table_in(getattr(self, name), shown) for name in _TABLES}
        rows = self.distributions["quantity"] == "speed"
        by_speed = factor(shown, dimensions("state")["speed"])
        tables["distributions"].loc[rows, ["from", "to"]] *= by_speed
        tables["distributions"].loc[rows, ["density", "lower", "upper"]] /= by_speed
        if shown is not None:
            said = {part.name: _in_model_units(getattr(made, part.name)) for part in fields(made) if part.name not in _AS_IT_IS}
            made = replace(made, **said)
        return replace(made, **tables, units=shown, in_model_units=shown is None)

    def plot(self, what: str = "msd", ax: Axes | None = None, *, units: Asked = None) -> Axes:
        """One of ``msd``, ``exponent``, ``autocorrelations``, ``speed``, ``turning_angle``, ``spectra``, ``first_passage``, in the units of
        the study, or in those that are given."""
        if not self.in_model_units:
            raise ValueError("plot the statistics from which these were converted, with units")
        shown = self.units if units is None else chosen(units, self.units)
        return plotting.plot_statistics(self, what, ax, shown)

    def __repr__(self) -> str:
        return f"<statistics of {self.bodies} bodies: persistence time {self.persistence}, diffusion {self.diffusion}>"


_AS_IT_IS = ("summary", "bodies", "complete", "units", "in_model_units")


def _in_model_units(value: Any) -> Any:
    """A reason, also that of a number, which says that its numbers are in model units."""
    if isinstance(value, str):
        return f"{value} (numbers in model units)" if re.search(r"\d", value) else value
    if isinstance(value, Measured):
        return replace(value, reason=_in_model_units(value.reason))
    if isinstance(value, Mapping):
        return {name: _in_model_units(entry) for name, entry in value.items()}
    return value


_TABLES = ("msd", "autocorrelations", "distributions", "spectra", "first_passage")


def _table_in(table: pd.DataFrame, units: Units | None) -> pd.DataFrame:
    """A copy in other units; the ends of an interval have the dimension of the number to their left."""
    known, number, made = dimensions("statistic"), "", {}
    for name in table:
        number = number if name in ("lower", "upper") else str(name)
        if number in known:
            made[str(name)] = table[name] * factor(units, known[number])
    return table.assign(**made)


def statistics(
    folders: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    *,
    transient: float = 0.0,
    radii: Sequence[float] = (),
    threshold: Threshold = None,
) -> Statistics:
    """Statistics of the bodies in folders written by ``motiform simulate``, one each; rows before `transient` are left out.

    A run that did not reach its end counts as far as it goes, with the warning :class:`EndedEarly`.
    """
    text, tables, _ = _motiform.statistics_of(paths_of(folders), float(transient), asked(radii, threshold))
    result = statistics_from(text, tables)
    left_out(result.summary["notes"])
    return result


def asked(radii: Sequence[float], threshold: Threshold) -> tuple[list[float], tuple[str, float | None] | None]:
    """As the native module takes it."""
    pair = (threshold, None) if isinstance(threshold, str) else threshold
    if pair is not None and not (isinstance(pair, tuple) and len(pair) == 2 and isinstance(pair[0], str)):
        raise TypeError(f"threshold = {threshold!r}: give a quantity, or one with a value, such as ('speed', 0.5)")
    return real(list(radii), "radii").tolist(), pair


_READ: dict[str, Callable[[str], Any]] = {"quantity": str, "count": int, "starts": int}


def _number(text: str) -> float:
    return float(text) if text else math.nan


def _frame(table: bytes) -> pd.DataFrame:
    """A table with every digit; NaN where there is no number."""
    names, *rows = csv.reader(io.StringIO(table.decode()))
    columns = {name: [row[place] for row in rows] for place, name in enumerate(names)}
    return pd.DataFrame({name: [_READ.get(name, _number)(text) for text in column] for name, column in columns.items()})


def _measured(entry: Mapping[str, Any]) -> Measured:
    if "reason" in entry:
        return Measured(math.nan, math.nan, math.nan, entry["reason"])
    return Measured(entry["value"], entry.get("lower", math.nan), entry.get("upper", math.nan))


def statistics_from(text: str, tables: Sequence[tuple[str, bytes]], units: Units | None = None) -> Statistics:
    """The statistics of the native module's JSON and CSV."""
    raw = json.loads(text)
    walk = raw["persistent_walk"]
    times = {name: _measured(entry["correlation_time"]) for name, entry in raw["autocorrelations"].items()}
    frames = {name: _frame(table) for name, table in tables}
    return Statistics(
        raw["bodies"],
        raw["complete"],
        _measured(raw["mean_speed"]),
        _measured(walk["persistence"]),
        _measured(walk["speed"]),
        _measured(walk["diffusion"]),
        _measured(raw["diffusion"]["displacements"]),
        _measured(raw["diffusion"]["green_kubo"]),
        times,
        frames["msd"],
        frames["autocorrelations"],
        frames["distributions"],
        frames["spectra"],
        frames["first_passage"],
        raw,
        units,
        doubt=raw["not_stationary"] or raw["unlike_bodies"] or raw["diffusion"]["doubt"],
    )
