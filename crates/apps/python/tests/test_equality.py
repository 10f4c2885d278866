"""Equality of results: of all their numbers, also after pickling."""

from __future__ import annotations

import copy
import dataclasses
import math
import pickle
from collections.abc import Callable

import numpy as np
import pandas as pd
import pytest

import motiform
from motiform.equality import same

BODY = motiform.preset("fig5a")

RESULTS: dict[str, Callable[[], object]] = {
    "trajectory": lambda: BODY.simulate(5.0),
    "verdict": lambda: BODY.classify(),
    "exponents": lambda: BODY.lyapunov(3, t_end=50.0),
    "equilibria": lambda: BODY.equilibria(starts=5)[0],
    "motions": lambda: BODY.motions(2),
    "crossings": lambda: BODY.section("s12", 0.0, t_end=50.0),
    "statistics": lambda: BODY.statistics(4, t_end=50.0, noise=0.01),
    "branches": lambda: BODY.branches(("kappa2", 0.6, 0.9), branches=1, points=8),
    "ensemble": lambda: motiform.ensemble(BODY, 5.0, starts=2),
}


@pytest.mark.parametrize("name", list(RESULTS))
def test_results_are_equal_where_their_numbers_are(name: str) -> None:
    one, other = RESULTS[name](), RESULTS[name]()
    assert one is not other and one == other and not one != other
    assert pickle.loads(pickle.dumps(one)) == one == copy.deepcopy(one)
    assert one != "something" and one is not None and one in [None, other]
    try:
        number = hash(one)
    except TypeError:  # it has arrays, tables or mappings
        assert name not in ("trajectory", "verdict")
    else:
        assert number == hash(pickle.loads(pickle.dumps(one)))


def test_results_with_other_numbers_are_not_equal() -> None:
    exponents = BODY.lyapunov(3, t_end=50.0)
    assert dataclasses.replace(exponents, values=exponents.values + 1e-15) != exponents
    assert dataclasses.replace(exponents, values=exponents.values[:2]) != exponents
    crossings = BODY.section("s12", 0.0, t_end=50.0)
    assert dataclasses.replace(crossings, table=crossings.table.iloc[1:]) != crossings
    run, other = BODY.simulate(5.0), BODY.simulate(5.0)
    assert run != BODY.simulate(5.0, rtol=1e-8) and run != BODY.simulate(4.0)
    other["s11"][3] += 1e-9
    assert run != other and hash(run) == hash(other)
    one, two = (motiform.preset("fig1").atlas({"kappa2": (-0.1, 0.1, 3), "gamma": (-0.1, 0.1, 3)}, samples=1, lines=0) for _ in range(2))
    assert one == two != dataclasses.replace(one, cells=one.cells.iloc[1:])


def test_what_is_not_a_number_is_equal_to_itself() -> None:
    unknown, other = (motiform.Measured(float("nan"), float("nan"), float("nan"), "not reached") for _ in range(2))
    assert unknown == other and hash(unknown) == hash(other) and unknown != motiform.Measured(1.0, math.nan, math.nan)
    known = motiform.Measured(1.0, 0.5, 2.0)
    assert hash(known) == hash((1.0, 0.5, 2.0, ""))  # as a frozen dataclass has it


@pytest.mark.parametrize(
    ("one", "other", "equal"),
    [
        (np.array([1.0, math.nan]), np.array([1.0, math.nan]), True),
        (np.array([1.0, math.nan]), np.array([math.nan, 1.0]), False),
        (np.array([1.0]), 1.0, False),
        (np.array(["a"]), np.array(["a"]), True),
        (np.array([1j, complex(math.nan)]), np.array([1j, complex(math.nan)]), True),
        ({"a": np.ones(2)}, {"a": np.ones(2)}, True),
        ({"a": np.ones(2)}, {"b": np.ones(2)}, False),
        ([math.nan, (1, 2)], [math.nan, (1, 2)], True),
        ((1, 2), [1, 2], False),
        (pd.DataFrame({"a": [1.0, math.nan]}), pd.DataFrame({"a": [1.0, math.nan]}), True),
        (pd.DataFrame({"a": [1.0]}), pd.DataFrame({"b": [1.0]}), False),
        (pd.DataFrame({"a": [1.0]}), None, False),
        (None, pd.DataFrame({"a": [1.0]}), False),
        (1, 1.0, True),
    ],
)
def test_values_are_compared_in_every_entry(one: object, other: object, equal: bool) -> None:
    assert same(one, other) is equal and same(other, one) is equal
