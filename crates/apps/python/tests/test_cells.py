"""Tracked cells: outlines in, modes, motions, fits and models out."""

from __future__ import annotations

import csv
import signal
import subprocess
import sys
import time
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt
import pandas as pd
import pytest

import motiform

Floats = npt.NDArray[np.float64]

STEP = 0.5
RADIUS = 3.0


def outline(centre: Floats, r0: float, z: dict[int, complex], count: int = 48) -> Floats:
    """R(theta) = R0 + sum of 2 Re(z_n e^{i n theta}) about a centre."""
    theta = 2.0 * np.pi * np.arange(count) / count
    r = r0 + sum(2.0 * (zn * np.exp(1j * n * theta)).real for n, zn in z.items())
    return centre + np.column_stack([r * np.cos(theta), r * np.sin(theta)])


@cache
def simulated(name: str, noise: float | None = None) -> list[tuple[float, Floats]]:
    """Outlines of a preset, with this process noise and noise of 1 % on every vertex: z2 = (s11 - i s12)/2, z3 = (u111 + i u222)/2."""
    run = motiform.preset(name).simulate(400.0, transient=500.0, dt_out=STEP, noise=noise)
    errors = np.random.default_rng(1)
    z2, z3 = (run["s11"] - 1j * run["s12"]) / 2.0, (run["u111"] + 1j * run["u222"]) / 2.0
    exact = run.outline(run.t[40], radius=RADIUS, points=48)
    assert exact is not None and np.allclose(outline(run.position[40], RADIUS, {2: z2[40], 3: z3[40]}), exact)
    blur = errors.normal(0.0, 0.01 * RADIUS, (len(run), 48, 2))
    frames = range(len(run))
    return [
        (float(run.t[k]), outline(run.position[k], RADIUS, {2: z2[k], 3: z3[k]}) + blur[k]) for k in frames
    ]


def write(path: Path, cells: dict[str, list[tuple[float, Floats]]]) -> Path:
    """The long table."""
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["cell", "frame", "i", "x", "y"])
        for name, frames in cells.items():
            for frame, (_, points) in enumerate(frames):
                table.writerows([name, frame, i, x, y] for i, (x, y) in enumerate(points.tolist()))
    return path


def test_exact_outlines_have_exact_modes() -> None:
    z = {2: 0.1 + 0.05j, 3: -0.03 + 0.06j, 4: 0.01j, 5: 0.02 + 0j}
    frames = [(2.0 * k, outline(np.array([0.3 * k, -k]), 1.0 + 0.01 * k, z)) for k in (0, 1, 2, 4)]
    cells = motiform.cells.from_arrays({"a, b": frames}, length_unit="um", time_unit="s")
    cell = cells["a, b"]
    modes = cell.modes
    assert modes["frame"].values.tolist() == [0, 1, 2, 4] and modes["t"].values.tolist() == [0.0, 2.0, 4.0, 8.0]
    for n, zn in z.items():
        assert np.allclose(modes[f"z{n}_re"], zn.real, atol=1e-13) and np.allclose(modes[f"z{n}_im"], zn.imag, atol=1e-13)
    assert np.allclose(modes["y"], [0.0, -1.0, -2.0, -4.0], atol=1e-13)
    assert modes["r0"].attrs["units"] == "um" and modes["t"].attrs["units"] == "s"
    assert cell.flags == {"gap": 1} and cell.counting == 4 and not modes["left_out"].any()
    assert cell.radius == pytest.approx(1.0175) and len(cell.outlines) == 4
    assert np.array_equal(cell.outlines[3][1], frames[3][1])


def test_cells_are_a_sequence_with_names() -> None:
    frames = [(float(k), outline(np.array([k, 0.0]), 1.0, {2: 0.01j})) for k in range(3)]
    shifted = [(t, points + [0.0, 9.0]) for t, points in frames]
    cells = motiform.cells.from_arrays({"a": frames, "7": shifted})
    assert cells.names == ["a", "7"] and len(cells) == 2 and "7" in cells and cells[1] is cells["7"]
    assert [cell.name for cell in cells] == ["a", "7"] and cells[1] in cells and "b" not in cells
    assert len(cells.modes) == 6 and "2 cells, 6 outlines; lengths in pixel" in repr(cells)
    with pytest.raises(KeyError, match="the cells are a, 7"):
        cells["b"]
    found = cells.observe(progress=False)
    assert list(found) == ["a", "7"] and found["a"].regime == "undecided" and "at least 40" in found["a"].why
    fit = cells["a"].fit(progress=False)
    assert not fit.decided and fit.model is None and not fit.place.known and len(fit.coefficients) == 0


