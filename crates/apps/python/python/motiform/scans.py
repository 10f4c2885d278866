"""Scans: phase diagrams of motions in parameter space."""

from __future__ import annotations

import json
import os
import reprlib
import signal
import warnings
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from threading import current_thread, main_thread
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd
import xarray as xr

from . import _motiform
from ._registry import ATTRACTORS, COURSES, NUMBERS, REGIMES, VERSION, info_of
from .calls import Random, axis_of, known_whole, paths_of, remark
from .errors import Incomplete, Interrupted
from .executors import gather
from .models import Model
from .progress import Bar, Progress
from .units import Asked, Units, chosen, dimensions, factor
from .units import name as unit_name

Axes = Mapping[str, "str | npt.ArrayLike"]
Path = str | os.PathLike[str]


def scan(
    model: Model,
    axes: Axes | None = None,
    *,
    samples: int | None = None,
    random: Random | None = None,
    seed: int | None = None,
    budget: float | None = None,
    why: bool = False,
    threads: int | None = None,
    executor: Executor | None = None,
    out: Path | None = None,
    resume: bool = False,
    overwrite: bool = False,
    shard: str | None = None,
    progress: Progress = None,
) -> xr.Dataset:
    """Classifies the motion in every cell of a grid over one or two parameters or coordinates of the start, from one or more initial states each.

    Parameters
    ----------
    model
        The model; it provides the parameters that no axis varies.
    axes
        Names of parameters, or of coordinates of the initial shape (a map of basins), with values: an array, or text as on the command
        line (``"0.1:1.6:64"`` is 64 values, both ends included). By default those of the model's study file.
    samples
        Initial states per cell: random, except that the first one is the model's ``initial`` if that is given, or an axis is a coordinate of it.
    random
        Size of random initial states: a size (each coordinate within ±size; by default 0.01 for one state per cell), or ``(min, max)``: all
        directions, with a log-uniform norm in this range (by default a hundredth of the model's typical size to the full size for several).
    budget
        Maximum model time for classifying one motion; 0 is the model's default.
    why
        Keep the evidence of each row as text; this takes more memory than all numbers.
    threads
        Number of threads of this process; by default all cores.
    executor
        Any ``concurrent.futures.Executor`` (process pools, ``dask.distributed``'s ``client.get_executor()``,
        ``mpi4py.futures``): work is submitted in tasks of 0.2 s or more, and lost tasks are submitted again.
    out, resume, overwrite, shard
        A folder to which the rows are written as they are computed, what to do if it exists, and the share ``"I/N"`` to compute;
        as ``--out --resume --force --shard`` on the command line.

    Returns
    -------
    xarray.Dataset
        Dimensions: the axes (the first one last, so that it runs along x in figures) and ``sample``. Variables:
        ``regime``, ``attractor`` and ``course`` (codes with CF ``flag_meanings``, -1 where missing, or without a course; names by
        ``ds.motiform.names()``) and the numbers of each motion with ``units``, NaN where a number is not defined for
        the motion. ``ds.motiform.to_pandas()`` returns a data frame with categoricals, ``ds.motiform.plot()`` plots the diagram.

    The result has the same bits for any threads, workers, interruptions and resumes. Ctrl-C raises :class:`Interrupted` with the
    rows computed so far.

    More: docs/python.md, docs/clusters.md.
    """
    known_whole(samples=samples, seed=seed, threads=threads)
    if not hasattr(model, "_study") or not isinstance(axes, Mapping | None):
        raise TypeError(f"scan({reprlib.repr(model)}, {reprlib.repr(axes)}): give a body, and a mapping from parameters to values")
    made = None if axes is None else [(name, axis_of(name, values)) for name, values in axes.items()]
    study = model._study if random is None else model._study.with_(None, None, {"random": random})
    plan = _motiform.ScanPlan(study, made, samples, seed, budget)
    remark(study, (name for name, _ in plan.axes()))
    stopped = _first_dataset()
    with Bar(progress, plan.cells, "cells") as bar:
        show = bar.callable() if stopped is None else _stop
        if out is not None:
            opening = "resume" if resume else "replace" if overwrite else "new"
            files = _motiform.ScanFiles(os.fspath(out), plan, shard, opening)
            try:
                _warn_of(files.damaged())
                if executor is None:
                    raised = files.run(_threads(threads), show)
                else:
                    raised = gather(plan, executor, None, files, show)
            finally:
                del files  # gives the folder free; a traceback would keep it
            raised = raised or stopped
            result = read_scan(out, why, quiet=shard is not None or raised is not None)
        elif shard is not None:
            raise ValueError(f"shard = {shard!r}: a share of a scan needs a folder, give out=...")
        elif executor is None:
            arrays, raised = plan.compute(_threads(threads), why, show)
            result = dataset(plan, arrays)
        else:
            table = Table(plan, why)
            raised = gather(plan, executor, table, None, show)
            result = dataset(plan, table.arrays())
    if model.units is not None:
        result.attrs["units"] = str(model.units)
    raised = raised or stopped  # a scan may be over before it reports its progress
    if raised is not None:
        raise Interrupted(result) if isinstance(raised, KeyboardInterrupt) else raised
    return result


