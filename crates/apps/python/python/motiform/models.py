"""A body: a model with parameters, an initial state and run settings."""

from __future__ import annotations

import json
import os
import reprlib
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _motiform
from ._registry import PRESETS
from .analysed import Analysed
from .atlases import Atlas, atlas_of, axis_text
from .branches import Branches, branches_of
from .calls import OnEnd, Random, axis_of, ended_early, known_end, known_whole, left_out, raised_with, range_of, real, remark, span, with_given
from .curves import Curves, curves_of
from .lifetimes import Lifetimes, lifetimes_of
from .measurements import Statistics, Threshold, asked, statistics_from
from .progress import Bar, Progress
from .trajectory import Floats, Trajectory


class Model(Analysed):
    """A model with its parameters. Immutable: :meth:`replace` returns a modified copy.

    Use :class:`Tensor`, :class:`Cell`, :class:`Amplitudes` (equations as text), :func:`preset` or :func:`study`.
    """

    def simulate(
        self,
        t_end: float | None = None,
        *,
        transient: float | None = None,
        dt_out: float | None = None,
        initial: Mapping[str, float] | None = None,
        random: Random | None = None,
        seed: int | None = None,
        noise: float | None = None,
        noise_velocity: float | None = None,
        stepper: str | None = None,
        rtol: float | None = None,
        atol: float | None = None,
        step: float | None = None,
        max_steps: int | None = None,
        escape_norm: float | None = None,
        on_end: OnEnd | None = None,
        progress: Progress = None,
    ) -> Trajectory:
        """Runs the body and records its motion.

        Parameters
        ----------
        t_end
            Recorded time (model time).
        transient
            Time before the recording; the position is reset after it.
        dt_out
            Time between rows; by default ``t_end / 2000``.
        initial
            Initial values by name (the shape's coordinates, ``x``, ``y``); those not given are 0. If none is given, the
            initial state is random, from `seed`.
        random
            Size of a random initial state: a size (each coordinate within ±size; by default 0.01), or ``(min, max)``: all
            directions, with a log-uniform norm in this range.
        noise
            Amplitude eta of additive white noise: ``du = f(u) dt + eta dW`` for every coordinate ``u`` of the shape, and of
            the velocity if it is an unknown (tensor), unless `noise_velocity` gives its amplitude.
        stepper, rtol, atol, step
            Method and step control; `step` gives a fixed step. `rtol` sets the accuracy of the run: `atol` follows it
            unless it is given (:attr:`Trajectory.tolerances` contains both).
        escape_norm
            A shape beyond this norm has escaped.
        on_end
            What to do if the run does not reach `t_end`: ``"warn"`` (:class:`EndedEarly`), ``"ignore"`` (the default
            if `escape_norm` or `max_steps` is given, because an early end is then expected) or ``"raise"`` (``RuntimeError``).

        Settings that are not given are those of the model or the preset. Ctrl-C raises :class:`Interrupted` with the shorter trajectory.

        More: docs/recipes.md, units in docs/units.md.
        """
        known_end(on_end)
        given = {
            "t_end": t_end, "transient": transient, "dt_out": dt_out, "random": random, "seed": seed, "noise": noise,
            "noise_velocity": noise_velocity, "stepper": stepper, "rtol": rtol, "atol": atol, "step": step, "max_steps": max_steps,
            "escape_norm": escape_norm,
        }  # fmt: skip
        study = with_given(self._study, initial, given)
        remark(study)
        with Bar(progress, lambda: span(study), "model time") as bar:
            run, raised = _motiform.simulate(study, bar.callable())
        trajectory = Trajectory(run)
        if raised is not None:
            raise raised_with(raised, trajectory)
        if not run.complete:
            asked = escape_norm is not None or max_steps is not None
            ended_early(run.ended, on_end or ("ignore" if asked else "warn"))
        return trajectory

    def branches(
        self,
        along: tuple[str, float, float],
        *,
        from_: str | None = None,
        start: str | os.PathLike[str] | None = None,
        direction: Literal["up", "down", "both"] = "both",
        branch_step: float | None = None,
        first_step: float | None = None,
        tolerance: float | None = None,
        steady: bool = False,
        from_stable: bool = False,
        doublings: int = 3,
        branches: int = 8,
        points: int = 2000,
        initial: Mapping[str, float] | None = None,
        seed: int | None = None,
        progress: Progress = None,
    ) -> Branches:
        """The motion that the start settles on, followed along a parameter, stable or not, with what begins on the way.

        >>> body = motiform.preset("fig4").replace(kappa2=0.9, kappa3=0.1)
        >>> found = body.branches(("kappa2", 0.3, 1.6), from_="zigzag", branches=2)
        >>> found.special[["kind", "kappa2", "period"]]
        >>> found.plot("turning_rate")

        `along` is a parameter with its range, which holds the start. `from_` names the motion that the start must settle on
        (motionless, straight, circular, spinning, zigzag, quasi-periodic, pulsating-straight). At most so many `branches` are followed,
        each over at most so many `points` to a side.

        `start` is a point of an earlier result, stable or not, whose parameters replace those of this model: ``"FOLDER:BRANCH:POINT"`` of
        branches, ``"FILE.json:NUMBER"`` of ``motiform equilibria --json``, ``"DATASET:t=TIME"`` or ``"DATASET:ROW"``; a dataset alone starts from
        its last state. `direction` says to which sides the start is followed. `branch_step` (0.02) and `first_step` (0.005) are the longest
        and the first step, as parts of the range; Newton's method has converged with a step below `tolerance` (1e-9). With `steady` the
        orbits that begin at Hopf points are not followed; with `from_stable` those alone that begin where a stable motion loses its stability. Of a
        cascade at most so many `doublings` of the period in a row are followed.

        More: docs/continuation.md.
        """
        known_whole(doublings=doublings, branches=branches, points=points)
        study = with_given(self._study, initial, {"seed": seed})
        name, range_ = range_of("along", along)
        remark(study, (name,))
        settings: dict[str, Any] = {
            "along": range_, "from": from_, "direction": direction, "branch_step": branch_step, "first_step": first_step,
            "tolerance": tolerance, "steady": steady, "from_stable": from_stable, "doublings": doublings,
            "branches": branches, "points": points,
        }  # fmt: skip
        with Bar(progress, branches, "branches") as bar:
            point = None if start is None else os.fspath(start)
            text, table, raised = _motiform.follow_branches(study, settings, point, bar.callable())
        result = branches_of(text, table, self.units)
        if raised is not None:
            raise raised_with(raised, result)
        return result

    def statistics(
        self,
        bodies: int = 100,
        *,
        t_end: float | None = None,
        transient: float | None = None,
        dt_out: float | None = None,
        initial: Mapping[str, float] | None = None,
        random: Random | None = None,
        seed: int | None = None,
        noise: float | None = None,
        noise_velocity: float | None = None,
        radii: Sequence[float] = (),
        threshold: Threshold = None,
        threads: int | None = None,
        progress: Progress = None,
    ) -> Statistics:
        """What is measured on many bodies: displacements, diffusion, correlations, distributions, first-passage times, spectra.

        >>> found = motiform.Tensor(gamma=1.0, kappa2=2.0, kappa3=2.0).statistics(100, t_end=400.0, transient=20.0, noise=0.3)
        >>> found.persistence, found.diffusion          # numbers with 95 % intervals, or the reason why there are none
        >>> found.msd, found.autocorrelations           # tables
        >>> found.plot("autocorrelations")

        Body k is :meth:`simulate` with the seed ``seed + k``: another random start, and other noise. Those that do not complete are
        left out, with the warning :class:`EndedEarly` that says how many, and how the first one ended. `radii` are those of discs that bodies leave; `threshold` is that of the residence times: a quantity (``"speed"``, a mode), or
        one with a value. Without `dt_out` samples are as far apart as in the model's own run, and further where all bodies would have more than
        two million. Ctrl-C raises :class:`Interrupted` with the statistics of the bodies that are finished, and
        ``KeyboardInterrupt`` if there is none.

        More: docs/statistics.md.
        """
        known_whole(bodies=bodies, threads=threads)
        if t_end is not None and dt_out is None:
            dt_out = _motiform.samples_apart(self._study, t_end, bodies)
        given = {
            "t_end": t_end, "transient": transient, "dt_out": dt_out, "random": random, "seed": seed,
            "noise": noise, "noise_velocity": noise_velocity,
        }  # fmt: skip
        study = with_given(self._study, initial, given)
        remark(study)
        counts = (bodies, threads or os.cpu_count() or 1)
        with Bar(progress, bodies, "bodies") as bar:
            text, tables, raised = _motiform.statistics(study, counts, asked(radii, threshold), bar.callable())
        result = statistics_from(text, tables, self.units)
        if raised is not None:
            raise raised_with(raised, result)
        left_out(result.summary["notes"])
        return result

    def curves(
        self,
        kinds: str | Sequence[str],
        along: tuple[str, float, float],
        across: tuple[str, float, float],
        *,
        from_: str | None = None,
        branches: int = 8,
        points: int = 2000,
        initial: Mapping[str, float] | None = None,
        seed: int | None = None,
        progress: Progress = None,
    ) -> Curves:
        """The special points of these `kinds` on the branches along one parameter, followed over two.

        >>> body = motiform.preset("fig4").replace(kappa2=0.9, kappa3=0.1)
        >>> plane = ("kappa2", 0.7, 1.2), ("kappa3", 0.05, 0.2)
        >>> found = body.curves("symmetry-breaking", *plane, from_="zigzag", branches=1)
        >>> found[0].points[["kappa2", "kappa3", "period"]]
        >>> found.plot()

        `kinds`: hopf, fold, pitchfork, symmetry-breaking, period-doubling, torus. `along` and `across` are parameters with their
        ranges; the branches are followed as by :meth:`branches` along the first one.

        More: docs/continuation.md.
        """
        known_whole(branches=branches, points=points)
        study = with_given(self._study, initial, {"seed": seed})
        names = [kinds] if isinstance(kinds, str) else list(kinds)
        (first, side), (second, other) = range_of("along", along), range_of("across", across)
        remark(study, (first, second))
        settings: dict[str, Any] = {
            "along": side, "curve": names, "in": f"{first},{other}", "from": from_, "branches": branches, "points": points,
        }  # fmt: skip
        with Bar(progress, 1, "of branches and curves") as bar:
            text, table, raised = _motiform.follow_curves(study, settings, bar.callable())
        result = curves_of(text, table, self.units)
        if raised is not None:
            raise raised_with(raised, result)
        return result

    def atlas(
        self,
        axes: Mapping[str, str | Sequence[float]] | None = None,
        *,
        samples: int | None = None,
        lines: int | None = None,
        branches: int | None = None,
        steady: bool | None = None,
        random: Random | None = None,
        seed: int | None = None,
        budget: float | None = None,
        threads: int | None = None,
        out: str | os.PathLike[str] | None = None,
        resume: bool = False,
        overwrite: bool = False,
        progress: Progress = None,
    ) -> Atlas:
        """A plane of two parameters: which motions happen where, and by which bifurcation each begins or ends.

        >>> body = motiform.preset("fig4")
        >>> found = body.atlas({"kappa2": (0.1, 1.6), "kappa3": (0.1, 1.0)})
        >>> found.regions[0].motions, found.boundaries[0].kinds
        >>> found.special, found.curves, found.cells      # tables
        >>> found.save("atlas.pdf", width="86mm")         # the figure of the command line
        >>> found.plot()                                  # one of Matplotlib

        `axes`: two parameters with their ranges, (low, high), (low, high, count), or text as on the command line (``"0.1:1.6:33"``); by default
        the plane of the model's preset. `samples`: initial states of each cell, 3 if neither this nor the study says it. `lines` across
        boundaries are followed (24, if neither this nor the study says it), with at most so many `branches` each (4), of `steady` motions
        alone if that is true (by default where the equations are stiff). `out`, `resume`, `overwrite`: a folder that :func:`read` reads, as with ``--out --resume --force``. An
        interruption raises ``KeyboardInterrupt``; with `out` what is finished is kept.

        More: docs/atlas.md.
        """
        known_whole(samples=samples, lines=lines, branches=branches, threads=threads)
        names = None if axes is None else [axis_text(name, values) for name, values in axes.items()]
        study = with_given(self._study, None, {"random": random, "seed": seed})
        remark(study, () if axes is None else tuple(axes))
        place = None if out is None else (os.fspath(out), "resume" if resume else "replace" if overwrite else "new")
        counts = (samples, budget, threads or os.cpu_count() or 1)
        settings = {"lines": lines, "branches": branches, "steady": steady}
        with Bar(progress, 1, "of cells and lines") as bar:
            native = _motiform.make_atlas(study, names, counts, settings, place, bar.callable())
        if native is None:
            raise KeyboardInterrupt
        return atlas_of(native, self.units)

    def lifetimes(
        self,
        along: Mapping[str, str | npt.ArrayLike],
        *,
        samples: int = 64,
        until: float | None = None,
        transient: float | None = None,
        random: Random | None = None,
        seed: int | None = None,
        threads: int | None = None,
        out: str | os.PathLike[str] | None = None,
        resume: bool = False,
        overwrite: bool = False,
        progress: Progress = None,
    ) -> Lifetimes:
        """How long transient chaos lives along a parameter, until the body blows up or is captured by a stable steady motion.

        >>> body = motiform.preset("fig4").replace(kappa3=0.1)
        >>> found = body.lifetimes({"kappa2": "0.36:0.46:6"}, until=2e5)
        >>> found.values[["kappa2", "events", "life", "lower", "upper"]]
        >>> print(found.law, found.sentence)
        >>> found.plot()

        `along`: a parameter with its values, an array, or text as on the command line (``"0.36:0.46:6"``). At each value `samples` random starts
        are followed for `until` (model time, in whole looks of the model; 100 looks if not given). A life counts from `transient` on, the way onto the
        chaotic set (one look if not given, and longer where bodies are captured). `random`: by default 0.01 to 1 times the model's typical
        size. `out`, `resume`, `overwrite`: a folder that :func:`read` reads, as with ``--out --resume --force``. An interruption raises
        ``KeyboardInterrupt``: the lives that have ended are the short ones, and give no mean; with `out` they are kept.

        Source: Cox and Oakes (1984), Analysis of Survival Data, ch. 3; Grebogi, Ott, Yorke (1986), Phys. Rev. Lett. 57, 1284. More: docs/lifetimes.md.
        """
        known_whole(samples=samples, threads=threads)
        if not isinstance(along, Mapping) or len(along) != 1:
            raise TypeError(f"along = {along!r}: give one parameter with its values, such as {{'kappa2': '0.36:0.46:6'}}")
        ((name, values),) = along.items()
        study = with_given(self._study, None, {"random": random, "seed": seed})
        remark(study, (name,))
        place = None if out is None else (os.fspath(out), "resume" if resume else "replace" if overwrite else "new")
        counts = (samples, threads or os.cpu_count() or 1, until, transient)
        with Bar(progress, 100.0, "%") as bar:
            text = _motiform.lifetimes(study, (name, axis_of(name, values)), counts, place, bar.callable())
        return lifetimes_of(json.loads(text), self.units)

    def __call__(self, t: float, u: npt.ArrayLike) -> Floats:
        """The vector field: d/dt of the coordinates at `u`, for integrators such as ``scipy.integrate.solve_ivp``.

        `u` contains the coordinates (:attr:`coordinates`), optionally followed by ``x``, ``y``: (entries,), or (entries, m) for m
        states at once. The result has the same shape. `t` is ignored.
        """
        states = real(u)
        if states.ndim not in (1, 2):
            raise ValueError(f"u has {states.ndim} dimensions: give (entries,) or (entries, m)")
        rows = np.ascontiguousarray(states[np.newaxis] if states.ndim == 1 else states.T)
        rates = self._flow().rates(rows)
        return rates[0] if states.ndim == 1 else np.ascontiguousarray(rates.T)

    def _flow(self) -> _motiform.Flow:
        flow: _motiform.Flow | None = self.__dict__.get("_made_flow")
        if flow is None:
            flow = self.__dict__["_made_flow"] = _motiform.Flow(self._study)
        return flow


def preset(name: str) -> Model:
    """A parameter set of the paper: ``fig1`` .. ``fig5b`` (tensor), ``fig6a`` .. ``fig6d`` (cell)."""
    if not isinstance(name, str):
        raise TypeError(f"name = {reprlib.repr(name)}: give the name of a parameter set of the paper: {', '.join(PRESETS)}")
    return of_study(_motiform.Study.preset(name))


def study(path: str | os.PathLike[str]) -> Model:
    """The model of a study file, with its parameters, start, run and scan."""
    name = os.fspath(path)
    if not os.path.exists(name):
        known = f"it is a parameter set of the paper: motiform.preset({name!r})"
        raise FileNotFoundError(f"there is no file {name!r}{f'; {known}' if name in PRESETS else ''}")
    return of_study(_motiform.Study.read(name))


def of_study(native: _motiform.Study) -> Model:
    """The model of a native study, as :class:`Tensor`, :class:`Cell` or :class:`Amplitudes`."""
    from . import bodies, equations

    name = native.model.capitalize()
    kind: type[Model] = equations.Amplitudes if name == "Amplitudes" else getattr(bodies, name)
    return kind._of(native)
