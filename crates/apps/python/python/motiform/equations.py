"""Models whose equations are given as text."""

from __future__ import annotations

import json
import reprlib
from collections.abc import Mapping, Sequence
from typing import Any

from . import _motiform
from .calls import coordinates_of, start_of
from .models import Model

__all__ = ["Amplitudes"]

Value = float | Mapping[str, Any]
"""A number, or ``{"value": .., "range": [.., ..], "symbol": .., "text": ..}``."""


class Amplitudes(Model):
    """A body given by equations of complex amplitudes: polynomials in ``z1, conj(z1), z2, ..`` with named parameters.

    Parameters
    ----------
    modes
        The angular index n of each amplitude ``z_n``: a rotation of the plane by an angle multiplies it by ``exp(-i n angle)``.
    equations
        The right-hand side of ``dz_n/dt`` for each mode: ``{"z1": "(gamma - |z1|^2)*z1", ..}``.
    parameters
        Their values, or ``{"value": .., "range": [.., ..], "symbol": .., "text": ..}``.
    velocity
        ``v1 + i v2`` as a polynomial; by default ``conj(z1)``.
    symmetry
        ``"rotation+mirror"``, ``"rotation"``, ``"mirror"`` or ``"none"``; found from the terms where it is not given. A term that breaks
        rotations is an error unless this says so.
    noise
        The strength of complex white noise on amplitudes, a number or a polynomial (Stratonovich): ``{"z2": "D", "z1": "s*z1"}``.
    initial
        Initial values by name: ``v1``, ``v2`` for the velocity's mode, ``z2_re``, ``z2_im``, .. for the others.

    Raises
    ------
    ValueError
        With the place in the text, and what was expected; or for a parameter with the name of a setting or of an attribute of bodies.

    Examples
    --------
    >>> body = motiform.Amplitudes(modes=[1], equations={"z1": "(gamma + i*omega - |z1|^2)*z1"}, parameters={"gamma": 1.0, "omega": 0.3})
    >>> body.classify().regime
    'circular'
    """

    def __init__(
        self,
        *,
        modes: Sequence[int],
        equations: Mapping[str, str],
        parameters: Mapping[str, Value] | None = None,
        velocity: str | None = None,
        symmetry: str | None = None,
        noise: Mapping[str, str] | None = None,
        initial: Mapping[str, float] | None = None,
    ) -> None:
        for key, given, example in (
            ("equations", equations, "from amplitudes to text, such as {'z1': 'gamma*z1'}; motiform.Field takes functions"),
            ("parameters", parameters, "from names to values, such as {'gamma': 1.0}"),
            ("noise", noise, "from amplitudes to text, such as {'z1': 'D'}"),
        ):
            if given is not None and not isinstance(given, Mapping):
                raise TypeError(f"{key} = {reprlib.repr(given)}: give a mapping {example}")
        for name in parameters or {}:
            if name == "self" or (hasattr(Amplitudes, name) and not name.startswith("_")):
                raise ValueError(f"parameters: {name} is the name of an attribute of bodies: choose another name")
        for name, equation in equations.items():
            if not isinstance(equation, str):
                raise TypeError(f"the equation of {name} must be text, such as 'gamma*z1', not {type(equation).__name__}; motiform.Field takes functions")
        text = _text(modes, equations, parameters or {}, {"velocity": velocity, "symmetry": symmetry}, noise or {})
        study = _motiform.Study.parse(text, "amplitudes")
        vars(self)["_study"] = study.with_({}, start_of(initial, coordinates_of(study)))


def _text(
    modes: Sequence[int],
    equations: Mapping[str, str],
    parameters: Mapping[str, Value],
    texts: Mapping[str, str | None],
    noise: Mapping[str, str],
) -> str:
    """The study file with these equations."""
    lines = ["[model.amplitudes]", f"modes = {_toml(list(modes))}"]
    lines += [f"{key} = {_toml(text)}" for key, text in texts.items() if text is not None]
    lines += ["[model.amplitudes.parameters]"]
    lines += [f"{_toml(name)} = {_toml(value)}" for name, value in parameters.items()]
    lines += ["[model.amplitudes.equations]"]
    lines += [f"{_toml(name)} = {_toml(text)}" for name, text in equations.items()]
    lines += ["[model.amplitudes.noise]"] if noise else []
    lines += [f"{_toml(name)} = {_toml(text)}" for name, text in noise.items()]
    return "\n".join(lines) + "\n"


def _toml(value: Any) -> str:
    """A value of a study file."""
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_toml(key)} = {_toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(entry) for entry in value) + "]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        return repr(float(value)) if hasattr(value, "__float__") else json.dumps(value)
    return repr(int(value))
