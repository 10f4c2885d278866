"""Physical units: those of the study on axes, and conversion on request."""

from __future__ import annotations

import math
import pickle
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest

import motiform
from motiform._registry import NUMBERS
from motiform.branches import _special_in
from motiform.units import dimensions

UNITS = "20um,3min"


@pytest.fixture(autouse=True)
def closed() -> Iterator[None]:
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def body() -> motiform.Model:
    return motiform.preset("fig5a").replace(units=UNITS)


@pytest.fixture(scope="module")
def run(body: motiform.Model) -> motiform.Trajectory:
    return body.simulate(50.0, dt_out=0.5)


def test_units_have_factors_and_names() -> None:
    units = motiform.Units(UNITS)
    assert units.factor((1, 0)) == 20.0 and units.factor((1, -1)) == pytest.approx(20.0 / 3.0)
    names = [units.name(dimension) for dimension in ((1, 0), (0, 1), (1, -1), (0, -1), (2, -1), (0, 0), (0, -1, True))]
    assert names == ["µm", "min", "µm/min", "1/min", "µm^2/min", "", "rad/min"]
    assert pickle.loads(pickle.dumps(units)) == units != motiform.Units("20um,1min")
    for bad in ("", "20um", "20,3", "-1um,1min"):
        with pytest.raises(ValueError, match="20um,1min"):
            motiform.Units(bad)


def test_a_study_keeps_its_units(body: motiform.Model, run: motiform.Trajectory, tmp_path: Path) -> None:
    assert motiform.preset("fig5a").units is None and str(body.units) == UNITS
    path = tmp_path / "study.toml"
    path.write_text(body.to_toml(), encoding="utf-8")
    assert motiform.study(path).units == body.units == pickle.loads(pickle.dumps(body)).units
    assert run.units == body.units == pickle.loads(pickle.dumps(run)).units
    with pytest.raises(ValueError, match="20um,1min"):
        body.replace(units="20")


def test_columns_are_in_model_units_unless_others_are_asked_for(run: motiform.Trajectory) -> None:
    plain = motiform.preset("fig5a").simulate(50.0, dt_out=0.5)
    assert np.array_equal(plain._block, run._block, equal_nan=True)
    assert np.array_equal(run.to_pandas().to_numpy(), run._block.T, equal_nan=True)
    frame = run.to_pandas(units=True)
    expected = {"t": 3.0, "x": 20.0, "v1": 20.0 / 3.0, "s11": 20.0, "speed": 20.0 / 3.0, "turning_rate": 1.0 / 3.0}
    for name, by in expected.items():
        np.testing.assert_allclose(frame[name], by * run[name], rtol=1e-14)
        np.testing.assert_array_equal(frame[name], run.values(name))
    assert frame.attrs["units"]["turning_rate"] == "rad/min"
    assert frame.attrs["units"]["speed"] == "µm/min" and "(µm/min)" in frame.attrs["meanings"]["speed"]
    assert not any("model" in meaning for meaning in frame.attrs["meanings"].values())
    # the speed of the table is that of its places, in any units
    fine = run.to_pandas(units="7mm,2h")
    step = np.hypot(np.diff(fine["x"]), np.diff(fine["y"])) / np.diff(fine["t"])
    np.testing.assert_allclose(step.mean(), fine["speed"].mean(), rtol=0.01)
    data = run.to_xarray(units=True)
    assert data.t.attrs["units"] == "min" and data.speed.attrs["units"] == "µm/min"
    np.testing.assert_allclose(data.speed, 20.0 / 3.0 * run["speed"])
    with pytest.raises(ValueError, match="the study has no units"):
        plain.to_pandas(units=True)
    assert plain.values("t", "1um,4s")[-1] == 200.0


def test_the_cell_has_dimensions_too() -> None:
    run = motiform.preset("fig6a").simulate(2.0, transient=0.0, dt_out=1.0)
    named = {name: run.dimension(name) for name in ("c2", "mode2", "length", "area", "closure_residual", "turning_rate")}
    assert named == {
        "c2": (1, 0), "mode2": (1, 0), "length": (1, 0), "area": (2, 0), "closure_residual": (0, 0), "turning_rate": (0, -1, True)
    }  # fmt: skip


def test_axes_are_those_of_the_study(run: motiform.Trajectory) -> None:
    ax = run.plot()
    assert ax.get_xlabel() == "$x$ (µm)" and ax.figure.axes[1].get_ylabel() == "$t$ (min)"
    plain = run.plot(units=False)
    assert plain.get_xlabel() == "$x$ (model length)"
    np.testing.assert_allclose(ax.dataLim.get_points(), 20.0 * plain.dataLim.get_points(), rtol=1e-12)
    assert run.plot(units="1mm,1h").get_ylabel() == "$y$ (mm)"
    film = run.animate(frames=3)
    film._draw_was_started = True
    film._draw_frame(100)  # the row of the time 50
    (drawn,) = film._fig.axes
    assert drawn.get_xlabel() == "$x$ (µm)" and drawn.get_title() == "$t$ = 150.0 min"


