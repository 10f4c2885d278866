"""What is found about cells."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

import pandas as pd

from ..equality import equal, hashed
from ..equations import Amplitudes

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_Result = TypeVar("_Result")


@dataclass(frozen=True)
class Value:
    """A number with its standard errors; NaN where there is none."""

    __eq__, __hash__ = equal, hashed

    value: float
    """The number."""
    error: float
    """Standard error from the expected information."""
    robust_error: float
    """Standard error from the scatter of the scores."""
    slice: float = math.nan
    """The value on the slice of the diagram, for parameters that the diagram fixes."""
    lower: float = math.nan
    """Lower end of the 95 % interval over all sets of terms that the data do not tell apart, for coordinates of a place."""
    upper: float = math.nan
    """Its upper end."""

    def __float__(self) -> float:
        return self.value

    def __str__(self) -> str:
        return f"{self.value:.5g} ± {self.error:.2g}"


@dataclass(frozen=True)
class Observation:
    """How a cell moves, from its samples alone."""

    __eq__, __hash__ = equal, hashed

    cell: str
    """Name of the cell."""
    frames: int
    """Frames that count."""
    regime: str
    """The motion, or ``undecided``."""
    why: str
    """The evidence, or what is missing."""
    confidence: float
    """Share of resampled records that give the same motion; NaN without a name."""
    numbers: Mapping[str, Any]
    """Numbers without a model, of every record: ``steps`` (speed, path, turning), ``displacement``, ``walk`` (persistence, diffusion,
    errors), ``forms`` (area, aspect ratio)."""
    measures: Mapping[str, Any] | None
    """The numbers behind it; ``None`` for records that are too short."""
    repeats: Mapping[str, Any] | None
    """Period, likeness and rotation of a motion that repeats; ``None`` where nothing repeats."""
    statistics: Mapping[str, Any] | None
    """Persistence time, diffusion coefficient and correlation times as ``motiform observe --json`` prints them; ``None`` for records that are too short."""
    units: tuple[str, str]
    """Units of length and time."""

    @property
    def displacement(self) -> pd.DataFrame:
        """Mean-square displacement: ``lag``, ``value``, ``lower``, ``upper`` (95 % interval); empty for records that are too short."""
        return _curve((self.statistics or {}).get("displacement", ()))

    @property
    def correlations(self) -> dict[str, pd.DataFrame]:
        """Autocorrelations of ``velocity``, ``z2`` and ``z3``, with the columns of ``displacement``."""
        memories = (self.statistics or {}).get("memories", ())
        return {memory["quantity"]: _curve(memory["correlation"]) for memory in memories}

    @property
    def decided(self) -> bool:
        """Whether the motion has a name."""
        return self.regime != "undecided"

    def plot(self) -> Figure:
        """Mean-square displacement and autocorrelations, with 95 % intervals. ``ValueError`` for records that are too short."""
        from .curves import plot_observation

        return plot_observation(self)


class Found(dict[str, _Result]):
    """Results by the names of the cells, with those over all cells."""

    population: Mapping[str, Any]
    """Shares of names and numbers over cells, as ``--json`` prints them; empty for fewer than two cells."""

    def __init__(self, results: Mapping[str, _Result], population: Mapping[str, Any]) -> None:
        super().__init__(results)
        self.population = population


@dataclass(frozen=True)
class Place:
    """Where a fitted cell lies on a diagram of the paper, or why it has no place there."""

    __eq__, __hash__ = equal, hashed

    coordinates: Mapping[str, Value]
    """The parameters that span the diagram; empty without a place."""
    others: Mapping[str, Value]
    """The parameters that the diagram fixes, with their values there (``slice``)."""
    distance: float
    """Distance from the slice; NaN without a place."""
    deviation: float
    """The same in standard errors."""
    reasons: tuple[str, ...] = ()
    """Why there is no place; empty if there is one."""

    @property
    def known(self) -> bool:
        """Whether there is a place."""
        return not self.reasons

    def __str__(self) -> str:
        if self.reasons:
            return "no place: " + "; ".join(self.reasons)
        at = ", ".join(f"{name} = {value}" for name, value in self.coordinates.items())
        return f"{at}; {self.distance:.3g} off the slice ({self.deviation:.1f} standard errors)"


@dataclass(frozen=True)
class Noise:
    """The noise of a fit, in the units of the data."""

    __eq__, __hash__ = equal, hashed

    measurement_factor: Value
    """Factor of the errors of the modes that the vertices give."""
    eta_v: Value
    """Noise of the velocity."""
    eta_shape: Value
    """Noise of the shape."""
    centre: Value
    """Error of each coordinate of the centre beside that of the contour, such as a jitter of the images; 0 where none is seen."""


@dataclass(frozen=True)
class CellFit:
    """The equations of a cell, and what follows from them. Definitions: docs/inference.md."""

    __eq__, __hash__ = equal, hashed

    cell: str
    """Name of the cell."""
    frames: int
    """Frames that count."""
    regime: str
    """The motion of the models that the data allow, or ``undecided``."""
    why: str
    """The motions of these models, or why there is no fit."""
    share: float
    """Share of these models with the most frequent motion; NaN where none were drawn."""
    draws: Mapping[str, int]
    """How many of these models have each motion."""
    identifiable: bool
    """Whether the data determine the coefficients."""
    determined: tuple[str, ...]
    """What the data determine, in words, among all terms."""
    unidentified: tuple[str, ...]
    """Combinations of coefficients that the data leave free."""
    handed: bool
    """Whether coefficients that are mirror symmetric are rejected; ``summary["handed"]`` is ``"not decidable"`` where a handed cell could
    not have been told."""
    handed_p_value: float
    """The p-value of this test; NaN without a fit."""
    coefficients: pd.DataFrame
    """``term``, ``imaginary``, ``value``, ``error``, ``robust_error``, ``low``, ``high`` and ``weak_form`` (the same coefficient by the weak form,
    a check of sign and order of magnitude; none where noise makes the rates), in the units of the data. Errors and ends of intervals are NaN where
    ``summary["no_intervals"]`` says why they do not hold, and where the search did not converge."""
    noise: Noise | None
    """``None`` without a fit."""
    place: Place
    """On the plane of Fig. 4."""
    place_reduced: Place
    """On the plane of Fig. 1."""
    warnings: tuple[str, ...]
    """What makes the fit doubtful."""
    simulated: pd.DataFrame
    """Cells simulated by the fit beside the observed one: ``statistic``, ``verdict`` (agrees, doubtful, differs), ``p_value``. Empty without a fit, without
    simulations, and where ``unstable``."""
    ladder: pd.DataFrame
    """Models compared by frames that their fits did not see, from a persistent random walk on: ``model``, ``coefficients``, ``gain_per_frame`` (log-likelihood
    above that of the first), ``behind`` and ``error`` (log-likelihood below the best), ``as_good``. Empty unless asked for (``ladder=True``), and of records
    that are too short."""
    unstable: bool
    """Whether too many simulated cells leave all bounds: then the fit does not describe the cell."""
    model: Amplitudes | None
    """The equations without noise, in the units of the data: classified and followed like all others. ``None`` without a fit."""
    noisy_model: Amplitudes | None
    """The equations with the process noise of the fit, to be simulated."""
    summary: Mapping[str, Any]
    """Everything, as ``motiform fit --json`` prints it."""
    units: tuple[str, str]
    """Units of length and time."""

    @property
    def decided(self) -> bool:
        """Whether the motion has a name."""
        return self.regime != "undecided"

    def bands(self, statistic: str) -> pd.DataFrame:
        """A statistic of the observed cell among those of the simulated ones: ``at`` (lags, or shares in %), ``observed``, and ``median``, ``low``,
        ``high`` (95 % band) of the simulated cells."""
        found = self.summary.get("simulated", {}).get("statistics", ())
        for one in found:
            if one["statistic"] == statistic:
                return pd.DataFrame({name: one[name] for name in ("at", "observed", "median", "low", "high")})
        known = ", ".join(one["statistic"] for one in found) or "none: there are no simulated cells"
        raise KeyError(f"{statistic!r}; the statistics are {known}")

    def plot(self) -> Figure:
        """Each statistic of the cell among those of the simulated cells, with the verdict. ``ValueError`` without simulated cells."""
        from .curves import plot_fit

        return plot_fit(self)

    def __repr__(self) -> str:
        return f"<fit of cell {self.cell}: {self.regime}, {len(self.coefficients)} coefficients, {self.frames} frames>"


_RUNGS = ("model", "coefficients", "gain_per_frame", "behind", "error", "as_good")
_COMPARED = ("statistic", "verdict", "p_value")


def _curve(points: Sequence[Mapping[str, float]]) -> pd.DataFrame:
    columns = ("lag", "value", "lower", "upper")
    return pd.DataFrame([[point.get(name, math.nan) for name in columns] for point in points], columns=list(columns))


def observation_of(raw: Mapping[str, Any], units: tuple[str, str]) -> Observation:
    """The observation of the native module's JSON."""
    names = ("cell", "frames", "regime", "why", "numbers", "measures", "repeats", "statistics")
    return Observation(**{name: raw[name] for name in names}, confidence=_number(raw["confidence"]), units=units)


