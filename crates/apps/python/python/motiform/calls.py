"""What all calls have in common: settings that are given, runs that end early, interruptions."""

from __future__ import annotations

import json
import os
import reprlib
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _motiform
from .errors import Doubtful, EndedEarly, Interrupted
from .trajectory import Floats

OnEnd = Literal["warn", "ignore", "raise"]

Random = float | str | tuple[float, float]
"""Random initial states: a size (each coordinate within +-size), or the smallest and the largest norm (log-uniform, all directions)."""


def range_of(key: str, value: Any) -> tuple[str, str]:
    """A parameter, and its range as study files have it: ``kappa2=0.3:1.6``."""
    try:
        name, low, high = value
        if not isinstance(name, str) or isinstance(value, str):
            raise TypeError
        return name, f"{name}={float(low)!r}:{float(high)!r}"
    except (TypeError, ValueError):
        raise TypeError(f"{key} = {value!r}: give a parameter with its range, ('kappa2', 0.3, 1.6)") from None


def with_given(study: _motiform.Study, initial: Mapping[str, float] | None, given: dict[str, Any]) -> _motiform.Study:
    """The study with these initial values and settings; `None` leaves one as it is."""
    run = {name: value for name, value in given.items() if value is not None}
    known_apart(run.get("dt_out"))
    known_whole(**run)
    if not run and initial is None:
        return study
    return study.with_(None, None if initial is None else start_of(initial, coordinates_of(study)), run)


def coordinates_of(study: _motiform.Study) -> list[str]:
    """The names that initial values may have."""
    return [*(name for name, _ in study.coordinates()), "x", "y"]


def start_of(initial: Any, coordinates: Sequence[str]) -> dict[str, Any]:
    """Initial values by name; what is no mapping from names is rejected."""
    try:
        values = dict({} if initial is None else initial)
    except (TypeError, ValueError):
        values = {None: None}
    if any(not isinstance(name, str) for name in values):
        names = ", ".join(coordinates if len(coordinates) <= 12 else [*coordinates[:10], "..", *coordinates[-2:]])
        raise TypeError(
            f"initial = {reprlib.repr(initial)}: give a mapping from coordinates to values, such as "
            f"{{{coordinates[0]!r}: 0.1}}; the coordinates are {names}"
        )
    return values


def remark(study: _motiform.Study, varied: Iterable[str] = ()) -> None:
    """Warns, at the line that called the caller, of what is probably not meant where the parameters `varied` are varied."""
    for text in study.remarks(list(varied)):
        warnings.warn(text, Doubtful, stacklevel=3)


def span(study: _motiform.Study) -> float:
    """The model time of a run."""
    run = json.loads(study.run())
    return float(run["transient"] + run["t_end"])


def real(values: npt.ArrayLike, key: str = "u") -> Floats:
    """An array of doubles; values that are not real numbers are rejected, not converted."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{key} must hold real numbers, not {array.dtype}")
    return array.astype(np.float64, copy=False)


def axis_of(name: str, values: str | npt.ArrayLike) -> Any:
    """Values for the native module: text, or a contiguous array of doubles."""
    if isinstance(values, str):
        return values
    if isinstance(values, tuple) and len(values) == 3 and isinstance(values[2], int) and isinstance(values[1], float):
        low, high, count = values
        raise ValueError(
            f"axis {name}: {values} is three values, or {count} values from {low} to {high}: "
            f'give the list {list(values)}, or the text "{low}:{high}:{count}"'
        )
    array = real(values, f"axis {name}")
    if np.asarray(values).dtype.kind == "b":
        raise TypeError(f"axis {name} must hold real numbers, not truth values")
    if array.ndim > 1:
        raise ValueError(f"axis {name} has {array.ndim} dimensions: give one")
    return np.ascontiguousarray(np.atleast_1d(array))


def paths_of(given: str | os.PathLike[str] | Iterable[str | os.PathLike[str]]) -> list[str]:
    """One path, or several."""
    several = [given] if isinstance(given, (str, os.PathLike)) else given
    return [os.fspath(path) for path in several]


def known_end(on_end: OnEnd | None) -> None:
    """Raises for a wish that is none, before the run."""
    if on_end not in (None, "warn", "ignore", "raise"):
        raise ValueError(f"on_end = {on_end!r}: give 'warn', 'ignore' or 'raise'")


WHOLE = 2**64
"""Whole numbers of the native module are below this."""


def known_whole(**given: Any) -> None:
    """Raises for what is no whole number, is negative or too large; the native module says what else is wrong."""
    for name, value in given.items():
        if name not in _WHOLE or value is None:
            continue
        if not isinstance(value, (int, np.integer)):
            raise TypeError(f"{name} must be a whole number of at least 0, not {value!r}")
        if not 0 <= value < WHOLE:
            remedy = f"from 0 to {WHOLE - 1}" if name == "seed" else "above 0"
            raise ValueError(f"{name} = {value}: give a whole number {remedy}")


_WHOLE = ("seed", "max_steps", "samples", "bodies", "count", "threads", "starts", "branches", "points", "doublings", "lines")


def known_apart(dt_out: Any) -> None:
    """Raises for a time of 0 between rows, which in a study stands for the default."""
    if np.isscalar(dt_out) and dt_out == 0:
        raise ValueError("dt_out = 0: give a time above 0")


def ended_early(how: str, on_end: OnEnd) -> None:
    """Does what was asked for a run that ended early."""
    if on_end == "raise":
        raise RuntimeError(f"the run {how}")
    if on_end == "warn":
        warnings.warn(f"the run {how}; see the result's outcome", EndedEarly, stacklevel=3)


def left_out(notes: Iterable[str]) -> None:
    """Warns, at the line that called the caller, of the bodies that are not in a result, or not as long as the others."""
    for text in notes:
        warnings.warn(text, EndedEarly, stacklevel=3)


def raised_with(raised: BaseException, result: object) -> BaseException:
    """The exception that stopped a call; after Ctrl-C it carries the result so far."""
    return Interrupted(result) if isinstance(raised, KeyboardInterrupt) else raised
