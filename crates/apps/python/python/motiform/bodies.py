"""The models by name, generated from the registry. Their signatures are in ``bodies.pyi``, which ``motiform._stubs`` writes."""

from __future__ import annotations

import inspect
import reprlib
from collections.abc import Mapping
from typing import Any

from . import _motiform
from ._registry import MODELS, ModelInfo
from .calls import coordinates_of, start_of
from .models import Model

__all__ = sorted(info.name.capitalize() for info in MODELS.values())


def docstring(info: ModelInfo) -> str:
    """The documentation of a model: title, equations, parameters with default and meaning."""
    lines = [info.title, "", info.equations, "", f"Source: {info.source}", "", "Parameters", "----------"]
    for parameter in info.parameters:
        lines += [f"{parameter.name} : float, default {parameter.default:g}"]
        lines += [f"    {parameter.meaning} (equation {parameter.equation})"]
    return "\n".join(lines)


def _class(info: ModelInfo) -> type[Model]:
    name = info.name.capitalize()

    def __init__(self: Model, *values: object, initial: Mapping[str, float] | None = None, **parameters: float) -> None:
        if values:
            first, given = info.parameters[0].name, reprlib.repr(values[0])
            raise TypeError(f"{name}({given}): parameters are given by name, such as {name}({first}={info.parameters[0].default:g})")
        study = _motiform.Study.of_model(info.name)
        vars(self)["_study"] = study.with_(parameters, start_of(initial, coordinates_of(study)))

    kind = inspect.Parameter.KEYWORD_ONLY
    named: list[Any] = [
        inspect.Parameter(parameter.name, kind, default=parameter.default, annotation=float)
        for parameter in info.parameters
    ]
    own = inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)
    start = inspect.Parameter("initial", kind, default=None)
    setattr(__init__, "__signature__", inspect.Signature([own, *named, start]))  # noqa: B010
    body = {"__init__": __init__, "__doc__": docstring(info), "__module__": __name__}
    return type(name, (Model,), body)


globals().update({info.name.capitalize(): _class(info) for info in MODELS.values()})
