"""Figures with matplotlib, in the colours and markers of all figures of motiform."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap, to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon
from matplotlib.path import Path

from ._registry import REGIMES, Regime
from .units import LENGTH, TIME, Units, dimensions, factor, label
from .units import name as unit_name

if TYPE_CHECKING:
    import xarray as xr

    from .atlases import Atlas
    from .branches import Branches
    from .curves import Curves
    from .lifetimes import Lifetimes
    from .measurements import Statistics
    from .trajectory import Trajectory

TIME_COLOURS = ListedColormap(plt.get_cmap("viridis")(np.linspace(0.0, 0.9, 256)), name="time")
"""Without the brightest colours, which are hard to see on white paper."""
_ZIGZAG = Path([(-1.0, -0.5), (-0.5, 0.5), (0.0, -0.5), (0.5, 0.5), (1.0, -0.5)])
_MARKERS: dict[str, Any] = {
    "Disc": "o", "Ring": "o", "Triangle": "^", "DownTriangle": "v", "Square": "s", "Diamond": "D",
    "Zigzag": _ZIGZAG, "Star": (6, 2, 0), "Cross": "x", "Question": "$?$",
}  # fmt: skip


def regime_mark(regime: Regime, size: float = 7.0) -> Line2D:
    """The marker of a regime, for legends."""
    hollow = regime.glyph in ("Ring", "Zigzag")
    return Line2D(
        [], [], linestyle="none", label=regime.name, markersize=size, color=regime.colour,
        marker=_MARKERS[regime.glyph], markerfacecolor="none" if hollow else regime.colour, markeredgewidth=1.4,
    )  # fmt: skip


def plot_path(run: Trajectory, ax: Axes | None, outlines: int, units: Units | None) -> Axes:
    """The path coloured by time, with outlines of the body at equal distances along it."""
    ax = plt.subplots(layout="constrained")[1] if ax is None else ax
    size, rate = factor(units, LENGTH), factor(units, TIME)
    path = size * run.position
    segments = np.stack((path[:-1], path[1:]), axis=1)
    line = LineCollection(list(segments), cmap=TIME_COLOURS, array=rate * run.t[:-1], linewidths=1.2, zorder=2)
    ax.add_collection(line)
    scale = drawn_scale(run)
    for row in _rows_along(path, outlines):
        curve = run.outline(float(run.t[row]), scale=scale)
        if curve is not None:
            colour = line.to_rgba(rate * run.t[row])
            ax.add_patch(Polygon(size * curve, closed=True, facecolor=(*colour[:3], 0.15), edgecolor=colour, zorder=3))
    ax.autoscale_view()
    ax.set_aspect("equal", adjustable="datalim")
    ax.locator_params(axis="x", nbins=6)
    ax.set(xlabel=label("$x$", units, LENGTH), ylabel=label("$y$", units, LENGTH))
    ax.figure.colorbar(line, ax=ax, label=label("$t$", units, TIME))
    if scale != 1.0:
        ax.set_title(f"body drawn {scale:g} times its size", fontsize="small", loc="right")
    return ax


def drawn_scale(run: Trajectory) -> float:
    """1 if the size of the body suits its path; otherwise a round factor that makes it visible."""
    extent = float(np.ptp(run.position, axis=0).max()) if len(run) else 0.0
    if extent <= 0.0:
        return 1.0
    share = run.radius / extent
    if 0.015 <= share <= 0.3:
        return 1.0
    wanted = 0.035 / share
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(power * min((1.0, 2.0, 5.0, 10.0), key=lambda step: abs(np.log(step * power / wanted))))


def _rows_along(path: Any, count: int) -> list[int]:
    """Rows at equal distances along a path."""
    if count < 1 or len(path) == 0:
        return []
    travelled = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))))
    if travelled[-1] == 0.0:
        return [0]
    places = np.searchsorted(travelled, np.linspace(0.0, travelled[-1], count))
    return sorted({min(int(place), len(path) - 1) for place in places})


def animate(run: Trajectory, frames: int, interval: float, units: Units | None) -> FuncAnimation:
    """The moving body, with its trail; the view is fixed and shows the whole path."""
    if frames < 1 or len(run) == 0:
        raise ValueError(f"frames = {frames} of {len(run)} rows: give at least 1 of at least 1")
    figure, ax = plt.subplots(layout="constrained")
    size = factor(units, LENGTH)
    scale, path = drawn_scale(run), size * run.position
    rows = np.unique(np.linspace(0, len(run) - 1, frames).astype(int))
    (trail,) = ax.plot([], [], color="0.6", linewidth=1.0)
    body = Polygon(np.zeros((3, 2)), closed=True, facecolor="#0072b233", edgecolor="#0072b2")
    ax.add_patch(body)
    margin = 1.5 * scale * size * run.radius
    low, high = path.min(axis=0) - margin, path.max(axis=0) + margin
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    ax.set(xlabel=label("$x$", units, LENGTH), ylabel=label("$y$", units, LENGTH))
    ax.set_aspect("equal", adjustable="box")
    ax.locator_params(axis="x", nbins=4)
    clock = ax.set_title("")

    def show(row: int) -> list[Any]:
        curve = run.outline(float(run.t[row]), scale=scale)
        body.set_visible(curve is not None)
        if curve is not None:
            body.set_xy(size * curve)
        trail.set_data(path[: row + 1, 0], path[: row + 1, 1])
        unit = "(model time)" if units is None else unit_name(units, TIME)
        clock.set_text(f"$t$ = {factor(units, TIME) * run.t[row]:.1f} {unit}")
        return [body, trail, clock]

    film = FuncAnimation(figure, show, frames=[int(row) for row in rows], interval=interval)
    plt.close(figure)  # or a notebook shows the first frame beside the film
    return film


def plot_scan(data: xr.Dataset, ax: Axes | None) -> Axes:
    """The most frequent motion of each cell; if several occur, ``ds.motiform.share`` gives the shares of the others."""
    ax = plt.subplots(layout="constrained")[1] if ax is None else ax
    axes: list[str] = list(data.attrs["axes"])
    shares = np.stack([data.motiform.share(regime.name).values for regime in REGIMES])
    symbols = {name: "$" + data[name].attrs["symbol"].replace("*", "") + "$" for name in axes}
    handles: list[Any]
    if len(axes) == 2:
        most = np.where(shares.sum(axis=0) > 0.0, shares.argmax(axis=0), len(REGIMES))
        drawn = [(place, regime) for place, regime in enumerate(REGIMES) if np.any(most == place)]
        colours = ListedColormap([regime.area for regime in REGIMES] + ["#ffffff"])
        x, y = (data[name].values for name in axes)
        ax.pcolormesh(x, y, most, cmap=colours, vmin=-0.5, vmax=len(REGIMES) + 0.5, shading="nearest")
        for place, regime in drawn:
            rows, columns = _marked(most == place)
            ax.plot(x[columns], y[rows], **_on_area(regime))
        handles = [
            (Patch(facecolor=regime.area, edgecolor="0.4", linewidth=0.6), Line2D([], [], **_on_area(regime)))
            for _, regime in drawn
        ]
        ax.locator_params(axis="x", nbins=6)
        ax.set(xlabel=symbols[axes[0]], ylabel=symbols[axes[1]])
    else:
        drawn = [(place, regime) for place, regime in enumerate(REGIMES) if np.any(shares[place] > 0.0)]
        handles = [regime_mark(regime) for _, regime in drawn]
        for (place, _), mark in zip(drawn, handles, strict=True):
            shown = shares[place] > 0.0
            ax.plot(data[axes[0]].values[shown], shares[place][shown], linestyle="none", marker=mark.get_marker(),
                    color=mark.get_color(), markerfacecolor=mark.get_markerfacecolor())  # fmt: skip
        ax.set(xlabel=symbols[axes[0]], ylabel="share of the initial states", ylim=(-0.02, 1.05))
    labels = [regime.name for _, regime in drawn]
    ax.legend(handles, labels, loc="center left", bbox_to_anchor=(1.02, 0.5), frameon=False, handleheight=1.4)
    ax.set_title(data.attrs["title"])
    return ax


def _on_area(regime: Regime) -> dict[str, Any]:
    """The marker of a regime on its own area, so that regimes can be distinguished without colours."""
    red, green, blue = to_rgb(regime.area)
    ink = "#ffffff" if 0.3 * red + 0.59 * green + 0.11 * blue < 0.45 else "#000000"
    hollow = regime.glyph in ("Ring", "Zigzag")
    return {
        "linestyle": "none", "marker": _MARKERS[regime.glyph], "markersize": 4.0, "color": ink, "alpha": 0.75,
        "markerfacecolor": "none" if hollow else ink, "markeredgewidth": 0.8,
    }  # fmt: skip


def _marked(cells: Any) -> tuple[Any, Any]:
    """Rows and columns of the cells that get a marker: at most about twenty along each axis, but at least one."""
    steps = [max(1, -(-size // 20)) for size in cells.shape]
    rows, columns = np.nonzero(cells)
    kept = (rows % steps[0] == steps[0] // 2) & (columns % steps[1] == steps[1] // 2)
    return (rows[kept], columns[kept]) if kept.any() else (rows[:1], columns[:1])


_SPECIAL = {
    "fold": (6, 2, 0), "pitchfork": "D", "hopf": "o", "period-doubling": "^", "symmetry-breaking": "s", "torus": "P",
    "branch-point": "v", "continuum": "h",
}  # fmt: skip


def plot_branches(found: Branches, y: str, ax: Axes | None) -> Axes:
    """Thick where stable, thin and dashed where not, in the colours of the motions; markers at special points."""
    ax = plt.subplots(layout="constrained")[1] if ax is None else ax
    colours = {regime.name: regime.colour for regime in REGIMES}
    motions: list[str] = []
    for branch in found.branches:
        table = branch.points
        at, value = table[found.along].to_numpy(), np.abs(table[y].to_numpy(float))
        plain = (table["special"] == "").to_numpy()
        stable, motion = table["stable"].to_numpy(), table["motion"].to_numpy()
        for k in range(len(table) - 1):
            known = k if plain[k] else k + 1
            style: dict[str, Any] = {"lw": 2.6} if stable[known] else {"lw": 1.0, "ls": (0, (4, 2))}
            ax.plot(at[k : k + 2], value[k : k + 2], color=colours[motion[known]], **style)
            if motion[known] not in motions:
                motions.append(motion[known])
    keys = [Line2D([], [], color=colours[name], lw=2.6, label=name) for name in motions]
    points = found.points
    for kind, marker in _SPECIAL.items():
        here = points[points["special"] == kind]
        if len(here):
            style = {"marker": marker, "color": "0.13", "ls": "none", "ms": 5}
            ax.plot(here[found.along], here[y].abs(), zorder=3, **style)
            keys.append(Line2D([], [], label=kind, **style))
    ax.legend(handles=keys, fontsize="small")
    columns = dimensions("motion")
    ylabel = label(y.replace("_", " "), found.units, columns[y]) if y in columns else y
    ax.set(xlabel=found.along, ylabel=ylabel)
    return ax


_STATISTICS: dict[str, tuple[str, str, str]] = {
    "msd": ("lag", "msd", "log"), "exponent": ("lag", "exponent", "log"),
    "autocorrelations": ("lag", "correlation", "linear"), "spectra": ("frequency", "power", "log"),
    "first_passage": ("radius", "mean", "log"), "speed": ("from", "density", "linear"),
    "turning_angle": ("from", "density", "linear"),
}  # fmt: skip


_WORDS = {
    "msd": "mean-square displacement", "exponent": "d ln MSD / d ln lag", "correlation": "$C$(lag)/$C$(0)",
    "mean": "mean first-passage time",
}  # fmt: skip


def _axis(name: str, units: Units | None) -> tuple[str, float]:
    """The label of an axis and the factor of its numbers. What has no single unit stays in model units."""
    if name == "power":
        return "power spectral density (unit$^2$ × time)", 1.0
    if name == "frequency":
        return f"frequency (cycles per {unit_name(units, TIME)})", factor(units, dimensions("statistic")[name])
    if name == "turning_angle":
        return "turning angle (rad)", 1.0
    dimension = dimensions("state", "statistic").get(name, (0, 0))
    return label(_WORDS.get(name, name), units, dimension), factor(units, dimension)


def plot_lifetimes(found: Lifetimes, ax: Axes | None) -> Axes:
    """Mean lives with their 95 % limits; an arrow upwards where only the lower limit is known."""
    ax = plt.subplots(layout="constrained")[1] if ax is None else ax
    table = found.values[found.values["watched"] > 0.0]
    known, above = table[table["events"] > 0], table[table["events"] == 0]
    off = [known["life"] - known["lower"], known["upper"] - known["life"]]
    ax.errorbar(known[found.parameter], known["life"], yerr=off, fmt="o", ms=4, capsize=2)
    ax.errorbar(above[found.parameter], above["lower"], yerr=0.2 * above["lower"], fmt="_", lolims=True, color="grey")
    ax.set(yscale="log", xlabel=found.parameter, ylabel=label("mean life", found.units if not found.in_model_units else None, TIME))
    return ax


def plot_statistics(found: Statistics, what: str, ax: Axes | None, units: Units | None) -> Axes:
    """A curve per quantity with its 95 % band; displacements with the fitted walk."""
    if what not in _STATISTICS:
        raise ValueError(f"what = {what!r}: choose one of {', '.join(_STATISTICS)}")
    ax = plt.subplots(layout="constrained")[1] if ax is None else ax
    x, y, scale = _STATISTICS[what]
    if what in ("speed", "turning_angle"):
        _plot_distribution(found, what, ax, units)
    else:
        (across, by_x), (upwards, by_y) = _axis(x, units), _axis(y, units)
        table = found.msd if what == "exponent" else getattr(found, what)
        ends = ("exponent_lower", "exponent_upper") if what == "exponent" else ("lower", "upper")
        groups = table.groupby("quantity", sort=False) if "quantity" in table else [("measured", table)]
        for name, rows in groups:
            at, (low, high) = by_x * rows[x], (by_y * rows[end] for end in ends)
            (line,) = ax.plot(at, by_y * rows[y], marker="o" if what == "first_passage" else "", ms=4, label=name)
            ax.fill_between(at, low, high, color=line.get_color(), alpha=0.22, lw=0)
        ax.set(xscale=scale, yscale="linear" if what == "exponent" else scale)
        ax.set(xlabel=across, ylabel=upwards)
    if what == "msd":
        _plot_walk(found, ax, (factor(units, TIME), factor(units, (2, 0))))
    ax.legend(fontsize="small")
    return ax


def _plot_distribution(found: Statistics, what: str, ax: Axes, units: Units | None) -> None:
    words, by = _axis(what, units)
    table = found.distributions[found.distributions["quantity"] == what]
    for lag, rows in table.groupby("lag", dropna=False, sort=False):
        edges = by * np.array([*rows["from"], rows["to"].iloc[-1]])
        name = what if np.isnan(lag) else f"lag {factor(units, TIME) * lag:.4g}"
        steps = ax.stairs(rows["density"] / by, edges, label=name, baseline=None)
        low, high = (np.array([*rows[end], rows[end].iloc[-1]]) / by for end in ("lower", "upper"))
        ax.fill_between(edges, low, high, step="post", color=steps.get_edgecolor(), alpha=0.22, lw=0)
    ax.set(xlabel=words, ylabel="probability density")
    ax.set_ylim(bottom=0.0)


def _plot_walk(found: Statistics, ax: Axes, by: tuple[float, float]) -> None:
    lag = found.msd["lag"]

    def line(x: Any, y: Any, style: str, name: str) -> None:
        ax.plot(by[0] * x, by[1] * y, color="0.13", lw=1.0, ls=style, label=name)

    if found.persistence.known or found.walk_speed.known:
        line(lag, found.msd["fit"], "-", "persistent random walk")
    if found.walk_speed.known:
        early = lag[lag <= 4.0 * (found.persistence.value if found.persistence.known else np.inf)]
        line(early, (found.walk_speed.value * early) ** 2, "--", "ballistic")
    late = found.summary["diffusion"]["line"]
    if found.late_diffusion.known and late:
        rising = lag[lag >= found.summary["diffusion"]["lags"][0] / 4.0]
        values = late[0] + late[1] * rising
        line(rising[values > 0], values[values > 0], ":", "diffusive")


_CURVES: dict[str, Any] = {
    "hopf": "-", "fold": (0, (1, 1)), "pitchfork": "--", "symmetry-breaking": "-.", "period-doubling": ":",
    "torus": (0, (6, 2, 1, 2, 1, 2)),
}  # fmt: skip


def plot_atlas(found: Atlas, ax: Axes | None) -> Axes:
    """The most frequent motion of each cell, the curves that bound a region, and the special points with their names."""
    ax = plt.subplots(layout="constrained")[1] if ax is None else ax
    most = found.cells.sort_values("rows", kind="stable").drop_duplicates("cell", keep="last").sort_values("cell")
    x, y, _ = found.grid()
    ranks = {regime.name: place for place, regime in enumerate(REGIMES)}
    cells = most["regime"].map(ranks).to_numpy().reshape(len(y), len(x))
    colours = ListedColormap([regime.area for regime in REGIMES])
    ax.pcolormesh(x, y, cells, cmap=colours, vmin=-0.5, vmax=len(REGIMES) - 0.5, shading="nearest")
    there = [regime for place, regime in enumerate(REGIMES) if np.any(cells == place)]
    keys: list[Any] = [Patch(facecolor=regime.area, label=regime.name) for regime in there]
    kinds: dict[str, Line2D] = {}
    for _, curve in found.curves[found.curves["unstable"] == 0].groupby("curve"):
        kind = curve["kind"].iloc[0]
        style: dict[str, Any] = {"color": "0.13", "ls": _CURVES[kind], "lw": 1.6}
        ax.plot(curve[found.parameters[0]], curve[found.parameters[1]], **style)
        kinds.setdefault(kind, Line2D([], [], label=kind, **style))
    for kind, points in found.special[found.special["kind"] != "unresolved"].groupby("kind"):
        at = [points[name] for name in found.parameters]
        is_end = bool((points["curve"] < 0).all())
        ax.plot(*at, marker="x" if is_end else "o", mfc="white", mec="0.13", ls="none", ms=6, zorder=3)
        if not is_end:
            for spot in zip(*at, strict=True):
                ax.annotate(str(kind), spot, xytext=(5, 5), textcoords="offset points", fontsize="small")
    ax.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]), xlabel=found.parameters[0], ylabel=found.parameters[1])
    ax.legend(handles=[*keys, *kinds.values()], fontsize="small", loc="center left", bbox_to_anchor=(1.02, 0.5))
    return ax


def plot_curves(found: Curves, ax: Axes | None) -> Axes:
    """A line style for each kind, pale where the motion is unstable on both sides; points of codimension two with their names."""
    ax = plt.subplots(layout="constrained")[1] if ax is None else ax
    across, upwards = found.parameters
    keys: dict[str, Line2D] = {}
    for curve in found.curves:
        x, y = (curve.points[name].to_numpy(float) for name in found.parameters)
        bounds = (curve.points["unstable"] == 0).to_numpy()
        style: dict[str, Any] = {"color": "0.13", "ls": _CURVES[curve.kind], "lw": 1.6}
        keys.setdefault(curve.kind, Line2D([], [], label=curve.kind, **style))
        edges = [0, *(np.flatnonzero(np.diff(bounds)) + 1), len(x)]
        for first, last in zip(edges[:-1], edges[1:], strict=True):
            shown = slice(max(first - 1, 0), last)
            ax.plot(x[shown], y[shown], alpha=1.0 if bounds[first] else 0.4, **style)
        for _, point in curve.codimension_2.iterrows():
            at = (point[across], point[upwards])
            ax.plot(*at, marker="o", mfc="white", mec="0.13", ls="none", ms=6, zorder=3)
            ax.annotate(point["kind"], at, xytext=(5, 5), textcoords="offset points", fontsize="small")
    ax.legend(handles=list(keys.values()), fontsize="small")
    ax.set(xlabel=across, ylabel=upwards)
    return ax
