"""Mean lives of transient chaos."""

from __future__ import annotations

import json
import pickle
import subprocess
from pathlib import Path

import numpy as np
import pytest

import motiform

BODY = motiform.preset("fig4").replace(kappa3=0.1)
ASKED = {"kappa2": [0.1, 0.2]}


def test_lives_are_those_of_the_command_line(tmp_path: Path, binary: Path) -> None:
    found = BODY.lifetimes(ASKED, samples=6, until=400.0, threads=1, out=tmp_path / "here", progress=False)
    words = "lifetimes tensor --preset fig4 --set kappa3=0.1 --axis kappa2=0.1,0.2 --samples 6 --until 400 --json --out there"
    there = json.loads(subprocess.run([binary, *words.split()], cwd=tmp_path, check=False, capture_output=True).stdout)
    assert found.summary == there and found.law == "too-few"
    assert motiform.read(tmp_path / "there") == found == motiform.read(tmp_path / "here") == pickle.loads(pickle.dumps(found))
    for name in ["lifetimes.json", "orbits.json", "mean-life.svg"]:
        assert (tmp_path / "here" / name).read_bytes() == (tmp_path / "there" / name).read_bytes(), name
    again = BODY.lifetimes(ASKED, samples=6, until=400.0, threads=2, out=tmp_path / "here", resume=True)
    assert again == found
    table = found.values
    assert (table["starts"] == table[["blew_up", "captured", "lasting", "regular", "lost"]].sum(axis=1)).all()
    assert (table["lower"] <= table["life"].fillna(np.inf)).all() and list(table["kappa2"]) == [0.1, 0.2]
    minutes = found.in_units("20um,2min")
    assert np.array_equal(minutes.values["watched"], 2.0 * table["watched"]) and minutes.values["events"].equals(table["events"])
    assert found.plot().get_ylabel() == "mean life (model time)"


def test_what_is_wrong_is_named(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="until = 0: give a model time above 0"):
        BODY.lifetimes(ASKED, until=0.0)
    with pytest.raises(TypeError, match="give one parameter with its values"):
        BODY.lifetimes({"kappa2": [0.1], "kappa3": [0.1]})
    with pytest.raises(TypeError, match="did you mean kappa2"):
        BODY.lifetimes({"kapa2": [0.1]})
    with pytest.raises(TypeError, match="samples must be a whole number"):
        BODY.lifetimes(ASKED, samples=2.5)  # type: ignore[arg-type]
    BODY.lifetimes(ASKED, samples=2, until=200.0, out=tmp_path / "lives")
    with pytest.raises(ValueError, match="overwrite=True"):
        BODY.lifetimes(ASKED, samples=3, until=200.0, out=tmp_path / "lives", resume=True)
