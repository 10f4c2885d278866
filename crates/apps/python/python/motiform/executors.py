"""A scan on any executor: task sizes are adapted during the scan, and lost tasks are submitted again."""

from __future__ import annotations

import queue
import warnings
from collections import deque
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _motiform
from ._registry import VERSION
from .errors import WorkersLost

if TYPE_CHECKING:
    from .scans import Table

TASK_SECONDS = 1.0
"""A task starts no further cell after this time (seconds); the rest of its cells is returned and submitted again."""
LEAST_SECONDS = 0.2
"""Tasks are not made shorter than this (seconds), according to the speed measured so far."""
TRIES = 5
"""How often the same cells may be lost before the scan gives up."""

Cells = tuple[int, int, int]
"""First cell, last cell (exclusive), how often they were lost."""


@lru_cache(maxsize=4)
def _plan(text: str) -> _motiform.ScanPlan:
    return _motiform.ScanPlan.of_json(text)


def task(text: str, first: int, last: int, why: bool, version: str) -> tuple[_motiform.Arrays, int, float]:
    """Runs on a worker. Returns the rows of cells from `first` on, the next cell, and the seconds. Idempotent."""
    if version != VERSION:
        raise RuntimeError(f"the worker has motiform {VERSION}, but the scan was started by {version}: install the same version")
    return _plan(text).task(first, last, TASK_SECONDS, why)


def workers(executor: Executor) -> int:
    """Number of tasks that an executor runs at once, if it reports this."""
    client = getattr(executor, "_client", None)
    if client is not None and hasattr(client, "ncores"):  # dask.distributed
        return max(1, int(sum(client.ncores().values())))
    for name in ("_max_workers", "num_workers"):
        count = getattr(executor, name, None)
        if isinstance(count, int) and count > 0:
            return count
    return 8


def gather(
    plan: _motiform.ScanPlan,
    executor: Executor,
    table: Table | None,
    files: _motiform.ScanFiles | None,
    progress: Callable[[float], object] | None,
) -> BaseException | None:
    """Computes a plan on an executor into `table`, or the remaining parts of `files`; returns the exception that stopped it, if any."""
    work = _Work(plan, executor, table, files, progress)
    del files
    try:
        work.run()
    except KeyboardInterrupt as stop:
        work.cancel()
        return stop
    except BaseException:
        work.cancel()
        raise
    finally:
        work.close()
    return None


