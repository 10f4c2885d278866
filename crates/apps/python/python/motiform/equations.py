"""Models whose equations are given as text."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from . import _motiform
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
        With the place in the text, and what was expected.

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
        for name, equation in equations.items():
            if not isinstance(equation, str):
                raise TypeError(f"the equation of {name} must be text, such as 'gamma*z1', not {type(equation).__name__}; motiform.Field takes functions")
        text = _text(modes, equations, parameters or {}, {"velocity": velocity, "symmetry": symmetry}, noise or {})
        vars(self)["_study"] = _motiform.Study.parse(text, "amplitudes").with_({}, dict(initial or {}))


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
