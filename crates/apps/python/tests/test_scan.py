"""Scans: layout, same bits as the command line, files."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import motiform

AXES = {"kappa2": "-0.2:0.2:9", "gamma": np.linspace(-0.1, 0.1, 5)}


@pytest.fixture(scope="module")
def data() -> xr.Dataset:
    return motiform.scan(motiform.preset("fig1"), AXES, samples=2, progress=False)


def test_dimensions_have_names_and_units(data: xr.Dataset) -> None:
    assert data.regime.dims == ("gamma", "kappa2", "sample") and data.regime.shape == (5, 9, 2)
    assert data.speed_mean.attrs["units"] == "model length per model time"
    assert data.regime.dtype == np.int8 and (data.regime >= 0).all()
    np.testing.assert_array_equal(data.gamma, AXES["gamma"])
    assert data.kappa2.values[0] == -0.2 and data.kappa2.values[-1] == 0.2


def test_a_cell_is_what_classify_says(data: xr.Dataset) -> None:
    names = data.motiform.names()
    cell = {"gamma": 4, "kappa2": 1, "sample": 0}
    body = motiform.preset("fig1").replace(
        kappa2=float(data.kappa2[cell["kappa2"]]), gamma=float(data.gamma[cell["gamma"]])
    )
    assert str(names.isel(cell).values) == body.classify().regime
    shares = sum(data.motiform.share(regime.name) for regime in motiform.REGIMES)
    assert np.allclose(shares, 1.0)


def test_frames_have_categoricals(data: xr.Dataset) -> None:
    frame = data.motiform.to_pandas()
    assert len(frame) == 90 and list(frame.regime.cat.categories) == [regime.name for regime in motiform.REGIMES]
    straight = frame[(frame.regime == "straight") & (frame["sample"] == 0)]
    assert (straight.speed_mean > 0.0).all()


def test_the_binary_finds_the_same_bits(binary: Path, tmp_path: Path, data: xr.Dataset) -> None:
    axes = ["--axis", AXES_TEXT[0], "--axis", AXES_TEXT[1]]
    arguments = ["scan", "tensor", "--preset", "fig1", *axes, "--samples", "2", "--no-figures", "--out", tmp_path / "b"]
    assert subprocess.run([binary, *arguments], capture_output=True).returncode in (0, 1)  # 1: undetermined rows
    from_binary = motiform.read(tmp_path / "b")
    assert isinstance(from_binary, xr.Dataset)
    xr.testing.assert_identical(from_binary, data)
    ours = motiform.scan(motiform.preset("fig1"), AXES, samples=2, out=tmp_path / "p", progress=False)
    xr.testing.assert_identical(ours, data)
    last = motiform.read(sorted((tmp_path / "b").glob("*.parquet"))[-1])
    whole = from_binary.motiform.to_pandas(cells=True)
    assert isinstance(last, pd.DataFrame) and last.cell.iloc[-1] == 44
    assert np.array_equal(whole.tail(len(last)).speed_mean, last.speed_mean, equal_nan=True)
    assert {"why", "kappa2"} <= set(last.columns)
    for part in sorted((tmp_path / "b").glob("*.parquet")):
        assert part.read_bytes() == (tmp_path / "p" / part.name).read_bytes()


AXES_TEXT = ("kappa2=-0.2:0.2:9", "gamma=" + ",".join(repr(float(value)) for value in np.linspace(-0.1, 0.1, 5)))


def test_shards_are_merged_and_scans_resumed(tmp_path: Path, data: xr.Dataset) -> None:
    body = motiform.preset("fig1")
    for shard in ("1/2", "2/2"):
        folder = tmp_path / shard[0]
        motiform.scan(body, AXES, samples=2, out=folder, shard=shard, progress=False)
    with pytest.warns(motiform.Incomplete, match="rows are not computed yet"):
        half = motiform.read(tmp_path / "1", why=True)
    assert isinstance(half, xr.Dataset) and 0 < int((half.regime < 0).sum()) < 90
    assert (half.motiform.names() == "").any() and half.why.dims == half.regime.dims
    xr.testing.assert_identical(motiform.merge([tmp_path / "1", tmp_path / "2"], tmp_path / "m"), data)
    resumed = motiform.scan(body, AXES, samples=2, out=tmp_path / "1", resume=True, progress=False)
    xr.testing.assert_identical(resumed, data)
    with pytest.raises(FileExistsError, match="exists"):
        motiform.scan(body, AXES, samples=2, out=tmp_path / "1")


def test_axes_are_used_or_refused() -> None:
    body = motiform.preset("fig1")
    for axes, kind, words in [
        ({"kapa2": [0.1]}, TypeError, "kapa2"),
        ({"kappa2": [0.1, 0.1]}, ValueError, "occurs twice"),
        ({"kappa2": [np.nan]}, ValueError, "not finite"),
        ({"kappa2": np.zeros((2, 2))}, ValueError, "dimensions"),
        ({"kappa2": ["a"]}, TypeError, "real numbers"),
        ({"kappa2": "0:1"}, ValueError, "LOW:HIGH:COUNT"),
        ({}, ValueError, "nothing to vary"),
    ]:
        with pytest.raises(kind, match=words):
            motiform.scan(body, axes)  # type: ignore[arg-type]
    one = motiform.scan(body, {"kappa2": np.array([0, 1], dtype=np.int16)[::-1]}, progress=False)
    assert one.kappa2.values.tolist() == [1.0, 0.0]
    with pytest.raises(ValueError, match="give out"):
        motiform.scan(body, {"kappa2": [0.1]}, shard="1/2")


def test_an_axis_may_be_a_coordinate_of_the_start(tmp_path: Path) -> None:
    body = motiform.preset("fig4").replace(kappa2=0.12, kappa3=0.45)
    data = motiform.scan(body, {"v1": [-0.8, 0.8], "u222": [-1.0, 0.0, 1.0]}, out=tmp_path / "b", progress=False)
    assert data.regime.dims == ("u222", "v1", "sample")
    assert "at the start" in data.v1.attrs["long_name"] and data.u222.attrs["symbol"] == "u222(0)"
    names = data.motiform.names().isel(sample=0)
    # v1 -> -v1 is a rotation by half a turn with a mirror, which leaves u222 as it is.
    assert (names.sel(v1=-0.8) == names.sel(v1=0.8)).all()
    assert names.sel(v1=0.8).values.tolist() == ["circular", "chaotic", "circular"]
    xr.testing.assert_identical(motiform.read(tmp_path / "b"), data)
    started = body.replace(initial={"v1": 0.8, "u222": 1.0})
    assert started.classify().regime == "circular"
    data.motiform.plot()


def test_every_file_of_the_binary_is_read(binary: Path, tmp_path: Path) -> None:
    def simulate(model: str, preset: str, out: str, *more: str) -> None:
        arguments = ["simulate", model, "--preset", preset, "--t-end", "30", "--out", str(tmp_path / out), *more]
        subprocess.run([binary, *arguments], check=True, capture_output=True)

    simulate("tensor", "fig5b", "run", "--no-figures")
    simulate("tensor", "fig5b", "one.parquet")
    simulate("tensor", "fig5b", "one.csv")
    simulate("cell", "fig6b", "cell", "--no-figures", "--transient", "10")
    ours = motiform.preset("fig5b").simulate(30.0)
    for name in ("run", "one.parquet"):
        read = motiform.read(tmp_path / name)
        assert isinstance(read, motiform.Trajectory) and read.names == ours.names
        assert read._block.tobytes() == ours._block.tobytes()
        assert read.manifest == ours.manifest
    frame = motiform.read(tmp_path / "one.csv")
    assert isinstance(frame, pd.DataFrame) and np.array_equal(frame.s11, ours["s11"])
    cell = motiform.read(tmp_path / "cell")
    fields = motiform.read(tmp_path / "cell/fields.h5")
    assert isinstance(cell, motiform.Trajectory) and isinstance(fields, xr.Dataset)
    assert fields.phi.dims == ("t", "s") and fields.outline.dims == ("t", "point", "xy")
    outline = cell.outline(float(fields.t[3]), points=fields.sizes["point"])
    np.testing.assert_array_equal(fields.outline[3], outline)
    manifest = motiform.read(tmp_path / "run/manifest.json")
    assert isinstance(manifest, dict) and manifest["plan_hash"] == ours.manifest["plan_hash"]
    with pytest.raises(FileNotFoundError):
        motiform.read(tmp_path / "none")
    (tmp_path / "x.txt").write_text("x")
    with pytest.raises(ValueError, match="no data of motiform"):
        motiform.read(tmp_path / "x.txt")


def test_three_numbers_that_can_be_read_in_two_ways_are_refused() -> None:
    body = motiform.preset("fig5a")
    with pytest.raises(ValueError, match="give the list"):
        motiform.scan(body, {"kappa2": (0.5, 1.0, 3)})
