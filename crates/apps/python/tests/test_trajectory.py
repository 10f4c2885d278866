"""Runs: arrays, views, frames, outlines, outcomes."""

from __future__ import annotations

import pickle
import sys
import threading
import time
import warnings

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import motiform


@pytest.fixture(scope="module")
def run() -> motiform.Trajectory:
    return motiform.preset("fig5a").simulate(50.0, dt_out=0.5)


def test_columns_are_views_of_one_block(run: motiform.Trajectory) -> None:
    assert run.t.shape == (101,) and run.position.shape == (101, 2) and run.velocity.shape == (101, 2)
    for view in (run.t, run["s11"], run.position, run.velocity, run.shape):
        assert np.shares_memory(view, run._block)
    assert np.array_equal(run.position[:, 0], run["x"])
    assert np.array_equal(run.shape[:, run.coordinates.index("u222")], run["u222"])
    with pytest.raises(KeyError, match="no column 'z'"):
        run["z"]


def test_a_trajectory_survives_a_pickle(run: motiform.Trajectory) -> None:
    for one in (run, motiform.preset("fig3").simulate(50.0, transient=0.0)):
        back = pickle.loads(pickle.dumps(one))
        assert np.array_equal(back._block, one._block, equal_nan=True)
        assert back.manifest == one.manifest and back.names == one.names
        assert (back.crossings is None) == (one.crossings is None)
        assert np.array_equal(back.outline(3), one.outline(3))


def test_velocity_is_the_rate_of_the_position(run: motiform.Trajectory) -> None:
    fine = motiform.preset("fig5a").simulate(1.0, dt_out=1e-3)
    slope = (fine.position[2:] - fine.position[:-2]) / 2e-3
    np.testing.assert_allclose(fine.velocity[1:-1], slope, atol=1e-6)
    cell = motiform.preset("fig6a").simulate(1.0, transient=0.0, dt_out=1e-2, initial={"c2": 0.3, "s3": 0.2})
    slope = (cell.position[2:] - cell.position[:-2]) / 2e-2
    np.testing.assert_allclose(cell.velocity[1:-1], slope, atol=1e-4 * np.abs(slope).max())


def test_tensors_are_symmetric_and_traceless(run: motiform.Trajectory) -> None:
    S, U = run.S, run.U
    assert np.array_equal(S, S.swapaxes(1, 2)) and np.all(np.trace(S, axis1=1, axis2=2) == 0.0)
    for axes in ((0, 2, 1, 3), (0, 1, 3, 2), (0, 3, 2, 1)):
        assert np.array_equal(U, U.transpose(axes))
    assert np.allclose(np.trace(U, axis1=1, axis2=2), 0.0)
    # observables of the table are the tensors' norms
    np.testing.assert_allclose(np.sqrt((S**2).sum((1, 2)) / 2), np.hypot(run["s11"], run["s12"]))


def test_modes_of_the_cell_are_a_view() -> None:
    run = motiform.preset("fig6a").simulate(2.0, transient=0.0, dt_out=1.0)
    assert np.shares_memory(run.modes, run._block)
    assert np.array_equal(run.modes[:, 1, 0], run["c2"]) and np.array_equal(run.modes[:, 2, 1], run["s3"])
    with pytest.raises(AttributeError, match="no modes"):
        motiform.Tensor().simulate(1.0).modes  # noqa: B018


def test_frames_and_datasets_hold_the_same_numbers(run: motiform.Trajectory) -> None:
    frame, data = run.to_pandas(), run.to_xarray()
    assert list(frame.columns) == run.names and frame.attrs["meanings"]["t"]
    for name in run.names:
        assert np.array_equal(frame[name].to_numpy(), run[name], equal_nan=True)
        assert np.array_equal(data[name].values, run[name], equal_nan=True)
    assert data.speed.attrs["units"] == "model length per model time" and data.speed.dims == ("t",)


def test_outlines_lie_about_the_body(run: motiform.Trajectory) -> None:
    outline = run.outline(20.3, points=300)
    assert outline is not None and outline.shape == (300, 2)
    row = run.row(20.3)
    assert run.t[row] == 20.5 and run.row(20.2) == 40
    distance = np.hypot(*(outline - run.position[row]).T)
    assert 0.3 * run.radius < distance.min() < distance.max() < 2.0 * run.radius
    for bad in (-0.1, 50.1, float("nan")):
        with pytest.raises(ValueError, match="the recording is from 0 to 50"):
            run.outline(bad)
    for radius in (-2, 0.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match=rf"radius = {radius}: give a length above 0; by default it is {run.radius:g}"):
            run.outline(20.3, radius=radius)


def test_the_field_is_that_of_the_run() -> None:
    body = motiform.Tensor(gamma=1.0, kappa2=0.5, kappa3=0.1, a1=-1.0, b1=-0.5, b2=0.3, d1=0.1, d2=0.8)
    start = {"v1": 0.3, "s11": 0.2, "u222": -0.1}
    run = body.simulate(20.0, dt_out=20.0, initial=start, rtol=1e-12, atol=1e-14)
    u = np.zeros(8)
    for name, value in start.items():
        u[body.coordinates.index(name)] = value
    other = solve_ivp(body, (0.0, 20.0), u, method="DOP853", rtol=1e-12, atol=1e-14)
    ours = np.concatenate((run.shape[-1], run.position[-1]))
    np.testing.assert_allclose(ours, other.y[:, -1], atol=1e-9)


def test_an_escape_is_an_outcome_and_a_warning() -> None:
    body = motiform.Tensor(gamma=1.0, kappa2=-1.0)
    with pytest.warns(motiform.EndedEarly, match="blew up|left every bound"):
        run = body.simulate(1000.0, initial={"s11": 0.5})
    assert run.outcome.kind == "escaped" and not run.outcome.complete and run.t[-1] < run.outcome.t
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        asked = body.simulate(1000.0, initial={"s11": 0.5}, escape_norm=10.0)
        body.simulate(1000.0, initial={"s11": 0.5}, on_end="ignore")
    assert asked.outcome.kind == "escaped"
    with pytest.raises(RuntimeError, match="the run"):
        body.simulate(1000.0, initial={"s11": 0.5}, on_end="raise")


def test_other_threads_run_meanwhile() -> None:
    """The interpreter's lock is free during a run."""
    counted, stop = [0], threading.Event()

    def count() -> None:
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    motiform.preset("fig5b").simulate(3000.0, transient=0.0, dt_out=10.0)
    before = counted[0]
    motiform.preset("fig5b").simulate(30000.0, transient=0.0, dt_out=10.0)
    stop.set()
    thread.join()
    assert counted[0] - before > 5


def test_without_tqdm_nothing_is_shown(monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setitem(sys.modules, "tqdm", None)
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    body = motiform.preset("fig5b")
    body.simulate(30000.0, transient=0.0, dt_out=10.0)
    assert capfd.readouterr() == ("", "")
    with pytest.raises(ImportError):
        body.simulate(1e7, transient=0.0, dt_out=1e4, progress=True)  # ends as soon as the bar would begin


def test_progress_is_told() -> None:
    told: list[float] = []
    motiform.preset("fig5b").simulate(300000.0, transient=0.0, dt_out=100.0, progress=told.append)
    assert told and told == sorted(told) and 0.0 <= told[0] and told[-1] <= 1.0

    def fail(_: float) -> None:
        raise ZeroDivisionError("of the callable")

    with pytest.raises(ZeroDivisionError):
        motiform.preset("fig5b").simulate(1e7, transient=0.0, dt_out=1e4, progress=fail)
