"""Writes ``bodies.pyi`` from the registry: ``python -m motiform._stubs`` (``--check`` compares)."""

from __future__ import annotations

import sys
from pathlib import Path

from . import bodies
from ._registry import MODELS, ModelInfo
from .bodies import docstring

HEAD = '''\
"""The models by name. Written by ``python -m motiform._stubs`` from the registry: do not edit."""

from collections.abc import Mapping

from ._registry import ModelInfo
from .models import Model

__all__ = [{names}]

def docstring(info: ModelInfo) -> str: ...
'''


def stub(info: ModelInfo) -> str:
    """The class of a model, with a keyword and a property for each parameter."""
    text = docstring(info).replace("\\", "\\\\").replace("\n", "\n    ")
    lines = [f"class {info.name.capitalize()}(Model):", f'    """{text}\n    """', ""]
    lines += ["    def __init__(", "        self,", "        *,", "        initial: Mapping[str, float] | None = None,"]
    lines += [f"        {parameter.name}: float = {parameter.default!r}," for parameter in info.parameters]
    lines += ["    ) -> None: ..."]
    for parameter in info.parameters:
        lines += ["    @property", f"    def {parameter.name}(self) -> float:"]
        lines += [f'        """{parameter.meaning} ({parameter.equation})"""']
    return "\n".join(line.rstrip() for line in "\n".join(lines).split("\n")) + "\n"


def text() -> str:
    """The whole file."""
    names = ", ".join(f'"{name}"' for name in bodies.__all__)
    return HEAD.format(names=names) + "".join(f"\n{stub(info)}" for info in MODELS.values())


def main(arguments: list[str]) -> int:
    """Writes the file, or checks whether it is up to date."""
    path = Path(__file__).with_name("bodies.pyi")
    if arguments == ["--check"]:
        same = path.exists() and path.read_text(encoding="utf-8") == text()
        print("bodies.pyi is up to date" if same else "bodies.pyi is out of date: run `python -m motiform._stubs`")
        return 0 if same else 1
    path.write_text(text(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
