"""Files and arrays -> cells."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd
from PIL import Image

from .. import _motiform
from ..calls import paths_of
from ..trajectory import Floats
from .sample import Cells

Outlines = Mapping[str, Iterable[tuple[float, Any]]]
"""Outlines of each cell: pairs of a time and an (n, 2) array, or a polygon with ``exterior.coords`` as those of shapely."""

Path = str | os.PathLike[str]

LARGEST = 2**16 - 1
"""The largest label of an image."""


def read(
    path: Path | Sequence[Path] | pd.DataFrame,
    *,
    interval: float | None = None,
    pixel_size: float | None = None,
    time_unit: str | None = None,
    length_unit: str | None = None,
    format: str | None = None,
    columns: Mapping[str, str] | None = None,
) -> Cells:
    """Reads outlines of tracked cells.

    Parameters
    ----------
    path
        A file, or several that form one data set; or a table in memory, with the columns that a CSV file would have.
    interval
        Time between frames in `time_unit`. If neither the file nor this says it, times are in frames.
    pixel_size
        Length of a pixel in `length_unit`. If neither the file nor this says it, lengths are in pixels.
    time_unit
        Unit of `interval`, s where none is given, or of times in the file whose unit it does not say: without it these are in frames.
    length_unit
        Unit of `pixel_size`, um where none is given.
    format
        ``csv``, ``parquet``, ``trackmate``, ``quimp-csv``, ``quimp-snqp``, ``amoepy``, ``roi``, ``roi-zip``, ``masks`` or ``wkt``,
        where the content fits several formats.
    columns
        Headers of the columns of a table, where they are not the usual ones: ``{"frame": "t", "x": "pos_x"}`` for ``cell``,
        ``frame``, ``i``, ``x``, ``y`` and ``wkt``.

    Raises
    ------
    ValueError
        For content that cannot be read, with the place in the file; ``OSError`` if the file cannot be opened.
    """
    if isinstance(path, pd.DataFrame):
        with TemporaryDirectory() as place:
            file = os.path.join(place, "table.csv")
            path.to_csv(file, index=any(name is not None for name in path.index.names))
            return _in_memory(file, (pixel_size, interval, (length_unit, time_unit), format, _named(columns)))
    return Cells(_motiform.Sample.read(paths_of(path), (pixel_size, interval, (length_unit, time_unit), format, _named(columns))))


def read_masks(
    path: Path | Sequence[Path] | npt.NDArray[np.integer[Any]],
    *,
    interval: float | None = None,
    pixel_size: float | None = None,
    time_unit: str | None = None,
    length_unit: str | None = None,
) -> Cells:
    """Reads label masks (TIFF or PNG): a folder, an image, a stack of images in one TIFF, or several images; or an array (frames, y, x).

    The pixels of a cell have its number, the same in all frames; 0 is the background. Numbers at the end of the names are the
    frames (``mask007.tif``). In a folder, ``res_track.txt`` or ``man_track.txt`` of the Cell Tracking Challenge says which cells
    come from which. The outline of a cell is the contour at half level around its largest part; y points down.
    """
    if isinstance(path, np.ndarray):
        with TemporaryDirectory() as place:
            first, *others = _images(path)
            file = os.path.join(place, "masks.tif")
            first.save(file, save_all=True, append_images=others)
            return _in_memory(file, (pixel_size, interval, (length_unit, time_unit), "masks", []))
    return read(
        path,
        interval=interval,
        pixel_size=pixel_size,
        time_unit=time_unit,
        length_unit=length_unit,
        format="masks",
    )


def _named(columns: Mapping[str, str] | None) -> list[tuple[str, str]]:
    """Other names of columns."""
    known = ("cell", "frame", "i", "x", "y", "wkt")
    named = dict(columns or {})
    if unknown := [name for name in named if name not in known]:
        raise ValueError(f"columns has no {unknown[0]!r}: the columns are {', '.join(known)}")
    return list(named.items())


def _in_memory(file: str, asked: Any) -> Cells:
    """Cells of a file that stands for data in memory: neither results nor errors name it."""
    try:
        return Cells(_motiform.Sample.read([file], asked, True))
    except ValueError as error:
        raise ValueError(str(error).replace(file, "the data")) from None


def _images(labels: npt.NDArray[Any]) -> list[Image.Image]:
    """An image for each frame of an array of labels."""
    if labels.dtype.kind not in "iu" or labels.ndim != 3:
        raise TypeError(f"labels must be an array of whole numbers, (frames, y, x), not {labels.dtype} of shape {labels.shape}")
    if not labels.size or labels.min() < 0 or labels.max() > LARGEST:
        raise ValueError(f"labels: give at least one frame, with whole numbers from 0 to {LARGEST}")
    return [Image.fromarray(frame.astype(np.uint16)) for frame in labels]


def from_arrays(
    outlines: Outlines, *, length_unit: str = "pixel", time_unit: str = "frame", y_down: bool | None = None
) -> Cells:
    """Cells from outlines in memory: ``{name: [(t, outline), ...]}``.

    An outline is an (n, 2) array or a polygon with ``exterior.coords``, such as those of shapely. Frames are counted in intervals
    of time, so that missing ones are gaps.
    """
    if not isinstance(outlines, Mapping):
        raise TypeError(f"outlines must be {{name: [(t, outline), ...]}}, not {type(outlines).__name__}")
    cells = [(str(name), _frames(str(name), frames)) for name, frames in outlines.items()]
    return Cells(_motiform.Sample.given(cells, ((length_unit, time_unit), y_down)))


def _frames(name: str, frames: Iterable[tuple[float, Any]]) -> list[tuple[float, Floats]]:
    found: dict[float, Floats] = {}
    for entry in frames:
        try:
            t, outline = entry
            time = float(t)
        except (TypeError, ValueError):
            raise TypeError(f"cell {name}: give pairs of a time and an outline: [(0.0, points), (1.0, points), ...]") from None
        if not math.isfinite(time):
            raise ValueError(f"cell {name}: the time {t} is not a finite number")
        if time in found:
            raise ValueError(f"cell {name}: there are several outlines at the time {t}")
        found[time] = _vertices(name, time, outline)
    return list(found.items())


def _vertices(name: str, t: float, outline: Any) -> Floats:
    exterior = getattr(outline, "exterior", None)
    points = np.asarray(outline if exterior is None else exterior.coords)
    if exterior is not None:
        points = points[:, :2] if points.size else np.empty((0, 2))  # without heights
    if points.dtype.kind not in "fiub":
        raise TypeError(f"cell {name}, time {t}: an outline must hold real numbers, not {points.dtype}")
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"cell {name}, time {t}: an outline must have the shape (n, 2), not {points.shape}")
    return np.ascontiguousarray(points, dtype=np.float64)
