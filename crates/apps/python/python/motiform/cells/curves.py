"""Figures of statistics: an observed cell alone, and among cells simulated by its fit."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

if TYPE_CHECKING:
    from .results import CellFit, Observation

_COLOURS = {"velocity": "#0072b2", "z2": "#d55e00", "z3": "#009e73", "z4": "#cc79a7"}
_SYMBOLS = {"velocity": "velocity", "z2": "$z_2$", "z3": "$z_3$", "z4": "$z_4$"}
_COLUMNS = 3


def plot_observation(found: Observation) -> Figure:
    """Mean-square displacement and autocorrelations with their 95 % intervals."""
    displacement, correlations = found.displacement, found.correlations
    if displacement.empty:
        raise ValueError(f"cell {found.cell} has no statistics to draw: {found.why}")
    length, time = found.units
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.6), layout="constrained")
    positive = displacement[(displacement["lag"] > 0.0) & (displacement["value"] > 0.0)]
    _curve(left, positive, "#0072b2", None)
    left.set(xscale="log", yscale="log", xlabel=f"lag $\\tau$ ({time})")
    left.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    left.xaxis.set_major_formatter("{x:g}")
    left.xaxis.set_minor_formatter(NullFormatter())
    left.set_ylabel(f"mean-square displacement ({length}$^2$)")
    for name, curve in correlations.items():
        _curve(right, curve, _COLOURS.get(name, "black"), _SYMBOLS.get(name, name))
    right.axhline(0.0, color="0.6", linewidth=0.8)
    right.set(xlabel=f"lag $\\tau$ ({time})", ylabel="autocorrelation", ylim=(-1.05, 1.05))
    right.legend(frameon=False)
    figure.suptitle(f"cell {found.cell}: {found.regime}")
    return figure


def plot_fit(found: CellFit) -> Figure:
    """Each statistic of the cell among those of the cells that its fit simulates."""
    names = list(found.simulated["statistic"])
    if not names:
        raise ValueError(f"cell {found.cell} has no simulated cells to compare with: {found.why}")
    rows = math.ceil(len(names) / _COLUMNS)
    figure, axes = plt.subplots(
        rows, _COLUMNS, figsize=(3.3 * _COLUMNS, 2.6 * rows), layout="constrained", squeeze=False
    )
    for ax, name, verdict in zip(axes.flat, names, found.simulated["verdict"], strict=False):
        curve = found.bands(name)
        ax.fill_between(curve["at"], curve["low"], curve["high"], color="#9ecae1", linewidth=0, label="simulated, 95 %")
        ax.plot(curve["at"], curve["median"], color="#3182bd", linewidth=1.0, label="simulated, median")
        ax.plot(curve["at"], curve["observed"], color="black", linewidth=1.4, label="observed")
        ax.set_title(f"{name}: {verdict}", fontsize="small")
        ax.set_xlabel(_axis(found, name), fontsize="small")
        ax.set_ylabel(_unit(found, name), fontsize="small")
    for ax in axes.flat[len(names) :]:
        ax.set_visible(False)
    axes.flat[0].legend(frameon=False, fontsize="x-small")
    figure.suptitle(f"cell {found.cell}: {found.regime}")
    return figure


def _curve(ax: Axes, curve: pd.DataFrame, colour: str, label: str | None) -> None:
    known = np.isfinite(curve["lower"]) & np.isfinite(curve["upper"])
    ax.fill_between(
        curve["lag"][known], curve["lower"][known], curve["upper"][known], color=colour, alpha=0.2, linewidth=0
    )
    ax.plot(curve["lag"], curve["value"], color=colour, linewidth=1.3, label=label)


def _axis(found: CellFit, name: str) -> str:
    raw = next(one for one in found.summary["simulated"]["statistics"] if one["statistic"] == name)
    return f"lag ({found.units[1]})" if raw["axis"] == "lag" else "share of the record (%)"


def _unit(found: CellFit, name: str) -> str:
    length, time = found.units
    if name == "mean-square displacement":
        return f"{length}$^2$"
    if name.startswith("size"):
        return length
    return {"speed": f"{length}/{time}", "turning angle": "rad"}.get(name, "")
