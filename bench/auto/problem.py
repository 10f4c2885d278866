"""A problem of the folder `problems`: one text of its equations, read by motiform and turned into Python and Fortran here."""

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import tomllib

FOLDER = Path(__file__).parent / "problems"
NAMES = re.compile(r"\d+\.?\d*|[A-Za-z_]\w*|\^")


@dataclass
class Problem:
    """dz_n/dt = text n. A real state u holds the real and imaginary parts of the amplitudes."""

    name: str
    parameters: dict
    texts: list
    along: str
    span: tuple
    python: list = field(init=False)

    def __post_init__(self):
        words = {"i": "1j", "^": "**", "conj": "np.conj"}
        self.python = [compile(NAMES.sub(lambda m: words.get(m[0], m[0]), text), self.name, "eval") for text in self.texts]

    def field(self, u, value):
        """du/dt where the parameter of the branch has this value; `u` may be a state or a column for each of many."""
        z = u[0::2] + 1j * u[1::2]
        names = {**self.parameters, self.along: value, "np": np, **{f"z{n + 1}": z[n] for n in range(len(z))}}
        rates = np.empty_like(u)
        for n, text in enumerate(self.python):
            rate = eval(text, names)
            rates[2 * n], rates[2 * n + 1] = rate.real, rate.imag
        return rates

    def jacobian(self, u, value):
        """df/du by differences that are exact for polynomials up to order four."""
        steps = 1e-2 * np.eye(len(u))
        at = lambda k: self.field(u[:, None] + k * steps, value)
        return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / 0.12

    def fortran(self, start):
        """The equations for AUTO, with the start at the parameters of the text (`start` may change them)."""
        order = [self.along, *(name for name in self.parameters if name != self.along)]
        size = 2 * len(self.texts)

        def word(match):
            text = match[0]
            if text[0].isdigit():
                return f"{float(text)!r}d0"
            known = {"i": "(0d0, 1d0)", "^": "**", "conj": "conjg"}
            return f"par({order.index(text) + 1})" if text in order else known.get(text, text)

        exponents = re.compile(r"\*\*(\d+)\.0d0")
        rates = [exponents.sub(r"**\1", NAMES.sub(word, text)) for text in self.texts]
        amplitudes = [f"z{n + 1} = cmplx(u({2 * n + 1}), u({2 * n + 2}), kind=8)" for n in range(len(rates))]
        set_rates = [f"w = {wrapped(rate)}\n  f({2 * n + 1}) = dble(w)\n  f({2 * n + 2}) = aimag(w)" for n, rate in enumerate(rates)]
        set_start = [f"par({n + 1}) = {number(self.parameters[name])}" for n, name in enumerate(order)]
        set_start += [f"u({n + 1}) = {number(value)}" for n, value in enumerate(start)]
        names = ", ".join(f"z{n + 1}" for n in range(len(rates)))
        return TEMPLATE.format(names=names, size=size, rates="\n  ".join([*amplitudes, *set_rates]), start="\n  ".join(set_start))


def number(value):
    return f"{value:.17e}".replace("e", "d")


def wrapped(text, width=100):
    """A long expression on several lines, broken before operators."""
    lines, line = [], ""
    for part in re.split(r"(?<=[\w)])(?=[-+*](?!\*))", text):
        if len(line) + len(part) > width:
            lines.append(line)
            line = ""
        line += part
    return " &\n    ".join([*lines, line])


def problem(name, **changed):
    """The problem of this name, with some parameters changed."""
    text = tomllib.loads((FOLDER / f"{name}.toml").read_text())
    model = text["model"]["amplitudes"]
    along, span = text["continue"]["along"].split("=")
    low, high = map(float, span.split(":"))
    return Problem(name, {**model["parameters"], **changed}, list(model["equations"].values()), along, (low, high))


TEMPLATE = """! Written by problem.py.
subroutine func(ndim, u, icp, par, ijac, f, dfdu, dfdp)
  implicit none
  integer, intent(in) :: ndim, icp(*), ijac
  double precision, intent(in) :: u(ndim), par(*)
  double precision, intent(out) :: f(ndim)
  double precision, intent(inout) :: dfdu(ndim, ndim), dfdp(ndim, *)
  complex(kind=8) :: w, {names}
  {rates}
end subroutine func

subroutine stpnt(ndim, u, par, t)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(inout) :: u(ndim), par(*)
  double precision, intent(in) :: t
  {start}
end subroutine stpnt

subroutine bcnd
end subroutine bcnd
subroutine icnd
end subroutine icnd
subroutine fopt
end subroutine fopt
subroutine pvls
end subroutine pvls
"""
