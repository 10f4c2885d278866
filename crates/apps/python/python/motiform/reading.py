"""Reading of all files that the command line writes."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import pandas as pd
import xarray as xr

from . import _motiform
from .atlases import Atlas, atlas_of
from .branches import Branches, branches_of
from .curves import Curves, curves_of
from .errors import Incomplete
from .lifetimes import Lifetimes, lifetimes_of
from .scans import read_scan
from .trajectory import Floats, Trajectory, _frame, crossing_frame


def read(path: str | os.PathLike[str], *, why: bool = False) -> Trajectory | Branches | Curves | Atlas | Lifetimes | xr.Dataset | pd.DataFrame | dict[str, Any]:
    """Reads a file or folder written by the command line.

    ======================================  ===============================================
    folder of ``motiform simulate``         :class:`Trajectory`
    ``.parquet`` of a trajectory            :class:`Trajectory` (it carries its manifest)
    ``.csv``, other ``.parquet``            ``pandas.DataFrame``
    folder of ``motiform continue``         :class:`Branches`, with ``--curve`` :class:`Curves`
    folder of ``motiform atlas``            :class:`Atlas`
    folder of ``motiform lifetimes``        :class:`Lifetimes`
    folder of ``motiform scan``             ``xarray.Dataset``, as :func:`scan` returns it
    a ``.parquet`` part of that folder      ``pandas.DataFrame`` of its rows
    ``fields.h5``                           ``xarray.Dataset`` with ``phi`` and ``outline``
    ``.json`` (manifests, ``--json``)       ``dict``
    ======================================  ===============================================

    `why`: keep the evidence of a scan's rows. A run that does not fit into memory is read by :func:`chunks`.
    """
    path = Path(path)
    if not path.exists():
        raise FileNotFoundError(f"{path} does not exist")
    if path.is_dir():
        if (path / "_manifest.json").exists():
            return read_scan(path, why)
        if (path / "branches.json").exists():
            return branches_of(*_motiform.read_branches(os.fspath(path))[:2])
        if (path / "curves.json").exists():
            return curves_of(*_motiform.read_curves(os.fspath(path))[:2])
        if (path / "atlas.json").exists():
            return atlas_of(_motiform.read_atlas(os.fspath(path)))
        if (path / "lifetimes.json").exists():
            return lifetimes_of(json.loads((path / "lifetimes.json").read_text(encoding="utf-8")))
        if (path / "orbits.json").exists():
            raise ValueError(f"{path} contains lifetimes that are not finished: the call of lifetimes that began it goes on with resume=True")
        return Trajectory(_motiform.read_run(os.fspath(path)))
    if path.suffix in (".parquet", ".csv"):
        if (path.parent / "_manifest.json").exists():
            return _part(path)
        run, table = _motiform.read_table(os.fspath(path))
        if run is not None:
            return Trajectory(run)
        assert table is not None
        return _table(*table)
    if path.suffix == ".h5":
        return _fields(path)
    if path.suffix == ".json":
        loaded: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        return loaded
    raise ValueError(f"{path} contains no data of motiform: give a folder, or a .parquet, .csv, .h5 or .json file")


def chunks(path: str | os.PathLike[str], *, columns: Iterable[str] | None = None) -> Iterator[pd.DataFrame]:
    """The rows of a table that may be larger than memory, in frames of at most 262,144 rows, one after the other.

    `path` is a folder of ``motiform simulate``, of which the trajectory is read, or a table (``.parquet``, ``.csv``). `columns`: these, in this
    order; of Parquet nothing else is read. The index counts on from frame to frame. Two frames are in memory at a time.
    """
    wanted = None if columns is None else list(columns)
    groups = _motiform.Chunks(os.fspath(path), wanted)
    first = 0
    while (group := groups.next()) is not None:
        frame = _table(*group)
        frame.index = pd.RangeIndex(first, first + len(frame))
        first += len(frame)
        yield frame if wanted is None else frame[wanted]


def _table(names: list[str], meanings: list[str], block: Floats) -> pd.DataFrame:
    return crossing_frame(names, meanings, block) if "rising" in names else _frame(names, meanings, block)


def _part(path: Path) -> pd.DataFrame:
    """The rows of one part of a scan's folder."""
    plan, _, _ = _motiform.read_scan(os.fspath(path.parent), False)
    first, last = plan.cells_of(int(path.stem.removeprefix("part-")))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Incomplete)  # of the other parts
        rows = read_scan(path.parent, True).motiform.to_pandas(cells=True)
    return rows[rows["cell"].between(first, last - 1)].reset_index(drop=True)


def _fields(path: Path) -> xr.Dataset:
    t, s, phi, outline, attributes = _motiform.read_fields(os.fspath(path))
    coords = {
        "t": ("t", t, {"long_name": "time", "units": "model time"}),
        "s": ("s", s, {"long_name": "arc length along the boundary", "units": "model length"}),
        "xy": ("xy", ["x", "y"]),
    }
    meaning = "boundary, absolute coordinates; NaN where it could not be closed"
    variables = {
        "phi": (("t", "s"), phi, {"long_name": "phi in the normal angle 2 pi (s + phi)/L", "units": "model length"}),
        "outline": (("t", "point", "xy"), outline, {"long_name": meaning, "units": "model length"}),
    }
    return xr.Dataset(variables, coords, dict(attributes))
