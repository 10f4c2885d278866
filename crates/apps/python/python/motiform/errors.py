"""Warnings and interruptions that carry their result."""

from __future__ import annotations


class EndedEarly(UserWarning):
    """A run did not reach its end: it escaped, its step size became too small, or its step budget was used up. See ``outcome`` of the result,
    or ``summary["notes"]`` of statistics of many bodies."""


class Incomplete(UserWarning):
    """Rows of a folder are missing or damaged."""


class Doubtful(UserWarning):
    """What is asked for is allowed, and probably not what is meant: a tie that says 0 = 0, an explicit stepper for stiff equations."""


class WorkersLost(RuntimeWarning):
    """An executor failed; the rest of a scan is computed in this process."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during ``simulate``, ``statistics``, ``branches``, ``curves``, ``scan``, or ``observe`` and ``fit`` of cells. The results computed so far are in
    ``result``."""

    def __init__(self, result: object) -> None:
        super().__init__("interrupted; what was computed so far is the exception's result")
        self.result = result
        """A shorter ``Trajectory``, ``Statistics`` of the bodies that are finished, the ``Branches`` or ``Curves`` found so far, a ``Dataset`` with missing
        rows, or the cells that are done."""
