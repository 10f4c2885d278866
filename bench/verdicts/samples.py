"""What is asked: parameter sets and starts, all from one seed."""

import math
import random

NAMES = "gamma kappa2 kappa3 a1 a2 a3 a4 a5 a6 b1 b2 b3 b4 b5 b6 d1 d2 d3 d4 d5 d6".split()
STATE = "v1 v2 s11 s12 u111 u222".split()

REDUCED = {"a1": 1.0, "b1": 0.5, "b3": 1.0, "kappa3": 1.0}
FULL = {"gamma": 1.0, "a1": -1.0, "b1": -0.5, "b2": 0.3, "d1": 0.1, "d2": 0.8}

# Ten sets: the planes of Figs. 1 and 4 with a point of every motion, those named in issue reports among them.
SETS = {
    "fig1": {**REDUCED, "kappa2": -0.1, "gamma": 0.1},
    "fig2": {**REDUCED, "kappa2": -0.1, "gamma": -0.04},
    "fig3": {**REDUCED, "kappa2": -0.06, "gamma": 0.02},
    "pulsating": {**REDUCED, "kappa2": -0.02, "gamma": -0.044},
    "ellipse": {**REDUCED, "kappa2": -0.1, "gamma": -0.3},
    "fig4": {**FULL, "kappa2": 0.5, "kappa3": 0.5},
    "fig5a": {**FULL, "kappa2": 0.9, "kappa3": 0.1},
    "breaking": {**FULL, "kappa2": 1.148, "kappa3": 0.1},
    "fig5b": {**FULL, "kappa2": 0.5, "kappa3": 0.1},
    "bistable": {**FULL, "kappa2": 1.11, "kappa3": 0.105},
}


def turned(z, angle):
    """z_n -> exp(-i n angle) z_n."""
    return [x * complex(math.cos(n * angle), -math.sin(n * angle)) for n, x in enumerate(z, 1)]


def coordinates(z):
    """v1, v2, S11, S12, U111, U222 of z1 = v1 - i v2, z2 = (S11 - i S12)/2, z3 = (U111 + i U222)/2."""
    return [z[0].real, -z[0].imag, 2 * z[1].real, -2 * z[1].imag, 2 * z[2].real, 2 * z[2].imag]


def amplitude(rng):
    return 10 ** rng.uniform(-6, 0)


def invariant(rng, kind, parameters):
    """A start in (or beside) an invariant subspace: of mirror images, of two- or three-fold shapes, of rest."""
    signed = lambda: rng.choice([-1, 1]) * amplitude(rng)
    any_phase = lambda: amplitude(rng) * complex(math.cos(a := rng.uniform(0, 2 * math.pi)), math.sin(a))
    z = [0j, 0j, 0j]
    if kind.startswith("mirror"):
        z = [complex(signed()) for _ in z]
    elif kind == "large mirror":
        z = [complex(rng.uniform(-1, 1)) for _ in z]
    elif kind == "two-fold":
        z[1] = any_phase()
    elif kind == "three-fold":
        z[2] = any_phase()
    elif kind == "one axis":
        z[0] = complex(signed())
    elif kind == "rest":
        z[1:] = [any_phase(), any_phase()]
    elif kind == "no triangle":
        z[:2] = [any_phase(), any_phase()]
    elif kind == "ellipse":
        kappa2, b3 = parameters.get("kappa2", 1.0), parameters.get("b3", 0.0)
        r = math.sqrt(-kappa2 / (8 * b3)) if b3 > 0 > kappa2 else amplitude(rng)
        z[1] = complex(rng.choice([-1, 1]) * r)
    elif kind == "general":
        z = [any_phase() for _ in z]
    # Along an axis of the plane zeros stay zeros; along others round-off leaves the subspace.
    if kind.endswith("turned"):
        z = turned(z, rng.uniform(0, 2 * math.pi))
    u = coordinates(z)
    if kind.endswith("nearly"):
        u = [x + rng.choice([1e-14, 1e-10, 1e-7]) * rng.uniform(-1, 1) for x in u]
    return u


