"""A batch of designs as one machine, whose numbers are arrays along a design axis.

    >>> import numpy as np
    >>> from geneva_cli import External, SideCrank
    >>> from geneva_cli.motion.many import many
    >>> from geneva_cli.motion.machine_spec import Spec
    >>> spec = Spec(External(6), SideCrank(A=0.0))
    >>> batch = many(spec, {"drive.A": np.array([0.0, 0.6, 2.0])})
    >>> batch.refused
    array([False, False,  True])
    >>> batch.spread(batch.machine.ratio)
    array([0.5, 0.5, nan])

``batch.machine`` is an ordinary machine of the designs that can be built, in their order. The
numbers that vary are arrays (m, 1), and so are the results. At k input angles, (k,) or (m, k),
results are (m, k). ``batch.spread`` returns (m, 1) values to their places among the n designs as
(n,). Build a refused design by itself to get the reason.

Keys that are not numbers (words, lists), and the number of rollers, have one value in all designs
of a machine. Designs that differ in them must be built as separate batches. ``may_vary`` is True
for a key that may vary.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, partial
from typing import NamedTuple, TypeAlias, TypeVar, cast

import numpy as np

from geneva_cli.errors import GenevaError, marking
from geneva_cli.motion.machine_spec import BEFORE, Spec, attribute
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.motion import Motion
from geneva_cli.numerics.arrays import (
    Array,
    Batchable,
    Mask,
    Number,
    Which,
    Whole,
    numbers_of,
    record_of,
)
from geneva_cli.numerics.latest import Latest
from geneva_cli.spec.rules import is_array
from geneva_cli.spec.schema import Field, Points, SpecTable, fields, unknown

T = TypeVar("T")
Change: TypeAlias = "Callable[[Array], object]"

# tables whose numbers may vary
TABLES = (
    *("wheel", "drive", BEFORE, "motion", "size", "load", "support", "motor", "shaft", "tolerance"),
    *("material.wheel", "material.roller"),
)


class Many(NamedTuple):
    """A batch of n designs as ``many`` built it."""

    machine: Mechanism | None  # of the designs that can be built; None if there are none
    refused: Mask  # (n,)

    @property
    def which(self) -> Whole:
        """Numbers of the designs in ``machine``."""
        return np.flatnonzero(~self.refused)

    def spread(self, values: Number) -> Array:
        """Values (m, 1) of the designs in ``machine`` as (n,), with NaN for refused designs."""
        which = self.which
        out = np.full(len(self.refused), np.nan)
        out[which] = np.broadcast_to(np.reshape(values, -1), which.shape)
        return out


def many(spec: Spec, varied: Mapping[str, object]) -> Many:
    """Build the machine of a spec with some of its keys varied.

    ``varied`` has keys as in the file (``drive.A``, ``wheel.z``, ``motion.lambda``), with arrays
    (n,) of numbers or with one value for all designs. Raises GenevaError for a key that the spec
    does not have. Raises ValueError for arrays of different lengths or keys that cannot be arrays.
    """
    arrays = {key: np.asarray(v) for key, v in varied.items() if is_array(v)}
    lengths = {len(values) for values in arrays.values()}
    if len(lengths) != 1 or any(values.ndim != 1 for values in arrays.values()):
        raise ValueError("keys must vary in arrays (n,) of one length")
    wrong = [key for key in arrays if not may_vary(spec, key)]
    if wrong:
        raise ValueError(f"{', '.join(wrong)}: cannot vary within a machine")
    (n,) = lengths
    # Linux takes freed memory back and returns it page by page: up to two fifths of the time of a
    # batch's peaks. Once 16 MB were freed, which are never written, the program keeps up to 32 MB.
    np.empty(1 << 21)
    columns = {**varied, **{key: values[:, None] for key, values in arrays.items()}}
    with np.errstate(all="ignore"), marking() as marks:
        try:
            numbers = np.arange(n)[:, None]
            machine = build(changed(spec, columns))._replace(design=numbers) if n else None
        except GenevaError:  # the error is the same for all designs
            machine = None
    refused = np.full(n, machine is None)
    for mark in marks:
        refused |= np.broadcast_to(mark, (n, 1))[:, 0]
    if machine is None or refused.all():
        return Many(None, np.full(n, True))
    return Many(taken(machine, ~refused) if refused.any() else machine, refused)


def may_vary(spec: Spec, key: str) -> bool:
    """True if a key of this spec may be an array: a number whose kind takes arrays.

    Raises GenevaError for a key that the spec does not have.
    """
    table, _, name = key.rpartition(".")
    if table not in TABLES:
        return False
    numeric = bool({int, float} & set(_field(spec, key).types))
    of_law = spec.motion is None or spec.motion.law.may_vary(table, name)
    # the number of rollers decides how many engagements a machine has; under load that of slots
    # does too, where a body stands off the axis of a wheel on a carrier
    counts = {"rollers", "z"} if spec.drive.wheels_on_carrier and spec.unbalanced else {"rollers"}
    # a drive before sees its own table as that of a drive
    of = "drive" if table == BEFORE else table
    before = spec.drive_before is None or spec.drive_before.may_vary(of, name)
    own = spec.drive.may_vary(table, name)
    return numeric and name not in counts and of_law and own and before


def changed(spec: Spec, values: Mapping[str, object]) -> Spec:
    """Return the spec with several keys changed at once; only the result must be valid."""
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
    part = vars(spec).get(attribute(table))
    if not isinstance(part, SpecTable):
        raise GenevaError(f"{key}: this spec has no [{table or key}]", (table, name))
    known = {field.key: field for field in fields(type(part))}
    if isinstance(part, Motion):
        known |= {field.key: field for field in fields(type(part.law))}
    if name not in known:
        raise unknown(name, table, tuple(known))
    return known[name]


def taken(thing: T, which: Which) -> T:
    """Reduce an object of a batch to some designs; ``which`` is a mask or their numbers."""
    if isinstance(which, slice):
        return cast("T", _changed(thing, lambda array: array[which], {}))
    numbers = numbers_of(which)
    return cast("T", _changed(thing, lambda array: array.take(numbers, axis=0), {}))


def selection(thing: T) -> Callable[[Which], T]:
    """Return the function that reduces an object of a batch to some designs, as ``taken`` does.

    It looks for arrays once: an object without them is the same for all designs.
    """
    if taken(thing, slice(0)) is thing:
        return lambda _: thing
    return partial(taken, thing)


def alone(thing: T, i: int) -> T:
    """The i-th design of an object of a batch, with numbers in place of arrays."""
    return cast("T", _changed(thing, lambda array: array[i, 0].item(), {}))


def designs_in(thing: object) -> int:
    """Number of designs in an object; 1 without an array along a design axis."""
    lengths = {1}

    def note(array: Array) -> Array:
        lengths.add(len(array))
        return array

    _changed(thing, note, {})
    return max(lengths)


def _changed(thing: object, change: Change, done: dict[int, object]) -> object:
    """Copy an object and change every array (n, 1) in it; return it unchanged if it has none."""
    if isinstance(thing, np.ndarray):
        return change(thing) if thing.ndim == 2 and thing.shape[1] == 1 else thing
    kind: type = type(thing)
    if not _may_hold(kind):
        return thing
    if id(thing) not in done:
        done[id(thing)] = _anew(thing, change, done)
    return done[id(thing)]


def _anew(thing: object, change: Change, done: dict[int, object]) -> object:
    if isinstance(thing, (tuple, list)):
        parts = [_changed(part, change, done) for part in thing]
        if all(a is b for a, b in zip(parts, thing, strict=True)):
            return thing
        return parts if isinstance(thing, list) else record_of(thing, parts)
    old = vars(thing)
    values = {name: _changed(value, change, done) for name, value in old.items()}
    if all(values[name] is value for name, value in old.items()):
        return thing
    new: object = object.__new__(type(thing))
    for name, value in values.items():  # a stored result belongs to the old set of designs
        vars(new)[name] = Latest() if isinstance(value, Latest) else value
    return new


@cache  # by type: most of what a machine holds is None or a number
def _may_hold(kind: type) -> bool:
    """True for tables of a spec, for what is built from them, and for records of both."""
    holders = SpecTable, Spec, Batchable, tuple, list
    return issubclass(kind, holders) and not issubclass(kind, Points)
