"""Statistics of many bodies."""

from __future__ import annotations

import math
import subprocess
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest

import motiform


def test_noise_on_a_straight_body_is_a_persistent_walk() -> None:
    body = motiform.Tensor(gamma=1.0, kappa2=2.0, kappa3=2.0)
    found = body.statistics(24, t_end=400.0, transient=20.0, noise=0.3, threads=2)
    assert found.bodies == 24 and found.complete and found.persistence.known and found.diffusion.known
    low, high = found.diffusion.lower, found.diffusion.upper
    assert low < found.diffusion.value < high
    assert found.late_diffusion.lower < high and low < found.late_diffusion.upper  # two estimators of one number
    assert found.green_kubo.lower < found.late_diffusion.value < found.green_kubo.upper
    assert float(found.walk_speed) == pytest.approx(1.0, rel=0.2)  # |v| = sqrt(gamma) without noise
    assert set(found.correlation_times) == {"velocity", "heading", "speed", "s", "u"} - _steady(found)
    speeds = found.distributions.query("quantity == 'speed'")
    assert (speeds["density"] * (speeds["to"] - speeds["from"])).sum() == pytest.approx(1.0)
    data = found.to_xarray()
    assert data["msd"].dims == ("lag",) and set(data["correlation"].dims) == {"time_lag", "quantity"}
    for what in ["msd", "exponent", "autocorrelations", "speed", "turning_angle", "spectra", "first_passage"]:
        axes = found.plot(what)
        assert axes.lines or axes.patches
        plt.close("all")
    with pytest.raises(ValueError, match="choose one of msd"):
        found.plot("mds")
    again = body.statistics(24, t_end=400.0, transient=20.0, noise=0.3, threads=1)
    assert again.msd.equals(found.msd)


def _steady(found: motiform.Statistics) -> set[str]:
    return {"u"} if "u" not in found.correlation_times else set()


def test_a_number_that_is_not_known_has_a_reason() -> None:
    found = motiform.Tensor(gamma=1.0, kappa2=2.0, kappa3=2.0).statistics(8, t_end=50.0, transient=50.0)
    assert not found.diffusion.known and found.diffusion.reason.startswith("not reached")
    assert math.isnan(float(found.diffusion)) and "unknown" in str(found.diffusion)


def test_what_is_wrong_is_named() -> None:
    body = motiform.Tensor(gamma=1.0)
    with pytest.raises(ValueError, match="without noise all bodies"):
        body.statistics(8, initial={"v1": 0.1})
    with pytest.raises(ValueError, match="choose one of speed"):
        body.statistics(8, t_end=20.0, threshold="sped")
    with pytest.raises(ValueError, match="bodies = 0"):
        body.statistics(0)


def test_bodies_that_are_left_out_are_warned_of(tmp_path: Path, binary: Path) -> None:
    body = motiform.preset("fig5a")
    with pytest.warns(motiform.EndedEarly, match="of 8 bodies are left out.*blew up at") as warned:
        found = body.statistics(8, t_end=50.0, noise=0.1)
    assert found.complete and found.bodies < 8 and [str(one.message) for one in warned] == found.summary["notes"]
    assert Path(warned[0].filename) == Path(__file__)
    escaping = "simulate tensor --preset fig4 --set kappa2=0.2 --set kappa3=0.1 --t-end 50 --transient 0 --dt-out 0.001 --no-figures"
    start = "v1=8 v2=1 s11=30 u111=-20".split()
    words = [*escaping.split(), *(word for value in start for word in ("--initial", value))]
    subprocess.run([binary, *words, "--out", tmp_path / "one"], capture_output=True)
    with pytest.warns(motiform.EndedEarly, match="one: .*it counts as far as it goes"):
        motiform.statistics(tmp_path / "one")


def test_an_interruption_keeps_what_is_finished() -> None:
    def stop(fraction: float) -> None:
        if fraction > 0.1:
            raise KeyboardInterrupt

    body = motiform.Tensor(gamma=1.0, kappa2=2.0, kappa3=2.0)
    with pytest.raises(motiform.Interrupted) as stopped:
        body.statistics(1000, t_end=400.0, noise=0.1, threads=2, progress=stop)
    part = stopped.value.result
    assert isinstance(part, motiform.Statistics) and not part.complete and 0 < part.bodies < 1000


def test_datasets_of_the_command_line_are_bodies(tmp_path: Path, binary: Path) -> None:
    for seed in "123":
        words = ["simulate", "tensor", "--set", "gamma=1", "--noise", "0.2", "--t-end", "300", "--no-figures"]
        subprocess.run(
            [binary, *words, "--seed", seed, "--out", tmp_path / seed], check=True, capture_output=True
        )
    found = motiform.statistics([tmp_path / seed for seed in "123"], transient=10.0)
    assert found.bodies == 3 and found.summary["errors"]["over"] == "blocks"
    assert np.isfinite(found.msd["msd"]).all()
