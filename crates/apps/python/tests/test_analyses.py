"""Questions about one motion."""

from __future__ import annotations

import json
import subprocess
import warnings
from pathlib import Path

import numpy as np
import pytest

import motiform


def test_verdicts_are_those_of_the_command_line(binary: Path) -> None:
    said = subprocess.run([binary, "classify", "tensor", "--preset", "fig5a", "--json"], capture_output=True, check=True)
    raw = json.loads(said.stdout)
    verdict = motiform.preset("fig5a").classify()
    assert (verdict.regime, verdict.why, verdict.period) == (raw["regime"], raw["why"], raw["period"])
    assert verdict.speed is not None and verdict.speed.mean == raw["speed"]["mean"]
    assert [estimate.value for estimate in verdict.exponents] == [entry["value"] for entry in raw["exponents"]]


def test_exponents_add_up_to_the_mean_divergence(binary: Path) -> None:
    body = motiform.preset("fig5b")
    found = body.lyapunov(6, transient=200.0, t_end=2000.0)
    arguments = ["--preset", "fig5b", "--transient", "200", "--t-end", "2000", "--json"]
    said = subprocess.run([binary, "lyapunov", "tensor", *arguments], capture_output=True, check=True)
    assert found.values.tolist() == [entry["value"] for entry in json.loads(said.stdout)["exponents"]]
    run = body.simulate(2000.0, transient=200.0, dt_out=0.1)
    step, sample = 1e-6, run.shape[::20]
    divergence = np.zeros(len(sample))
    for place in range(6):
        shift = np.zeros(6)
        shift[place] = step
        divergence += (body(0.0, (sample + shift).T) - body(0.0, (sample - shift).T))[place] / (2 * step)
    assert found.sum == pytest.approx(divergence.mean(), abs=0.02)


def test_equilibria_are_steady() -> None:
    body = motiform.preset("fig1").replace(kappa2=-0.1, gamma=0.1)
    found = body.equilibria(starts=60)
    growth = [e.eigenvalues[0].real for e in found]
    assert len(found) >= 3 and growth == sorted(growth)
    circle = [e for e in found if not any(e.shape.values())]
    assert len(circle) == 1 and circle[0].kind == "motionless" and not circle[0].stable
    for e in found:
        u = np.array([e.shape[name] for name in body.coordinates])
        speed = float(np.hypot(*body(0.0, np.concatenate((u, [0.0, 0.0])))[6:]))
        assert speed == pytest.approx(e.speed, abs=1e-12)
        if e.kind != "circular":
            assert np.abs(body(0.0, u)).max() < 1e-9
    assert body.classify().regime in {e.kind for e in found if e.stable} | {"quasi-periodic", "zigzag", "rectangular"}


def test_sections_are_crossed_where_they_are() -> None:
    body = motiform.preset("fig5a")
    found = body.section("s12", 0.1, "rising", t_end=300.0)
    assert len(found) > 5 and found.outcome.complete
    table = found.table
    np.testing.assert_allclose(table["s12"], 0.1, atol=1e-9)
    assert table["rising"].dtype == bool and table["rising"].all()
    slopes = [body(0.0, row)[3] for row in table[body.coordinates].to_numpy()]
    assert min(slopes) > 0.0
    assert found.pairs("v1").shape == (len(found) - 1, 2)
    both = body.section("y", t_end=300.0).table
    np.testing.assert_allclose(both["y"], 0.0, atol=1e-9)
    with pytest.raises(ValueError, match="unknown"):
        body.section("w")
    with pytest.raises(ValueError, match="direction"):
        body.section("y", 0.0, "up")  # type: ignore[arg-type]


def test_shares_of_many_starts_are_those_of_the_command_line(binary: Path) -> None:
    body = motiform.preset("fig1").replace(kappa2=0.1, gamma=0.05)
    found = body.motions(6, threads=2)
    arguments = ["--preset", "fig1", "--set", "kappa2=0.1", "--set", "gamma=0.05", "--samples", "6", "--json"]
    said = json.loads(subprocess.run([binary, "classify", "tensor", *arguments], capture_output=True, check=True).stdout)
    shares = [{name: value for name, value in share.__dict__.items() if value is not None} for share in found.shares]
    assert shares == said["shares"]
    assert found.starts == said["starts"] and found.starts["random"] == {"min": 0.01, "max": 1.0}
    assert [verdict.why for verdict in found.verdicts] == [entry["why"] for entry in said["samples"]]
    assert sum(share.count for share in found.shares) == 6
    assert all(share.lower <= share.value <= share.upper for share in found.shares)
    assert "of 6 starts of size 0.01 to 1, log-uniform" in str(found)
    small, text = body.motions(2, random=0.01), body.motions(2, random="0.5:0.5")
    assert small.starts["words"] == "uniform within ±0.01" and text.starts["words"] == "of size 0.5"
    with pytest.raises((ValueError, TypeError), match="random"):
        body.motions(2, random=(1.0, 0.1))


def test_averages_that_are_too_short_have_no_error() -> None:
    short = motiform.preset("fig5b").lyapunov(1, transient=0.0, t_end=0.01)
    assert np.isinf(short.errors).all() and short.without_error is not None
    assert "(no error)" in str(short)
    enough = motiform.preset("fig5b").lyapunov(1, transient=200.0, t_end=1000.0)
    assert np.isfinite(enough.errors).all() and enough.without_error is None


def test_results_state_their_accuracy(binary: Path) -> None:
    body = motiform.preset("fig5b").replace(kappa2=0.9)
    found = body.lyapunov(1, transient=10.0, t_end=100.0)
    assert str(found.accuracy) == "dop853, rtol 1e-09, atol 1e-12" and str(found).startswith("λ1 = ")
    assert body.classify().accuracy == found.accuracy
    assert all(verdict.accuracy == found.accuracy for verdict in body.motions(2).verdicts)


def test_what_is_probably_not_meant_is_a_warning() -> None:
    tied = motiform.preset("fig4").tie(b3="d3")
    says = "the tie b3 = d3 says 0 = 0 everywhere here: d3 is 0 and is not varied"
    with pytest.warns(motiform.Doubtful, match=says) as caught:
        tied.classify()
    assert caught[0].filename == __file__
    with pytest.warns(motiform.Doubtful, match=says):
        motiform.scan(tied, {"kappa2": "0.5:0.6:2"}, progress=False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        motiform.scan(tied, {"d3": "0.05:0.06:2"}, progress=False)
        tied.replace(d3=0.05).classify()
    with pytest.warns(motiform.Doubtful, match="the equations of cell are stiff, and dop853 is an explicit method"):
        motiform.preset("fig6a").simulate(0.01, stepper="dop853", max_steps=50, transient=0.0)


def test_wishes_that_are_none_are_refused_before_the_run() -> None:
    body = motiform.preset("fig5a")
    for call in (
        lambda: body.simulate(1.0, on_end="stop"),  # type: ignore[arg-type]
        lambda: body.lyapunov(1, on_end="stop"),  # type: ignore[arg-type]
        lambda: body.section("y", on_end="stop"),  # type: ignore[arg-type]
    ):
        with pytest.raises(ValueError, match="on_end = 'stop': give 'warn'"):
            call()
    with pytest.raises(ValueError, match="starts = -1: give a whole number above 0"):
        body.equilibria(starts=-1)