KINDS = ["mirror", "mirror turned", "mirror nearly", "large mirror", "two-fold", "three-fold", "one axis", "rest",
         "no triangle", "ellipse", "origin", "general"]


def from_subspaces(seed, per_set=100):
    """`per_set` starts for each of the ten sets."""
    for name, parameters in SETS.items():
        rng = random.Random(f"{seed} {name}")
        for i in range(per_set):
            kind = KINDS[i % len(KINDS)]
            start = invariant(rng, kind, parameters)
            yield {"id": f"{name}/{i}/{kind.replace(' ', '-')}", "model": "tensor", "parameters": parameters,
                   "start": dict(zip(STATE, start))}


def coefficients(rng, i):
    """A point of the 21-parameter space: half of them anywhere, half around the paper's two models with every term on.
    Every second one has all cubic terms damping, so that not everything blows up."""
    if i % 4 < 2:
        strength = rng.choice([1.0, 0.3, 0.1])
        p = {name: strength * rng.gauss(0, 1) for name in NAMES[3:]}
        for name in NAMES[:3]:
            p[name] = rng.choice([1, 0.3, 0.1, 0.03]) * rng.uniform(-1, 1)
    else:
        centre = {**FULL, "kappa2": rng.uniform(0.1, 1.4), "kappa3": rng.uniform(0.03, 0.4)}
        if rng.random() < 0.4:
            centre = {**REDUCED, "kappa2": rng.uniform(-0.22, 0.22), "gamma": rng.uniform(-0.16, 0.12),
                      "kappa3": rng.uniform(-0.1, 1)}
        spread = rng.choice([0.2, 0.05])
        p = {name: centre.get(name, 0.0) + (spread * rng.gauss(0, 1) if name in NAMES[3:] else 0.0) for name in NAMES}
    if i % 2:
        for name in "a4 a5 b3 b4 b5 d3 d4 d5".split():
            p[name] = abs(p[name])
    return p


def anywhere(seed, count=2000):
    """Points of the 21-parameter space with starts of several sizes, one in four in an invariant subspace."""
    rng = random.Random(f"{seed} anywhere")
    for i in range(count):
        p = coefficients(rng, i)
        kind, size = "general", rng.choice([1e-4, 1e-2, 0.1, 1.0])
        start = [size * rng.uniform(-1, 1) for _ in STATE]
        if rng.random() < 0.25:
            kind = rng.choice(KINDS[:-1])
            start = invariant(rng, kind, p)
        yield {"id": f"any/{i}/{kind.replace(' ', '-')}", "model": "tensor", "parameters": p, "start": dict(zip(STATE, start))}


LENGTHS = [6.2, 7.0, 9.0, 12.0, 12.4, 12.8, 13.2, 13.5, 14.4, 15.0, 18.0, 20.85, 21.0, 21.4, 21.6, 21.75, 21.8, 22.0, 22.3, 24.0, 28.0,
           29.2, 29.3, 29.4, 29.45, 29.6, 29.8, 31.0]


def cells(seed):
    """The active cell at lengths of every window, from general starts; and from exact symmetry where the circle is unstable."""
    rng = random.Random(f"{seed} cells")
    names = [f"{wave}{n}" for n in range(1, 22) for wave in "cs"]
    for length in LENGTHS:
        start = {name: 0.01 * rng.uniform(-1, 1) for name in names}
        yield {"id": f"cell/{length}/general", "model": "cell", "parameters": {"length": length}, "start": start}
    for length in (7.0, 13.5, 15.0, 24.0):
        for kind, start in [("circle", {}), ("mode-1", {"s1": 0.05}), ("mode-2", {"c2": 0.05}), ("mode-3", {"c3": 0.05}),
                            ("mirror", {f"s{n}": 0.1 * rng.uniform(-1, 1) for n in (1, 2, 3)})]:
            yield {"id": f"cell/{length}/{kind}", "model": "cell", "parameters": {"length": length}, "start": start}
