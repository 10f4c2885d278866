"""The fit compared with other estimators on the same cells.

    cargo run --release -p motiform-inference --example cells -- bench/inference/results 20
    pip install pysindy StochasticForceInference
    python bench/inference/bench.py bench/inference/results                      # without "SFI parametric", which compiles for minutes
    python bench/inference/bench.py bench/inference/results "SFI parametric"

Prints a table and writes `rivals.csv` with every coefficient. All have the same 22 terms. Those that need the velocity as a variable get the slope
of the parabola through five frames (PySINDy) or the central difference (SFI).
"""

import csv
import sys
import time
from pathlib import Path

import jax

jax.config.update("jax_enable_x64", True)

import jax.numpy as jnp
import numpy as np
import pysindy
from SFI import OverdampedLangevinInference, TrajectoryCollection
from SFI.statefunc import make_basis

HALF = 8  # frames on each side of a weak-form window


def factors(name):
    """`z1: |z1|^2 z1` as (equation, [(amplitude, power of z, power of conj z)])."""
    equation, text = name.split(": ")
    powers = {}
    for factor in text.split():
        base, _, power = factor.partition("^")
        power = int(power or 1)
        n = int(base.strip("|*")[1:])
        z, c = powers.get(n, (0, 0))
        if base.startswith("|"):
            z, c = z + power // 2, c + power // 2
        elif base.endswith("*"):
            c += power
        else:
            z += power
        powers[n] = (z, c)
    return int(equation[1:]), [(n, z, c) for n, (z, c) in powers.items()]


def monomials(names, z):
    """Each term's product for amplitudes `z` (index 1 to 3)."""
    values = []
    for name in names:
        product = 1.0
        for n, p, q in factors(name)[1]:
            product = product * z[n] ** p * z[n].conj() ** q
        values.append(product)
    return values


def amplitudes(data, z1):
    return {1: z1, 2: data[:, 3] + 1j * data[:, 4], 3: data[:, 5] + 1j * data[:, 6]}


def velocity(data, dt):
    """z1 = x' - i y' from the parabola through five frames; two frames are lost at each end."""
    w = data[:, 1] - 1j * data[:, 2]
    return (2 * (w[4:] - w[:-4]) + (w[3:-1] - w[1:-3])) / (10 * dt)


def sindy(names, data, dt):
    """PySINDy, strong form: smoothed finite differences, least squares without a threshold."""
    inner = data[2:-2]
    z = amplitudes(inner, velocity(data, dt))
    derivative = pysindy.SmoothedFiniteDifference()
    c = {}
    for n in (1, 2, 3):
        own = [name for name in names if factors(name)[0] == n]
        rows = np.array(monomials(own, z)).T
        left = np.concatenate([derivative._differentiate(part[:, None], dt)[:, 0] for part in (z[n].real, z[n].imag)])
        optimiser = pysindy.STLSQ(threshold=0.0, alpha=0.0)
        optimiser.fit(np.concatenate([rows.real, rows.imag]), left[:, None])
        c.update(zip(own, np.ravel(optimiser.coef_)))
    return {name: (c[name], None) for name in names}


def sindy_weak(names, data, dt):
    """PySINDy's weak form (WeakPDELibrary over time), on real and imaginary parts."""
    inner = data[2:-2]
    t = inner[:, 0] - inner[0, 0]
    z = amplitudes(inner, velocity(data, dt))
    columns = monomials(names, z)
    identity = pysindy.CustomLibrary(library_functions=[lambda x: x], function_names=[lambda x: x])
    weak = pysindy.WeakPDELibrary(identity, spatiotemporal_grid=t, K=200, H_xt=[HALF * dt], include_bias=False)
    stacked = np.array([part for column in columns for part in (column.real, column.imag)]).T
    np.random.seed(1)
    weak.fit([pysindy.AxesArray(stacked, {"ax_time": 0, "ax_coord": 1})])
    integrals = np.asarray(weak.transform([pysindy.AxesArray(stacked, {"ax_time": 0, "ax_coord": 1})])[0])
    c = {}
    for n in (1, 2, 3):
        own = [k for k, name in enumerate(names) if factors(name)[0] == n]
        state = pysindy.AxesArray(np.stack([z[n].real, z[n].imag], 1), {"ax_time": 0, "ax_coord": 1})
        left = np.asarray(weak.convert_u_dot_integral(state))
        rows = np.concatenate([integrals[:, [2 * k for k in own]], integrals[:, [2 * k + 1 for k in own]]])
        solution = np.linalg.lstsq(rows, np.concatenate([left[:, 0], left[:, 1]]), rcond=None)[0]
        c.update({names[k]: value for k, value in zip(own, solution)})
    return {name: (c[name], None) for name in names}


