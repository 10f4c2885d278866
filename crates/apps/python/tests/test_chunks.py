"""Tables of any length: chunks of rows, in memory that does not grow with the table."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import motiform

GROUP = 1 << 18


def written(binary: Path, folder: Path, rows: int, more: str = "") -> Path:
    """A folder of a run with this many rows."""
    words = f"simulate tensor --preset fig5a --transient 0 --dt-out 0.01 --t-end {(rows - 1) * 0.01} --no-figures {more} --out"
    subprocess.run([binary, *words.split(), folder], check=True, capture_output=True)
    return folder


@pytest.fixture(scope="module")
def run(binary: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return written(binary, tmp_path_factory.mktemp("chunks") / "run", GROUP + 1000)


def test_chunks_are_the_whole_table(run: Path) -> None:
    whole = motiform.read(run)
    assert isinstance(whole, motiform.Trajectory)
    parts = list(motiform.chunks(run))
    assert [len(part) for part in parts] == [GROUP, 1000]
    pd.testing.assert_frame_equal(pd.concat(parts), whole.to_pandas(), check_exact=True)
    assert parts[1].attrs["meanings"]["speed"] == whole.meaning("speed")
    table = motiform.chunks(run / "trajectory.parquet")
    assert sum(len(part) for part in table) == len(whole)


def test_columns_alone_and_in_the_order_asked_for(run: Path) -> None:
    parts = list(motiform.chunks(run, columns=["speed", "t"]))
    whole = motiform.read(run)
    assert isinstance(whole, motiform.Trajectory)
    assert all(list(part.columns) == ["speed", "t"] for part in parts)
    np.testing.assert_array_equal(np.concatenate([part.speed for part in parts]), whole["speed"])
    with pytest.raises(OSError, match="no column z: it has t, x, y"):
        next(motiform.chunks(run, columns=["z"]))


def test_text_and_short_tables(binary: Path, tmp_path: Path) -> None:
    folder = written(binary, tmp_path / "text", 70_000, "--format csv")
    parts = list(motiform.chunks(folder))
    assert len(parts) == 2 and list(parts[1].index[[0, -1]]) == [1 << 16, 69_999]
    whole = motiform.read(folder)
    assert isinstance(whole, motiform.Trajectory)
    pd.testing.assert_frame_equal(pd.concat(parts), whole.to_pandas(), check_exact=True)
    assert [len(part) for part in motiform.chunks(written(binary, tmp_path / "short", 3))] == [3]


def test_what_is_no_table_is_refused(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "none.parquet", tmp_path / "none.txt"):
        with pytest.raises(OSError, match="none|no trajectory"):
            next(motiform.chunks(path))


def test_a_reader_that_stops_early_is_left_alone(run: Path) -> None:
    for _ in range(50):
        assert len(next(motiform.chunks(run, columns=["t"]))) == GROUP


def test_memory_does_not_grow_with_the_table(binary: Path, tmp_path: Path) -> None:
    pytest.importorskip("resource")
    program = """
import resource, sys
import motiform
for path in sys.argv[1:]:
    rows = sum(len(part) for part in motiform.chunks(path))
    print(rows, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""
    folders = [written(binary, tmp_path / str(groups), groups * GROUP) for groups in (2, 8)]
    done = subprocess.run([sys.executable, "-c", program, *folders], check=True, capture_output=True, text=True)
    (few, little), (many, much) = (map(int, line.split()) for line in done.stdout.splitlines())
    assert (few, many) == (2 * GROUP, 8 * GROUP)
    columns = len(next(motiform.chunks(folders[0])).columns)
    # The longer table has 6 groups more; 2 of them may be noise of the allocator. (ru_maxrss is in KiB on Linux, in bytes on macOS.)
    unit = 1 if sys.platform == "darwin" else 1024
    assert (much - little) * unit < 2 * GROUP * columns * 8
