"""Models: parameters, copies, errors."""

from __future__ import annotations

import copy
import inspect
import json
import operator
import pickle
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import motiform


def test_a_model_has_the_parameters_of_the_registry() -> None:
    body = motiform.Tensor(kappa2=0.5)
    assert body.kappa2 == 0.5 and body.gamma == motiform.MODELS["tensor"].parameters[0].default
    assert list(body.parameters) == [spec.name for spec in motiform.MODELS["tensor"].parameters]
    names = list(inspect.signature(motiform.Cell.__init__).parameters)
    assert names[1:-1] == [spec.name for spec in motiform.MODELS["cell"].parameters]
    assert "kappa2" in (motiform.Tensor.__doc__ or "")


def test_copies_are_changed_and_originals_are_not() -> None:
    body = motiform.preset("fig5b")
    other = body.replace(kappa2=0.45, t_end=7.0, initial={"v1": 0.25})
    assert (other.kappa2, other.run["t_end"], other.initial) == (0.45, 7.0, {"v1": 0.25})
    assert body.kappa2 == 0.5 and body.initial == {} and body != other
    assert isinstance(body, motiform.Tensor) and isinstance(motiform.preset("fig6a"), motiform.Cell)


def test_parameters_follow_from_others() -> None:
    body = motiform.preset("fig4").replace(d3=0.05, kappa2=0.2).tie(b3="d3", kappa3="2*kappa2")
    assert (body.b3, body.kappa3) == (0.05, 0.4)
    assert body.replace(d3=-1.0).b3 == -1.0
    assert 'b3 = "d3"' in body.to_toml()
    with pytest.raises(ValueError, match="leave out the tie"):
        body.replace(b3=0.7)
    with pytest.raises(ValueError, match="did you mean d3"):
        body.tie(b3="d33")


@pytest.mark.parametrize("name", list(motiform.PRESETS))
def test_models_travel(name: str, tmp_path: Path) -> None:
    body = motiform.preset(name).replace(seed=7)
    assert pickle.loads(pickle.dumps(body)) == body == copy.deepcopy(body)
    file = tmp_path / f"{name}.toml"
    file.write_text(body.to_toml(), encoding="utf-8")
    assert motiform.study(file) == body


def refused(binary: Path, *arguments: str) -> str:
    """What the command line says against an input."""
    done = subprocess.run([binary, *arguments], capture_output=True, text=True)
    assert done.returncode == 2
    return done.stderr


@pytest.mark.parametrize(
    ("kind", "call", "arguments"),
    [
        (TypeError, lambda: motiform.Tensor(kapa2=1.0), ("--set", "kapa2=1")),
        (ValueError, lambda: motiform.Tensor(kappa2=1e9), ("--set", "kappa2=1e9")),
        (ValueError, lambda: motiform.preset("fig7"), ("--preset", "fig7")),
        (ValueError, lambda: motiform.Tensor().simulate(-1.0), ("--t-end=-1",)),
        (ValueError, lambda: motiform.Tensor().simulate(1.0, dt_out=0), ("--dt-out", "0")),
        (ValueError, lambda: motiform.Tensor().simulate(1.0, dt_out=-1.0), ("--dt-out=-1",)),
        (ValueError, lambda: motiform.Tensor().simulate(1.0, stepper="rk5"), ("--stepper", "rk5")),
        (ValueError, lambda: motiform.Tensor(initial={"w1": 1.0}), ("--initial", "w1=1")),
    ],
)
def test_errors_have_the_words_of_the_command_line(
    binary: Path, kind: type[Exception], call: object, arguments: tuple[str, ...]
) -> None:
    assert callable(call)
    with pytest.raises(kind) as error:
        call()
    said = " ".join(refused(binary, "simulate", "tensor", *arguments).split())
    assert " ".join(str(error.value).split()) in said


def test_wrong_types_are_type_errors() -> None:
    for call in (
        lambda: motiform.Tensor(kappa2="much"),  # type: ignore[arg-type]
        lambda: motiform.Tensor(kappa2=None),  # type: ignore[arg-type]
        lambda: motiform.Tensor().simulate(1.0, seed=1.5),  # type: ignore[arg-type]
        lambda: motiform.Tensor().simulate("long"),  # type: ignore[arg-type]
    ):
        with pytest.raises(TypeError, match="must be a"):
            call()


def test_what_was_meant_is_named() -> None:
    with pytest.raises(FileNotFoundError, match=r"parameter set of the paper: motiform.preset\('fig5a'\)"):
        motiform.study("fig5a")
    with pytest.raises(FileNotFoundError, match="there is no file 'mine.toml'$"):
        motiform.study("mine.toml")
    with pytest.raises(TypeError, match="kapa2.*did you mean kappa2"):  # a wrong name goes before a wrong value
        motiform.Tensor(kapa2="much")  # type: ignore[arg-type]


def test_numbers_of_numpy_are_numbers() -> None:
    body = motiform.Tensor(kappa2=np.float32(0.5), gamma=np.int64(1))
    assert (body.kappa2, body.gamma) == (0.5, 1.0)
    with pytest.raises(AttributeError, match="kapa2"):
        body.kapa2  # type: ignore[attr-defined]  # noqa: B018


BODIES = {
    "tensor": lambda: motiform.preset("fig5a"),
    "cell": lambda: motiform.Cell(length=21.6),
    "text": lambda: motiform.Amplitudes(modes=[1], equations={"z1": "(gamma - |z1|^2)*z1"}, parameters={"gamma": 1.0}),
}