def basis(names):
    """The 22 terms as vector fields over (Re z1, Im z1, .., Im z3)."""

    def fields(x):
        z = {n: x[2 * n - 2] + 1j * x[2 * n - 1] for n in (1, 2, 3)}
        columns = []
        for name, value in zip(names, monomials(names, z)):
            n = factors(name)[0]
            columns.append(jnp.zeros(6).at[2 * n - 2].set(value.real).at[2 * n - 1].set(value.imag))
        return jnp.stack(columns, -1)

    return make_basis(fields, dim=6, rank=1, n_features=len(names), labels=list(names))


def sfi(names, data, dt, parametric):
    """StochasticForceInference: (z1 from central differences, z2, z3) as an overdamped process."""
    w = data[:, 1] - 1j * data[:, 2]
    z1 = (w[2:] - w[:-2]) / (2 * dt)
    state = np.column_stack([z1.real, z1.imag, data[1:-1, 3:7]])
    inference = OverdampedLangevinInference(TrajectoryCollection.from_arrays(X=state, dt=dt))
    inference.compute_diffusion_constant()
    if parametric:
        inference.infer_force(basis(names))
    else:
        inference.infer_force_linear(basis(names))
    inference.compute_force_error()
    c = np.asarray(inference.force_coefficients_full)
    e = np.asarray(inference.force_coefficients_stderr)
    return {name: (c[k], e[k]) for k, name in enumerate(names)}


METHODS = {
    "PySINDy": sindy,
    "PySINDy weak": sindy_weak,
    "SFI linear": lambda *a: sfi(*a, parametric=False),
    "SFI parametric": lambda *a: sfi(*a, parametric=True),
}


def compare(folder, methods):
    rows = list(csv.DictReader(open(folder / "fits.csv")))
    names = list(dict.fromkeys(row["term"] for row in rows))
    truth = {row["term"]: float(row["truth"]) for row in rows}
    cells = sorted({int(row["cell"]) for row in rows})
    for cell in cells:
        data = np.loadtxt(folder / f"{cell}.csv", delimiter=",", skiprows=1)
        for method, estimate in ((m, METHODS[m]) for m in methods):
            start = time.perf_counter()
            try:
                found = estimate(names, data, data[1, 0] - data[0, 0])
            except Exception as problem:  # a rival that fails is a result
                print(f"{method}, cell {cell}: {type(problem).__name__}: {problem}", file=sys.stderr)
                continue
            seconds = time.perf_counter() - start
            for name, (value, error) in found.items():
                rows.append(dict(method=method, cell=cell, term=name, truth=truth[name], value=value,
                                 error="" if error is None else error, seconds=seconds))
    with open(folder / "rivals.csv", "w", newline="") as out:
        writer = csv.DictWriter(out, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    table(rows)


def table(rows):
    print("| method | median error of the 9 true coefficients | coverage of 95 % intervals | median seconds |")
    print("| --- | --- | --- | --- |")
    for method in dict.fromkeys(row["method"] for row in rows):
        own = [row for row in rows if row["method"] == method]
        true = [row for row in own if float(row["truth"]) != 0]
        errors = [abs(float(row["value"]) / float(row["truth"]) - 1) for row in true]
        stated = [row for row in own if row["error"] not in ("", None)]
        held = [abs(float(r["value"]) - float(r["truth"])) < 1.96 * float(r["error"]) for r in stated]
        cover = f"{np.mean(held):.2f}" if held else "none stated"
        seconds = np.median([float(row["seconds"]) for row in own])
        print(f"| {method} | {100 * np.median(errors):.1f} % | {cover} | {seconds:.3g} |")


if __name__ == "__main__":
    compare(Path(sys.argv[1]), sys.argv[2:] or ["PySINDy", "PySINDy weak", "SFI linear"])
