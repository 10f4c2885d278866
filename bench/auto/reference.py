"""What is true: closed forms, published values, and special points solved for with SciPy, independent of both programs."""

from dataclasses import dataclass
from math import sqrt

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar, root

FLOW = dict(method="DOP853", rtol=1e-12, atol=1e-13)
BEND = 2 / (3 * sqrt(3))
CANARD = 0.3241785225037  # what `canard` returns


def nagumo(x):
    """The current at which FitzHugh-Nagumo's equilibrium has this x, for a = 0.7 and b = 0.8."""
    return (x + 0.7) / 0.8 - x + x**3 / 3


# Per problem or case: kind and value. Closed forms, except: the homoclinic connection and the doublings, to the digits given (the sixth
# doubling lies between 4.20343 and 4.20345, where SciPy's multipliers are -0.99210 and -1.00697); the folds of FitzHugh-Nagumo, which
# (x, y, I) -> (-x, 7/4 - y, 7/4 - I) maps to each other.
KNOWN = {
    "lorenz": [("branch-point", 1.0), ("hopf", 470 / 19), ("homoclinic", 13.9265574)],
    "rossler": [("period-doubling", value) for value in (2.832445, 3.837358, 4.124215, 4.186997, 4.200537, 4.203441)],
    "fhn": [("hopf", nagumo(-sqrt(0.936))), ("hopf", nagumo(sqrt(0.936))), ("fold", CANARD), ("fold", 1.75 - CANARD)],
    "lv": [("branch-point", 1.0)],
    "transcrit": [("branch-point", 0.0)],
    "cusp": [("fold", -BEND), ("fold", BEND)],
    "isola": [("fold", -0.5), ("fold", 0.5)],
    "snic": [("fold", 1.0)],
    "snic-orbit": [("homoclinic", 1.0)],
}

# Per problem: equilibria on the branches that are connected to the start, as a value of the parameter and the state.
VISITS = {
    "cusp": [(0.0, x, 0.0) for x in (-1.0, 0.0, 1.0)],
    "transcrit": [(mu, x, 0.0) for mu in (-0.7, 0.7) for x in (0.0, mu)],
    "lv": [(0.7, 0.7, 0.3), (0.7, 1.0, 0.0), (1.3, 1.3, -0.3), (1.3, 1.0, 0.0)],
    "isola": [(0.0, 0.5, 0.0), (0.0, 1.5, 0.0)],
    "snic": [(0.6, 0.6, 0.8), (0.6, 0.6, -0.8)],
    "lorenz": [(10.0, side * sqrt(24.0), side * sqrt(24.0), 9.0 * abs(side), 0.0) for side in (-1, 0, 1)],
}


@dataclass
class Found:
    """A special point as a program reports it; `period` is 0 for equilibria, `state` None where there is none."""

    kind: str
    value: float
    state: np.ndarray | None
    period: float = 0.0


def equilibrium(problem, guess, value):
    answer = root(problem.field, guess, args=(value,), tol=1e-11)
    assert np.abs(answer.fun).max() < 1e-10, (problem.name, answer.message)
    return answer.x


def steady_test(kind, matrix):
    """Zero at a fold: the product of the eigenvalues; at a Hopf bifurcation: the product of the sums of two."""
    roots = np.linalg.eigvals(matrix)
    if kind == "hopf":
        first, second = np.triu_indices(len(roots), 1)
        roots = roots[first] + roots[second]
    return np.prod(roots).real


def solved(problem, point):
    """The parameter of a fold or Hopf point of equilibria next to a reported one; None if there is none within 1e-3 of the range."""
    size, span = len(point.state), problem.span[1] - problem.span[0]

    def law(y):
        return [*problem.field(y[:size], y[-1]), steady_test(point.kind, problem.jacobian(y[:size], y[-1]))]

    answer = root(law, [*point.state, point.value + 1e-4 * span], tol=1e-12)
    good = np.abs(answer.fun).max() < 1e-9 and abs(answer.x[-1] - point.value) < 1e-3 * span
    return answer.x[-1] if good else None


def settled(problem, value, start, samples=401):
    """One period of the orbit on which a simulation settles: rows of time and state."""
    law = lambda _, u: problem.field(u, value)
    begin = solve_ivp(law, (0, 1000), start, **FLOW).y[:, -1]
    normal = law(0, begin)
    section = lambda _, u: normal @ (u - begin)
    section.direction = 1.0
    path = solve_ivp(law, (0, 100), begin, events=section, dense_output=True, **FLOW)
    size = np.ptp(path.y, axis=1).max()
    period = next(t for t, u in zip(path.t_events[0], path.y_events[0]) if t > 1e-3 and np.abs(u - begin).max() < 1e-4 * size)
    times = np.linspace(0, period, samples)
    return np.column_stack([times, path.sol(times).T])


def canard(problem):
    """The first fold of FitzHugh-Nagumo's cycles: the least current of a cycle that crosses x = -1/2 leftwards, over its height there.

    For each height the current is found at which the orbit comes back to it; with less current it comes back lower, or never.
    """
    section = lambda _, u: u[0] + 0.5
    section.direction, section.terminal = -1.0, True

    def lift(current, height):
        law = lambda _, u: problem.field(u, current)
        away = solve_ivp(law, (0, 5), [-0.5, height], **FLOW).y[:, -1]
        back = solve_ivp(law, (0, 100), away, events=section, **FLOW).y_events[0]
        return (back[0][1] if len(back) else 0.0) - height

    currents = lambda height: brentq(lift, 0.3241, 0.3243, args=(height,), xtol=1e-13)
    return minimize_scalar(currents, bounds=(0.95, 1.2), method="bounded", options={"xatol": 1e-3}).fun