def fit_of(
    raw: Mapping[str, Any], coefficients: pd.DataFrame, model: Amplitudes | None, units: tuple[str, str]
) -> CellFit:
    """The fit of the native module's JSON, with the rows of this cell and its model."""
    noise = raw.get("noise")
    return CellFit(
        cell=raw["cell"],
        frames=raw["frames"],
        regime=raw["regime"],
        why=raw["why"],
        share=_number(raw.get("share")),
        draws=raw.get("draws", {}),
        identifiable=raw["identifiable"],
        determined=tuple(raw.get("determined", ())),
        unidentified=tuple(raw.get("unidentified", ())),
        handed=raw.get("handed") is True,
        handed_p_value=_number(raw.get("handed_p_value")),
        coefficients=coefficients,
        noise=None if noise is None else Noise(**{name: _value(entry) for name, entry in noise.items()}),
        place=_place(raw, "place"),
        place_reduced=_place(raw, "place_reduced"),
        warnings=tuple(raw.get("warnings", ())),
        simulated=pd.DataFrame(
            [[one[name] for name in _COMPARED] for one in raw.get("simulated", {}).get("statistics", ())],
            columns=list(_COMPARED),
        ),
        ladder=pd.DataFrame(
            [[rung[name] for name in _RUNGS] for rung in raw.get("ladder", {}).get("models", ())],
            columns=list(_RUNGS),
        ),
        unstable=raw.get("simulated", {}).get("unstable", False),
        model=None if model is None else model.replace(noise=0.0, noise_velocity=0.0),
        noisy_model=model,
        summary=raw,
        units=units,
    )


def _place(raw: Mapping[str, Any], key: str) -> Place:
    if key not in raw:
        return Place({}, {}, math.nan, math.nan, tuple(raw.get(f"no_{key}", ("there is no fit",))))
    entry = dict(raw[key])
    others = {name: _value(other) for name, other in entry.pop("others").items()}
    distance, deviation = _number(entry.pop("distance")), _number(entry.pop("deviation"))
    return Place({name: _value(value) for name, value in entry.items()}, others, distance, deviation)


def _value(entry: Mapping[str, Any]) -> Value:
    return Value(**{name: _number(number) for name, number in entry.items()})


def _number(value: float | None) -> float:
    return math.nan if value is None else float(value)
