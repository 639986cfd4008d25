"""Tables of a spec: frozen records whose fields are their keys, checked when they are created.

A field is annotated with its type, its rule and its meaning:

    A: Annotated[float, Range(-1.0, 1.0, "()"), "base offset / crank length"]

Most modules of tables do without ``from __future__ import annotations``: text that is evaluated
when a run starts takes longer than objects.
"""

from __future__ import annotations

import dataclasses
import inspect
import math
import typing
from collections.abc import Iterable, Mapping, Sequence
from types import NoneType, UnionType
from typing import Annotated, Any, ClassVar, NamedTuple, Self, TypeAlias

from geneva_cli.errors import GenevaError, cut, few, nearest, refuse
from geneva_cli.spec.rules import TINY, Csv, OneOf, Range, is_array, plain

LIST: TypeAlias = tuple[float, ...]
LIST_MAX = 1000
TEXT_MAX = 500  # letters of a free text; a drawing fits a longer one into no title block
SHOWN_MAX = 200  # characters of a value in a record that is shown
REQUIRED = dataclasses.MISSING
_NAMES: dict[Any, str] = {
    LIST: "a list of numbers",
    str: "text",
    int: "a whole number",
    float: "a number",
    bool: "true or false",
}


class Points(NamedTuple):
    """Pairs from a CSV file, and the file's name as in the spec."""

    pairs: tuple[tuple[float, float], ...]
    file: str = ""


class Field(NamedTuple):
    """One key of a table: its names, types, rule, default and meaning."""

    key: str  # in the file
    attribute: str  # in Python
    types: tuple[Any, ...]
    rule: Any
    default: Any  # REQUIRED if there is none
    meaning: str

    @property
    def words(self) -> tuple[str, ...]:
        """The words that its values may be; none for numbers and free text."""
        if isinstance(self.rule, Range):
            return self.rule.words
        return self.rule if isinstance(self.rule, OneOf) else ()


HASH = "_hash"  # name under which a record stores its own hash


class _Signature:
    """Signature of a table's class, for ``help`` and editors; it is computed when they ask."""

    def __get__(self, table: object, kind: type[SpecTable]) -> inspect.Signature:
        kinds, parameters = inspect.Parameter, []
        for one in sorted(kind._parameters.values(), key=lambda one: bool(one.kw_only)):
            place = kinds.KEYWORD_ONLY if one.kw_only else kinds.POSITIONAL_OR_KEYWORD
            default = kinds.empty if one.default is REQUIRED else one.default
            parameters.append(kinds(one.name, place, default=default, annotation=one.type))
        return inspect.Signature(parameters)


