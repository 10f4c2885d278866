"""Label masks -> cells: images in which every pixel has the number of its cell."""

from __future__ import annotations

import importlib
import os
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from .. import _motiform
from ..trajectory import Floats
from .sample import Cells

_IMAGES = (".tif", ".tiff", ".png")
_TRACKS = ("res_track.txt", "man_track.txt")


def read_masks(
    path: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    *,
    interval: float | None = None,
    pixel_size: float | None = None,
    time_unit: str = "s",
    length_unit: str = "um",
) -> Cells:
    """Reads label masks (TIFF or PNG): a folder, an image, a stack of images in one TIFF, or files in their order.

    The pixels of a cell have its number, the same in all frames; 0 is the background. In a folder, numbers at the end of the names
    are the frames (``mask007.tif``), and ``res_track.txt`` or ``man_track.txt`` of the Cell Tracking Challenge says which cells
    come from which. The outline of a cell is the contour around its largest part; y points down.

    Needs the extra ``cells``: ``pip install "motiform[cells]"``.
    """
    paths = [Path(path)] if isinstance(path, (str, os.PathLike)) else [Path(one) for one in path]
    if not paths:
        raise ValueError("there is no file to read: give at least one")
    folder = paths[0] if len(paths) == 1 and paths[0].is_dir() else None
    files = _files(folder) if folder is not None else list(enumerate(paths))
    for setting, value in (("pixel_size", pixel_size), ("interval", interval)):
        if value is not None and not (np.isfinite(value) and value > 0.0):
            raise ValueError(f"{setting} = {value}: give a finite number above 0")
    scale, step = pixel_size or 1.0, interval or 1.0
    cells: dict[int, list[tuple[int | None, float, Floats]]] = {}
    sizes: set[tuple[int, int]] = set()
    parts: dict[int, int] = {}
    for frame, image in _images(files):
        sizes.add((image.shape[1], image.shape[0]))
        for label, points, count in _outlines(image):
            cells.setdefault(label, []).append((frame, frame * step, points * scale))
            if count > 1:
                parts[label] = parts.get(label, 0) + 1
    if not cells:
        raise ValueError(f"{paths[0]}: all pixels are 0: there is no cell")
    if len(sizes) > 1:
        raise ValueError(f"{paths[0]}: the images have different sizes: {', '.join(map(str, sorted(sizes)))}")
    ((width, height),) = sizes
    units = (length_unit if pixel_size else "pixel", time_unit if interval else "frame")
    image_size = ([width * scale, height * scale], scale)
    named = [(str(label), frames) for label, frames in sorted(cells.items())]
    of_cells = {
        str(label): [f"cell {label}: several parts in {count} frames; the largest is kept"]
        for label, count in sorted(parts.items())
    }
    notes = []
    if pixel_size is None:
        notes.append("no scale: lengths are in pixels; give pixel_size")
    if interval is None:
        notes.append("no frame interval: times are in frames; give interval")
    if folder is not None:
        for name, note in _divisions(folder).items():
            of_cells.setdefault(name, []).append(note)
    return Cells(_motiform.Sample.given(named, (units, True, image_size)), notes, of_cells)


def _needed(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = {"skimage.measure": "scikit-image", "imageio.v3": "imageio"}.get(name, name)
        raise ImportError(
            f'label masks need {package}: install the extra cells, pip install "motiform[cells]"'
        ) from error


def _files(folder: Path) -> list[tuple[int, Path]]:
    """The images of a folder with their frames: the last number of each name."""
    images = sorted(one for one in folder.iterdir() if one.suffix.lower() in _IMAGES)
    if not images:
        raise ValueError(f"{folder}: no image: names must end with {', '.join(_IMAGES)}")
    numbers = [re.findall(r"\d+", image.stem) for image in images]
    frames = [int(found[-1]) for found in numbers if found]
    if len(frames) < len(images) or len(set(frames)) < len(images):
        return list(enumerate(images))
    return sorted(zip(frames, images, strict=True))


def _images(files: Sequence[tuple[int, Path]]) -> Iterator[tuple[int, npt.NDArray[Any]]]:
    """Images one by one; a stack is as many frames."""
    for frame, path in files:
        if path.suffix.lower() == ".png":
            image = np.asarray(_needed("imageio.v3").imread(path))
        else:
            image = np.asarray(_needed("tifffile").imread(path))
        if image.dtype.kind not in "uib":
            raise ValueError(f"{path}: pixels are {image.dtype}: a label mask has whole numbers")
        if image.ndim == 2:
            yield frame, image
        elif image.ndim == 3 and image.shape[2] not in (3, 4) and len(files) == 1:
            yield from enumerate(image)
        else:
            raise ValueError(f"{path}: an image of shape {image.shape}: a label mask has one number per pixel")


def _outlines(image: npt.NDArray[Any]) -> Iterator[tuple[int, Floats, int]]:
    """Label, outline of the largest part in (x, y), and number of parts, of each cell. The first pixel spans 0 to 1."""
    find_contours, regions = _needed("skimage.measure").find_contours, _needed("skimage.measure").regionprops
    inside = image > 0
    labels, places = np.unique(image[inside], return_inverse=True)
    dense = np.zeros(image.shape, np.int64)
    dense[inside] = places.ravel() + 1  # labels may be any numbers
    for region in regions(dense):
        mask = np.pad(region.image, 1).astype(float)
        contours = find_contours(mask, 0.5)
        areas = [_area(contour) for contour in contours]
        largest = max(range(len(areas)), key=lambda place: abs(areas[place]))
        top, left = region.bbox[:2]
        points = contours[largest][:-1, ::-1] + [left - 0.5, top - 0.5]  # padded by a pixel whose middle is at 0
        count = sum(area * areas[largest] > 0.0 for area in areas)
        yield int(labels[region.label - 1]), np.ascontiguousarray(points), count


def _area(contour: Floats) -> float:
    """The signed area: parts and holes have opposite signs."""
    x, y = contour[:, 1], contour[:, 0]
    return 0.5 * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))


def _divisions(folder: Path) -> dict[str, str]:
    """What the table of tracks says about divisions, by cell."""
    table = next((folder / name for name in _TRACKS if (folder / name).exists()), None)
    if table is None:
        return {}
    found: dict[int, list[int]] = {}
    for number, line in enumerate(table.read_text(encoding="utf-8").splitlines(), 1):
        words = line.split()
        if not words:
            continue
        if len(words) != 4 or not all(re.fullmatch(r"-?\d+", word) for word in words):
            raise ValueError(f"{table}, line {number}: {line!r}, where label, begin, end and parent are expected")
        label, _, _, parent = map(int, words)
        if parent:
            found.setdefault(parent, []).append(label)
    into = {parent: ", ".join(map(str, labels)) for parent, labels in sorted(found.items())}
    return {str(parent): f"cell {parent} becomes {labels}" for parent, labels in into.items()}
