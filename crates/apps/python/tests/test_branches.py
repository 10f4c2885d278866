"""Motions followed along a parameter."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

import motiform


def test_the_zigzag_is_stable_between_its_symmetry_breakings() -> None:
    body = motiform.preset("fig4").replace(kappa2=0.9, kappa3=0.1)
    found = body.branches(("kappa2", 0.7, 1.2), from_="zigzag", branches=1)
    assert found.complete and len(found) == 1
    zigzag = found[0]
    assert zigzag.motion == "zigzag" and zigzag.form == "mirror-zigzag"
    broken = zigzag.special[zigzag.special["kind"] == "symmetry-breaking"]["kappa2"].tolist()
    assert broken == pytest.approx([0.783547, 1.148047], abs=1e-6)
    assert zigzag.stable == ((broken[0], broken[1]),)
    start = zigzag.points[zigzag.points["kappa2"] == 0.9].iloc[0]
    assert start["period"] == pytest.approx(45.3131035, abs=1e-6) and start["stable"]
    assert zigzag.to_xarray().sizes["point"] == len(zigzag.points)
    axes = found.plot("period")
    assert axes.get_xlabel() == "kappa2" and axes.get_legend() is not None
    assert list(found.special["kind"]).count("symmetry-breaking") == 2


def test_a_start_that_is_another_motion_is_refused() -> None:
    body = motiform.preset("fig4").replace(kappa2=0.9, kappa3=0.1)
    with pytest.raises(ValueError, match="settles on zigzag motion"):
        body.branches(("kappa2", 0.3, 1.6), from_="circular")
    with pytest.raises(ValueError, match="is outside"):
        body.branches(("kappa2", 1.0, 1.6))
    with pytest.raises(ValueError, match="did you mean kappa2"):
        body.branches(("kapa2", 0.3, 1.6))


def test_steady_motions_alone_to_one_side_from_a_point_of_a_folder(tmp_path: Path, binary: Path) -> None:
    body = motiform.preset("fig1").replace(kappa2=-0.06, gamma=0.05)
    steady = body.branches(("gamma", -0.1, 0.1), steady=True, branches=20)
    kinds = {branch.motion for branch in steady}
    assert {"motionless", "straight", "circular"} <= kinds <= {"motionless", "straight", "circular"}
    onset = steady.special[steady.special["kind"] == "hopf"]["gamma"].tolist()
    assert any(abs(value - 0.024) < 1e-9 for value in onset)
    upwards = body.branches(("gamma", -0.1, 0.1), direction="up", branches=1, branch_step=0.01, first_step=0.002, tolerance=1e-11)
    assert upwards[0].points["gamma"].min() == 0.05 and len(upwards[0].points) > 20
    folder = tmp_path / "branches"
    along = ["--along", "gamma=-0.1:0.1", "--no-figures", "--out", folder]
    where = ["tensor", "--preset", "fig1", "--set", "kappa2=-0.06", "--set", "gamma=0.05"]
    subprocess.run([binary, "continue", *where, *along], capture_output=True, check=True)
    again = body.branches(("gamma", -0.1, 0.1), start=f"{folder}:0:5", branches=1)
    assert again[0].motion == "circular"
    with pytest.raises(ValueError, match="direction"):
        body.branches(("gamma", -0.1, 0.1), direction="sideways")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="branch_step"):
        body.branches(("gamma", -0.1, 0.1), branch_step=2.0)


def test_symmetry_breakings_lie_on_an_arch() -> None:
    body = motiform.preset("fig4").replace(kappa2=0.9, kappa3=0.1)
    plane = ("kappa2", 0.7, 1.2), ("kappa3", 0.09, 0.2)
    found = body.curves("symmetry-breaking", *plane, from_="zigzag", branches=1)
    assert found.complete and len(found) == 1 and found.parameters == ("kappa2", "kappa3")
    arch = found[0]
    assert arch.kind == "symmetry-breaking" and arch.not_found == ("doubly-critical",) and len(arch.ends) == 2
    assert arch.start["kappa2"] == pytest.approx(0.783547, abs=1e-6)
    assert 0.113 < arch.points["kappa3"].max() < 0.12
    assert arch.points["critical_re"].to_numpy() == pytest.approx(-1.0, abs=1e-6)
    assert len(found.codimension_2) == 0
    axes = found.plot()
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("kappa2", "kappa3") and axes.get_legend() is not None


def test_curves_of_other_kinds_are_refused() -> None:
    body = motiform.preset("fig4").replace(kappa2=0.9, kappa3=0.1)
    with pytest.raises(ValueError, match="did you mean hopf"):
        body.curves(["hopff"], ("kappa2", 0.3, 1.6), ("kappa3", 0.02, 0.3))
    with pytest.raises(ValueError, match="two different parameters"):
        body.curves("hopf", ("kappa2", 0.3, 1.6), ("kappa2", 0.02, 2.0))


def test_branches_of_handed_bodies_say_to_which_side_they_turn() -> None:
    found = motiform.preset("chiral").branches(("omega", 0.02, 0.2), branches=1)
    courses = set(found.points["course"])
    assert courses and courses <= {"clockwise", "anticlockwise", ""}
    assert courses & {"clockwise", "anticlockwise"}
