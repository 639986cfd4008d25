"""Which kinds make no machine together: each names its rules; here are those of sizes, and more."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial, reduce
from operator import and_, or_
from typing import NamedTuple

from geneva_cli.errors import GenevaError, refuse
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.kind import Kind
from geneva_cli.motion.machine_spec import Spec, attribute
from geneva_cli.motion.records import KINDS
from geneva_cli.spec.load_named import load_named
from geneva_cli.spec.rules import is_array
from geneva_cli.spec.schema import SpecTable, fields


class Conflict(NamedTuple):
    """A combination that makes no machine, if ``when`` is true."""

    when: object  # a truth value, or an array of them for a batch
    key: tuple[str, ...]  # to blame
    text: str  # with values of the spec, as in ``{spec.wheel.z}``


# The rules of a drive come first, then those of its wheel, then those of what adds to it.
_KINDS = [
    *[kind for kind in KINDS if kind.refuses and kind.drive],
    *[kind for kind in KINDS if kind.refuses and kind.wheel],
    *[kind for kind in KINDS if kind.refuses and not (kind.drive or kind.wheel)],
]


def refuse_conflicts(spec: Spec) -> None:
    """Raise GenevaError if the spec combines kinds that make no machine together."""
    rules: list[Callable[[Spec], Iterator[Conflict]]] = [_of_drive_before]
    for kind in _KINDS:
        if concerns(kind, spec):
            rules.append(load_named(kind.refuses))
    for rule in (*rules, _of_sizes):
        for when, key, text in rule(spec):
            if is_array(when):
                refuse(when, partial(GenevaError, text))
            elif when:
                raise GenevaError(text.format(spec=spec), key)


def concerns(kind: Kind, spec: Spec) -> bool:
    """True if the spec has the kind, or sets a key of the kind's own."""
    if (kind.drive and kind.name == spec.drive.NAME) or (
        kind.wheel and kind.name == spec.wheel.NAME
    ):
        return True
    for key in kind.keys:
        table, _, name = key.partition(".")
        of = vars(spec)[attribute(table)]
        value, default = vars(of).get(name), getattr(type(of), name, None)
        if value is not default and (is_array(value) or value != default):
            return True
    return False


def is_set(table: SpecTable, kind: type[SpecTable] | None = None) -> object:
    """True if a key of a table, or of its base, differs from its default; for a batch an array."""
    keys = fields(kind or type(table))
    return reduce(or_, (getattr(table, key.attribute) != key.default for key in keys))


def is_geared(spec: Spec) -> bool:
    """True if the spec's drive, or the one before it, has gears."""
    drives = (spec.drive, spec.drive_before) if spec.drive_before else (spec.drive,)
    return any(drive.gears or drive.round_gears for drive in drives)


def _of_drive_before(spec: Spec) -> Iterator[Conflict]:
    """Rules on a drive that turns the shaft of another."""
    drive, before, key = spec.drive, spec.drive_before, ("drive", "before")
    if before is None:
        return
    text = 'kind = "{spec.drive_before.NAME}" cannot turn the shaft of another drive: remove '
    yield Conflict(not before.IN_FRONT, (*key, "kind"), text + "[drive.before]")
    text = 'kind = "{spec.drive_before.NAME}" cannot stand before kind = "{spec.drive.NAME}": '
    yield Conflict(drive.FIRST, key, text + "{spec.drive.FIRST}")
    text = (
        "n_rpm, rollers and roller_angles_deg belong to the machine: set them in "
        "[drive], not in [drive.before]"
    )
    yield Conflict(is_set(before, Drive), key, text)
    text = (
        'the crank of kind = "{spec.drive.NAME}" is on the shaft: set kind = '
        '"{spec.drive_before.NAME}" in [drive] instead'
    )
    yield Conflict(drive.direct and not (spec.motion or len(drive.cranks) > 1), key, text)


def _of_sizes(spec: Spec) -> Iterator[Conflict]:
    """Rules on the keys of the slots' mouths and of the horns, and on a limit."""
    size, wheel = spec.size, spec.wheel
    for key in ("mouth_radius_mm", "horn_tip_mm"):
        is_cut = getattr(size, key) > 0.0
        text = f"{key} is for external and internal wheels, not gearing = "
        text += '"{spec.wheel.NAME}": remove it'
        yield Conflict(is_cut & (not (wheel.FLAT and spec.output.turns)), ("size", key), text)
        text = f"{key} is for wheels with a recess behind every slot: remove it, or stop"
        yield Conflict(is_cut & wheel.stopped, ("size", key), text)
    sizes = [key for key in spec.tolerance.as_dict() if key != "distribution"]
    exact = reduce(and_, (getattr(spec.tolerance, key) == 0.0 for key in sizes))
    text = (
        "dwell_position_max_deg limits the error of a wheel within its tolerances: set one or more "
        f"of {', '.join(sizes)} in [tolerance]"
    )
    limited = spec.limits.dwell_position_max_deg is not None
    yield Conflict(limited and exact, ("limits", "dwell_position_max_deg"), text)
