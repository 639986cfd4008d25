"""Named tuples that are quick to define: a short run defines two hundred of them.

``typing.NamedTuple`` compiles a constructor for each one, and each annotation of it, which takes a
sixth of such a run. Here all records of as many fields share a constructor's code. Their fields
need annotations that are text, by ``from __future__ import annotations``.
"""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Iterable
from functools import cache
from types import FunctionType
from typing import TYPE_CHECKING, Any, Self


class Record(tuple[Any, ...]):
    """What all named tuples share."""

    __slots__ = ()
    _fields: tuple[str, ...]

    @classmethod
    def _make(cls, values: Iterable[Any]) -> Self:
        values = tuple(values)
        if len(values) != len(cls._fields):
            raise TypeError(f"{cls.__name__} has {len(cls._fields)} fields, not {len(values)}")
        return tuple.__new__(cls, values)

    def _asdict(self) -> dict[str, Any]:
        return dict(zip(self._fields, self, strict=True))

    def _replace(self, /, **changes: Any) -> Self:
        changed = self._make(map(changes.pop, self._fields, self))
        if changes:
            raise TypeError(f"{type(self).__name__} has no fields {[*changes]}")
        return changed

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value!r}" for name, value in self._asdict().items())
        return f"{type(self).__name__}({values})"

    def __getnewargs__(self) -> tuple[Any, ...]:  # to be copied and pickled
        return tuple(self)

    __replace__ = _replace  # for ``copy.replace``


@cache
def _template(count: int) -> Any:
    """A named tuple of so many fields, whose constructor and getters others take."""
    return namedtuple("_template", [f"field_{i}" for i in range(count)])


class _Definition(type):
    """Makes a record of the annotated names of a class body."""

    def __new__(cls, name: str, bases: tuple[type, ...], body: dict[str, Any]) -> type:
        if not bases:
            return super().__new__(cls, name, bases, body)
        fields = tuple(body.get("__annotations__", ()))
        defaults = {field: body.pop(field) for field in fields if field in body}
        template = _template(len(fields))
        new = template.__new__
        code = new.__code__.replace(co_varnames=("_cls", *fields), co_qualname=f"{name}.__new__")
        body |= {
            "__slots__": (),
            "__match_args__": fields,
            "_fields": fields,
            "_field_defaults": defaults,
            "__new__": FunctionType(code, new.__globals__, "__new__", (*defaults.values(),)),
        }
        for field, place in zip(fields, template._fields, strict=True):
            body[field] = vars(template)[place]
        return type(name, (Record, *bases[1:]), body)


if TYPE_CHECKING:
    from typing import NamedTuple as NamedTuple
else:

    class NamedTuple(metaclass=_Definition):
        """The base of a class body whose annotated names are the fields of a record.

        >>> class Point(NamedTuple):
        ...     x: float
        ...     y: float = 0.0
        >>> Point(1.0), Point(1.0)._replace(y=2.0).y
        (Point(x=1.0, y=0.0), 2.0)
        """
