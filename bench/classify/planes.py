"""The three planes: their points, the one start of all of them, and the study that motiform reads."""

import numpy as np

from models import Cell, Tensor

AXES = {
    "fig1": (("kappa2", -0.22, 0.22), ("gamma", -0.16, 0.12)),
    "fig4": (("kappa2", 0.05, 1.65), ("kappa3", 0.05, 1.05)),
    "fig6": (("length", 6.0, 30.0),),
}
SHAPE = {"v1": 0.0063, "v2": 0.0041, "s11": 0.0054, "s12": -0.017, "u111": -0.0104, "u222": 0.0036}
MODES = 21


def boundary():
    """Amplitudes of cos and sin in phi: up to 0.01, mode n weighted by 1/n^2."""
    numbers = np.random.default_rng(1).uniform(-0.01, 0.01, (MODES, 2)) / np.arange(1, MODES + 1)[:, None] ** 2
    return {f"{wave}{n + 1}": round(float(numbers[n, i]), 8) for n in range(MODES) for i, wave in enumerate("cs")}


def start_of(plane):
    return boundary() if plane == "fig6" else SHAPE


def study(plane, count):
    """A study file of motiform: the plane with `count` values on each axis."""
    lines = [f'preset = "{plane}a"' if plane == "fig6" else f'preset = "{plane}"', "[initial]", "perturb = 0.0"]
    lines += [f"{name} = {value!r}" for name, value in start_of(plane).items()]
    axes = ", ".join(f'"{name}={low}:{high}:{count}"' for name, low, high in AXES[plane])
    return "\n".join([*lines, "[scan]", f"axes = [{axes}]", ""])


def points(plane, count):
    """The points in motiform's order: the first axis runs fastest."""
    values = [np.linspace(low, high, count) for _, low, high in AXES[plane]]
    grids = np.meshgrid(*values, indexing="ij")
    names = [name for name, _, _ in AXES[plane]]
    return [dict(zip(names, map(float, point))) for point in zip(*(grid.ravel(order="F") for grid in grids))]


def rival_model(plane, count):
    """The model of all points, and the start of each, in the amplitudes of models.py."""
    where = points(plane, count)
    if plane == "fig6":
        model = Cell([point["length"] for point in where])
        values = np.array(list(start_of(plane).values())).reshape(MODES, 2)
        state = ((values[:, 0] - 1j * values[:, 1]) / 2 / model.phase).view(float)
    else:
        model, s = Tensor(plane, where), SHAPE
        z = np.array([s["v1"] - 1j * s["v2"], (s["s11"] - 1j * s["s12"]) / 2, (s["u111"] + 1j * s["u222"]) / 2])
        state = z[: model.modes].view(float)
    return model, np.tile(state, (len(where), 1))