class _Work:
    """The state of a running scan."""

    def __init__(
        self,
        plan: _motiform.ScanPlan,
        executor: Executor,
        table: Table | None,
        files: _motiform.ScanFiles | None,
        progress: Callable[[float], object] | None,
    ) -> None:
        self._plan, self._executor, self._progress = plan, executor, progress
        self._text, self._workers = plan.to_json(), workers(executor)
        self._keeper = _Keeper(plan, files) if files is not None else None
        self._table = table
        self._whys = files is not None or (table is not None and table.whys is not None)
        spans = [(0, plan.cells)] if files is None else [plan.cells_of(part) for part in files.left()]
        self._left: deque[Cells] = deque((first, last, 0) for first, last in spans)
        self._cells = self._remaining = sum(last - first for first, last in spans)
        self._flying: dict[Future[Any], Cells] = {}
        self._arrived: queue.SimpleQueue[Future[Any]] = queue.SimpleQueue()
        self._seconds, self._seen = 0.0, 0  # of worker time, for so many cells
        self._broken = False

    def run(self) -> None:
        """Runs until every cell is computed."""
        while self._left or self._flying:
            while self._left and len(self._flying) < 2 * self._workers and not self._broken:
                self._submit(self._cut())
            if self._broken and self._left and not self._flying:
                self._here(self._left.popleft())
                continue
            try:
                future = self._arrived.get(timeout=0.1)
            except queue.Empty:
                continue
            self._take(future)

    def cancel(self) -> None:
        """Cancels tasks that have not started."""
        for future in self._flying:
            future.cancel()

    def close(self) -> None:
        """Releases the folder, even if a traceback keeps this object alive."""
        if self._keeper is not None:
            self._keeper.close()

    def _cut(self) -> Cells:
        """The next cells: an even share of the remaining ones, so that the last tasks end together, but no less than
        `LEAST_SECONDS` of work."""
        first, last, lost = self._left.popleft()
        share = -(-self._remaining // (3 * self._workers))
        least = int(LEAST_SECONDS * self._seen / self._seconds) + 1 if self._seconds > 0 else 1
        end = min(last, first + max(share, least, 1))
        if end < last:
            self._left.appendleft((end, last, lost))
        return first, end, lost

    def _submit(self, cells: Cells) -> None:
        try:
            future = self._executor.submit(task, self._text, cells[0], cells[1], self._whys, VERSION)
        except (BrokenExecutor, RuntimeError) as error:
            self._break(error)
            self._left.appendleft(cells)
            return
        self._flying[future] = cells
        future.add_done_callback(self._arrived.put)

    def _take(self, future: Future[Any]) -> None:
        first, last, lost = self._flying.pop(future)
        try:
            arrays, end, seconds = future.result()
        except KeyboardInterrupt:
            raise
        except BrokenExecutor as error:
            self._break(error)
            self._left.appendleft((first, last, lost))
        except BaseException as error:
            if isinstance(error, (ValueError, TypeError)) or lost + 1 >= TRIES:
                raise RuntimeError(f"cells {first} to {last} could not be computed by the executor: {error}") from error
            self._left.append((first, last, lost + 1))
        else:
            if end < last:
                self._left.append((end, last, 0))
            self._seconds, self._seen = self._seconds + seconds, self._seen + end - first
            self._keep(first, end, arrays)

    def _keep(self, first: int, end: int, arrays: _motiform.Arrays) -> None:
        if self._table is not None:
            self._table.put(first, arrays)
        if self._keeper is not None:
            self._keeper.put(first, end, arrays)
        self._remaining -= end - first
        if self._progress is not None:
            self._progress(1.0 - self._remaining / self._cells)

    def _break(self, error: BaseException) -> None:
        if not self._broken:
            text = f"the executor failed ({error or type(error).__name__}): the rest is computed in this process"
            warnings.warn(text, WorkersLost, stacklevel=6)
        self._broken = True

    def _here(self, cells: Cells) -> None:
        arrays, end, _ = self._plan.task(cells[0], cells[1], TASK_SECONDS, self._whys)
        if end < cells[1]:
            self._left.appendleft((end, *cells[1:]))
        self._keep(cells[0], end, arrays)


class _Keeper:
    """Holds the rows of incomplete parts, and writes complete parts to the files."""

    def __init__(self, plan: _motiform.ScanPlan, files: _motiform.ScanFiles) -> None:
        self._plan, self._files = plan, files
        self._size = plan.cells_of(0)[1]  # all parts but the last have as many cells
        self._waiting: dict[int, dict[int, _motiform.Arrays]] = {}

    def put(self, first: int, end: int, arrays: _motiform.Arrays) -> None:
        """Adds rows of cells ``first..end``, which lie in one part."""
        part = first // self._size
        pieces = self._waiting.setdefault(part, {})
        pieces[first] = arrays
        start, last = self._plan.cells_of(part)
        if sum(len(piece[0][0]) for piece in pieces.values()) < (last - start) * self._plan.samples:
            return
        ordered = [pieces[place] for place in sorted(pieces)]
        regimes, attractors, courses = (
            [code for piece in ordered for code in piece[0][kind].tolist()] for kind in range(3)
        )
        numbers = [np.concatenate(columns) for columns in zip(*(piece[1] for piece in ordered), strict=True)]
        whys = [why for piece in ordered for why in piece[2] or []]
        self._files.keep(part, (regimes, attractors, courses), numbers, whys)
        del self._waiting[part]

    def close(self) -> None:
        """Releases the files."""
        del self._files
