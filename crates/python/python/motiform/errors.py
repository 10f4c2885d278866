"""Warnings and interruptions that carry their result."""

from __future__ import annotations


class EndedEarly(UserWarning):
    """A run did not reach its end: it escaped, or its step size or budget gave out. See ``outcome`` of the result."""


class Incomplete(UserWarning):
    """A folder lacks rows, or holds damaged ones."""


class WorkersLost(RuntimeWarning):
    """An executor broke down; the rest of a scan is computed here."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a long call. What was computed until then is in ``result``."""

    def __init__(self, result: object) -> None:
        super().__init__("interrupted; what was computed so far is the exception's result")
        self.result = result
        """A shorter ``Trajectory``, or a ``Dataset`` with rows missing."""
