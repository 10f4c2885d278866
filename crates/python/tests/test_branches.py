"""Motions followed along a parameter."""

from __future__ import annotations

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
