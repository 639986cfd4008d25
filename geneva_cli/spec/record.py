"""Frozen records whose fields are annotated in their class, as those of a dataclass.

A dataclass generates its methods when its class is made. That takes a third of the start of a short
run, as a spec has some thirty tables. Here all records have common methods, and the fields of a
class are read when its first record is made.
"""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Iterable, Sequence
from typing import Any, ClassVar, NamedTuple, Self, dataclass_transform, get_origin

from geneva_cli.errors import GenevaError, cut, few, nearest

REQUIRED = dataclasses.MISSING
SHOWN_MAX = 200  # characters of a value in a record that is shown shortly
HASH = "_hash"  # name under which a record stores its own hash


class Parameter(NamedTuple):
    """A field of a record, as its class declares it."""

    name: str
    default: Any  # REQUIRED if there is none
    kw_only: bool
    annotation: Any


class _Signature:
    """Signature of a record's class, for ``help`` and editors; it is computed when they ask."""

    def __get__(self, record: object, kind: type[Record]) -> inspect.Signature:
        empty = inspect.Parameter.empty
        by_keyword = inspect.Parameter.KEYWORD_ONLY
        either = inspect.Parameter.POSITIONAL_OR_KEYWORD
        return inspect.Signature(
            [
                inspect.Parameter(
                    one.name,
                    by_keyword if one.kw_only else either,
                    default=empty if one.default is REQUIRED else one.default,
                    annotation=one.annotation,
                )
                for one in sorted(parameters(kind), key=lambda one: one.kw_only)
            ]
        )


@dataclass_transform(frozen_default=True, field_specifiers=(dataclasses.field,))
class Record:
    """A frozen record. Two are equal if they have one class and equal values."""

    KW_ONLY: ClassVar[bool] = False  # True if the fields of the class itself have no position
    __signature__ = _Signature()

    def __init_subclass__(cls, kw_only: bool = False) -> None:
        cls.KW_ONLY = kw_only

    def __new__(cls, *_: object, **named: object) -> Self:
        """Refuse a keyword that is no field, with the nearest."""
        refuse_keywords(cls.__name__, named, names(cls))
        return super().__new__(cls)

    def __init__(self, *values: object, **named: object) -> None:
        own, kind = vars(self), type(self)
        if values:
            named = _by_name(kind, values, named)
        for one in parameters(kind):
            value = own[one.name] = named.get(one.name, one.default)
            if value is REQUIRED:
                raise TypeError(f"{kind.__name__} needs {one.name}")
        self.__post_init__()

    def __post_init__(self) -> None:
        """Check the values of a new record."""

    def __setattr__(self, name: str, value: object) -> None:
        raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")

    def __delattr__(self, name: str) -> None:
        raise dataclasses.FrozenInstanceError(f"cannot delete field {name!r}")

    def _values(self) -> dict[str, Any]:
        """Values by field name."""
        own = vars(self)
        return {name: own[name] for name in names(type(self))}

    def __eq__(self, other: object) -> bool:
        if not (isinstance(other, Record) and type(other) is type(self)):
            return NotImplemented
        return self is other or self._values() == other._values()

    def __hash__(self) -> int:
        own = vars(self)
        if HASH not in own:
            # includes the type, since many laws and drives have equal values
            own[HASH] = hash((type(self), *self._values().values()))
        value: int = own[HASH]
        return value

    def __getstate__(self) -> dict[str, object]:
        """The values without the hash: in another process strings hash differently."""
        return {name: value for name, value in vars(self).items() if name != HASH}

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value!r}" for name, value in self._values().items())
        return f"{type(self).__qualname__}({values})"

    def replace(self, **changes: Any) -> Self:
        """Return a copy with some fields changed and checked.

        >>> Spherical(6).replace(axes_deg=60.0)
        Spherical(z=6, held_by=None, axes_deg=60.0)
        """
        kind = type(self)
        refuse_keywords(kind.__name__, changes, names(kind))
        new = object.__new__(kind)
        vars(new).update(self._values() | changes)
        new.__post_init__()
        return new


def _by_name(
    kind: type[Record], values: Sequence[object], named: dict[str, object]
) -> dict[str, object]:
    """Arguments by name. Raises TypeError for too many values, or one that is also named."""
    own = [one.name for one in parameters(kind) if not one.kw_only]
    if len(values) > len(own):
        most = f"at most {len(own)} arguments" if own else "no argument"
        raise TypeError(f"{kind.__name__} takes {most} without a name, not {len(values)}")
    by_place = dict(zip(own, values, strict=False))
    for name in by_place.keys() & named:
        raise TypeError(f"{kind.__name__} has two values of {name}")
    return by_place | named


def refuse_keywords(what: str, keywords: Iterable[str], known: Sequence[str]) -> None:
    """Raise GenevaError for a keyword that ``what`` does not take, with the nearest one."""
    for name in keywords:
        if name not in known:
            hint = nearest(name, known)
            raise GenevaError(f"{what} has no {cut(name)}{hint}; it takes {few(name, known)}")


def shortly(record: Record) -> str:
    """A record as Python writes it, without the fields that have their defaults.

    >>> shortly(SideCrank(A=0.6))
    'SideCrank(A=0.6)'
    """
    arguments = []
    for one in parameters(type(record)):
        value = getattr(record, one.name)
        if value != one.default:
            text = shortly(value) if isinstance(value, Record) else repr(value)
            arguments.append(f"{one.name}={cut(text, SHOWN_MAX)}")
    return f"{type(record).__name__}({', '.join(arguments)})"


_parameters_of: dict[type, tuple[Parameter, ...]] = {}
_names_of: dict[type, tuple[str, ...]] = {}


def parameters(kind: type[Record]) -> tuple[Parameter, ...]:
    """Fields of a class of records, those of its bases first."""
    if kind not in _parameters_of:
        by_name: dict[str, Parameter] = {}
        for base in kind.__mro__[::-1]:
            if issubclass(base, Record):
                by_name |= {one.name: one for one in _declared(base)}
        _parameters_of[kind] = tuple(by_name.values())
    return _parameters_of[kind]


def _declared(kind: type[Record]) -> Iterable[Parameter]:
    """Yield the fields that a class itself declares: its annotations but those of the class."""
    own = vars(kind)
    for name, annotation in own.get("__annotations__", {}).items():
        text = isinstance(annotation, str)
        if annotation.startswith("ClassVar") if text else get_origin(annotation) is ClassVar:
            continue
        default: Any = own.get(name, REQUIRED)
        if isinstance(default, dataclasses.Field):
            yield Parameter(name, default.default, bool(default.kw_only), annotation)
        else:
            yield Parameter(name, default, own["KW_ONLY"], annotation)


def names(kind: type[Record]) -> tuple[str, ...]:
    """Names of the fields of a class of records."""
    if kind not in _names_of:
        _names_of[kind] = tuple(one.name for one in parameters(kind))
    return _names_of[kind]
