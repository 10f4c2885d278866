"""Random input never crashes the interpreter: it is used, or refused clearly."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import motiform

BODY = motiform.preset("fig5b")
DTYPES = st.sampled_from([np.float64, np.float32, np.int32, np.uint8, np.bool_, ">f8", np.float16])


@given(hnp.arrays(DTYPES, hnp.array_shapes(max_dims=3, max_side=9)), st.booleans(), st.integers(1, 3))
@settings(deadline=None)
def test_any_array_is_used_or_refused(array: npt.NDArray[np.float64], fortran: bool, stride: int) -> None:
    view = (np.asfortranarray(array) if fortran else array)[..., ::stride]
    fits = view.ndim in (1, 2) and view.shape[0] in (6, 8)
    if not fits:
        with pytest.raises(ValueError, match="entries|dimensions"):
            BODY(0.0, view)
        return
    rates = BODY(0.0, view)
    plain = np.array(view, dtype=np.float64, order="C")
    assert rates.shape == view.shape and rates.dtype == np.float64
    assert np.array_equal(rates, BODY(0.0, plain), equal_nan=True)


@pytest.mark.parametrize("wrong", [np.zeros(6, complex), np.array(["a"] * 6), np.array([None] * 6), [{}] * 6])
def test_what_is_not_real_is_refused(wrong: npt.ArrayLike) -> None:
    with pytest.raises(TypeError, match="must hold real numbers"):
        BODY(0.0, wrong)


@pytest.mark.parametrize(
    ("call", "match"),
    [
        (lambda: BODY.lyapunov(2.5), "count must be a whole number of at least 0, not 2.5"),
        (lambda: BODY.equilibria(starts="a"), "starts must be a whole number"),
        (lambda: BODY.branches(("kappa2", 0.1, 1.0), points=0.5), "points must be a whole number"),
        (lambda: BODY.atlas({"kappa2": 3, "kappa3": (0.1, 1.0)}), "kappa2 = 3: give .low, high."),
        (lambda: BODY.statistics(4, threshold=3), "threshold = 3: give a quantity"),
        (lambda: BODY.statistics(4, radii=["x"]), "radii must hold real numbers"),
        (lambda: BODY.simulate(10.0, random=(1.0,)), "random = .1.0,.: give a size"),
        (lambda: motiform.ensemble(BODY, "x"), "t must hold real numbers"),
        (lambda: motiform.ensemble(BODY, 1.0, parameters={"kappa2": "x"}), "parameters.'kappa2'. must hold real numbers"),
        (lambda: motiform.scan("fig1", {"kappa2": [0.1]}), "give a body"),
        (lambda: motiform.scan(BODY, ["kappa2"]), "a mapping from parameters to values"),
    ],
)
def test_what_is_of_another_kind_is_named(call: Callable[[], object], match: str) -> None:
    with pytest.raises((TypeError, ValueError), match=match):
        call()


FINITE = st.floats(allow_nan=True, allow_infinity=True)


@given(st.dictionaries(st.sampled_from([spec.name for spec in BODY.info.parameters]), FINITE, max_size=5))
@settings(deadline=None, max_examples=60)
def test_any_parameters_run_or_are_refused(parameters: dict[str, float]) -> None:
    try:
        body = motiform.Tensor(**parameters)
    except ValueError as error:
        assert any(name in str(error) for name in parameters)
        return
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", motiform.EndedEarly)
        run = body.simulate(2.0, initial={"v1": 0.3, "s11": 0.1}, max_steps=2000)
    assert np.isfinite(run.position).all()


@given(st.floats(), st.floats(), st.floats())
@settings(deadline=None, max_examples=60)
def test_any_times_run_or_are_refused(t_end: float, transient: float, dt_out: float) -> None:
    try:
        run = BODY.simulate(t_end, transient=transient, dt_out=dt_out, max_steps=500, on_end="ignore")
    except ValueError:
        return
    assert len(run) >= 0
