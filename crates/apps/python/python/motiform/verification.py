"""Verification of results on disk."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _motiform
from .progress import Bar, Progress


@dataclass(frozen=True)
class Verification:
    """What :func:`verify` found; names are relative to the folder."""

    intact: bool
    """Whether every file is as it was written, and every number the same when computed again."""
    kind: str
    """``dataset``, ``scan``, ``branches``, ``curves``, ``atlas``, ``lifetimes``, ``statistics``, ``observations``, ``fits``, ``report``."""
    version: str
    """The version of motiform that wrote it."""
    complete: bool
    """Whether the result is complete; one that was interrupted can be intact."""
    checked: str
    """What was checked beside the digests of the files."""
    rows: int
    """Rows that were computed again and compared bit by bit."""
    unchanged: int
    """Files that are as they were written."""
    changed: tuple[str, ...]
    """Files that are changed."""
    missing: tuple[str, ...]
    """Files that are not there."""
    foreign: tuple[str, ...]
    """What others put there; this is no problem."""
    different: tuple[str, ...]
    """Numbers that are not the same when computed again, and plans and files that cannot be read."""

    @property
    def problems(self) -> tuple[str, ...]:
        """Everything for which the result is not intact, in sentences."""
        changed = (f"{name} is changed" for name in self.changed)
        missing = (f"{name} is missing" for name in self.missing)
        return (*changed, *missing, *self.different)

    def __str__(self) -> str:
        rows = f": {self.rows} rows" if self.rows else ""
        checked = f"{self.unchanged} files unchanged; {self.checked}{rows}"
        return f"{self.kind}, intact ({checked})" if self.intact else f"{self.kind}, not intact: {'; '.join(self.problems)}"


def verify(folder: str | os.PathLike[str], all: bool = False, *, progress: Progress = None) -> Verification:
    """Checks a folder that motiform wrote, as ``motiform verify`` does.

    The digests of its files and the hash of its plan are checked. Rows of datasets and scans, and cells of an atlas, are computed again and compared bit by bit: a sample, or
    all of them with `all`.
    """
    path = Path(folder)
    if not path.exists():
        raise FileNotFoundError(f"{path} does not exist")
    with Bar(progress, 1.0, "of the numbers") as bar:
        found: dict[str, Any] = json.loads(_motiform.verify(os.fspath(path), all, bar.callable()))
    version: str = found.pop("motiform")
    for key in ("changed", "missing", "foreign", "different"):
        found[key] = tuple(found[key])
    return Verification(version=version, **found)
