"""Physical units of length and time."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace
from typing import Any, TypeVar

import numpy as np
import pandas as pd

from . import _motiform

Dimension = tuple[int, int] | tuple[int, int, bool]
"""Powers of length and time, and ``True`` for angles: a speed has (1, -1), a turning rate (0, -1, True)."""

LENGTH: Dimension = (1, 0)
TIME: Dimension = (0, 1)


def dimensions(*subjects: str) -> dict[str, Dimension]:
    """The dimensions of the quantities of these subjects (``motion``, ``statistic``, ...; docs/quantities.md) that change with the units."""
    declared = {name: powers for subject in subjects for name, (_, powers) in _motiform.quantities(subject).items()}
    return {name: powers for name, powers in declared.items() if powers is not None and any(powers[:2])}


@dataclass(frozen=True)
class Units:
    """What a unit of length and one of time of a model are, such as ``Units("20um,1min")``.

    ``units.factor((1, -1))`` is the factor from model units of a quantity with these powers of length and time (here a speed), and
    ``units.name((1, -1))`` is the name of its unit, ``µm/min``.

    More: docs/units.md.
    """

    text: str
    """Both units, as study files and the command line give them."""
    _native: _motiform.Units = field(init=False, repr=False, compare=False, hash=False)

    def __post_init__(self) -> None:
        native = _motiform.Units.parse(self.text)
        if native is None:
            raise ValueError("units: write what a unit of length and one of time are, such as 20um,1min")
        object.__setattr__(self, "_native", native)

    def __reduce__(self) -> tuple[Any, ...]:
        return Units, (self.text,)

    def factor(self, dimension: Dimension) -> float:
        """The factor from model units of a quantity with such powers of length and time."""
        return self._native.factor(*dimension)

    def name(self, dimension: Dimension) -> str:
        """The name of its unit; empty for a number."""
        return self._native.name(*dimension)

    def __str__(self) -> str:
        return self.text


Asked = Units | str | bool | None
"""Units that a method takes: ``True`` for those of the study, ``False`` for those of the model, others by their text."""


def units_of(text: str) -> Units | None:
    """The units of a study; ``None`` where they are those of the model."""
    return Units(text) if text else None


def chosen(asked: Asked, own: Units | None) -> Units | None:
    """The units that a method works in; ``None`` for those of the model."""
    if asked is True and own is None:
        raise ValueError("units=True: the study has no units; give some, such as '20um,1min'")
    if isinstance(asked, str):
        return Units(asked)
    return asked if isinstance(asked, Units) else own if asked else None


def factor(units: Units | None, dimension: Dimension) -> float:
    """The factor from model units; 1 without units."""
    return 1.0 if units is None else units.factor(dimension)


def name(units: Units | None, dimension: Dimension) -> str:
    """The name of a unit, in model units too: ``model length per model time``."""
    return _motiform.Units.of_model(*dimension) if units is None else units.name(dimension)


def label(quantity: str, units: Units | None, dimension: Dimension) -> str:
    """The label of an axis with its unit, exponents as Matplotlib sets them."""
    unit = re.sub(r"\^(-?\d+)", r"$^{\1}$", name(units, dimension))
    return f"{quantity} ({unit})" if unit else quantity


def table_in(table: pd.DataFrame, units: Units | None) -> pd.DataFrame:
    """A copy of a table of motions with its columns in other units; states, eigenvalues and parameters stay in model units."""
    known = dimensions("motion")
    named = [column for column in table.columns if column in known]
    # an object column of numbers and None is one of numbers
    return table.assign(**{column: pd.to_numeric(table[column]) * factor(units, known[column]) for column in named})


D = TypeVar("D")


def converted(result: D, units: Units | None, dimensions: Mapping[str, Dimension]) -> D:
    """A copy of a result with the named fields in other units than those of the model. Nothing else is changed."""
    named = {part.name: dimensions[part.name] for part in fields(result) if part.name in dimensions}  # type: ignore[arg-type]
    made = {key: scaled(getattr(result, key), factor(units, dimension)) for key, dimension in named.items()}
    return replace(result, **made)  # type: ignore[type-var]


def scaled(value: Any, by: float) -> Any:
    """Numbers, and all numbers in results, arrays, tuples, lists and mappings."""
    if isinstance(value, (bool, str)) or value is None:
        return value
    if isinstance(value, (int, float, np.ndarray)):
        return value * by
    if isinstance(value, (tuple, list)):
        return type(value)(scaled(entry, by) for entry in value)
    if isinstance(value, dict):
        return {key: scaled(entry, by) for key, entry in value.items()}
    if is_dataclass(value) and not isinstance(value, type):
        return replace(value, **{part.name: scaled(getattr(value, part.name), by) for part in fields(value)})
    raise TypeError(f"{type(value).__name__} has no unit")