def _first_dataset() -> KeyboardInterrupt | None:
    """Makes a first dataset, for which xarray imports much for seconds. Ctrl-C does not end an import halfway.

    It is kept: the scan then ends with the rows that it has.
    """
    pressed: list[KeyboardInterrupt] = []
    # In other threads, and with a handler of the program's own, Ctrl-C raises nothing here.
    raises = current_thread() is main_thread() and signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if raises:
        signal.signal(signal.SIGINT, lambda *_: pressed.append(KeyboardInterrupt()))
    try:
        xr.Dataset({"first": ("x", [0])})
    finally:
        if raises:
            signal.signal(signal.SIGINT, signal.default_int_handler)
    return pressed[0] if pressed else None


def _stop(_: float) -> None:
    """Progress of a scan that was interrupted before it began."""
    raise KeyboardInterrupt


def merge(folders: Path | Sequence[Path], out: Path, *, overwrite: bool = False) -> xr.Dataset:
    """Merges the folders of a scan's shards into `out`, and reads it."""
    _, damaged = _motiform.merge(paths_of(folders), os.fspath(out), overwrite)
    _warn_of(damaged)
    return read_scan(out, False)


def read_scan(path: Path, why: bool, *, quiet: bool = False) -> xr.Dataset:
    """The dataset of a scan folder; missing rows have the regime -1."""
    plan, arrays, damaged = _motiform.read_scan(os.fspath(path), why)
    _warn_of(damaged)
    missing = int(np.count_nonzero(arrays[0][0] < 0))
    if missing and not quiet:
        text = f"{os.fspath(path)}: {missing} of {arrays[0][0].size} rows are not computed yet"
        warnings.warn(text, Incomplete, stacklevel=3)
    return dataset(plan, arrays)


class Table:
    """The rows of a whole scan, filled as tasks come back."""

    def __init__(self, plan: _motiform.ScanPlan, why: bool) -> None:
        rows = plan.cells * plan.samples
        self._samples = plan.samples
        self.regimes = np.full(rows, -1, np.int8)
        self.attractors = np.full(rows, -1, np.int8)
        self.courses = np.full(rows, -1, np.int8)
        self.numbers = [np.full(rows, np.nan) for _ in NUMBERS]
        self.whys = [""] * rows if why else None

    def put(self, first: int, arrays: _motiform.Arrays) -> None:
        """Takes in the rows of cells from `first` on."""
        (regimes, attractors, courses), numbers, whys = arrays
        place = slice(first * self._samples, first * self._samples + len(regimes))
        self.regimes[place] = regimes
        self.attractors[place] = attractors
        self.courses[place] = courses
        for column, values in zip(self.numbers, numbers, strict=True):
            column[place] = values
        if self.whys is not None and whys is not None:
            self.whys[place] = whys

    def arrays(self) -> _motiform.Arrays:
        """The rows as the native module gives them."""
        return (self.regimes, self.attractors, self.courses), self.numbers, self.whys


