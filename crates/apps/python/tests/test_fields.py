"""Compiled fields: exact solutions, a built-in model, and what is refused."""

from __future__ import annotations

import copy
import ctypes
import math
import pickle
import shutil
import subprocess
from pathlib import Path
from typing import Any

import motiform
import numpy as np
import pytest
from motiform.addresses import SIGNATURE

POINTER = ctypes.POINTER(ctypes.c_double)
FUNCTION = ctypes.CFUNCTYPE(None, ctypes.c_double, POINTER, POINTER, POINTER)

SOURCE = """
#include <math.h>
void driven(double t, const double *x, const double *p, double *dx) { dx[0] = -p[0]*x[0] + cos(t); }
void square(double t, const double *x, const double *p, double *dx) { dx[0] = x[0]*x[0]; }
void silent(double t, const double *x, const double *p, double *dx) { dx[0] = 1.0; }
void turn(double t, const double *x, const double *p, double *dx) { dx[0] = p[0]*x[1]; dx[1] = -p[0]*x[0]; }
void lorenz(double t, const double *x, const double *p, double *dx) {
    dx[0] = p[0]*(x[1] - x[0]);
    dx[1] = x[0]*(p[1] - x[2]) - x[1];
    dx[2] = x[0]*x[1] - p[2]*x[2];
}
void lorenz_jacobian(double t, const double *x, const double *p, double *j) {
    double rows[9] = {-p[0], p[0], 0, p[1] - x[2], -1, -x[0], x[1], x[0], -p[2]};
    for (int k = 0; k < 9; k++) j[k] = rows[k];
}
"""

LORENZ = {"sigma": 10.0, "rho": 28.0, "beta": 8 / 3}


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler")
    folder: Path = tmp_path_factory.mktemp("fields")
    (folder / "fields.c").write_text(SOURCE)
    subprocess.run([compiler, "-O2", "-shared", "-fPIC", "fields.c", "-o", "fields.so", "-lm"], cwd=folder, check=True)
    return ctypes.CDLL(str(folder / "fields.so"))


def driven(t: Any, x: float, k: float) -> Any:
    """The solution of ``x' = -k x + cos t`` from x at time 0."""
    return (k * np.cos(t) + np.sin(t)) / (k * k + 1) + (x - k / (k * k + 1)) * np.exp(-k * t)


def test_an_orbit_is_the_exact_solution(library: ctypes.CDLL) -> None:
    field = motiform.Field(library.driven, ["x"], {"k": 0.7}, initial={"x": 2.0})
    orbit = field.simulate(20.0, dt_out=0.037, rtol=1e-11)
    assert orbit.states.shape == (541, 1) and orbit.outcome.complete
    assert np.abs(orbit["x"] - driven(orbit.t, 2.0, 0.7)).max() < 1e-9
    assert list(orbit.to_pandas().columns) == ["t", "x"]
    shifted = field.simulate(20.0, transient=5.0, dt_out=0.5, initial={"x": driven(-5.0, 2.0, 0.7)}, rtol=1e-11)
    assert np.abs(shifted["x"] - driven(shifted.t, 2.0, 0.7)).max() < 1e-9
    fixed = field.simulate(20.0, stepper="rk4", step=1e-3)
    assert np.abs(fixed["x"] - driven(fixed.t, 2.0, 0.7)).max() < 1e-10
    assert np.isclose(field(0.5, [2.0])[0], -1.4 + math.cos(0.5), rtol=1e-15)
    assert field(0.5, [[1.0, 2.0, 3.0]]).shape == (1, 3)


def test_a_python_callback_and_an_address_give_the_same_bits(library: ctypes.CDLL) -> None:
    def turn(_: float, x: Any, p: Any, dx: Any) -> None:
        dx[0], dx[1] = p[0] * x[1], -p[0] * x[0]

    def orbit(function: Any) -> Any:
        return motiform.Field(function, 2, {"omega": 1.3}).simulate(5.0, initial={"x1": 1.0}).states

    address = ctypes.cast(library.turn, ctypes.c_void_p).value
    assert np.array_equal(orbit(library.turn), orbit(address))
    assert np.array_equal(orbit(library.turn), orbit(FUNCTION(turn)))
    times = motiform.Field(FUNCTION(turn), 2, {"omega": 1.3}).simulate(5.0, initial={"x1": 1.0})
    assert np.allclose(times["x2"], -np.sin(1.3 * times.t), atol=1e-8)


