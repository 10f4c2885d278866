"""Models whose equations are given as text."""

from __future__ import annotations

import numpy as np
import pytest

import motiform


def handed(omega: float = 0.3) -> motiform.Amplitudes:
    return motiform.Amplitudes(
        modes=[1],
        equations={"z1": "(gamma + i*omega - |z1|^2)*z1"},
        parameters={"gamma": 0.25, "omega": {"value": omega, "range": (-1, 1), "symbol": "ω", "text": "handedness"}},
        initial={"v1": 0.5},
    )


def test_a_handed_swimmer_runs_on_its_circle() -> None:
    """Speed sqrt(gamma), turning at -omega: z1 = v1 - i v2."""
    run = handed().simulate(10.0, transient=100.0, dt_out=0.1)
    speed = np.hypot(run["v1"], run["v2"])
    assert np.allclose(speed, 0.5, atol=1e-8)
    heading = np.unwrap(np.arctan2(run["v2"], run["v1"]))
    assert np.allclose(np.diff(heading) / 0.1, -0.3, atol=1e-7)


def test_the_model_describes_itself_and_reads_back() -> None:
    body = handed()
    assert body.coordinates == ["v1", "v2"]
    assert body.omega == 0.3
    assert [parameter.name for parameter in body.info.parameters] == ["gamma", "omega"]
    assert body.info.parameters[1].meaning == "handedness."
    changed = body.replace(omega=0.1)
    assert isinstance(changed, motiform.Amplitudes)
    assert changed.omega == 0.1
    assert "omega" in changed.to_toml()


def test_classified_and_scanned_like_the_others() -> None:
    assert handed().classify().regime == "circular"
    found = motiform.scan(handed(), {"omega": [-0.3, 0.3]})
    assert found["omega"].attrs["symbol"] == "*ω*"
    rates = found["turning_rate"].values.ravel()
    assert rates[0] == pytest.approx(0.3) and rates[1] == pytest.approx(-0.3)
    assert found.motiform.names("course").values.ravel().tolist() == ["anticlockwise", "clockwise"]
    assert found.motiform.to_pandas()["course"].tolist() == ["anticlockwise", "clockwise"]
    preset = motiform.preset("ohta-ohkuma")
    assert isinstance(preset, motiform.Amplitudes)


def test_errors_show_the_place() -> None:
    with pytest.raises(TypeError, match="along = 'omega': give a parameter with its range"):
        handed().branches("omega")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="equation of z1 must be text"):
        motiform.Amplitudes(modes=[1], equations={"z1": lambda z: z})  # type: ignore[dict-item]
    with pytest.raises(ValueError, match="did you mean gamma"):
        motiform.Amplitudes(modes=[1], equations={"z1": "gama*z1"}, parameters={"gamma": 1.0})
    with pytest.raises(ValueError, match="breaks rotations"):
        motiform.Amplitudes(modes=[1, 2], equations={"z1": "z1", "z2": "z1"})


@pytest.mark.parametrize("key", ["equations", "parameters", "noise"])
@pytest.mark.parametrize("given", [lambda z: z, ["z1"], "z1"])
def test_what_is_no_mapping_is_named(key: str, given: object) -> None:
    arguments: dict[str, object] = {"modes": [1], "equations": {"z1": "z1"}, key: given}
    with pytest.raises(TypeError, match=rf"^{key} = .*: give a mapping from (amplitudes|names) to" + (".*motiform.Field" if key == "equations" else "")):
        motiform.Amplitudes(**arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["units", "run", "simulate", "parameters", "replace", "self", "initial", "t_end", "seed", "random"])
def test_a_parameter_is_not_called_as_something_of_bodies(name: str) -> None:
    with pytest.raises(ValueError, match=rf"{name} is the name of (a setting of runs|an attribute of bodies): choose another name"):
        motiform.Amplitudes(modes=[1], equations={"z1": f"({name} - |z1|^2)*z1"}, parameters={name: 1.0})


def test_names_that_bodies_do_not_have_are_free() -> None:
    body = motiform.Amplitudes(modes=[1], equations={"z1": "(budget - |z1|^2)*z1"}, parameters={"budget": 1.0})
    assert body.replace(budget=2.0).budget == 2.0


def test_noise_of_equations_is_reproducible() -> None:
    body = motiform.Amplitudes(
        modes=[1, 2],
        equations={"z1": "(gamma - |z1|^2)*z1 - conj(z1)*z2", "z2": "-kappa*z2 + z1^2"},
        parameters={"gamma": 1.0, "kappa": 0.5, "D": 0.05, "s": 0.1},
        noise={"z2": "D", "z1": "s*z1"},
        initial={"v1": 1.0},
    )
    first, same, other = (body.simulate(20.0, transient=0.0, dt_out=0.1, seed=seed) for seed in (1, 1, 2))
    for name in ("x", "v1", "z2_re", "z2_im"):
        assert np.array_equal(first[name], same[name]) and not np.array_equal(first[name], other[name])
    quiet = body.replace(D=0.0, s=0.0).simulate(20.0, transient=0.0, dt_out=0.1)
    assert np.ptp(first["z2_im"]) > 1e-3 and np.abs(quiet["z2_im"]).max() < 1e-12
    assert "[model.amplitudes.noise]" in body.to_toml()
    with pytest.raises(ValueError, match="sigma"):
        motiform.Amplitudes(modes=[1], equations={"z1": "z1"}, noise={"z1": "sigma"})
