"""Results of analyses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt
import pandas as pd

from .equality import equal, hashed
from .units import Asked, Units, chosen, converted, dimensions

R = TypeVar("R")


def with_units(result: R, units: Units | None) -> R:
    """A result of a study with these units."""
    return replace(result, units=units)  # type: ignore[type-var]


def in_units(result: R, units: Asked) -> R:
    """A copy of a result with its numbers in other units."""
    known: Any = result
    if not known.in_model_units:
        raise ValueError(f"the numbers are in {known.units} already")
    shown = chosen(units, known.units)
    made = converted(result, shown, dimensions("motion", "answer"))
    return replace(made, units=shown, in_model_units=shown is None)  # type: ignore[type-var]


@dataclass(frozen=True)
class Outcome:
    """How a run ended. Only a complete run reached its requested end."""

    kind: str
    """``completed``, ``escaped``, ``step-underflow``, ``closure-failed``, ``step-budget`` or ``interrupted``."""
    t: float
    """The corresponding time (model time): the end of the run, or the blow-up time t*."""
    complete: bool
    text: str
    """The outcome as text."""
    details: Mapping[str, Any] = field(default_factory=dict)

    def __str__(self) -> str:
        return self.text


def outcome_of(raw: dict[str, Any], complete: bool, text: str) -> Outcome:
    """The outcome of a manifest."""
    details = {key: value for key, value in raw.items() if key not in ("kind", "t")}
    return Outcome(raw["kind"], raw["t"], complete, text, details)


@dataclass(frozen=True)
class Estimate:
    """A number with the half width of its 95 % confidence interval; ``None`` where the data say nothing about it."""

    __eq__, __hash__ = equal, hashed

    value: float
    error: float | None = None


@dataclass(frozen=True)
class Spread:
    """Mean and extremes over the motion."""

    __eq__, __hash__ = equal, hashed

    mean: float
    min: float
    """Smallest value of the samples (720 of a period, in equal steps of time)."""
    max: float
    """Largest value of the samples."""
    error: float | None = None
    """Half width of the 95 % confidence interval of the mean; None where the mean has the accuracy of the motion itself, or no error."""


@dataclass(frozen=True)
class Accuracy:
    """What a motion was computed with: relative and absolute tolerance, or a fixed step (model time)."""

    stepper: str
    rtol: float | None = None
    atol: float | None = None
    step: float | None = None

    def __str__(self) -> str:
        if self.step is not None:
            return f"{self.stepper}, step {self.step:g}"
        return f"{self.stepper}, rtol {self.rtol:g}, atol {self.atol:g}"


@dataclass(frozen=True)
class Saddle:
    """The rates of the saddles of a heteroclinic cycle (inverse model time)."""

    __eq__, __hash__ = equal, hashed

    out: float
    inward: float
    error: float = 0.0
    """The error of their sum."""


@dataclass(frozen=True)
class Verdict:
    """The regime of a motion, with the evidence. Numbers that are not defined for the motion are ``None``, or empty."""

    __eq__, __hash__ = equal, hashed

    regime: str
    """motionless, straight, pulsating-straight, circular, spinning, rectangular, quasi-periodic, zigzag, chaotic, blow-up or
    undetermined."""
    attractor: str
    """equilibrium, unstable (an equilibrium that only a start of exact symmetry does not leave), periodic, torus, heteroclinic, chaotic, escape or unknown."""
    why: str
    """The evidence in one sentence."""
    time: float
    """Model time used for the decision."""
    accuracy: Accuracy
    form: str | None = None
    """The symmetry of a periodic motion: mirror-zigzag, rotating-zigzag, pulsating-circular, ... (docs/regimes.md)."""
    course: str | None = None
    """The direction, where the model prefers one: anticlockwise, clockwise, along-field, across-field, ... (docs/regimes.md)."""
    heading: float | None = None
    """Direction of the velocity, or of the drift of a motion that repeats (rad, from the x axis), in a model without rotations."""
    margin: float | None = None
    """Distance of the decisive quantity from its threshold, in units of its own uncertainty: 1 is weak, 10 is clear."""
    resolution: Mapping[str, Any] | None = None
    """How far the numbers move with more modes: the ``parameter`` that was changed, its ``value``, the largest relative ``change``."""
    speed: Spread | None = None
    """Speed of the centre of mass (model length per model time)."""
    turning_rate: float | None = None
    """Mean turning rate of the heading (rad per model time)."""
    turning_error: float | None = None
    """Its half width of the 95 % confidence interval, where it is an average over a part of the motion."""
    period: float | None = None
    """Time after which the body is as it was, but for the net rotation (model time)."""
    net_rotation: float | None = None
    """Net rotation per period (rad, -pi to pi)."""
    drift: float | None = None
    """Distance travelled per period (model length)."""
    swing: float | None = None
    """Peak-to-peak swing of the heading over one period (rad)."""
    lasted: float | None = None
    """For chaos: the model time for which it was observed to last, at least."""
    escape_time: float | None = None
    """The blow-up time t* (model time)."""
    saddle: Saddle | None = None
    exponents: tuple[Estimate, ...] = ()
    """Lyapunov exponents, largest first (inverse model time)."""
    legs: tuple[float, ...] = ()
    """Turns from leg to leg (rad)."""
    rests: tuple[float, ...] = ()
    """Durations of the rests (model time)."""
    units: Units | None = None
    """What a unit of length and one of time are, if the study says it."""
    in_model_units: bool = True
    """Whether the numbers are in model units: false of what :meth:`in_units` returns."""

    def in_units(self, units: Asked = True) -> Verdict:
        """A copy with speeds, rates, times and lengths in the units of the study, or in others (``"20um,1min"``); all else stays as it is.

        The sentence `why` has its numbers in model units; as text the copy says so.
        """
        return in_units(self, units)

    def __str__(self) -> str:
        course = f", {self.course.replace('-', ' ')}" if self.course else ""
        return f"{self.regime}{course}: {self.why}{'' if self.in_model_units else ' (numbers in model units)'}"


def verdict_of(raw: dict[str, Any]) -> Verdict:
    """The verdict of the native module's JSON."""
    made: dict[str, Any] = dict(raw)
    made["accuracy"] = Accuracy(**raw["accuracy"])
    for name, kind in (("speed", Spread), ("saddle", Saddle)):
        if made.get(name) is not None:
            made[name] = kind(**made[name])
    made["exponents"] = tuple(Estimate(**entry) for entry in raw.get("exponents", ()))
    for name in ("legs", "rests"):
        made[name] = tuple(raw.get(name, ()))
    return Verdict(**made)


