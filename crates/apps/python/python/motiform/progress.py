"""Progress: a bar if tqdm is installed and the work takes more than a second, otherwise nothing."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from types import TracebackType
from typing import Any

Progress = bool | Callable[[float], object] | None
"""``None``: a bar if tqdm is installed; ``True``: a bar, or ImportError; ``False``: nothing; or a callable that receives the
fraction done, 0 to 1."""


class Bar:
    """Shows the fraction done of `total` units; created at the first report, because most calls are too short for one."""

    def __init__(self, progress: Progress, total: float | Callable[[], float], unit: str) -> None:
        self._wanted, self._given, self._unit = progress, total, unit
        self._total = 1.0
        self._bar: Any = None

    def callable(self) -> Callable[[float], object] | None:
        """The callable to which native code passes the fraction done."""
        if self._wanted is False:
            return None
        return self._wanted if callable(self._wanted) else self._show

    def _show(self, fraction: float) -> None:
        if self._bar is None:
            self._total = self._given() if callable(self._given) else self._given
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")  # without ipywidgets a notebook shows the bar as text
                    from tqdm.auto import tqdm
            except ImportError:
                if self._wanted is True:
                    raise
                self._bar = False
            else:
                unit = f" {self._unit}"
                self._bar = tqdm(total=self._total, unit=unit, unit_scale=True, delay=1.0, leave=False)
        if self._bar is not False:
            self._bar.update(fraction * self._total - self._bar.n)

    def __enter__(self) -> Bar:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar:
            self._bar.close()
