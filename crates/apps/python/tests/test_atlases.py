"""A plane of two parameters: the same numbers as the command line, its figure, verification, and what is refused."""

from __future__ import annotations

import json
import pickle
import subprocess
from pathlib import Path

import numpy as np
import pytest

import motiform

PLANE = {"kappa2": "-0.1:0.1:9", "gamma": (-0.1, 0.1, 9)}
OPTIONS = "--axis kappa2=-0.1:0.1:9 --axis gamma=-0.1:0.1:9 --samples 1 --lines 4 --json"


@pytest.fixture(scope="module")
def folder(binary: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, object]]:
    """An atlas of the command line, with what it printed."""
    path = tmp_path_factory.mktemp("atlas") / "atlas"
    words = ["atlas", "tensor", "--preset", "fig1", *OPTIONS.split(), "--out", path]
    done = subprocess.run([binary, *words], capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr  # 1: undetermined cells
    return path, json.loads(done.stdout)


def test_numbers_are_those_of_the_command_line(folder: tuple[Path, dict[str, object]]) -> None:
    path, printed = folder
    found = motiform.preset("fig1").atlas(PLANE, samples=1, lines=4, progress=False)
    assert found.summary == printed and found.parameters == ("kappa2", "gamma")
    again = motiform.read(path)
    assert isinstance(again, motiform.Atlas) and again.summary == printed
    assert again.cells.equals(found.cells) and again.curves.equals(found.curves)
    kept = pickle.loads(pickle.dumps(found))
    assert kept == found and kept.figure() == found.figure()
    region = found.regions[0]
    assert sum(one.share for one in found.regions) == pytest.approx(1.0) and len(region.motions) == 1
    across, upwards, motions = found.grid()
    column = int(np.flatnonzero(across == region.inside["kappa2"])[0])
    row = int(np.flatnonzero(upwards == region.inside["gamma"])[0])
    assert motions[row, column] == region.motions[0]
    named = {kind for boundary in found.boundaries for kind in boundary.kinds}
    assert named and set(found.curves["kind"]) and found.curves["curve"].nunique() == len(printed["curves"])  # type: ignore[arg-type]
    # the line of Fig. 1 on which straight motion begins to turn passes between cells of both
    assert any({"straight", "circular"} == {*boundary.between[0], *boundary.between[1]} for boundary in found.boundaries)


def test_the_figure_is_that_of_the_command_line(folder: tuple[Path, dict[str, object]], tmp_path: Path) -> None:
    path, _ = folder
    found = motiform.read(path)
    assert isinstance(found, motiform.Atlas)
    assert found.figure() == (path / "atlas.svg").read_bytes()
    found.save(tmp_path / "atlas.pdf", width="86mm")
    assert (tmp_path / "atlas.pdf").read_bytes().startswith(b"%PDF")
    assert b'width="86mm"' in found.figure(width="86mm")
    axes = found.plot()
    assert axes.get_xlabel() == "kappa2" and axes.lines and axes.get_legend() is not None
    with pytest.raises(ValueError, match="'gif'"):
        found.figure("gif")


def test_cells_are_verified(folder: tuple[Path, dict[str, object]], binary: Path, tmp_path: Path) -> None:
    path, _ = folder
    found = motiform.verify(path, all=True, progress=False)
    assert (found.intact, found.kind) == (True, "atlas") and found.rows > 40 and "cells computed again" in found.checked
    sample = motiform.verify(path, progress=False)
    assert sample.intact and 0 < sample.rows < found.rows
    # another number in the file that is read, as a fault of another version would write it
    copy = tmp_path / "atlas"
    copy.mkdir()
    for file in path.iterdir():
        (copy / file.name).write_bytes(file.read_bytes())
    state = json.loads((copy / "atlas.json").read_text())
    first = next(place for place in state["grid"]["places"] if place["like"] is None)
    first["motions"][0]["regime"] = "zigzag" if first["motions"][0]["regime"] != "zigzag" else "straight"
    (copy / "atlas.json").write_text(json.dumps(state))
    damaged = motiform.verify(copy, all=True, progress=False)
    assert not damaged.intact and any("other motions" in problem for problem in damaged.different), damaged
    done = subprocess.run([binary, "verify", copy, "--all", "--json"], capture_output=True, check=False)
    assert done.returncode == 1 and json.loads(done.stdout)["different"] == list(damaged.different)
    manifest = json.loads((copy / "manifest.json").read_text())
    (copy / "manifest.json").write_text(json.dumps({**manifest, "complete": False}))
    with pytest.raises(ValueError, match="contains an atlas that is not finished.*resume=True"):
        motiform.read(copy)


def test_a_folder_is_written_and_axes_are_checked(tmp_path: Path) -> None:
    body = motiform.preset("fig1")
    small = {"kappa2": (-0.1, 0.1, 5), "gamma": (-0.1, 0.1, 5)}
    found = body.atlas(small, samples=1, lines=1, out=tmp_path / "new", progress=False)
    again = motiform.read(tmp_path / "new")
    assert isinstance(again, motiform.Atlas) and again.summary == found.summary
    with pytest.raises(FileExistsError, match="overwrite=True"):
        body.atlas(small, samples=1, lines=1, out=tmp_path / "new", progress=False)
    with pytest.raises(ValueError, match="give two axes"):
        body.atlas({"kappa2": (0.0, 1.0)})
    with pytest.raises(ValueError, match=r"give \(low, high\)"):
        body.atlas({"kappa2": (0.0,), "gamma": (0.0, 1.0)})
    with pytest.raises(ValueError, match="did you mean kappa2"):
        body.atlas({"kapa2": (0.0, 1.0), "gamma": (0.0, 1.0)})