def test_results_are_converted_on_request(body: motiform.Model) -> None:
    verdict = body.classify()
    other = verdict.in_units()
    assert verdict.in_model_units and not other.in_model_units and verdict.units == other.units == body.units
    assert verdict.period is not None and other.period == pytest.approx(3.0 * verdict.period)
    assert verdict.speed is not None and other.speed is not None
    assert other.speed.mean == pytest.approx(20.0 / 3.0 * verdict.speed.mean)
    assert other.drift == pytest.approx(20.0 * (verdict.drift or 0.0)) and other.swing == verdict.swing
    assert (verdict.regime, verdict.why) == (other.regime, other.why)
    assert str(other) == f"{verdict} (numbers in model units)" and str(verdict.in_units(False)) == str(verdict)
    with pytest.raises(ValueError, match="already"):
        other.in_units()
    exponents = body.lyapunov(2, t_end=200.0)
    np.testing.assert_allclose(exponents.in_units("1um,2s").values, exponents.values / 2.0)
    steady = body.equilibria(starts=5)[0]
    np.testing.assert_allclose(steady.in_units().eigenvalues, steady.eigenvalues / 3.0)
    with pytest.raises(ValueError, match="the study has no units"):
        motiform.preset("fig5a").classify().in_units()


def test_statistics_are_those_that_the_program_prints(binary: Path) -> None:
    walk = motiform.Tensor(gamma=1.0, kappa2=2.0, kappa3=2.0).replace(units=UNITS)
    found = walk.statistics(10, t_end=100.0, noise=0.3)
    other = found.in_units()
    words = "statistics tensor --set gamma=1 --set kappa2=2 --set kappa3=2 --noise 0.3 --t-end 100 --bodies 10".split()
    text = subprocess.run([binary, *words, "--units", UNITS], check=True, capture_output=True, encoding="utf-8").stdout
    printed = re.search(r"speed +mean ([\d.]+)", text)
    assert printed is not None, text
    assert float(printed[1]) == pytest.approx(other.mean_speed.value, rel=1e-3)
    assert other.mean_speed.value == pytest.approx(20.0 / 3.0 * found.mean_speed.value)
    np.testing.assert_allclose(other.msd["msd"], 400.0 * found.msd["msd"])
    np.testing.assert_allclose(other.msd["exponent"], found.msd["exponent"])
    np.testing.assert_allclose(other.first_passage["radius"], 20.0 * found.first_passage["radius"])
    speed = other.distributions[other.distributions["quantity"] == "speed"]
    assert (speed["density"] * (speed["to"] - speed["from"])).sum() == pytest.approx(1.0)
    ax = found.plot()
    assert ax.get_xlabel() == "lag (min)" and ax.get_ylabel() == "mean-square displacement (µm$^{2}$)"
    np.testing.assert_allclose(ax.lines[0].get_ydata(), other.msd["msd"])
    assert found.plot("spectra").get_xlabel() == "frequency (cycles per min)"
    assert found.plot("speed", units=False).get_xlabel() == "speed (model length per model time)"
    assert found.plot("first_passage").get_ylabel() == "mean first-passage time (min)"


def test_reasons_keep_model_units_and_say_so(body: motiform.Model) -> None:
    found = body.statistics(4, t_end=20.0, noise=0.02)
    other = found.in_units()
    assert re.search(r"longest lag .*\d", found.diffusion.reason) and not other.diffusion.known
    assert other.diffusion.reason == f"{found.diffusion.reason} (numbers in model units)" and other.mean_speed.reason == ""
    times, converted = found.correlation_times["velocity"], other.correlation_times["velocity"]
    assert not times.known and converted.reason.startswith(times.reason) and "model units" in str(converted)
    assert repr(other) != repr(found) == repr(found.in_units(False))
    np.testing.assert_allclose(other.msd["lag"], 3.0 * found.msd["lag"])
    np.testing.assert_allclose(other.autocorrelations["lag"], 3.0 * found.autocorrelations["lag"])


def test_columns_of_motions_have_the_units_that_scans_state() -> None:
    known = dimensions("motion")
    for name, _, unit in NUMBERS:
        dimension = known.get(name)
        assert unit in ("", "1", "rad") if dimension is None else unit == motiform.units.name(None, dimension), name