@dataclass(frozen=True)
class Share:
    """The share of one motion among random starts, with Wilson's 95 % interval."""

    __eq__, __hash__ = equal, hashed

    regime: str
    count: int
    of: int
    value: float
    lower: float
    upper: float
    course: str | None = None
    """Where the model tells left from right, or has a field."""


@dataclass(frozen=True)
class Motions:
    """The motions of many initial states."""

    __eq__, __hash__ = equal, hashed

    verdicts: tuple[Verdict, ...]
    """The verdict on each initial state, in order."""
    shares: tuple[Share, ...]
    """The shares of the random initial states, the most frequent motion first."""
    starts: Mapping[str, Any]
    """What was sampled: ``count``, ``given`` (an additional start that was given), ``random`` and the same as text in ``words``."""
    escapes: Mapping[str, Any] | None
    """How many blew up, when, and the rate of escape from chaos, with 95 % limits; ``None`` without chaos and blow-up."""
    text: str
    """Shares and escapes as text."""

    def __str__(self) -> str:
        return self.text


def motions_of(raw: dict[str, Any]) -> Motions:
    """The motions of the native module's JSON."""
    verdicts = tuple(verdict_of({**entry, "accuracy": raw["accuracy"]}) for entry in raw["samples"])
    shares = tuple(Share(**entry) for entry in raw["shares"])
    return Motions(verdicts, shares, raw["starts"], raw.get("escapes"), "; ".join(raw["words"]))


