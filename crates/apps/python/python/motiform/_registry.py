"""The registry of motiform, read once from the native module: models, parameters, presets, regimes."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from . import _motiform

_RAW: dict[str, Any] = json.loads(_motiform.registry())


@dataclass(frozen=True)
class Parameter:
    """A parameter of a model."""

    name: str
    """The paper's name in ASCII."""
    symbol: str
    """Notation in figures: ``*`` around italic letters, ``_`` before a subscript."""
    default: float
    range: tuple[float, float]
    """The range of interest."""
    allowed: tuple[float, float]
    """The allowed values."""
    whole: bool
    """Whether only whole numbers are allowed."""
    equation: str
    """The equation in which it occurs."""
    meaning: str

    @property
    def tex(self) -> str:
        """The symbol for matplotlib."""
        return "$" + self.symbol.replace("*", "") + "$"


@dataclass(frozen=True)
class ModelInfo:
    """A model of the registry."""

    name: str
    title: str
    equations: str
    source: str
    parameters: tuple[Parameter, ...]
    coordinates: tuple[tuple[str, str], ...]
    """Name and meaning of each coordinate of the shape, for the default parameters."""
    run: dict[str, Any]
    """The default run settings."""
    budget: float
    """Default of the maximum model time for classifying one motion."""


@dataclass(frozen=True)
class Preset:
    """A parameter set of the paper."""

    name: str
    model: str
    title: str
    about: str
    free: tuple[str, ...]
    """The parameters that span the paper's diagram, if the preset represents one."""
    parameters: dict[str, float]
    """The parameters that it sets; all others have their defaults."""


@dataclass(frozen=True)
class Regime:
    """A type of motion, and its appearance in figures."""

    name: str
    meaning: str
    """The motion of the body, in one sentence."""
    colour: str
    area: str
    tint: str
    """The pale background of a marker."""
    glyph: str
    words: str = ""
    """The name in sentences and legends."""
    hand: str | None = None
    """The sense of turning, where it is that of one."""


def info_of(raw: dict[str, Any]) -> ModelInfo:
    """The entry of a model from its JSON."""
    parameters = tuple(
        Parameter(**{**entry, "range": tuple(entry["range"]), "allowed": tuple(entry["allowed"])})
        for entry in raw["parameters"]
    )
    coordinates = tuple((entry["name"], entry["meaning"]) for entry in raw["coordinates"])
    names = ("name", "title", "equations", "source", "run", "budget")
    return ModelInfo(parameters=parameters, coordinates=coordinates, **{name: raw[name] for name in names})


VERSION: str = _RAW["version"]
MODELS: dict[str, ModelInfo] = {raw["name"]: info_of(raw) for raw in _RAW["models"]}
PRESETS: dict[str, Preset] = {
    raw["name"]: Preset(**{**raw, "free": tuple(raw["free"])}) for raw in _RAW["presets"]
}
STEPPERS: tuple[str, ...] = tuple(_RAW["steppers"])
RUN_SETTINGS: tuple[str, ...] = tuple(_RAW["run_settings"])
REGIMES: tuple[Regime, ...] = tuple(Regime(**raw) for raw in _RAW["regimes"])
ATTRACTORS: tuple[str, ...] = tuple(_RAW["attractors"])
COURSES: tuple[str, ...] = tuple(_RAW["courses"])
NUMBERS: tuple[tuple[str, str, str], ...] = tuple((raw["name"], raw["meaning"], raw["unit"]) for raw in _RAW["numbers"])
"""The numbers of a scan's rows: name, meaning and unit."""