def test_branches_and_curves_are_converted_on_request(body: motiform.Model) -> None:
    found = body.branches(("kappa2", 0.6, 0.9), branches=1, points=12)
    other = found.in_units()
    assert found.units == other.units == body.units and found.in_model_units and not other.in_model_units
    for name, by in {"speed": 20.0 / 3.0, "turning_rate": 1.0 / 3.0, "period": 3.0, "kappa2": 1.0, "v1": 1.0}.items():
        np.testing.assert_allclose(other.points[name], by * found.points[name], rtol=1e-14)
    np.testing.assert_array_equal(other[0].points["period"], other.points["period"])
    assert found.plot().get_ylabel() == "speed (µm/min)"
    assert found.plot("period", units=False).get_ylabel() == "period (model time)"
    with pytest.raises(ValueError, match="already"):
        other.in_units()
    with pytest.raises(ValueError, match="with units"):
        other.plot()
    curves = body.curves("symmetry-breaking", ("kappa2", 0.76, 0.95), ("kappa3", 0.098, 0.102), from_="zigzag", branches=1, points=60)
    assert len(curves) >= 1 and curves.units == body.units
    np.testing.assert_allclose(curves.in_units("1um,2s").points["period"], 2.0 * curves.points["period"], rtol=1e-14)
    np.testing.assert_array_equal(curves.in_units().points["kappa2"], curves.points["kappa2"])


def test_connections_are_converted_on_request() -> None:
    body = motiform.preset("fig4").replace(kappa2=0.9, kappa3=0.1, units=UNITS)
    found = body.branches(("kappa2", 0.8, 1.6), from_="zigzag", branches=2)
    special, other = found.special, found.in_units().special
    (place,) = special.index[special["kind"] == "homoclinic"][:1]
    before, after = special.loc[place], other.loc[place]
    for name in ("rate", "saddle_quantity"):
        assert after[name] == pytest.approx(before[name] / 3.0)
    for name in ("leading_growing", "leading_decaying"):
        np.testing.assert_allclose(after[name], np.array(before[name]) / 3.0)
    np.testing.assert_allclose(after["saddle"]["eigenvalues"], np.array(before["saddle"]["eigenvalues"]) / 3.0)
    assert after["saddle"]["speed"] == pytest.approx(20.0 / 3.0 * before["saddle"]["speed"])
    assert after["saddle"]["shape"] == before["saddle"]["shape"]
    unchanged = ["kappa2", "error", "remaining", "coefficient", "kind", "law"]
    assert special[unchanged].equals(other[unchanged])
    np.testing.assert_allclose(other["period"], 3.0 * special["period"])


def test_saddles_of_cycles_are_converted_each() -> None:
    saddle = {"speed": 1.0, "turning_rate": 3.0, "eigenvalues": [[3.0, 0.0]], "shape": [1.0], "leading_growing": [6.0, 0.0], "share": 0.5}
    table = pd.DataFrame({"saddles": [[saddle, saddle], math.nan, None], "rate": [3.0, math.nan, None]})
    made = _special_in(table, motiform.Units(UNITS))
    expected = {"speed": pytest.approx(20.0 / 3.0), "turning_rate": 1.0, "eigenvalues": [[1.0, 0.0]], "shape": [1.0], "leading_growing": [2.0, 0.0], "share": 0.5}
    assert made["saddles"][0] == [expected, expected] and math.isnan(made["saddles"][1]) and made["saddles"][2] is None
    assert made["rate"][0] == 1.0 and table["saddles"][0][0] == saddle


def test_scans_and_atlases_are_converted_on_request(body: motiform.Model) -> None:
    data = motiform.scan(body, {"kappa2": [0.8, 0.9]}, progress=False)
    other = data.motiform.in_units()
    np.testing.assert_allclose(other["period"], 3.0 * data["period"], rtol=1e-14)
    np.testing.assert_allclose(other["speed_mean"], 20.0 / 3.0 * data["speed_mean"], rtol=1e-14)
    assert other["speed_mean"].attrs["units"] == "µm/min" and other["margin"].identical(data["margin"])
    np.testing.assert_array_equal(other["kappa2"], data["kappa2"])
    with pytest.raises(ValueError, match="already"):
        other.motiform.in_units()
    with pytest.raises(ValueError, match="the study has no units"):
        motiform.scan(motiform.preset("fig5a"), {"kappa2": [0.9]}, progress=False).motiform.in_units()
    atlas = body.atlas({"kappa2": (1.2, 1.6, 3), "kappa3": (0.6, 1.0, 3)}, samples=1, lines=0)
    assert atlas.units == body.units
    np.testing.assert_allclose(atlas.in_units().cells["speed_mean"], 20.0 / 3.0 * atlas.cells["speed_mean"], rtol=1e-14)
    assert atlas.in_units().summary == atlas.summary