def test_a_built_in_model_has_the_same_orbit() -> None:
    body = motiform.preset("fig5b")

    def rates(t: float, x: Any, _: Any, dx: Any) -> None:
        for k, rate in enumerate([*body(t, [x[k] for k in range(6)]), x[0], x[1]]):
            dx[k] = rate

    start = {"v1": 0.5, "v2": 0.1, "s11": 0.1, "s12": -0.2, "u111": 0.05, "u222": 0.1, "x": 3.0, "y": -2.0}
    field = motiform.Field(FUNCTION(rates), [*body.coordinates, "x", "y"], initial=start)
    run = body.simulate(20.0, transient=0.0, dt_out=0.5, initial=start)
    orbit = field.simulate(20.0, dt_out=0.5)
    for name in ("v1", "u222", "x", "y"):
        assert np.allclose(orbit[name], run[name], rtol=0, atol=1e-7), name
    many = motiform.ensemble(field, [1.0, 20.0], starts=[list(start.values())], threads=2)
    assert np.allclose(many.position[0, 1], run.position[-1], atol=1e-7)


def test_many_orbits_on_threads(library: ctypes.CDLL) -> None:
    field = motiform.Field(library.driven, ["x"], {"k": 0.7})
    k, starts = np.linspace(0.2, 2.0, 40), np.linspace(-3.0, 3.0, 40)
    times = np.array([0.0, 1.0, 12.5])
    one = motiform.ensemble(field, times, starts=starts[:, None], parameters={"k": k}, rtol=1e-11, threads=1)
    two = motiform.ensemble(field, times, starts=starts[:, None], parameters={"k": k}, rtol=1e-11, threads=3)
    assert np.array_equal(one.states, two.states) and one.complete.all() and len(one) == 40
    assert np.abs(one["x"] - driven(times[None], starts[:, None], k[:, None])).max() < 1e-9
    with pytest.raises(AttributeError, match="position"):
        _ = one.position
    blown = motiform.ensemble(motiform.Field(library.square, ["x"]), [0.5, 1.0], starts=[[0.5], [1.5]])
    assert list(blown.complete) == [True, False] and np.isnan(blown["x"][1, 1])


def test_a_blow_up_is_a_value(library: ctypes.CDLL) -> None:
    field = motiform.Field(library.square, ["x"], initial={"x": 0.5})
    with pytest.warns(motiform.EndedEarly):
        orbit = field.simulate(5.0, dt_out=0.1)
    assert orbit.outcome.kind == "escaped" and abs(orbit.outcome.t - 2.0) < 1e-6
    assert np.allclose(orbit["x"], 1 / (2 - orbit.t), rtol=1e-6) and len(orbit) == 20
    early = field.simulate(5.0, transient=3.0, on_end="ignore")
    assert len(early) == 0 and early.outcome.details["during"] == "transient"
    # An entry that the function does not write is not a number, not an old value.
    with pytest.warns(motiform.EndedEarly):
        assert not motiform.Field(library.silent, 2, initial={"x1": 1.0}).simulate(1.0).outcome.complete


def test_crossings(library: ctypes.CDLL) -> None:
    field = motiform.Field(library.turn, ["a", "b"], {"omega": 2.0}, initial={"a": -1.0})
    found = field.section("a", 0.0, "rising", t_end=10.0, rtol=1e-11)
    assert np.allclose(found.table["t"], np.pi * np.array([0.25, 1.25, 2.25]), atol=1e-9)
    assert found.pairs("b").shape == (2, 2)


def test_exponents_with_and_without_a_jacobian(library: ctypes.CDLL) -> None:
    start = {"x": 1.0, "y": 2.0, "z": 20.0}
    plain = motiform.Field(library.lorenz, list(start), LORENZ, initial=start)
    exact = motiform.Field(library.lorenz, list(start), LORENZ, initial=start, jacobian=library.lorenz_jacobian)
    a, b = (field.lyapunov(transient=5.0, t_end=20.0, rtol=1e-11, on_end="ignore") for field in (plain, exact))
    assert np.allclose(a.values, b.values, atol=1e-5)
    found = plain.lyapunov(t_end=2000.0)
    assert abs(found.values[0] - 0.9056) < 3 * found.errors[0] and found.neutral == 1
    assert abs(found.sum + 10 + 1 + 8 / 3) < 1e-5
    with pytest.raises(ValueError, match="does not depend on the time"):
        motiform.Field(library.driven, ["x"], {"k": 1.0}, initial={"x": 1.0}).lyapunov()
    with pytest.raises(ValueError, match="from 1 to 3"):
        plain.lyapunov(4)