def dataset(plan: _motiform.ScanPlan, arrays: _motiform.Arrays) -> xr.Dataset:
    """Named dimensions, units and codes for the rows of a plan."""
    (regimes, attractors, courses), numbers, whys = arrays
    axes = plan.axes()
    dims = (*(name for name, _ in reversed(axes)), "sample")
    sizes = (*(len(values) for _, values in reversed(axes)), plan.samples)
    info = info_of(json.loads(plan.info()))
    said = {name: {"long_name": f"{meaning}, at the start", "symbol": f"{name}(0)"} for name, meaning in info.coordinates}
    said |= {spec.name: {"long_name": spec.meaning, "symbol": spec.symbol} for spec in info.parameters}
    coords: dict[str, Any] = {name: (name, values, said[name]) for name, values in axes}
    coords["sample"] = ("sample", np.arange(plan.samples), {"long_name": "number of the initial state"})
    variables: dict[str, Any] = {
        "regime": (dims, regimes.reshape(sizes), _flags("the motion", [regime.name for regime in REGIMES])),
        "attractor": (dims, attractors.reshape(sizes), _flags("the kind of reduced attractor", ATTRACTORS)),
        "course": (dims, courses.reshape(sizes), _flags("sense of rotation, or direction to the field", COURSES)),
    }
    for (name, meaning, unit), values in zip(NUMBERS, numbers, strict=True):
        variables[name] = (dims, values.reshape(sizes), {"long_name": meaning, "units": unit})
    if whys is not None:
        texts = np.array(whys, dtype=object).reshape(sizes)
        variables["why"] = (dims, texts, {"long_name": "the evidence in one sentence"})
    attrs: dict[str, Any] = {
        "model": plan.model,
        "title": plan.title,
        "motiform": VERSION,
        "plan": plan.to_json(),
        "plan_hash": plan.hash,
        "axes": [name for name, _ in axes],
    }
    return xr.Dataset(variables, coords, attrs | {f"parameter_{name}": value for name, value in plan.parameters})


def _flags(meaning: str, names: Sequence[str]) -> dict[str, Any]:
    """A categorical variable according to the CF conventions."""
    values = np.arange(len(names), dtype=np.int8)
    return {"long_name": meaning, "flag_values": values, "flag_meanings": " ".join(names)}


@xr.register_dataset_accessor("motiform")  # type: ignore[no-untyped-call]
class ScanAccessor:
    """Methods of the dataset of a scan: ``ds.motiform``."""

    def __init__(self, data: xr.Dataset) -> None:
        self._data = data

    def names(self, variable: str = "regime") -> xr.DataArray:
        """The names of ``regime`` (or ``attractor``, ``course``) codes; empty where a row is missing, or has no course."""
        codes = self._data[variable]
        names = np.array([*codes.attrs["flag_meanings"].split(), ""])
        return xr.DataArray(names[codes.values], codes.coords, codes.dims, attrs={"long_name": codes.long_name})

    def share(self, regime: str) -> xr.DataArray:
        """The share of initial states that lead to a regime, over the axes."""
        known = [entry.name for entry in REGIMES]
        if regime not in known:
            raise ValueError(f"regime = {regime!r}: the regimes are {', '.join(known)}")
        share: xr.DataArray = (self._data.regime == known.index(regime)).mean("sample")
        return share

    def to_pandas(self, *, cells: bool = False) -> pd.DataFrame:
        """One row per cell and sample; ``regime``, ``attractor`` and ``course`` are categoricals in the order of legends. `cells`
        adds the number of each cell, which is the order of rows in files."""
        frame = self._data.to_dataframe(dim_order=list(self._data["regime"].dims)).reset_index()
        if cells:
            frame.insert(0, "cell", np.arange(len(frame)) // self._data.sizes["sample"])
        for name in ("regime", "attractor", "course"):
            names = self._data[name].attrs["flag_meanings"].split()
            frame[name] = pd.Categorical.from_codes(frame[name].to_numpy(), categories=names)
        return frame

    def in_units(self, units: Asked = True) -> xr.Dataset:
        """A copy with speeds, rates, times and lengths in the units of the model that was scanned, or in others (``"20um,1min"``), as their
        ``units`` say. Axes, which are parameters or coordinates, stay in model units."""
        if "in_units" in self._data.attrs:
            raise ValueError(f"the numbers are in {self._data.attrs['in_units']} already")
        own = self._data.attrs.get("units")
        shown = chosen(units, None if own is None else Units(own))
        if shown is None:
            return self._data.copy()
        named = {name: power for name, power in dimensions("motion").items() if name in self._data.data_vars}
        made = {
            name: (self._data[name] * factor(shown, dimension)).assign_attrs(
                self._data[name].attrs | {"units": unit_name(shown, dimension)}
            )
            for name, dimension in named.items()
        }
        return self._data.assign(made).assign_attrs(self._data.attrs | {"in_units": str(shown)})

    def plot(self, ax: Any = None) -> Any:
        """The phase diagram: the most frequent motion of each cell, in the colours of every figure of motiform."""
        from .plotting import plot_scan

        return plot_scan(self._data, ax)


def _threads(threads: int | None) -> int:
    if threads is None:
        return os.cpu_count() or 1
    if threads < 1:
        raise ValueError(f"threads = {threads}: give at least 1")
    return threads


def _warn_of(damaged: Sequence[str]) -> None:
    for how in damaged:
        warnings.warn(how, Incomplete, stacklevel=4)
