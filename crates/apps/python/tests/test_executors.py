"""Scans on executors: the same bits as a local scan, also when workers are lost."""

from __future__ import annotations

import os
import signal
import time
import warnings
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import motiform
from motiform import executors

AXES = {"kappa2": "-0.2:0.2:12", "gamma": "-0.1:0.1:8"}
BODY = motiform.preset("fig1")


@pytest.fixture(scope="module")
def local() -> xr.Dataset:
    return motiform.scan(BODY, AXES, samples=2, why=True, progress=False)


@pytest.fixture(autouse=True)
def many_tasks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Tasks much shorter than real ones, so that there are many."""
    monkeypatch.setattr(executors, "LEAST_SECONDS", 0.005)


def test_threads_and_processes(local: xr.Dataset) -> None:
    with ThreadPoolExecutor(3) as pool:
        xr.testing.assert_identical(motiform.scan(BODY, AXES, samples=2, why=True, executor=pool), local)
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        xr.testing.assert_identical(motiform.scan(BODY, AXES, samples=2, why=True, executor=pool), local)


def test_folders_are_filled_and_resumed(local: xr.Dataset, tmp_path: Path) -> None:
    with ThreadPoolExecutor(3) as pool:
        found = motiform.scan(BODY, AXES, samples=2, why=True, executor=pool, out=tmp_path / "a", progress=False)
    xr.testing.assert_identical(found, local)
    motiform.scan(BODY, AXES, samples=2, out=tmp_path / "b", progress=False)
    parts = sorted((tmp_path / "a").glob("part-*.parquet"))
    assert [part.read_bytes() for part in parts] == [(tmp_path / "b" / part.name).read_bytes() for part in parts]
    parts[0].unlink()
    tasks = Counting()
    found = motiform.scan(BODY, AXES, samples=2, why=True, executor=tasks, out=tmp_path / "a", resume=True)
    xr.testing.assert_identical(found, local)
    assert 0 < tasks.cells < 96


class Counting(Executor):
    """Computes at once, and counts."""

    def __init__(self) -> None:
        self.cells = 0

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        future.set_result(fn(*args, **kwargs))
        self.cells += future.result()[1] - args[1]
        return future


class Losing(Counting):
    """Loses every task twice."""

    def __init__(self) -> None:
        super().__init__()
        self.tries: dict[int, int] = {}

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        first = args[1]
        self.tries[first] = self.tries.get(first, 0) + 1
        if self.tries[first] > 2:
            return super().submit(fn, *args, **kwargs)
        future: Future[Any] = Future()
        future.set_exception(ConnectionError("the worker is gone"))
        return future


def test_lost_tasks_are_given_out_again(local: xr.Dataset) -> None:
    losing = Losing()
    xr.testing.assert_identical(motiform.scan(BODY, AXES, samples=2, why=True, executor=losing), local)
    assert len(losing.tries) > 3 and set(losing.tries.values()) == {3}


class Hopeless(Counting):
    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        future.set_exception(ConnectionError("the worker is gone"))
        return future


def test_what_is_lost_again_and_again_is_said() -> None:
    with pytest.raises(RuntimeError, match="cells 0 to .* could not be computed by the executor: the worker is gone"):
        motiform.scan(BODY, AXES, executor=Hopeless())


def test_a_broken_pool_is_no_end(local: xr.Dataset) -> None:
    pool = ProcessPoolExecutor(2, mp_context=get_context("spawn"))
    pool.submit(os.getpid).result()

    def kill(_: float) -> None:
        for process in pool._processes.values():
            process.kill()

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = motiform.scan(BODY, AXES, samples=2, why=True, executor=pool, progress=kill)
    xr.testing.assert_identical(found, local)
    assert any(issubclass(entry.category, motiform.WorkersLost) for entry in caught)
    pool.shutdown()


@pytest.mark.filterwarnings("ignore")  # dask warns of its own ports and closing sockets
def test_dask_survives_a_killed_worker(local: xr.Dataset) -> None:
    from distributed import Client, LocalCluster

    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster, Client(cluster) as client:
        killed: list[int] = []

        def kill(fraction: float) -> None:
            if not killed and fraction > 0.1:
                pid = cluster.workers[0].pid
                os.kill(pid, signal.SIGKILL)
                killed.append(pid)

        axes = {"kappa2": "-0.2:0.2:24", "gamma": "-0.1:0.1:16"}
        assert executors.workers(client.get_executor()) == 2
        found = motiform.scan(BODY, axes, why=True, executor=client.get_executor(), progress=kill)
        assert killed
    xr.testing.assert_identical(found, motiform.scan(BODY, axes, why=True, progress=False))


def test_ctrl_c_keeps_what_is_done(local: xr.Dataset) -> None:
    def press(fraction: float) -> None:
        if fraction > 0.2:
            signal.raise_signal(signal.SIGINT)

    with ThreadPoolExecutor(2) as pool, pytest.raises(motiform.Interrupted) as stop:
        motiform.scan(BODY, AXES, samples=2, why=True, executor=pool, progress=press)
    partial = stop.value.result
    assert isinstance(partial, xr.Dataset)
    done = partial.regime >= 0
    assert 0 < int(done.sum()) < done.size
    assert bool((partial.regime == local.regime).where(done, True).all())


@pytest.mark.parametrize("pooled", [False, True])
def test_a_stopped_scan_leaves_its_folder_free(local: xr.Dataset, tmp_path: Path, pooled: bool) -> None:
    """The exception is kept, as a notebook keeps the last one, and the scan is resumed."""

    def press(fraction: float) -> None:
        if fraction > 0.2:
            raise KeyboardInterrupt

    with ThreadPoolExecutor(2) as pool:
        executor = pool if pooled else None
        with pytest.raises(motiform.Interrupted) as stop:
            motiform.scan(BODY, AXES, samples=2, executor=executor, out=tmp_path / "a", progress=press)
    found = motiform.scan(BODY, AXES, samples=2, why=True, out=tmp_path / "a", resume=True, progress=False)
    xr.testing.assert_identical(found, local)
    assert isinstance(stop.value.result, xr.Dataset)


def test_a_failed_scan_leaves_its_folder_free(local: xr.Dataset, tmp_path: Path) -> None:
    with pytest.raises(RuntimeError) as stop:
        motiform.scan(BODY, AXES, samples=2, executor=Hopeless(), out=tmp_path / "a")
    found = motiform.scan(BODY, AXES, samples=2, why=True, out=tmp_path / "a", resume=True, progress=False)
    xr.testing.assert_identical(found, local)
    assert "worker is gone" in str(stop.value)


def test_a_task_ends_in_time() -> None:
    """A task begins no cell after its time, and says where to go on."""
    from motiform import _motiform

    plan = _motiform.ScanPlan(BODY._study, [("kappa2", "-0.2:0.2:200"), ("gamma", "-0.1:0.1:200")])
    began = time.monotonic()
    arrays, end, seconds = plan.task(0, plan.cells, 0.2, False)
    assert 0 < end < plan.cells and len(arrays[0][0]) == end and arrays[2] is None
    assert 0.2 <= seconds <= time.monotonic() - began
