"""What is asked of the motion of a body: its name, its exponents, steady motions, crossings."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import replace
from typing import Literal

from . import _motiform
from .calls import OnEnd, Random, ended_early, known_end, known_whole, remark, span, with_given
from .described import Described
from .progress import Bar, Progress
from .results import (
    Crossings,
    Equilibrium,
    Exponents,
    Motions,
    Verdict,
    equilibrium_of,
    exponents_of,
    motions_of,
    outcome_of,
    verdict_of,
    with_units,
)
from .trajectory import crossing_frame


class Analysed(Described):
    """Analyses of the motion of a body."""

    def classify(
        self,
        *,
        budget: float = 0.0,
        initial: Mapping[str, float] | None = None,
        random: Random | None = None,
        perturb: float | None = None,
        seed: int | None = None,
        progress: Progress = None,
    ) -> Verdict:
        """Classifies the motion within at most `budget` model time (0: the model's default), with the evidence.

        The flow preserves exact symmetries, so coordinates that `initial` leaves at zero get random values within `perturb` times its
        largest value (1e-6 if not given; 0 keeps the exact start).

        More: docs/regimes.md.
        """
        study = with_given(self._study, initial, {"random": random, "perturb": perturb, "seed": seed})
        remark(study)
        with Bar(progress, budget or self.info.budget, "model time") as bar:
            verdict = verdict_of(json.loads(_motiform.classify(study, budget, bar.callable())))
        return with_units(verdict, self.units)

    def motions(
        self,
        samples: int = 100,
        *,
        random: Random | None = None,
        budget: float = 0.0,
        initial: Mapping[str, float] | None = None,
        seed: int | None = None,
        threads: int | None = None,
        progress: Progress = None,
    ) -> Motions:
        """The motions of `samples` initial states: shares with 95 % intervals, what was sampled, and how many escape.

        The initial states are random (after the one in `initial`, if given): without `random` they have all directions and
        log-uniform sizes from a hundredth of the model's typical size to the full size.

        More: docs/regimes.md.
        """
        known_whole(samples=samples, threads=threads)
        study = with_given(self._study, initial, {"random": random, "seed": seed})
        remark(study)
        with Bar(progress, 100.0, "%") as bar:
            count = threads or os.cpu_count() or 1
            found = motions_of(json.loads(_motiform.motions(study, samples, budget, count, bar.callable())))
        return replace(found, verdicts=tuple(with_units(verdict, self.units) for verdict in found.verdicts))

    def lyapunov(
        self,
        count: int | None = None,
        *,
        transient: float | None = None,
        t_end: float | None = None,
        initial: Mapping[str, float] | None = None,
        random: Random | None = None,
        seed: int | None = None,
        on_end: OnEnd = "warn",
        progress: Progress = None,
    ) -> Exponents:
        """The `count` largest Lyapunov exponents (by default at most 6), with errors, averaged over `t_end`.

        More: docs/regimes.md.
        """
        known_end(on_end)
        known_whole(count=count)
        study = with_given(self._study, initial, {"random": random, "seed": seed})
        remark(study)
        count = min(6, len(study.coordinates())) if count is None else count
        with Bar(progress, 100.0, "%") as bar:
            raw = json.loads(_motiform.lyapunov(study, count, transient, t_end, bar.callable()))
        if not raw["complete"]:
            ended_early(raw["ended"], on_end)
        return with_units(exponents_of(raw), self.units)

    def equilibria(self, *, starts: int = 200, seed: int | None = None, progress: Progress = None) -> list[Equilibrium]:
        """The steady motions (at rest, straight, circular) that Newton's method finds from the circle and from random
        shapes, and deflation beside them, the most stable first. The list may be incomplete; more `starts` may find more.

        More: docs/continuation.md.
        """
        known_whole(starts=starts)
        if starts < 1:
            raise ValueError(f"starts = {starts}: give at least 1")
        study = with_given(self._study, None, {"seed": seed})
        with Bar(progress, starts, "starts") as bar:
            raw = json.loads(_motiform.equilibria(study, starts, bar.callable()))
        return [with_units(equilibrium_of(entry), self.units) for entry in raw]

    def section(
        self,
        coordinate: str = "y",
        value: float = 0.0,
        direction: Literal["rising", "falling", "either"] = "either",
        *,
        t_end: float | None = None,
        transient: float | None = None,
        initial: Mapping[str, float] | None = None,
        seed: int | None = None,
        on_end: OnEnd = "warn",
        progress: Progress = None,
    ) -> Crossings:
        """The crossings of the orbit with ``coordinate = value``, located to round-off.

        More: docs/python.md.
        """
        known_end(on_end)
        study = with_given(self._study, initial, {"t_end": t_end, "transient": transient, "seed": seed})
        remark(study)
        with Bar(progress, lambda: span(study), "model time") as bar:
            found = _motiform.section(study, coordinate, value, direction, bar.callable())
        table, (raw, complete, ended) = found
        if not complete:
            ended_early(ended, on_end)
        return Crossings(crossing_frame(*table), outcome_of(json.loads(raw), complete, ended))
