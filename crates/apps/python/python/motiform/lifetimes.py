"""Mean lives of transient chaos along a parameter."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import pandas as pd

from . import plotting
from .equality import equal, hashed
from .units import TIME, Asked, Units, chosen, factor

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Lifetimes:
    """How long chaos lives along a parameter, and by which law. Definitions and formulas: docs/lifetimes.md."""

    __eq__, __hash__ = equal, hashed

    parameter: str
    """The parameter."""
    values: pd.DataFrame
    """A row for each of its values: the ``starts``, those that ``blew_up``, were ``captured``, were ``lasting``, moved ``regular``, or were ``lost``; the
    ``delay`` after which a life counts, the time ``until`` which they are followed, ``events`` (ends of lives; ``early`` ones, before the delay,
    do not count), the time ``watched``, and the mean ``life`` with its exact 95 % limits (NaN and infinity without events). Times are model times."""
    law: str
    """``power-law`` (a crisis), ``exponential`` (none), ``cannot-be-told-apart``, ``neither``, ``not-exponential`` or ``too-few``."""
    sentence: str
    """The law in words, with its numbers."""
    notes: tuple[str, ...]
    """What the numbers do not tell by themselves."""
    summary: Mapping[str, Any]
    """Everything that ``motiform lifetimes --json`` prints."""
    units: Units | None = None
    """What a unit of length and one of time are, if the study says it."""
    in_model_units: bool = True
    """Whether the table is in model units: false of what :meth:`in_units` returns."""

    def in_units(self, units: Asked = True) -> Lifetimes:
        """A copy with the times of the table in the units of the study, or in others (``"20um,1min"``). `sentence`, `notes` and `summary` stay
        in model units."""
        if not self.in_model_units:
            raise ValueError(f"the lifetimes are in {self.units} already")
        shown = chosen(units, self.units)
        times = {name: self.values[name] * factor(shown, TIME) for name in _TIMES}
        return replace(self, values=self.values.assign(**times), units=shown, in_model_units=shown is None)

    def plot(self, ax: Axes | None = None) -> Axes:
        """The mean lives with their limits on a logarithmic axis."""
        return plotting.plot_lifetimes(self, ax)

    def __repr__(self) -> str:
        return f"<lifetimes at {len(self.values)} values of {self.parameter}: {self.sentence}>"


_TIMES = ("until", "delay", "watched", "life", "lower", "upper")


def lifetimes_of(raw: dict[str, Any], units: Units | None = None) -> Lifetimes:
    """The lifetimes of the JSON of the command line."""

    def row(at: dict[str, Any]) -> dict[str, Any]:
        life = at["life"]
        limits = {"life": math.nan if life["value"] is None else life["value"], "upper": math.inf if life["upper"] is None else life["upper"]}
        return {raw["parameter"]: at["value"], **at, **life, **limits}

    table = pd.DataFrame([row(at) for at in raw["values"]]).drop(columns="value")
    return Lifetimes(raw["parameter"], table, raw["laws"]["answer"], raw["sentence"], tuple(raw["notes"]), raw, units)