@typing.dataclass_transform(frozen_default=True, field_specifiers=(dataclasses.field,))
class SpecTable:
    """A table of the spec. Raises GenevaError, naming table and key, for an invalid value.

    Each class of tables is a dataclass of its annotated fields, without a decorator, and frozen.
    Their methods are written here, as generating them for each class slows the start of a run.
    """

    TABLE: ClassVar[str] = ""  # its name in the file
    WORDS_APART: ClassVar[str] = "_"  # what stands between the words of its keys
    SHARED: ClassVar[tuple[str, ...]] = ()  # its numbers that all designs of a batch have in common
    __signature__ = _Signature()
    _parameters: ClassVar[dict[str, dataclasses.Field[object]]]  # by name

    def __init_subclass__(
        cls, table: str = "", kw_only: bool = False, names: Iterable[str] = (), of: object = None
    ) -> None:
        cls.TABLE = table or cls.TABLE
        for name in names:  # keys that have one annotation, and are None by default
            cls.__annotations__[name] = of
            setattr(cls, name, None)
        dataclasses.dataclass(init=False, eq=False, repr=False, kw_only=kw_only)(cls)
        cls._parameters = {}
        for one in dataclasses.fields(cls):  # type: ignore[arg-type]
            cls._parameters[one.name] = one

    def __init__(self, *values: object, **named: object) -> None:
        own, kind = vars(self), type(self)
        if not named.keys() <= kind._parameters.keys():
            refuse_keywords(kind.__name__, named, [*kind._parameters])
        if values:
            named = kind.__signature__.bind_partial(*values, **named).arguments
        for name, one in kind._parameters.items():
            own[name] = named.get(name, one.default)
            if own[name] is REQUIRED:
                raise TypeError(f"{kind.__name__} needs {name}")
        self.__post_init__()

    def __setattr__(self, name: str, value: object) -> None:
        raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")

    def __post_init__(self) -> None:
        own = vars(self)
        for field in fields(type(self)):
            value = own[field.attribute]
            if value is not field.default:
                own[field.attribute] = checked(self.TABLE, field, value)

    def __eq__(self, other: object) -> bool:
        if not (isinstance(other, SpecTable) and type(other) is type(self)):
            return NotImplemented
        own, others, names = vars(self), vars(other), type(self)._parameters
        return [*map(own.__getitem__, names)] == [*map(others.__getitem__, names)]

    def __hash__(self) -> int:
        own, kind = vars(self), type(self)
        if HASH not in own:
            # includes the type, since many laws and drives have equal values
            own[HASH] = hash((kind, *map(own.__getitem__, kind._parameters)))
        value: int = own[HASH]
        return value

    def __getstate__(self) -> dict[str, object]:
        """The state without the hash, for another process, in which strings hash differently."""
        return {name: value for name, value in vars(self).items() if name != HASH}

    def __repr__(self) -> str:
        """The record as Python writes it, without the fields that have their defaults."""
        arguments = []
        for name, one in self._parameters.items():
            text = repr(vars(self)[name])
            if one.repr and text != repr(one.default):
                arguments.append(f"{name}={cut(text, SHOWN_MAX)}")
        return f"{type(self).__qualname__}({', '.join(arguments)})"

    def as_dict(self) -> dict[str, Any]:
        """Values by key.

        >>> External(6).as_dict()
        {'z': 6, 'held_by': None, 'offset_mm': 0.0, 'steps_deg': None, 'stop': False}
        """
        own, out = vars(self), {}
        for field in fields(type(self)):
            out[field.key] = own[field.attribute]
        return out

    def _own_keys(self) -> dict[str, Field]:
        """Fields by their keys in the file."""
        return {field.key: field for field in fields(type(self))}

    def with_keys(self, values: Mapping[str, Any]) -> Self:
        """Return a copy with keys changed, written as in the file; None sets a key's default.

        Raises GenevaError for a key that the table does not have, or a value out of its range.

        >>> SideCrank(A=0.6).with_keys({"A": 0.5}).A
        0.5
        """
        known, changes = self._own_keys(), {}
        for key, value in values.items():
            if key not in known:
                raise unknown(key, self.TABLE, tuple(known))
            if value is None:
                value = known[key].default
                if value is REQUIRED:
                    raise missing(known[key], self.TABLE)
            changes[known[key].attribute] = value
        return self.replace(**changes)

    def replace(self, **changes: Any) -> Self:
        """Return a copy with some fields changed and checked.

        >>> Spherical(6).replace(axes_deg=60.0)
        Spherical(z=6, axes_deg=60.0)
        """
        # dataclasses.replace takes twice the time
        kind = type(self)
        if not changes.keys() <= kind._parameters.keys():
            refuse_keywords(kind.__name__, changes, [*kind._parameters])
        new = object.__new__(kind)
        own, values = vars(self), vars(new)
        for name in kind._parameters:
            values[name] = own[name]
        values.update(changes)
        new.__post_init__()
        return new


def refuse_keywords(what: str, names: Iterable[str], known: Sequence[str]) -> None:
    """Raise GenevaError for a keyword that ``what`` does not take, with the nearest one."""
    for name in names:
        if name not in known:
            hint = nearest(name, known)
            raise GenevaError(f"{what} has no {cut(name)}{hint}; it takes {few(name, known)}")


# by class; mypy takes no class with a hash of its own as an argument of functools.cache
_fields_of: dict[type, tuple[Field, ...]] = {}


def fields(table: type[SpecTable]) -> tuple[Field, ...]:
    """Keys of a table, in their order."""
    if table in _fields_of:
        return _fields_of[table]
    own, keys = dict[str, Any](), list[Field]()
    for base in reversed(table.__mro__[:-2]):  # but for those of every table
        own |= inspect.get_annotations(base, eval_str=True)
    for name, one in table._parameters.items():
        # others are no keys: objects with their own keys, such as a motion's law
        if typing.get_origin(own[name]) is Annotated:
            annotated, rule, meaning = typing.get_args(own[name])
            # an alternative (a | b) by its parts, anything else as it is; tuple[...] stays whole
            types = typing.get_args(annotated) if isinstance(annotated, UnionType) else (annotated,)
            key = name.rstrip("_").replace("_", table.WORDS_APART)
            key = "file" if isinstance(rule, Csv) else key
            keys.append(Field(key, name, types, rule, one.default, meaning))
    _fields_of[table] = tuple(keys)
    return _fields_of[table]


def checked(table: str, field: Field, value: Any) -> Any:
    """A value of the field's type and in its range, as the table holds it."""
    kind, types, rule = type(value), field.types, field.rule
    numeric = int in types or float in types
    if (kind is float or kind is int) and numeric and rule.holds(value):  # the usual case
        if kind in types:
            return value
        if kind is int and abs(value) < 2**53:
            return float(value)
    place = (*table.split("."), field.key)
    if kind is not str:
        value = plain(value)
    if type(value) in (NoneType, bool) and type(value) in types:
        return value
    if isinstance(rule, Csv):
        return _points(place, field, value)
    is_word = isinstance(value, str)
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if numeric and not is_word and (is_number or is_array(value)):
        return _number(place, field, value) if is_number else _numbers(place, field, value)
    if LIST in types and is_array(value):
        value = value.tolist()
    if isinstance(value, (list, tuple)) and LIST in types:
        if not 0 < len(value) <= LIST_MAX:
            raise GenevaError(f"{field.key} must be a list of 1 to {LIST_MAX} numbers", place)
        return tuple(checked(table, field._replace(types=(float,)), one) for one in value)
    if is_word and str in types:
        return _word(place, field, value)
    if is_word and float in types:
        from geneva_cli.spec.units import in_unit_of

        try:
            number = in_unit_of(field.key, value)
        except GenevaError as error:
            raise GenevaError(f"{error} ({field.meaning})", place) from None
        return checked(table, field, number)
    expected = " or ".join(_NAMES[t] for t in types if t in _NAMES)
    raise GenevaError(f"{field.key} must be {expected}, not {shown(value)}", place)


