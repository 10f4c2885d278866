"""Objects and mappings that cannot be changed: errors instead of assignments without effect."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

V = TypeVar("V")


class Fixed:
    """An object whose attributes cannot be set: its class has ``replace``, and sets its own ones in ``vars(self)``."""

    if not TYPE_CHECKING:  # type checkers know that these attributes are read-only

        def __setattr__(self, name: str, value: object) -> NoReturn:
            kind = type(self).__name__
            raise AttributeError(f"{name} = {value!r}: a {kind} cannot be changed; replace({name}={value!r}) returns a changed copy")

        def __delattr__(self, name: str) -> NoReturn:
            kind = type(self).__name__
            raise AttributeError(f"del {name}: a {kind} cannot be changed; replace(...) returns a changed copy")


class Values(dict[str, V]):
    """Names and values of an object that cannot be changed: ``dict(values)`` is a copy that can be changed."""

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        raise TypeError(
            "these values are read-only: replace(NAME=value) returns a changed copy of the object, and dict(...) a copy of the values"
        )

    if not TYPE_CHECKING:
        __setitem__ = __delitem__ = __ior__ = _refuse
        clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return Values, (dict(self),)
