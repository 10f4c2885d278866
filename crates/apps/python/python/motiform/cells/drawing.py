"""Figures of a tracked cell."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from ..plotting import TIME_COLOURS
from ..trajectory import Floats

if TYPE_CHECKING:
    from .sample import Cell


def plot_cell(cell: Cell, outlines: int, units: tuple[str, str], y_down: bool) -> Figure:
    """A film strip of outlines at equal times, and the path with the same outlines."""
    shown = [entry for entry in cell.outlines if len(entry[1]) > 2]
    if outlines < 1 or not shown:
        raise ValueError(f"outlines = {outlines} of {len(shown)}: give at least 1 of at least 1")
    rows = np.unique(np.linspace(0, len(shown) - 1, outlines).round().astype(int))
    film = [shown[row] for row in rows]
    times = Normalize(shown[0][0], max(shown[-1][0], np.nextafter(shown[0][0], np.inf)))
    figure, (strip, path) = plt.subplots(
        2, 1, figsize=(6.4, 6.0), layout="constrained", gridspec_kw={"height_ratios": [1, 4]}
    )
    _strip(strip, film, times)
    _path(path, cell, film, times)
    path.set(xlabel=f"$x$ ({units[0]})", ylabel=f"$y$ ({units[0]})")
    figure.colorbar(plt.cm.ScalarMappable(times, TIME_COLOURS), ax=path, label=f"$t$ ({units[1]})")
    figure.suptitle(f"cell {cell.name}")
    if y_down:
        strip.invert_yaxis()
        path.invert_yaxis()
    return figure


def _strip(ax: Axes, film: list[tuple[float, Floats]], times: Normalize) -> None:
    """Outlines side by side, each about the middle of its box."""
    width = 1.15 * max(float(np.ptp(points, axis=0).max()) for _, points in film)
    for number, (t, points) in enumerate(film):
        middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
        colour = TIME_COLOURS(times(t))
        placed = points - middle + [number * width, 0.0]
        ax.add_patch(Polygon(placed, closed=True, facecolor=(*colour[:3], 0.25), edgecolor=colour))
    ax.set(xlim=(-0.6 * width, (len(film) - 0.4) * width), ylim=(-0.6 * width, 0.6 * width))
    ax.set_aspect("equal")
    ax.set_axis_off()


def _path(ax: Axes, cell: Cell, film: list[tuple[float, Floats]], times: Normalize) -> None:
    """The centres of the frames that count, coloured by time, with the outlines of the strip."""
    modes = cell.modes
    counts = ~modes["left_out"].values
    centres = np.column_stack([modes["x"].values, modes["y"].values])[counts]
    segments = np.stack((centres[:-1], centres[1:]), axis=1)
    line = LineCollection(list(segments), cmap=TIME_COLOURS, norm=times, array=modes["t"].values[counts][:-1], linewidths=1.2)
    ax.add_collection(line)
    for t, points in film:
        colour = TIME_COLOURS(times(t))
        ax.add_patch(Polygon(points, closed=True, facecolor=(*colour[:3], 0.12), edgecolor=colour, linewidth=0.8))
    ax.autoscale_view()
    ax.set_aspect("equal", adjustable="datalim")