def _word(place: tuple[str, ...], field: Field, value: str) -> str:
    """A text, one of a list of words, or a word that stands for a number."""
    if field.rule is None:
        return free_text(field.key, value, place)
    if value not in field.words:
        fault = f"must be {field.rule}{nearest(value, field.words)}"
        raise GenevaError(f"{field.key} = {shown(value)} {fault}", place)
    return value


def _points(place: tuple[str, ...], field: Field, value: Any) -> Points:
    if not isinstance(value, Points):  # a Python user may pass a list of pairs
        try:
            value = Points(tuple((float(x), float(y)) for x, y in value))
        except (TypeError, ValueError):
            text = f"{field.key}: points must be pairs of numbers u,s"
            raise GenevaError(text, place) from None
    rule, pairs, name = field.rule, value.pairs, value.file or field.key
    for i in range(len(pairs)):
        if fault := rule.fault(pairs, i):
            raise GenevaError(f"{name}, point {i + 1}: {fault}", place)
    if len(pairs) < rule.POINTS_MIN:
        text = f"{name}: {len(pairs)} points; at least {rule.POINTS_MIN} are needed"
        raise GenevaError(text, place)
    return value


def _number(place: tuple[str, ...], field: Field, value: float) -> float:
    whole, fault = int in field.types, f"must be {field.rule}"
    if whole and not isinstance(value, int):
        fault = "must be a whole number"
        if abs(value) < 2.0**53:  # beyond it, a float may be rounded to a whole number
            fault += f", as {math.floor(value)} or {math.ceil(value)}"
    elif 0.0 < abs(value) < TINY:  # no reader of the rule would think of such numbers
        fault += f"; sizes below {TINY:g} are not computed"
    elif value in field.rule:
        return value if whole else float(value)
    raise GenevaError(f"{field.key} = {shown(value)} {fault} ({field.meaning})", place)


def _numbers(place: tuple[str, ...], field: Field, values: Any) -> Any:
    """Numbers of a batch of designs. Invalid ones are marked, and become NaN.

    A whole number, which cannot be NaN, becomes the least that the rule allows.
    """
    import numpy as np

    wrong = ~field.rule.holds(values)
    if int in field.types:
        wrong = wrong | (values != np.floor(values))
    refuse(wrong, lambda: GenevaError(f"{field.key} must be {field.rule}", place))
    if int in field.types:
        return np.where(wrong, field.rule.low, values).astype(np.int64)
    return np.where(wrong, np.nan, values.astype(np.float64))


def free_text(key: str, text: str, place: tuple[str, ...]) -> str:
    """The text. Raises GenevaError if it is too long, or has letters that UTF-8 has no code for."""
    if len(text) > TEXT_MAX:
        raise GenevaError(f"{key} has {len(text)} letters; at most {TEXT_MAX}", place)
    try:
        text.encode()
    except UnicodeEncodeError:
        raise GenevaError(f"{key} = {shown(text)}: not UTF-8 text", place) from None
    return text


def unknown(key: str, table: str, known: Sequence[str], hint: str = "") -> GenevaError:
    """Error for a key that a table does not have; without a hint it names the nearest key."""
    hint = hint or nearest(key, known)
    text = f"unknown key {cut(key)} in [{table}]{hint}; known: {few(key, known)}"
    return GenevaError(text, (*table.split("."), key))


def refuse_kind(value: object, name: str, kind: Any, example: str = "") -> None:
    """Raise GenevaError for a name or a class where an object of a kind is needed."""
    if not isinstance(value, kind):
        example = example or f"{kind.__name__}(...)"
        raise GenevaError(f"{name} must be an object like {example}, not {cut(repr(value))}")


def missing(field: Field, table: str, why: str = "") -> GenevaError:
    """Error for a key without a default that is not set."""
    rule = f", {field.rule}" if field.rule else ""
    text = f"[{table}] needs {field.key}{why}: {field.meaning}{rule}"
    return GenevaError(text, tuple(table.split(".")))


def shown(value: Any) -> str:
    """A wrong value, short enough for a message."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{cut(value)}"'
    if isinstance(value, (dict, list, tuple)):
        return "a table" if isinstance(value, dict) else "a list"
    return f"{value:.12g}" if isinstance(value, float) else cut(value)