def test_what_does_not_work_says_why(library: ctypes.CDLL) -> None:
    field = motiform.Field(library.turn, ["a", "b"], {"omega": 2.0}, initial={"a": -1.0})
    for name in ("classify", "motions", "equilibria", "branches", "curves", "statistics", "to_toml"):
        with pytest.raises(NotImplementedError, match=r"compiled field: .*Amplitudes"):
            getattr(field, name)()
    with pytest.raises(NotImplementedError, match="equations are known"):
        motiform.scan(field, {"omega": "0:1:3"})  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="pickled"):
        pickle.dumps(field)
    assert copy.copy(field) is field and copy.deepcopy({"one": field}) == {"one": field}
    with pytest.raises(ValueError, match="omega = nan: give a finite number"):
        field.replace(omega=float("nan"))
    assert field.replace(omega=1.0).parameters == {"omega": 1.0} and field.parameters == {"omega": 2.0}
    with pytest.raises(TypeError, match=r"initial = \[1, 2\]: give a mapping from coordinates to values, such as \{'a': 0.1\}"):
        field.simulate(1.0, initial=[1, 2])  # type: ignore[arg-type]
    for call in (lambda: field.simulate(1.0, max_steps=-1), lambda: motiform.ensemble(field, 1.0, starts=[[1.0, 0.0]], max_steps=-1)):
        with pytest.raises(ValueError, match="max_steps = -1: give a whole number above 0"):
            call()
    with pytest.raises(ValueError, match="dt_out = 0: give a time above 0"):
        field.simulate(1.0, dt_out=0)
    with pytest.raises(AttributeError, match="a Field cannot be changed"):
        field.parameters = {"omega": 1.0}  # type: ignore[misc]
    with pytest.raises(TypeError, match="read-only"):
        field.parameters["omega"] = 1.0  # type: ignore[index]


@pytest.mark.parametrize(
    ("make", "error", "word"),
    [
        (lambda _: motiform.Field(math.cos, 1), TypeError, "compiled function"),
        (lambda _: motiform.Field(0, 1), ValueError, "address"),
        (lambda _: motiform.Field(FUNCTION(), 1), ValueError, "address 0"),
        (lambda _: motiform.Field(ctypes.CFUNCTYPE(None, ctypes.c_double)(print), 1), TypeError, "declared"),
        (lambda f: motiform.Field(f, []), ValueError, "at least one"),
        (lambda f: motiform.Field(f, ["a", "a"]), ValueError, "different"),
        (lambda f: motiform.Field(f, "ab"), TypeError, "list of names"),
        (lambda f: motiform.Field(f, 2, {"omega": "1"}), TypeError, "real number"),
        (lambda f: motiform.Field(f, 2, initial={"a": 1.0}), ValueError, "x1, x2"),
        (lambda f: motiform.Field(f, 2).simulate(), ValueError, "initial"),
        (lambda f: motiform.Field(f, 2, initial={"x1": 1}).simulate(-1.0), ValueError, "t_end"),
        (lambda f: motiform.Field(f, 2, initial={"x1": 1}).simulate(stepper="krogstad4"), ValueError, "linear part"),
        (lambda f: motiform.Field(f, 2, initial={"x1": 1}).simulate(rtol=0.5), ValueError, "rtol"),
        (lambda f: motiform.Field(f, 2, initial={"x1": 1}).section("b"), ValueError, "x1, x2"),
        (lambda f: motiform.Field(f, 2).replace(omega=1.0), TypeError, "unknown parameter"),
        (lambda f: motiform.ensemble(motiform.Field(f, 2), 1.0, starts=3), ValueError, "array of starts"),
        (lambda f: motiform.ensemble(motiform.Field(f, 2), 1.0, starts=[[1.0]]), ValueError, "shape"),
        (lambda f: motiform.ensemble(motiform.Field(f, 2), 1.0, starts=[[1.0, 2.0]], seed=3), ValueError, "seed"),
    ],
)
def test_wrong_input_is_named(library: ctypes.CDLL, make: Any, error: type[Exception], word: str) -> None:
    with pytest.raises(error, match=word):
        make(library.turn)


def test_numba() -> None:
    numba = pytest.importorskip("numba")

    @numba.cfunc(SIGNATURE)
    def turn(t, x, p, dx):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202
        dx[0], dx[1] = p[0] * x[1], -p[0] * x[0]

    orbit = motiform.Field(turn, 2, {"omega": 1.3}).simulate(5.0, initial={"x1": 1.0})
    assert np.allclose(orbit["x2"], -np.sin(1.3 * orbit.t), atol=1e-8)

    @numba.cfunc("float64(float64)")
    def wrong(t):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202
        return t

    with pytest.raises(TypeError, match="declared"):
        motiform.Field(wrong, 2)
