"""Vector fields given as compiled functions: what values alone allow, and a reason for everything else."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NoReturn

import numpy as np
import numpy.typing as npt

from . import _motiform
from .addresses import address_of
from .calls import OnEnd, ended_early, known_apart, known_end, known_whole, raised_with, real, start_of
from .equality import equal, hashed
from .fixed import Fixed, Values
from .progress import Bar, Progress
from .results import Crossings, Exponents, Outcome, exponents_of, outcome_of
from .trajectory import Floats, crossing_frame

if TYPE_CHECKING:
    import pandas as pd

    from .ensembles import Ensemble

__all__ = ["Field", "Orbit"]


@dataclass(frozen=True)
class Orbit:
    """A recorded orbit of a :class:`Field`."""

    __eq__, __hash__ = equal, hashed

    t: Floats
    """Times of the rows, (rows,)."""
    states: Floats
    """States, (rows, coordinates)."""
    names: tuple[str, ...]
    """Names of the coordinates."""
    outcome: Outcome
    """How the run ended."""

    def __getitem__(self, name: str) -> Floats:
        """One coordinate, (rows,)."""
        if name not in self.names:
            raise KeyError(f"{name!r}: the coordinates are {', '.join(self.names)}")
        return self.states[:, self.names.index(name)]

    def __len__(self) -> int:
        return len(self.t)

    def to_pandas(self) -> pd.DataFrame:
        """A data frame: ``t`` and the coordinates."""
        import pandas as pd

        return pd.DataFrame(np.column_stack((self.t, self.states)), columns=["t", *self.names])


class Field(Fixed):
    """A vector field ``dx/dt = f(t, x; p)`` given as a compiled function of C::

        void f(double t, const double *x, const double *p, double *dx)

    Parameters
    ----------
    function
        A ``numba.cfunc`` with the signature ``motiform.addresses.SIGNATURE``, a function of ctypes (of a library, or a ``CFUNCTYPE``), or an address. It reads
        the coordinates ``x`` and the parameters ``p`` in the order given here, and writes every entry of ``dx``.
    coordinates
        Their names, or their number n for the names ``x1 .. xn``.
    parameters
        Names and values, in the order in which the function reads them.
    jacobian
        A function of the same kind that writes ``df_i/dx_j`` at place ``n*i + j`` of its last argument. Without it, exponents use differences.
    initial
        Initial values by name; those not given are 0. If none are given, :meth:`simulate` needs them.

    motiform knows nothing of such a function but its values: not its symmetry, not which coordinates are a velocity, no derivatives. Orbits, ensembles,
    crossings and exponents work; everything else raises ``NotImplementedError`` with the reason, and the remedy :class:`Amplitudes`.

    The function must not keep state, and several threads call it at once (``threads=1`` prevents it). A wrong address or signature, or a
    function that reads or writes beyond its arguments, ends Python without an exception: nobody can check that.

    Examples
    --------
    >>> library = ctypes.CDLL("./lorenz.so")
    >>> field = motiform.Field(library.lorenz, ["x", "y", "z"], {"sigma": 10.0, "rho": 28.0, "beta": 8 / 3})
    >>> orbit = field.simulate(50.0, initial={"x": 1.0, "y": 1.0, "z": 20.0})
    >>> field.lyapunov(initial={"x": 1.0, "y": 1.0, "z": 20.0}, t_end=2000.0)
    """

    _functions: tuple[Any, Any]
    _coordinates: list[str]
    _parameters: Values[float]
    _initial: Values[float]
    _native: _motiform.Field

    def __init__(
        self,
        function: Any,
        coordinates: int | Sequence[str],
        parameters: Mapping[str, float] | None = None,
        *,
        jacobian: Any = None,
        initial: Mapping[str, float] | None = None,
    ) -> None:
        own = vars(self)  # nothing else can set attributes
        own["_functions"] = (function, jacobian)
        own["_coordinates"] = _names(coordinates)
        own["_parameters"] = Values({name: _number(name, value) for name, value in (parameters or {}).items()})
        own["_initial"] = Values({name: _number(name, value) for name, value in start_of(initial, self.coordinates).items()})
        self._start(None, needed=False)
        addresses = (address_of(function, "function"), None if jacobian is None else address_of(jacobian, "jacobian"))
        own["_native"] = _motiform.Field(self.coordinates, list(self.parameters.values()), *addresses, self._functions)

    @property
    def coordinates(self) -> list[str]:
        """Names of the coordinates."""
        return list(self._coordinates)

    @property
    def parameters(self) -> Mapping[str, float]:
        """Names and values of the parameters; read-only."""
        return self._parameters

    @property
    def initial(self) -> Mapping[str, float]:
        """The given initial values; read-only."""
        return self._initial

    def replace(self, *, initial: Mapping[str, float] | None = None, **parameters: float) -> Field:
        """A copy with other values of parameters, or other initial values."""
        for name in parameters:
            if name not in self.parameters:
                raise TypeError(f"unknown parameter {name!r}: this field has {', '.join(self.parameters) or 'none'}")
        function, jacobian = self._functions
        values = {**self.parameters, **parameters}
        start = self.initial if initial is None else initial
        return Field(function, self.coordinates, values, jacobian=jacobian, initial=start)

    def simulate(
        self,
        t_end: float = 200.0,
        *,
        transient: float = 0.0,
        dt_out: float | None = None,
        initial: Mapping[str, float] | None = None,
        stepper: str | None = None,
        rtol: float | None = None,
        atol: float | None = None,
        step: float | None = None,
        max_steps: int | None = None,
        escape_norm: float | None = None,
        on_end: OnEnd | None = None,
        progress: Progress = None,
    ) -> Orbit:
        """One orbit with a row every `dt_out` (by default ``t_end / 2000``), from dense output.

        The function is asked for times from ``-transient`` to ``t_end``. Steppers: dop853 (the default, rtol 1e-9), dopri5; rk4, heun, euler with a fixed `step`. An
        orbit that does not reach its end is a value with its outcome: see :meth:`Model.simulate`.
        """
        known_end(on_end)
        known_apart(dt_out)
        known_whole(max_steps=max_steps)
        run = _given(
            t_end=t_end, transient=transient, dt_out=dt_out, stepper=stepper, rtol=rtol, atol=atol, step=step, max_steps=max_steps,
            escape_norm=escape_norm,
        )  # fmt: skip
        with Bar(progress, transient + t_end, "time") as bar:
            rows, end, raised = self._native.simulate(self._start(initial), run, bar.callable())
        outcome = _outcome(end)
        orbit = Orbit(rows[:, 0], rows[:, 1:], tuple(self.coordinates), outcome)
        if raised is not None:
            raise raised_with(raised, orbit)
        if not outcome.complete:
            asked = escape_norm is not None or max_steps is not None
            ended_early(outcome.text, on_end or ("ignore" if asked else "warn"))
        return orbit

    def section(
        self,
        coordinate: str,
        value: float = 0.0,
        direction: Literal["rising", "falling", "either"] = "either",
        *,
        t_end: float = 200.0,
        transient: float = 0.0,
        initial: Mapping[str, float] | None = None,
        rtol: float | None = None,
        on_end: OnEnd = "warn",
        progress: Progress = None,
    ) -> Crossings:
        """The crossings of the orbit with ``coordinate = value``, located to round-off."""
        known_end(on_end)
        if coordinate not in self.coordinates:
            raise ValueError(f"no coordinate {coordinate!r}: give one of {', '.join(self.coordinates)}")
        run = _given(t_end=t_end, transient=transient, rtol=rtol)
        surface = (self.coordinates.index(coordinate), float(value), direction)
        with Bar(progress, transient + t_end, "time") as bar:
            table, end = self._native.section(self._start(initial), surface, run, bar.callable())
        outcome = _outcome(end)
        if not outcome.complete:
            ended_early(outcome.text, on_end)
        return Crossings(crossing_frame(*table), outcome)

    def lyapunov(
        self,
        count: int | None = None,
        *,
        transient: float = 100.0,
        t_end: float = 1000.0,
        initial: Mapping[str, float] | None = None,
        stepper: str | None = None,
        rtol: float | None = None,
        atol: float | None = None,
        on_end: OnEnd = "warn",
        progress: Progress = None,
    ) -> Exponents:
        """The `count` largest Lyapunov exponents (by default at most 6), averaged over `t_end` after `transient`.

        With a `jacobian` tangent vectors are exact; without, they come from differences of order 4, whose relative error is about 1e-12 where the
        function is smooth on the scale of its coordinates. The function must not depend on the time (``ValueError``): make the phase a
        coordinate. `neutral` counts the flow's direction only: symmetries are not known.
        """
        known_end(on_end)
        run = _given(stepper=stepper, rtol=rtol, atol=atol)
        count = min(6, len(self.coordinates)) if count is None else count
        with Bar(progress, 100.0, "%") as bar:
            times = (float(transient), float(t_end))
            text = self._native.lyapunov(self._start(initial), count, times, run, bar.callable())
        raw = json.loads(text)
        if not raw["complete"]:
            ended_early(raw["ended"], on_end)
        return exponents_of(raw)

    def __call__(self, t: float, u: npt.ArrayLike) -> Floats:
        """The rates at `u`: (coordinates,), or (coordinates, m) for m states at once, as for ``scipy.integrate.solve_ivp``."""
        states = real(u)
        if states.ndim not in (1, 2):
            raise ValueError(f"u has {states.ndim} dimensions: give (coordinates,) or (coordinates, m)")
        rows = np.ascontiguousarray(states[np.newaxis] if states.ndim == 1 else states.T)
        rates = self._native.rates(float(t), rows)
        return rates[0] if states.ndim == 1 else np.ascontiguousarray(rates.T)

    def classify(self, *_: object, **__: object) -> NoReturn:
        """Not for a field: raises ``NotImplementedError`` with the reason."""
        _refuse("classify", "the criteria need the velocity, the symmetry and exact derivatives of a body")

    def motions(self, *_: object, **__: object) -> NoReturn:
        """Not for a field: raises ``NotImplementedError`` with the reason."""
        _refuse("motions", "the criteria need the velocity, the symmetry and exact derivatives of a body")

    def equilibria(self, *_: object, **__: object) -> NoReturn:
        """Not for a field: raises ``NotImplementedError`` with the reason."""
        _refuse("equilibria", "steady motions are those of a body whose rotations are known")

    def branches(self, *_: object, **__: object) -> NoReturn:
        """Not for a field: raises ``NotImplementedError`` with the reason."""
        _refuse("branches", "continuation needs exact derivatives, also by parameters, and the symmetry of a body")

    def curves(self, *_: object, **__: object) -> NoReturn:
        """Not for a field: raises ``NotImplementedError`` with the reason."""
        _refuse("curves", "continuation needs exact derivatives, also by parameters, and the symmetry of a body")

    def atlas(self, *_: object, **__: object) -> NoReturn:
        """Not for a field: raises ``NotImplementedError`` with the reason."""
        _refuse("atlas", "the criteria need the velocity, the symmetry and exact derivatives of a body")

    def statistics(self, *_: object, **__: object) -> NoReturn:
        """Not for a field: raises ``NotImplementedError`` with the reason."""
        _refuse("statistics", "they are those of a body's position, velocity and modes")

    def to_toml(self) -> NoReturn:
        """Not for a field: raises ``NotImplementedError`` with the reason."""
        _refuse("to_toml", "a compiled function cannot be written to a file")

    @property
    def _study(self) -> _motiform.Study:
        _refuse("this", "plans and files describe models whose equations are known, so that others can compute the same")

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Field cannot be pickled: the address of a compiled function is that of this process only")

    def __copy__(self) -> Field:
        return self  # it does not change

    def __deepcopy__(self, _: dict[int, Any]) -> Field:
        return self

    def __repr__(self) -> str:
        parts = [", ".join(self.coordinates), *(f"{name}={value:g}" for name, value in self.parameters.items())]
        return f"Field({', '.join(parts)})"

    def _start(self, initial: Mapping[str, float] | None, *, needed: bool = True) -> list[float]:
        values = self.initial if initial is None else start_of(initial, self.coordinates)
        for name in values:
            if name not in self.coordinates:
                raise ValueError(f"no coordinate {name!r}: the initial values are those of {', '.join(self.coordinates)}")
        if needed and not values:
            raise ValueError("a field has no start of its own: give initial={NAME: value}")
        return [_number(name, values.get(name, 0.0)) for name in self.coordinates]

    def _ensemble(
        self, times: Floats, starts: Any, varied: dict[str, Floats], run: dict[str, Any], threads: int | None, progress: Progress
    ) -> Ensemble:
        """As :func:`motiform.ensemble`."""
        from .ensembles import Ensemble, _matched, _parameters, _rows

        if run.pop("random") is not None or run.pop("seed") is not None:
            raise ValueError("random and seed are for random starts, which a field does not have: give an array of starts")
        table = _parameters(self, varied)
        if starts is None:
            starts = [self._start(None)]
        if isinstance(starts, (int, np.integer)):
            raise ValueError("a field has no distribution of random starts: give an array of starts, (members, coordinates)")
        table, places = _matched(table, _rows(starts, (len(self.coordinates),)))
        count = threads or os.cpu_count() or 1
        rows = (table.tolist(), places.tolist(), times.tolist())
        with Bar(progress, 100.0, "%") as bar:
            states, ends = self._native.ensemble(*rows, _given(**run), count, bar.callable())
        outcomes = tuple(outcome_of(*end) for end in json.loads(ends))
        spread = {name: np.broadcast_to(values, (len(outcomes),)) for name, values in varied.items()}
        return Ensemble(times, states, tuple(self.coordinates), spread, outcomes)


def _names(coordinates: int | Sequence[str]) -> list[str]:
    if isinstance(coordinates, str):
        raise TypeError(f"coordinates = {coordinates!r}: give a list of names, or their number")
    if isinstance(coordinates, (int, np.integer)):
        coordinates = [f"x{place}" for place in range(1, int(coordinates) + 1)]
    names = [str(name) for name in coordinates]
    if not names:
        raise ValueError("coordinates: give at least one")
    if len(set(names)) < len(names) or "t" in names or "rising" in names:
        raise ValueError(f"coordinates = {names}: give different names, none of them 't' or 'rising'")
    return names


def _number(name: str, value: Any) -> float:
    if isinstance(value, (str, complex)) or not hasattr(value, "__float__"):
        raise TypeError(f"{name} must be a real number, not {type(value).__name__}")
    if not math.isfinite(number := float(value)):
        raise ValueError(f"{name} = {number}: give a finite number")
    return number


def _given(**settings: Any) -> dict[str, Any]:
    return {name: value for name, value in settings.items() if value is not None}


def _outcome(end: tuple[str, bool, str]) -> Outcome:
    return outcome_of(json.loads(end[0]), *end[1:])


def _refuse(what: str, reason: str) -> NoReturn:
    remedy = "write the equations as motiform.Amplitudes, which has all analyses"
    raise NotImplementedError(f"{what} does not work for a compiled field: {reason}; {remedy}")