def test_polygons_are_taken_by_their_exterior() -> None:
    points = outline(np.zeros(2), 2.0, {3: 0.1 + 0j})
    closed = np.vstack([points, points[:1]])
    polygon = SimpleNamespace(exterior=SimpleNamespace(coords=[(x, y, 5.0) for x, y in closed]))
    cell = motiform.cells.from_arrays({"a": [(0.0, polygon), (1.0, points + 1.0)]})[0]
    assert cell.modes["z3_re"].values == pytest.approx([0.1, 0.1], abs=1e-13)
    shapely = pytest.importorskip("shapely")
    same = motiform.cells.from_arrays({"a": [(0.0, shapely.Polygon(points)), (1.0, points + 1.0)]})[0]
    assert same.modes.equals(cell.modes)


@pytest.mark.parametrize(
    ("frames", "message"),
    [
        ([(0.0, np.zeros((4, 3)))], "shape"),
        ([(np.nan, np.zeros((4, 2)))], "not a finite number"),
        ([(1.0, np.zeros((4, 2))), (1.0, np.ones((4, 2)))], "several outlines at the time 1"),
        ([(0.0, np.eye(2))], "no frame has more than 2 vertices: .* the position of the cell"),
        ([], "no vertex"),
    ],
)
def test_arrays_that_are_no_outlines_are_refused(frames: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        motiform.cells.from_arrays({"a": frames})


def test_files_that_cannot_be_read_are_refused(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="none.csv"):
        motiform.cells.read(tmp_path / "none.csv")
    path = write(tmp_path / "cells.csv", {"a": simulated("fig5a")[:3]})
    with pytest.raises(ValueError, match="csv, parquet"):
        motiform.cells.read(path, format="excel")
    with pytest.raises(ValueError, match="pixel_size"):
        motiform.cells.read(path, pixel_size=-1.0)


def test_unknown_units_stay_pixels_and_frames(tmp_path: Path) -> None:
    path = write(tmp_path / "cells.csv", {"a": simulated("fig5a")[:3]})
    bare = motiform.cells.read(path)
    assert (bare.length_unit, bare.time_unit) == ("pixel", "frame") and any("pixel_size" in note for note in bare.notes)
    scaled = motiform.cells.read([path], interval=2.0, pixel_size=0.5, time_unit="min")
    assert (scaled.length_unit, scaled.time_unit, scaled.notes) == ("um", "min", ())
    assert scaled[0].radius == pytest.approx(0.5 * bare[0].radius) and scaled[0].modes["t"].values.tolist() == [0, 2, 4]


@pytest.mark.parametrize(("name", "regime"), [("fig5a", "zigzag"), ("fig5b", "chaotic")])
def test_simulated_written_read_fitted_and_named_again(name: str, regime: str, tmp_path: Path) -> None:
    path = write(tmp_path / "cells.csv", {"one": simulated(name), "short": simulated(name)[100:130]})
    cells = motiform.cells.read(path, interval=STEP, pixel_size=1.0)
    done: list[float] = []
    fits = cells.fit(threads=2, draws=20, progress=done.append)
    fit = fits["one"]
    assert motiform.preset(name).classify().regime == regime
    assert fit.regime == regime and fit.share >= 0.9 and sum(fit.draws.values()) >= 20 and fit.frames == 801
    kappa2 = motiform.preset(name).kappa2
    assert fit.place.known and abs(float(fit.place.coordinates["kappa2"]) - kappa2) < 4.0 * fit.place.coordinates["kappa2"].error
    assert fit.place.coordinates["kappa2"].lower < kappa2 < fit.place.coordinates["kappa2"].upper
    terms = fit.coefficients.set_index("term")
    assert abs(terms.loc["z2: z2", "value"] + kappa2) < 4.0 * terms.loc["z2: z2", "error"]
    assert not fit.place_reduced.known and "z3" in str(fit.place_reduced)
    assert fit.noise is not None and fit.noise.measurement_factor.value == pytest.approx(1.0, abs=0.05)
    assert fits["short"].regime == "undecided" and fits["short"].why
    observed = cells["one"].observe()
    assert observed.regime == ("zigzag" if regime == "zigzag" else "undecided") and observed.why
    assert len(observed.displacement) > 10 and (observed.displacement["lower"] <= observed.displacement["value"]).all()
    assert list(observed.correlations) == ["velocity", "z2", "z3"] and observed.correlations["z2"]["value"][0] == 1.0
    # cells simulated by the fit are like it
    assert len(fit.simulated) == 9 and not fit.unstable and (fit.simulated["verdict"] == "agrees").sum() >= 6
    band = fit.bands("speed")
    assert ((band["low"] <= band["median"]) & (band["median"] <= band["high"])).all()
    with pytest.raises(KeyError, match="mean-square displacement"):
        fit.bands("nothing")
    assert fits["short"].simulated.empty
    with pytest.raises(ValueError, match="no simulated cells"):
        fits["short"].plot()
    titles = [ax.get_title() for ax in fit.plot().axes if ax.get_visible()]
    assert titles and all(name in title for name, title in zip(fit.simulated["statistic"], titles, strict=True))
    assert sum(share["count"] for share in fits.population["regimes"] if share["name"] == regime) == 1
    square, memory = observed.plot().axes
    assert "(s)" in square.get_xlabel() and len(memory.lines) == 4
    assert np.isnan(observed.confidence) == (not observed.decided)
    with pytest.raises(ValueError, match="no statistics"):
        cells["short"].observe().plot()
    plt.close("all")
    # the fit is a model like all others
    assert fit.model is not None and fit.model.classify().regime == regime
    run = fit.model.simulate(100.0, transient=300.0)
    assert run.outcome.complete and np.hypot(run["v1"], run["v2"]).mean() > 0.3
    assert fit.noisy_model is not None and fit.noisy_model.run["noise"] == fit.noise.eta_shape.value
    if regime == "zigzag":
        near = fit.model.kappa2 - 0.05, fit.model.kappa2 + 0.05
        assert fit.model.branches(("kappa2", *near), from_="zigzag", branches=1)[0].motion == "zigzag"


def test_one_cell_alone_has_the_same_fit() -> None:
    cells = motiform.cells.from_arrays({"one": simulated("fig5b")[:400], "two": simulated("fig5b")[400:]})
    together = cells.fit(draws=4, threads=2, progress=False)
    alone = cells["two"].fit(draws=4, progress=False)
    assert alone.summary == together["two"].summary and alone.coefficients.equals(together["two"].coefficients)
    assert alone.place == cells["two"].place() != cells["two"].place("fig1")
    with pytest.raises(ValueError, match="give 'fig4' or 'fig1'"):
        cells["two"].place("fig6")


def test_models_are_compared_by_frames_that_their_fits_did_not_see() -> None:
    cell = motiform.cells.from_arrays({"one": simulated("fig5b", noise=0.02)[:300]})[0]
    fit = cell.fit(draws=4, simulations=0, ladder=True, progress=False)
    walk, selected = fit.ladder.iloc[0], fit.ladder.set_index("model").loc["terms that the data ask for"]
    assert walk["gain_per_frame"] == 0 and not walk["as_good"] and walk["coefficients"] == 3
    assert selected["gain_per_frame"] > 1 and selected["behind"] < 0.1 * walk["behind"]
    assert cell.fit(draws=4, simulations=0, progress=False).ladder.empty


def test_plots() -> None:
    cell = motiform.cells.from_arrays({"one": simulated("fig5b")[:50]})[0]
    strip, path, _ = cell.plot(outlines=5).axes
    assert len(strip.patches) == len(path.patches) == 5 and path.get_xlabel() == "$x$ (pixel)"
    flat = motiform.cells.from_arrays({"a": [(0.0, outline(np.zeros(2), 1.0, {}, 8))]})[0]
    assert flat.counting == 0 and flat.plot().axes  # no frame counts
    with pytest.raises(ValueError, match="outlines = 0"):
        cell.plot(outlines=0)
    plt.close("all")


def test_ctrl_c_gives_the_fits_that_are_done() -> None:
    program = """
import numpy as np, motiform
run = motiform.preset("fig5b").simulate(400.0, dt_out=0.5)
noise = np.random.default_rng(1)
frames = [(t, run.outline(t, radius=3.0, points=48) + noise.normal(0.0, 0.03, (48, 2))) for t in run.t]
cells = motiform.cells.from_arrays({str(k): frames for k in range(100)})
print("ready", flush=True)
try:
    cells.fit(threads=1, progress=False)
except motiform.Interrupted as stop:
    print("stopped", len(stop.result))
"""
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None and process.stdout.readline() == "ready\n"
        time.sleep(0.7)
        process.send_signal(signal.SIGINT)
        words = process.stdout.read().split()
    assert words and words[0] == "stopped" and int(words[1]) < 100


def disc(size: int, centre: tuple[float, float], r: float) -> npt.NDArray[np.bool_]:
    y, x = np.mgrid[:size, :size] + 0.5
    found: npt.NDArray[np.bool_] = (x - centre[0]) ** 2 + (y - centre[1]) ** 2 < r * r
    return found


@pytest.mark.parametrize("kind", ["tif", "png"])
def test_label_masks(kind: str, tmp_path: Path) -> None:
    writer = pytest.importorskip("tifffile" if kind == "tif" else "imageio.v3").imwrite
    for frame in range(4):
        image = np.zeros((64, 64), np.uint16 if kind == "tif" else np.uint8)
        image[disc(64, (20.0 + 2 * frame, 30.0), 9.0)] = 3
        image[disc(64, (50.0, 0.0), 8.0)] = 8
        image[60, 60] = 3  # a speck
        writer(tmp_path / f"mask{frame + 5:03}.{kind}", image)
    (tmp_path / "res_track.txt").write_text("3 5 8 0\n8 5 8 3\n")
    cells = motiform.cells.read_masks(tmp_path, interval=2.0, pixel_size=0.5)
    assert cells.names == ["3", "8"] and cells.y_down and (cells.length_unit, cells.time_unit) == ("um", "s")
    three = cells["3"]
    assert three.modes["frame"].values.tolist() == [5, 6, 7, 8] and three.modes["t"].values[0] == 10.0
    assert three.modes["x"].values == pytest.approx([10.0, 11.0, 12.0, 13.0], abs=1e-9)
    assert three.radius == pytest.approx(4.5, rel=0.02) and three.counting == 4
    assert three.notes == ("cell 3: several parts in 4 frames; the largest is kept", "cell 3 becomes 8")
    assert cells["8"].flags["clipped"] == 4
    files = [tmp_path / f"mask{frame:03}.{kind}" for frame in (5, 6)]
    assert motiform.cells.read_masks(files)["3"].modes["frame"].values.tolist() == [5, 6]
    (tmp_path / "res_track.txt").write_text("3 5 8\n")
    with pytest.raises(ValueError, match="line 1"):
        motiform.cells.read_masks(tmp_path)


def test_tables_and_masks_in_memory_are_those_of_files(tmp_path: Path) -> None:
    tifffile = pytest.importorskip("tifffile")
    rows = [("a", frame, *point) for frame, (_, points) in enumerate(simulated("fig5b")[:20]) for point in points]
    table = pd.DataFrame(rows, columns=["cell", "frame", "x", "y"])
    table.to_csv(tmp_path / "cells.csv", index=False)
    one, other = (motiform.cells.read(given, interval=2.0, pixel_size=0.5) for given in (table, tmp_path / "cells.csv"))
    assert one["a"].modes.identical(other["a"].modes) and one["a"].notes == other["a"].notes
    assert motiform.cells.read(table.set_index("cell"), interval=2.0, pixel_size=0.5)["a"].modes.identical(one["a"].modes)
    named = motiform.cells.read(table.rename(columns={"x": "pos"}), interval=2.0, pixel_size=0.5, columns={"x": "pos"})
    assert named["a"].modes.identical(one["a"].modes)
    y, x = np.mgrid[:60, :70]
    labels = np.stack([300 * (np.hypot(x - 30 - frame, 1.3 * (y - 30)) < 15) for frame in range(6)]).astype(np.int64)
    tifffile.imwrite(tmp_path / "stack.tif", labels.astype(np.uint16), photometric="minisblack")
    here, there = (motiform.cells.read_masks(given, interval=2.0) for given in (labels, tmp_path / "stack.tif"))
    assert here["300"].modes.identical(there["300"].modes)
    for wrong, kind in ((labels * 0.5, TypeError), (labels[0], TypeError), (-labels, ValueError), (labels << 10, ValueError)):
        with pytest.raises(kind, match="labels"):
            motiform.cells.read_masks(wrong)


def test_masks_in_one_file_and_what_is_no_mask(tmp_path: Path) -> None:
    tifffile = pytest.importorskip("tifffile")
    stack = np.zeros((3, 40, 40), np.uint32)
    stack[:, disc(40, (20.0, 20.0), 8.0)] = 4_000_000_000  # any number is a label
    tifffile.imwrite(tmp_path / "stack.tif", stack, photometric="minisblack")
    cells = motiform.cells.read_masks(tmp_path / "stack.tif")
    assert cells.names == ["4000000000"] and cells.length_unit == "pixel" and cells[0].flags == {"repeated frame": 2}
    assert any("pixel_size" in note for note in cells.notes)
    tifffile.imwrite(tmp_path / "empty.tif", stack[0] * 0)
    tifffile.imwrite(tmp_path / "grey.tif", stack[0].astype(np.float32))
    tifffile.imwrite(tmp_path / "rgb.tif", np.zeros((8, 9, 3), np.uint8), photometric="rgb")
    tifffile.imwrite(tmp_path / "small.tif", stack[0, :30])
    (tmp_path / "folder").mkdir()
    for files, message in (
        (["empty.tif"], "no outline"),
        (["grey.tif"], "whole number"),
        (["rgb.tif"], "one whole number for each pixel"),
        (["stack.tif", "stack.tif"], "given twice"),
        (["stack.tif", "small.tif"], "frame"),
        (["folder"], "no image"),
        ([], "at least one"),
    ):
        with pytest.raises(ValueError, match=message):
            motiform.cells.read_masks([tmp_path / name for name in files])
    with pytest.raises(ValueError, match="interval = 0"):
        motiform.cells.read_masks(tmp_path / "stack.tif", interval=0.0)
    with pytest.raises(FileNotFoundError):
        motiform.cells.read_masks(tmp_path / "none.tif")


def test_written_outlines_come_back(tmp_path: Path) -> None:
    outlines = simulated("fig5b")[:6]
    cells = motiform.cells.from_arrays({"a, 1": outlines, "2": outlines[2:]}, length_unit="um", time_unit="s")
    cells.write(tmp_path / "both.csv")
    back = motiform.cells.read(tmp_path / "both.csv", pixel_size=1.0, interval=STEP)
    assert back.names == cells.names and back.time_unit == "s"
    for before, after in zip(cells["a, 1"].outlines, back["a, 1"].outlines, strict=True):
        assert np.array_equal(before[1], after[1])
    cells["2"].write(tmp_path / "one.txt")
    (only,) = motiform.cells.read(tmp_path / "one.txt")
    for (t, before), (again, after) in zip(cells["2"].outlines, only.outlines, strict=True):
        assert t == again and np.array_equal(before, after)
    with pytest.raises(ValueError, match="it holds one cell, and there are 2"):
        cells.write(tmp_path / "both.txt")
    with pytest.raises(ValueError, match="one.xls.*end the name"):
        cells.write(tmp_path / "one.xls")
    pixels = motiform.cells.from_arrays({"one": outlines})
    with pytest.raises(ValueError, match="it needs um and s"):
        pixels[0].write(tmp_path / "pixels.txt")
    assert not (tmp_path / "pixels.txt").exists()


def test_columns_have_names(tmp_path: Path) -> None:
    path = write(tmp_path / "cells.csv", {"one": simulated("fig5b")[:4]})
    text = path.read_text().replace("cell,frame,i,x,y", "who,when,k,east,north", 1)
    path.write_text(text)
    columns = {"cell": "who", "frame": "when", "i": "k", "x": "east", "y": "north"}
    assert motiform.cells.read(path, columns=columns).names == ["one"]
    with pytest.raises(ValueError, match="columns has no 'z'"):
        motiform.cells.read(path, columns={"z": "east"})
    (tmp_path / "words.txt").write_text("a cell moved\n")
    with pytest.raises(ValueError, match=r"columns are named by columns=\{'frame': HEADER\}"):
        motiform.cells.read(tmp_path / "words.txt")


def test_settings_of_fits_are_checked() -> None:
    cells = motiform.cells.from_arrays({"one": simulated("fig5b")[:60]})
    with pytest.raises(ValueError, match="order = 7"):
        cells.fit(order=7, progress=False)
    with pytest.raises(ValueError, match="modes = 5: give 2, 3 or 4"):
        cells.fit(modes=5, progress=False)
    with pytest.raises(RuntimeError, match="stop"):
        cells.fit(progress=_stop)


def test_a_fit_with_z4_says_when_z4_is_not_seen() -> None:
    cells = motiform.cells.from_arrays({"one": simulated("fig5b")[:60]})
    fit = cells.fit(modes=4, progress=False)["one"]
    assert not fit.decided and "z4 does not exceed its errors of observation" in fit.why


def _stop(_: float) -> None:
    raise RuntimeError("stop")
