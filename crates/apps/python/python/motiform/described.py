"""What a body is: a model with parameters, an initial state and run settings, as data."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from . import _motiform
from ._registry import MODELS, RUN_SETTINGS, ModelInfo, info_of
from .calls import coordinates_of, known_whole, start_of
from .fixed import Fixed, Values
from .units import Units, units_of

if TYPE_CHECKING:
    from typing_extensions import Self

D = TypeVar("D", bound="Described")

_SETTINGS = frozenset({"random", "units", *RUN_SETTINGS})


class Described(Fixed):
    """A study: immutable, comparable, and the same after pickling."""

    _study: _motiform.Study

    @classmethod
    def _of(cls: type[D], study: _motiform.Study) -> D:
        model = cls.__new__(cls)
        vars(model)["_study"] = study
        return model

    @property
    def info(self) -> ModelInfo:
        """The entry of the registry: equations, source, parameters with meanings and ranges."""
        return MODELS.get(self._study.model) or info_of(json.loads(self._study.info()))

    @property
    def title(self) -> str:
        """The title of a preset or a study file."""
        return self._study.title

    @property
    def about(self) -> str:
        """For a preset: what it shows."""
        return self._study.about

    @property
    def free(self) -> list[str]:
        """The parameters that span the paper's diagram, if the preset represents one."""
        return self._study.free

    @property
    def parameters(self) -> Mapping[str, float]:
        """All parameters, in the order of the registry; read-only."""
        return Values(self._study.parameters())

    @property
    def initial(self) -> Mapping[str, float]:
        """The given initial values, read-only; if there are none, the initial state is random."""
        return Values(self._study.initial())

    @property
    def run(self) -> Mapping[str, Any]:
        """The run settings, read-only: ``t_end``, ``transient``, ``stepper``, ``rtol``, ``seed``, ..."""
        return Values(json.loads(self._study.run()))

    @property
    def units(self) -> Units | None:
        """What a unit of length and one of time are (``[figure] units`` of a study, or ``replace(units="20um,1min")``); ``None`` if
        nothing is said."""
        return units_of(self._study.units)

    @property
    def coordinates(self) -> list[str]:
        """Names of the shape's coordinates."""
        return [name for name, _ in self._study.coordinates()]

    def __getattr__(self, name: str) -> float:
        if not name.startswith("_"):
            for known, value in self._study.parameters():
                if known == name:
                    return value
        raise AttributeError(f"{type(self).__name__} has no attribute or parameter {name!r}")

    def replace(self, *, initial: Mapping[str, float] | None = None, **changes: Any) -> Self:
        """A copy with other parameters, run settings (``t_end``, ``rtol``, ``seed``, ...), initial values or ``units`` (``"20um,1min"``)."""
        settings = {name: changes.pop(name) for name in list(changes) if name in _SETTINGS}
        known_whole(**settings)
        if "units" in settings:
            settings["units"] = _units_text(settings["units"])
        return self._of(self._study.with_(changes, start_of(initial, coordinates_of(self._study)), settings))

    def tie(self, **expressions: str) -> Self:
        """A copy in which parameters follow from others: ``body.tie(b3="d3", kappa3="2*kappa2")``, also in scans over them."""
        for name, expression in expressions.items():
            if not isinstance(expression, str):
                raise TypeError(f"{name} = {expression!r}: give an expression as text, such as '2*kappa2'; replace({name}={expression!r}) sets a value")
        return self._of(self._study.tied(expressions))

    def to_toml(self) -> str:
        """A study file for the command line: ``motiform simulate FILE.toml`` computes the same bits."""
        return self._study.to_toml()

    def __getstate__(self) -> dict[str, Any]:
        return {"_study": self._study}

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Described) and self._study == other._study

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __repr__(self) -> str:
        # Equations given as text have no defaults to leave out.
        values = self.parameters.items() if type(self).__name__ == "Amplitudes" else self._study.given()
        return f"{type(self).__name__}({', '.join(f'{name}={value:g}' for name, value in values)})"


def _units_text(units: object) -> str:
    """Units as a study has them."""
    if not isinstance(units, (str, Units)):
        raise TypeError(f"units = {units!r}: write what a unit of length and one of time are, such as '20um,1min'")
    return str(units)
