"""Many orbits: each is the run that it is alone, to the bit."""

import motiform
import numpy as np
import pytest


def test_members_are_single_runs() -> None:
    body = motiform.preset("fig5b")
    kappa2 = np.linspace(0.45, 0.65, 11)
    start = [0.5, 0.1, 0.1, -0.2, 0.05, 0.1, 3.0, -2.0]
    found = motiform.ensemble(body, 40.0, starts=[start], parameters={"kappa2": kappa2})
    assert found.states.shape == (11, 1, 8) and found.complete.all()
    for k, value in enumerate(kappa2):
        initial = dict(zip([*body.coordinates, "x", "y"], start, strict=True))
        run = body.replace(kappa2=value).simulate(40.0, transient=0.0, initial=initial)
        assert found["s11"][k, -1] == run["s11"][-1]
        assert np.array_equal(found.position[k, -1], run.position[-1])


def test_threads_and_company_change_nothing() -> None:
    body, times = motiform.preset("fig5b"), [0.0, 1.0, 10.0, 50.0]
    one = motiform.ensemble(body, times, starts=20, threads=1)
    two = motiform.ensemble(body, times, starts=20, threads=2)
    assert np.array_equal(one.states, two.states) and len(one) == 20
    alone = motiform.ensemble(body, times, starts=one.states[7, :1])
    assert np.array_equal(alone.states[0], one.states[7])


@pytest.mark.parametrize(("name", "how"), [("fig2", {"stepper": "rk4", "step": 0.01}), ("fig6c", {})])
def test_other_methods_and_the_cell(name: str, how: dict) -> None:
    body = motiform.preset(name)
    found = motiform.ensemble(body, [2.0, 5.0], starts=3, seed=4, **how)
    assert found.complete.all() and np.isfinite(found.states).all()
    initial = dict(zip(found.names, motiform.ensemble(body, 0.0, starts=3, seed=4).states[1, 0], strict=True))
    run = body.simulate(5.0, transient=0.0, initial=initial, **how)
    assert np.allclose(found.states[1, -1, :-2], [run[n][-1] for n in body.coordinates], rtol=1e-5, atol=1e-7)


def test_who_escapes_says_so() -> None:
    body = motiform.preset("fig4").replace(kappa2=0.2, kappa3=0.1)
    start = [[8.0, 1.0, 30.0, 0.0, -20.0, 0.0], [0.1, 0.0, 0.1, 0.0, 0.0, 0.0]]
    found = motiform.ensemble(body, [0.0, 0.01, 5.0], starts=start)
    assert list(found.complete) == [False, True]
    assert np.isnan(found["v1"][0, -1]) and np.isfinite(found["v1"][0, 0])
    assert found.outcomes[0].kind == "escaped"


@pytest.mark.parametrize(
    ("given", "word"),
    [
        ({"t": [2.0, 1.0]}, "increasing"),
        ({"t": 1.0, "starts": [[1.0]]}, "shape"),
        ({"t": 1.0, "starts": 0}, "at least 1"),
        ({"t": 1.0, "parameters": {"kapa2": [1.0]}}, "kappa2"),
        ({"t": 1.0, "parameters": {"kappa2": [1.0, 2.0], "kappa3": [1.0, 2.0, 3.0]}}, "values"),
        ({"t": 1.0, "starts": 3, "parameters": {"kappa2": [1.0, 2.0]}}, "rows"),
    ],
)
def test_wrong_input_is_named(given: dict, word: str) -> None:
    with pytest.raises((ValueError, AttributeError, TypeError), match=word):
        motiform.ensemble(motiform.preset("fig5b"), **given)
