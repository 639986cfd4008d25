"""NamedTuple, which a run defines two hundred times.

The one of ``typing`` compiles every annotation, and a constructor for each class: a tenth of the
time of a short run. This one has the same methods and compiles nothing.
"""

from __future__ import annotations

from operator import itemgetter
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # a type checker reads the fields of this one
    from typing import NamedTuple as NamedTuple
else:

    class _Fields(type):
        """Makes fields of a class's annotations, unless a class above has fields."""

        def __new__(meta, name, bases, space):
            if bases[0] is not tuple and not bases[0]._fields:
                fields = tuple(space.get("__annotations__", ()))
                space["_field_defaults"] = {one: space[one] for one in fields if one in space}
                space.update((one, property(itemgetter(i))) for i, one in enumerate(fields))
                space.update(_fields=fields, __match_args__=fields, __slots__=())
            return super().__new__(meta, name, bases, space)

    class NamedTuple(tuple, metaclass=_Fields):
        """A tuple whose values have names; its methods are those of ``typing.NamedTuple``.

        The module of a class postpones the evaluation of annotations.
        """

        __slots__ = ()
        _fields = ()

        def __new__(cls, *values, **named):
            """Return a tuple of values, by position, by name or by default."""
            if named or len(values) != len(cls._fields):
                values = cls._completed(values, named)
            return tuple.__new__(cls, values)

        @classmethod
        def _completed(cls, values, named):
            """Values of all fields. Raises TypeError for one too many, unknown or missing."""
            known = cls._field_defaults | named if named else cls._field_defaults
            try:
                every = (*values, *[known[one] for one in cls._fields[len(values) :]])
            except KeyError as missing:
                raise TypeError(f"{cls.__name__}() needs {missing.args[0]}") from None
            if len(every) > len(cls._fields):
                raise TypeError(f"{cls.__name__} has {len(cls._fields)} fields, not {len(every)}")
            for one in named:
                if one not in cls._fields[len(values) :]:
                    why = f"{one} already" if one in cls._fields else f"no field {one}"
                    raise TypeError(f"{cls.__name__} has {why}")
            return every

        @classmethod
        def _make(cls, values):
            """Return a tuple of an iterable's values."""
            return cls(*values)

        def _replace(self, **named):
            """Return a copy with some other values."""
            for one in named:
                if one not in self._fields:
                    raise ValueError(f"{type(self).__name__} has no field {one}")
            return tuple.__new__(type(self), map(named.get, self._fields, self))

        def _asdict(self):
            """Return the values by name."""
            return dict(zip(self._fields, self, strict=True))

        def __repr__(self):
            values = ", ".join(map("{}={!r}".format, self._fields, self))
            return f"{type(self).__name__}({values})"

        def __getnewargs__(self):
            return tuple(self)
