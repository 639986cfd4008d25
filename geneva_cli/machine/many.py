"""Many designs at once: one machine whose numbers are arrays along a design axis.

    >>> import numpy as np
    >>> from geneva_cli import External, SideCrank
    >>> from geneva_cli.machine.many import many
    >>> from geneva_cli.machine.spec import Spec
    >>> spec = Spec(External(6), SideCrank(A=0.0))
    >>> found = many(spec, {"drive.A": np.array([0.0, 0.6, 2.0])})
    >>> found.refused
    array([False, False,  True])
    >>> found.spread(found.machine.ratio)
    array([0.5, 0.5, nan])

``found.machine`` is a machine like any other, of the designs that can be built, in their order. The
numbers that vary in it are arrays (m, 1); what follows from them is (m, 1) too, and at k input
angles (k,) or (m, k) it is (m, k). ``found.spread`` puts (m, 1) back among the n designs as (n,).
Why a design is refused is told by building it alone.

Keys that are no numbers (words, lists), and the number of rollers, have one value in all designs of
a machine: designs that differ in them must be built apart. ``may_vary`` says which keys may vary.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, TypeVar, cast

import numpy as np

from geneva_cli.errors import GenevaError, marking
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.motion import Motion
from geneva_cli.machine.spec import Spec, attribute
from geneva_cli.numerics.latest import Latest
from geneva_cli.spec.schema import Field, Points, SpecTable, fields, unknown

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask, Number, Which, Whole

T = TypeVar("T")
Change: TypeAlias = "Callable[[Array], object]"

# whose numbers may vary
TABLES = (
    *("wheel", "drive", "motion", "size", "load", "support", "motor", "shaft", "tolerance"),
    *("material.wheel", "material.roller"),
)
ONE_BY_ONE = {"rollers"}  # numbers that count what a machine is made of


class Many(NamedTuple):
    """What ``many`` built of n designs."""

    machine: Mechanism | None  # of those that can be built; None where there is none
    refused: Mask  # (n,)

    @property
    def which(self) -> Whole:
        """The numbers of the designs in ``machine``."""
        return np.flatnonzero(~self.refused)

    def spread(self, values: Number) -> Array:
        """The values (m, 1) of the designs in ``machine`` as (n,): NaN for those refused."""
        which = self.which
        out = np.full(len(self.refused), np.nan)
        out[which] = np.broadcast_to(np.reshape(values, -1), which.shape)
        return out


def many(spec: Spec, varied: Mapping[str, object]) -> Many:
    """The machine of a spec with some of its keys varied.

    ``varied`` has keys as in the file (``drive.A``, ``wheel.z``, ``motion.lambda``) with arrays
    (n,) of numbers, or with one value for all designs. Raises GenevaError for a key that the spec
    does not have, and ValueError for arrays of unlike lengths or keys that cannot be arrays.
    """
    arrays = {key: np.asarray(v) for key, v in varied.items() if _is_array(v)}
    lengths = {len(values) for values in arrays.values()}
    if len(lengths) != 1 or any(values.ndim != 1 for values in arrays.values()):
        raise ValueError("keys must vary in arrays (n,) of one length")
    wrong = [key for key in arrays if not may_vary(spec, key)]
    if wrong:
        raise ValueError(f"{', '.join(wrong)}: cannot vary within a machine")
    (n,) = lengths
    given = {**varied, **{key: values[:, None] for key, values in arrays.items()}}
    with np.errstate(all="ignore"), marking() as marks:
        try:
            machine = build(changed(spec, given))._replace(design=_numbers(n)) if n else None
        except GenevaError:  # what holds for all of them
            machine = None
    refused = np.full(n, machine is None)
    for mark in marks:
        refused |= np.broadcast_to(mark, (n, 1))[:, 0]
    if machine is None or refused.all():
        return Many(None, np.full(n, True))
    return Many(taken(machine, ~refused) if refused.any() else machine, refused)


def _numbers(n: int) -> int:
    """The numbers of n designs, (n, 1): how many there are, whatever varies in them."""
    return cast("int", np.arange(n)[:, None])


def may_vary(spec: Spec, key: str) -> bool:
    """Whether a key of this spec may be an array: a number, of a kind that takes arrays of it.

    Raises GenevaError for a key that the spec does not have.
    """
    table, _, name = key.rpartition(".")
    if table not in TABLES:
        return False
    numeric = bool({int, float} & set(_field(spec, key).types))
    of_law = spec.motion is None or spec.motion.law.may_vary(table, name)
    return numeric and name not in ONE_BY_ONE and of_law and spec.drive.may_vary(table, name)


def changed(spec: Spec, values: Mapping[str, object]) -> Spec:
    """The spec with several keys changed at once; only the result must be valid."""
    tables: dict[str, dict[str, object]] = {}
    for key, value in values.items():
        tables.setdefault(key.rpartition(".")[0], {})[_field(spec, key).attribute] = value
    parts: dict[str, SpecTable] = {}
    for table, new in tables.items():
        if spec.motion is not None and table == "motion":
            own = {name: v for name, v in new.items() if name in Motion.__dataclass_fields__}
            law = {name: v for name, v in new.items() if name not in own}
            parts[table] = spec.motion.replace(law=spec.motion.law.replace(**law), **own)
        else:
            part: SpecTable = vars(spec)[attribute(table)]
            parts[attribute(table)] = part.replace(**new)
    return spec.replace(**parts)


def _field(spec: Spec, key: str) -> Field:
    table, _, name = key.rpartition(".")
    held = vars(spec).get(attribute(table))
    if not isinstance(held, SpecTable):
        raise GenevaError(f"{key}: this spec has no [{table or key}]", (table, name))
    known = {field.key: field for field in fields(type(held))}
    if isinstance(held, Motion):
        known |= {field.key: field for field in fields(type(held.law))}
    if name not in known:
        raise unknown(name, table, tuple(known))
    return known[name]


def taken(thing: T, which: Which) -> T:
    """An object of many designs reduced to some: ``which`` is a mask or their numbers."""
    return cast("T", _changed(thing, lambda array: array[which], {}))


def alone(thing: T, i: int) -> T:
    """The i-th design of an object of many: with numbers for its arrays."""
    return cast("T", _changed(thing, lambda array: array[i, 0].item(), {}))


def designs_in(thing: object) -> int:
    """How many designs an object is of: 1 without an array along a design axis."""
    lengths = {1}

    def note(array: Array) -> Array:
        lengths.add(len(array))
        return array

    _changed(thing, note, {})
    return max(lengths)


def _is_array(value: object) -> bool:
    return isinstance(value, np.ndarray)


def _changed(thing: object, change: Change, done: dict[int, object]) -> object:
    """A copy with every array (n, 1) in it changed; an object without any is returned itself."""
    if isinstance(thing, np.ndarray):
        return change(thing) if thing.ndim == 2 and thing.shape[1] == 1 else thing
    kind: type = type(thing)
    if not _may_hold(kind):
        return thing
    if id(thing) not in done:
        done[id(thing)] = _anew(thing, change, done)
    return done[id(thing)]


def _anew(thing: object, change: Change, done: dict[int, object]) -> object:
    kind: type = type(thing)
    if isinstance(thing, (tuple, list)):
        parts = [_changed(part, change, done) for part in thing]
        if all(a is b for a, b in zip(parts, thing, strict=True)):
            return thing
        return kind(parts) if kind in (tuple, list) else kind(*parts)
    held = vars(thing)
    values = {name: _changed(value, change, done) for name, value in held.items()}
    if all(values[name] is value for name, value in held.items()):
        return thing
    new: object = object.__new__(kind)
    for name, value in values.items():  # what is kept was worked out of other designs
        vars(new)[name] = Latest() if isinstance(value, Latest) else value
    return new


@cache
def _may_hold(kind: type) -> bool:
    """Whether it is a kind of object of the machine or of its spec, whose numbers may be arrays."""
    if issubclass(kind, Points):
        return False
    ours = kind.__module__.startswith(("geneva_cli.machine.", "geneva_cli.spec."))
    return ours or issubclass(kind, (tuple, list))