@dataclass(frozen=True)
class Exponents:
    """Lyapunov exponents of one orbit (inverse model time), largest first."""

    __eq__, __hash__ = equal, hashed

    values: npt.NDArray[np.float64]
    """(count,)"""
    errors: npt.NDArray[np.float64]
    """Half widths of the 95 % confidence intervals, (count,); infinite if the average is too short for an error."""
    neutral: int
    """The number of exponents that must be 0 by symmetry and time invariance: a check on the others."""
    time: float
    """Averaging time (model time), after `transient`."""
    transient: float
    outcome: Outcome
    accuracy: Accuracy
    without_error: str | None = None
    """The reason why exponents have no error."""
    dimension: Estimate | None = None
    """The Kaplan-Yorke dimension of the set of shapes, rotated copies included; None if too few exponents were computed."""
    units: Units | None = None
    """What a unit of length and one of time are, if the study says it."""
    in_model_units: bool = True
    """Whether the numbers are in model units: false of what :meth:`in_units` returns."""

    def in_units(self, units: Asked = True) -> Exponents:
        """A copy with rates and times in the units of the study, or in others (``"20um,1min"``); all else stays as it is."""
        return in_units(self, units)

    @property
    def sum(self) -> float:
        """The mean growth rate of volumes, if all exponents were computed."""
        return float(self.values.sum())

    def __str__(self) -> str:
        pairs = enumerate(zip(self.values, self.errors, strict=True), 1)
        return ", ".join(
            f"λ{number} = {value:.5g} " + (f"± {error:.1g}" if np.isfinite(error) else "(no error)")
            for number, (value, error) in pairs
        )


def exponents_of(raw: dict[str, Any]) -> Exponents:
    """The exponents of the native module's JSON."""
    pairs = [(entry["value"], entry.get("error", np.inf)) for entry in raw["exponents"]]
    estimates = np.array(pairs, dtype=float).reshape(-1, 2)
    outcome = outcome_of(raw["outcome"], raw["complete"], raw["ended"])
    ends = (raw["neutral"], raw["time"], raw["transient"], outcome, Accuracy(**raw["accuracy"]), raw.get("without_error"))
    dimension = raw.get("dimension")
    return Exponents(estimates[:, 0], estimates[:, 1], *ends, Estimate(**dimension) if dimension else None)


@dataclass(frozen=True)
class Equilibrium:
    """A steady motion: a shape that is constant up to a steady rotation."""

    __eq__, __hash__ = equal, hashed

    kind: str
    """motionless, straight, circular or spinning."""
    shape: dict[str, float]
    """Its coordinates; all its rotations are equilibria too."""
    speed: float
    """(model length per model time)"""
    turning_rate: float
    """(rad per model time)"""
    eigenvalues: npt.NDArray[np.complex128]
    """Eigenvalues of the reduced linearisation, largest real part first (inverse model time)."""
    unstable: int
    """Number of growing directions."""
    residual: float
    share: float
    """Fraction of the random starts from which Newton's method converged to this equilibrium."""
    found_by: str
    """What led to it first: starts (the circle or a random start), deflation, or mirror (the mirror image of another)."""
    family: int = 0
    """Dimension of the family of equilibria that it stands for (rotated copies not counted); 0 where it is alone."""
    course: str | None = None
    """Sense of rotation, or direction to the field, where the model tells them apart."""
    heading: float | None = None
    """Direction of the velocity (rad from the x-axis), where rotations are no symmetry."""
    units: Units | None = None
    """What a unit of length and one of time are, if the study says it."""
    in_model_units: bool = True
    """Whether the numbers are in model units: false of what :meth:`in_units` returns."""

    def in_units(self, units: Asked = True) -> Equilibrium:
        """A copy with speed and rates in the units of the study, or in others (``"20um,1min"``); all else stays as it is."""
        return in_units(self, units)

    @property
    def stable(self) -> bool:
        """Whether there is no growing direction."""
        return self.unstable == 0


def equilibrium_of(raw: dict[str, Any]) -> Equilibrium:
    """The equilibrium of the native module's JSON."""
    eigenvalues = np.array([complex(*pair) for pair in raw["eigenvalues"]], dtype=np.complex128)
    rest = {key: value for key, value in raw.items() if key != "motion"}
    return Equilibrium(**{**rest, "kind": raw["motion"], "eigenvalues": eigenvalues})


@dataclass(frozen=True)
class Crossings:
    """The crossings of an orbit with a section."""

    __eq__, __hash__ = equal, hashed

    table: pd.DataFrame
    """One row per crossing: ``t``, ``x``, ``y``, the coordinates of the shape (of a field: its coordinates), ``rising``."""
    outcome: Outcome

    def __len__(self) -> int:
        return len(self.table)

    def pairs(self, name: str) -> npt.NDArray[np.float64]:
        """The return map of a column: (crossings - 1, 2), each value with the next one."""
        values = self.table[name].to_numpy()
        return np.column_stack((values[:-1], values[1:]))
