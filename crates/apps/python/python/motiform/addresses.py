"""The address of a compiled function, with what can be checked of its signature."""

from __future__ import annotations

import ctypes
from _ctypes import CFuncPtr
from typing import Any

__all__ = ["SIGNATURE", "address_of"]

SIGNATURE = "void(float64, CPointer(float64), CPointer(float64), CPointer(float64))"
"""The signature for ``numba.cfunc``."""

_KINDS = (ctypes.POINTER(ctypes.c_double), ctypes.c_void_p)
_WANTED = "void f(double t, const double *x, const double *p, double *out)"


def address_of(function: Any, what: str) -> int:
    """The address of a ``numba.cfunc``, a function of ctypes, or an address itself."""
    if isinstance(function, int) and not isinstance(function, bool):
        if not 0 < function < 1 << (8 * ctypes.sizeof(ctypes.c_void_p)):
            raise ValueError(f"{what} = {function}: give the address of a loaded function")
        return function
    if hasattr(function, "address") and hasattr(function, "ctypes"):  # a numba.cfunc
        _check(getattr(function.ctypes, "argtypes", None), getattr(function.ctypes, "restype", None), what)
        return int(function.address)
    if isinstance(function, CFuncPtr):
        _check(function.argtypes, function.restype if function.argtypes is not None else None, what)
        return ctypes.cast(function, ctypes.c_void_p).value or 0
    raise TypeError(
        f"{what} is a {type(function).__name__}, not a compiled function: give a numba.cfunc({SIGNATURE!r}), a function of ctypes, "
        f"or the address of {_WANTED}"
    )


def _check(arguments: Any, result: Any, what: str) -> None:
    """The declared types, where there are any: a function of a library has none unless somebody has set them."""
    if arguments is None:
        return
    right = len(arguments) == 4 and arguments[0] is ctypes.c_double and all(kind in _KINDS for kind in arguments[1:])
    if not right or result is not None:
        shown = ", ".join(kind.__name__ for kind in arguments)
        raise TypeError(f"{what} is declared with the arguments ({shown}): give {_WANTED}")