@pytest.mark.parametrize("name", list(BODIES))
def test_a_body_cannot_be_changed(name: str) -> None:
    body = BODIES[name]()
    known = next(iter(body.parameters))
    value = body.parameters[known]
    for attribute in (known, "kapa2", "t_end", "parameters", "_study"):
        with pytest.raises(AttributeError, match=rf"{attribute} = 7.*replace\({attribute}=7\)"):
            setattr(body, attribute, 7)
    with pytest.raises(AttributeError, match="cannot be changed"):
        del body._study
    changes: list[Callable[[Any], object]] = [
        lambda values: values.update({known: 5.0}),
        lambda values: values.pop(known),
        lambda values: values.setdefault("new", 1.0),
        lambda values: operator.setitem(values, known, 5.0),
        lambda values: operator.delitem(values, known),
        lambda values: operator.ior(values, {known: 5.0}),
        lambda values: values.clear(),
    ]
    for values in (body.parameters, body.initial, body.run):
        before = dict(values)
        for change in changes:
            with pytest.raises(TypeError, match=r"read-only: replace\(NAME=value\)"):
                change(values)
        assert values == before == pickle.loads(pickle.dumps(values)) == copy.deepcopy(values) == json.loads(json.dumps(values))
    for same in (pickle.loads(pickle.dumps(body)), copy.copy(body), copy.deepcopy(body)):
        assert same == body and same.parameters[known] == value
    assert body.replace(**body.parameters).parameters == body.parameters
    body(0.0, np.zeros(len(body.coordinates)))  # keeps what it computes with
    assert {**body.parameters, known: 5.0}[known] == 5.0 and body.parameters[known] == value


def test_no_time_between_rows_is_refused_and_the_default_is_not() -> None:
    body = motiform.preset("fig5a")
    for zero in (0, 0.0, np.float64(0.0)):
        with pytest.raises(ValueError, match="dt_out = 0: give a time above 0"):
            body.statistics(3, t_end=50.0, noise=0.1, dt_out=zero)
    assert len(body.replace(dt_out=0.0).simulate(10.0)) == len(body.simulate(10.0, dt_out=0.005)) == 2001  # as in a study


@pytest.mark.parametrize("seed", [-1, 2**64, np.int64(-1)])
def test_seeds_are_whole_numbers_of_64_bits(seed: int) -> None:
    body = motiform.preset("fig5a")
    calls: list[Callable[[], object]] = [
        lambda: body.simulate(1.0, seed=seed),
        lambda: body.replace(seed=seed),
        lambda: body.classify(seed=seed),
        lambda: body.motions(2, seed=seed),
        lambda: motiform.scan(body, {"kappa2": "0.8:0.9:2"}, seed=seed),
        lambda: motiform.ensemble(body, 1.0, seed=seed),
    ]
    for call in calls:
        with pytest.raises(ValueError, match=f"seed = {seed}: give a whole number from 0 to 18446744073709551615"):
            call()
    assert body.replace(seed=2**64 - 1).run["seed"] == 2**64 - 1 and body.replace(seed=0).run["seed"] == 0


def test_counts_below_0_are_named() -> None:
    body = motiform.preset("fig5a")
    calls: dict[str, Callable[[], object]] = {
        "samples": lambda: body.motions(-2),
        "count": lambda: body.lyapunov(-2),
        "bodies": lambda: body.statistics(-2),
        "max_steps": lambda: body.simulate(1.0, max_steps=-2),
        "threads": lambda: body.motions(2, threads=-2),
    }
    for name, call in calls.items():
        with pytest.raises(ValueError, match=f"{name} = -2: give a whole number above 0"):
            call()


@pytest.mark.parametrize("initial", [[1, 2], "v1", {1: 1.0}, 0.1, np.ones(6)])
def test_an_initial_state_is_given_by_names(initial: Any) -> None:
    body = motiform.preset("fig5a")
    for call in (
        lambda: body.simulate(1.0, initial=initial),
        lambda: body.replace(initial=initial),
        lambda: motiform.Tensor(initial=initial),
    ):
        with pytest.raises(TypeError, match=r"initial = .*: give a mapping from coordinates to values, such as \{'v1': 0.1\}; .* v1, v2, s11,"):
            call()
    given = pd.Series({"v1": 0.2, "s11": 0.1})
    assert motiform.Tensor(initial=given).initial == given.to_dict() and body.replace(initial=None) == body  # type: ignore[arg-type]


def test_what_is_not_given_by_name_is_named() -> None:
    with pytest.raises(TypeError, match=r"^Tensor\(1.0\): parameters are given by name, such as Tensor\(gamma=1\)"):
        motiform.Tensor(1.0)  # type: ignore[misc]
    with pytest.raises(TypeError, match=r"^Cell\(9\): .*Cell\(length="):
        motiform.Cell(9)  # type: ignore[misc]
    with pytest.raises(TypeError, match="name = None: give the name of a parameter set of the paper: fig1, .* fig6d"):
        motiform.preset(None)  # type: ignore[arg-type]
    body = motiform.preset("fig5a")
    with pytest.raises(TypeError, match=r"b3 = 2: give an expression as text.*replace\(b3=2\)"):
        body.tie(b3=2)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="units = 3: .*'20um,1min'"):
        body.replace(units=3)
    assert body.replace(units=motiform.Units("20um,1min")) == body.replace(units="20um,1min")
