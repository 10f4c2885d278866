"""Equality of results: of all their numbers, NaN equal to NaN."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np
import pandas as pd

__all__ = ["equal", "hashed", "same"]


def equal(self: Any, other: object) -> Any:
    """``__eq__`` of a result: the same class, and the same in every field that is compared."""
    names = _compared(self)
    if type(self) is not type(other):
        return NotImplemented
    return all(same(getattr(self, name), getattr(other, name)) for name in names)


def hashed(self: Any) -> int:
    """``__hash__`` of a result: equal results have equal ones. A result with tables, arrays or mappings has none (``TypeError``)."""
    return hash(tuple(_key(getattr(self, name)) for name in _compared(self)))


def _compared(result: Any) -> list[str]:
    return [part.name for part in fields(result) if part.compare]


def _key(value: Any) -> Any:
    """A value to hash; the hash of NaN is that of the object, not of the number."""
    if isinstance(value, tuple):
        return tuple(map(_key, value))
    return "nan" if isinstance(value, float) and np.isnan(value) else value


def same(one: Any, other: Any) -> bool:
    """Whether two values are equal: tables and arrays in every entry, NaN equal to NaN."""
    if one is other:
        return True
    tables = (pd.DataFrame, pd.Series)
    if isinstance(one, tables) or isinstance(other, tables):
        return type(one) is type(other) and bool(one.equals(other))
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        if not isinstance(one, np.ndarray) or not isinstance(other, np.ndarray):
            return False
        numbers = one.dtype.kind in "fc" and other.dtype.kind in "fc"
        return bool(np.array_equal(one, other, equal_nan=numbers))
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(same(value, other[key]) for key, value in one.items())
    if isinstance(one, (list, tuple)) and type(one) is type(other):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, (float, np.floating)) and isinstance(other, (float, np.floating)):
        return bool(one == other) or bool(np.isnan(one) and np.isnan(other))
    return bool(one == other)
