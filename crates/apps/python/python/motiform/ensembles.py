"""Many orbits at once: from many starts, with many values of the parameters, or both."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _motiform
from .calls import Random, known_whole, real, remark, with_given
from .equality import equal, hashed
from .progress import Bar, Progress
from .results import Outcome, outcome_of
from .trajectory import Floats

if TYPE_CHECKING:
    from .fields import Field
    from .models import Model


@dataclass(frozen=True)
class Ensemble:
    """The states of many orbits at given times."""

    __eq__, __hash__ = equal, hashed

    t: Floats
    """The times, (T,)."""
    states: Floats
    """Coordinates of the shape, then x and y: (members, T, entries). NaN at times that a member did not reach: `outcomes` gives the reason."""
    names: tuple[str, ...]
    """Names of the entries."""
    parameters: Mapping[str, Floats]
    """The parameters that were varied, (members,) each."""
    outcomes: tuple[Outcome, ...]
    """How each member ended."""

    def __getitem__(self, name: str) -> Floats:
        """One coordinate of all members, (members, T)."""
        if name not in self.names:
            raise KeyError(f"{name!r}: the coordinates are {', '.join(self.names)}")
        return self.states[:, :, self.names.index(name)]

    @property
    def position(self) -> Floats:
        """Positions, (members, T, 2)."""
        if self.names[-2:] != ("x", "y"):
            raise AttributeError(f"the coordinates of this field are {', '.join(self.names)}: none of them is known as a position")
        return self.states[:, :, -2:]

    @property
    def complete(self) -> npt.NDArray[np.bool_]:
        """Which members reached all times, (members,)."""
        return np.array([outcome.complete for outcome in self.outcomes], dtype=bool)

    def __len__(self) -> int:
        return len(self.outcomes)

    def __iter__(self) -> Iterator[Floats]:
        """The states of one member after the other, (T, entries)."""
        return iter(self.states)


def ensemble(
    body: Model | Field,
    t: float | npt.ArrayLike,
    *,
    starts: int | npt.ArrayLike | None = None,
    parameters: Mapping[str, npt.ArrayLike] | None = None,
    random: Random | None = None,
    seed: int | None = None,
    stepper: str | None = None,
    rtol: float | None = None,
    atol: float | None = None,
    step: float | None = None,
    max_steps: int | None = None,
    escape_norm: float | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Ensemble:
    """Computes the states of many orbits of `body` at the times `t`, or at a single time `t`.

    The tensor model with the paper's couplings runs eight (or four) orbits at a time in the vector registers of each core, if the
    stepper is dop853 with a tolerance. Every orbit has the same bits as a single run, independent of the others, the threads and the machine.

    Parameters
    ----------
    t
        Increasing times, the first one at least 0; or one time, the end.
    starts
        Number of random starts at the origin (determined by `random` and `seed`); or an array of starts, (members, entries) with the
        coordinates of the shape (:attr:`Model.coordinates`), optionally followed by x and y. A single start is used for all members. By default one
        random start for each member.
    parameters
        Values of some parameters by name: an array with one value per member, or a number.

    A :class:`Field` needs an array of starts, (members, coordinates), and runs on threads; `random` and `seed` are not for it.

    Members are matched one to one: starts and parameters have the same length, or length one.
    """
    from .fields import Field

    known_whole(seed=seed, max_steps=max_steps, threads=threads)
    given = {
        "random": random, "seed": seed, "stepper": stepper, "rtol": rtol, "atol": atol, "step": step, "max_steps": max_steps,
        "escape_norm": escape_norm,
    }  # fmt: skip
    times = np.atleast_1d(real(t, "t"))
    if times.ndim != 1 or times.size == 0:
        raise ValueError("t must be one time or a list of times")
    varied = {name: np.atleast_1d(real(values, f"parameters[{name!r}]")) for name, values in (parameters or {}).items()}
    if isinstance(body, Field):
        return body._ensemble(times, starts, varied, given, threads, progress)
    study = with_given(body._study, None, given)
    remark(study, varied)
    table = _parameters(body, varied)
    places = _starts(body, study, starts, len(table))
    table, places = _matched(table, places)
    count = threads or os.cpu_count() or 1
    with Bar(progress, 100.0, "%") as bar:
        states, ends = _motiform.ensemble(study, table, places, times.tolist(), count, bar.callable())
    outcomes = tuple(outcome_of(*end) for end in json.loads(ends))
    names = (*body.coordinates, "x", "y")
    spread = {name: np.broadcast_to(values, (len(outcomes),)) for name, values in varied.items()}
    return Ensemble(times, states, names, spread, outcomes)


def _parameters(body: Model | Field, varied: dict[str, Floats]) -> Floats:
    """All parameters of each member."""
    base = body.parameters
    for name, values in varied.items():
        if name not in base:
            wrong: dict[str, Any] = {name: float(values[0])}
            body.replace(**wrong)  # says which names there are
        if values.ndim != 1:
            raise ValueError(f"parameters[{name!r}] has {values.ndim} dimensions: give one value per member")
    members = max([1, *(len(values) for values in varied.values())])
    table = np.tile(np.array(list(base.values()), dtype=np.float64), (members, 1))
    for name, values in varied.items():
        if len(values) not in (1, members):
            raise ValueError(f"parameters[{name!r}] has {len(values)} values where another has {members}")
        table[:, list(base).index(name)] = values
    return table


def _starts(body: Model, study: Any, starts: int | npt.ArrayLike | None, members: int) -> Floats:
    """The start of each member, with its position."""
    if starts is None:
        starts = members
    if isinstance(starts, (int, np.integer)):
        if starts < 1:
            raise ValueError(f"starts = {starts}: give at least 1")
        return np.array(_motiform.random_starts(study, int(starts)), dtype=np.float64)
    entries = len(body.coordinates)
    array = _rows(starts, (entries, entries + 2))
    if array.shape[1] == entries:
        array = np.hstack([array, np.zeros((len(array), 2))])
    return np.ascontiguousarray(array)


def _rows(starts: npt.ArrayLike, widths: tuple[int, ...]) -> Floats:
    """An array of starts, (members, one of these widths)."""
    array = np.array(np.atleast_2d(real(starts, "starts")))
    if array.ndim != 2 or array.shape[1] not in widths:
        wanted = ", or ".join(f"(members, {width})" + (" with x and y" if place else "") for place, width in enumerate(widths))
        raise ValueError(f"starts has the shape {array.shape}: give {wanted}")
    return array


def _matched(table: Floats, places: Floats) -> tuple[Floats, Floats]:
    """Both with a row for each member."""
    members = max(len(table), len(places))
    for name, rows in (("parameters", table), ("starts", places)):
        if len(rows) not in (1, members):
            raise ValueError(f"{name} has {len(rows)} rows for {members} members: give one for each, or one for all")
    wide = [np.ascontiguousarray(np.broadcast_to(rows, (members, rows.shape[1]))) for rows in (table, places)]
    return wide[0], wide[1]
