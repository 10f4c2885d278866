"""Figures: what is drawn is what is there."""

from __future__ import annotations

from collections.abc import Iterator

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.collections import QuadMesh

import motiform
from motiform.plotting import drawn_scale


@pytest.fixture(autouse=True)
def closed() -> Iterator[None]:
    yield
    plt.close("all")


def test_a_path_is_drawn_with_its_body() -> None:
    run = motiform.preset("fig5a").simulate(100.0)
    ax = run.plot(outlines=7)
    assert len(ax.patches) == 7 and ax.get_xlabel() == "$x$ (model length)"
    assert ax.get_aspect() == 1.0
    ax.figure.canvas.draw()


def test_a_film_shows_every_frame() -> None:
    run = motiform.preset("fig6b").simulate(50.0, transient=100.0)
    film = run.animate(frames=5)
    assert len(list(film.new_frame_seq())) == 5
    film._draw_frame(3)  # a frame of it
    (ax,) = film._fig.axes
    film._fig.canvas.draw()
    for name, (low, high) in (("x", ax.get_xlim()), ("y", ax.get_ylim())):
        assert low < run[name].min() and run[name].max() < high  # the whole path is in sight
    film._draw_was_started = True
    with pytest.raises(ValueError, match="frames"):
        run.animate(frames=0)


def test_a_diagram_has_the_colours_of_the_regimes() -> None:
    data = motiform.scan(motiform.preset("fig1"), {"kappa2": "-0.2:0.2:9", "gamma": "-0.1:0.1:7"}, progress=False)
    ax = data.motiform.plot()
    (mesh,) = [child for child in ax.get_children() if isinstance(child, QuadMesh)]
    names = data.motiform.names().isel(sample=0).values
    drawn = mesh.cmap(mesh.norm(mesh.get_array()))
    areas = {regime.name: regime.area for regime in motiform.REGIMES}
    for place in np.ndindex(names.shape):
        assert tuple(round(255 * part) for part in drawn[place][:3]) == tuple(bytes.fromhex(areas[names[place]][1:]))
    assert {text.get_text() for text in ax.get_legend().get_texts()} == set(np.unique(names))
    line = motiform.scan(motiform.preset("fig1"), {"kappa2": "-0.2:0.2:9"}, samples=3, progress=False).motiform.plot()
    line.figure.canvas.draw()


def test_a_legend_names_rare_motions_too() -> None:
    """With one axis every motion that is drawn has its mark, also one that is nowhere the most frequent."""
    data = motiform.scan(motiform.preset("fig1"), {"kappa2": "-0.2:0.2:5"}, samples=3, progress=False)
    codes = data.regime.values.copy()
    zigzag = [regime.name for regime in motiform.REGIMES].index("zigzag")
    codes[2, 0] = zigzag
    data = data.assign(regime=(data.regime.dims, codes, data.regime.attrs))
    names = [text.get_text() for text in data.motiform.plot().get_legend().get_texts()]
    assert "zigzag" in names and set(names) == set(np.unique(data.motiform.names()))


def test_small_bodies_are_drawn_larger() -> None:
    run = motiform.preset("fig6a").simulate(1000.0)
    scale, extent = drawn_scale(run), float(np.ptp(run.position, axis=0).max())
    assert 0.015 <= scale * run.radius / extent <= 0.3
