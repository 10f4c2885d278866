"""Verification: the same findings as the command line, and every kind of damage."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

import motiform

RUN = "simulate tensor --preset fig5a --t-end 20 --dt-out 0.1 --transient 0 --no-figures --format csv --out"


def run(binary: Path, words: str, folder: Path) -> None:
    subprocess.run([binary, *words.split(), folder], check=True, capture_output=True)


def test_intact_results(binary: Path, tmp_path: Path) -> None:
    run(binary, RUN, tmp_path / "run")
    found = motiform.verify(tmp_path / "run", all=True)
    assert (found.intact, found.kind, found.rows, found.problems) == (True, "dataset", 201, ())
    assert found.complete and found.version == motiform.__version__ and "computed again" in found.checked
    (tmp_path / "run/notes.md").write_text("mine")
    again = motiform.verify(tmp_path / "run")
    assert again.intact and again.foreign == ("notes.md",)

    motiform.scan(motiform.preset("fig1"), {"kappa2": "0.1:0.2:3"}, budget=300.0, out=tmp_path / "scan", progress=False)
    scan = motiform.verify(tmp_path / "scan", all=True, progress=False)
    assert (scan.intact, scan.kind, scan.rows) == (True, "scan", 3)


def test_damage_is_found_as_the_command_line_finds_it(binary: Path, tmp_path: Path) -> None:
    run(binary, RUN, tmp_path / "run")
    table = tmp_path / "run/trajectory.csv"
    lines = table.read_text().splitlines(keepends=True)
    row = lines[50].split(",")
    row[2] = repr(float(row[2]) * (1.0 + 1e-12))
    table.write_text("".join([*lines[:50], ",".join(row), *lines[51:]]))
    found = motiform.verify(tmp_path / "run", all=True)
    assert not found.intact and found.changed == ("trajectory.csv",)
    assert any("row 49" in problem for problem in found.problems), found.problems
    done = subprocess.run([binary, "verify", tmp_path / "run", "--all", "--json"], capture_output=True)
    seen = json.loads(done.stdout)
    assert done.returncode == 1 and seen["different"] == list(found.different) and seen["rows"] == found.rows


def test_branches_and_their_plan(binary: Path, tmp_path: Path) -> None:
    folder = tmp_path / "branches"
    run(binary, "continue tensor --preset fig5a --along kappa2=0.85:0.95 --branches 1 --points 5 --out", folder)
    assert motiform.verify(folder).intact
    manifest = folder / "manifest.json"
    manifest.write_text(manifest.read_text().replace("0.85", "0.84"))
    found = motiform.verify(folder)
    assert "manifest.json is changed" in found.problems and "does not give its hash" in found.problems[1]
    assert "not intact" in str(found)


def test_what_is_no_result(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        motiform.verify(tmp_path / "nothing")
    with pytest.raises(ValueError, match="no inventory"):
        motiform.verify(tmp_path)
    (tmp_path / "_inventory.jsonl").write_text("{}")
    with pytest.raises(OSError, match="no inventory of motiform"):
        motiform.verify(tmp_path)


def test_a_stop_ends_it(binary: Path, tmp_path: Path) -> None:
    run(binary, RUN.replace("--t-end 20", "--t-end 20000"), tmp_path / "run")

    def stop(_: float) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        motiform.verify(tmp_path / "run", all=True, progress=stop)
    reported: list[float] = []
    assert motiform.verify(tmp_path / "run", all=True, progress=reported.append).rows == 200_001
    assert reported and max(reported) <= 1.0
