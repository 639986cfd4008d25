"""A machine that turns both ways is judged twice: the worse checks, and what differs.

No other file that judges knows that a machine may turn backwards.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from geneva_cli.errors import Notice
from geneva_cli.motion.both_ways import every_way
from geneva_cli.motion.laws.law import Law
from geneva_cli.motion.machine_spec import BEFORE
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peaks import worst
from geneva_cli.table import rows_table
from geneva_cli.verdict import checks
from geneva_cli.verdict.checks.all_checks import BEFORE_TURN, OF_TURN
from geneva_cli.verdict.checks.check import Check

if TYPE_CHECKING:
    from geneva_cli.parts.parts import Parts
    from geneva_cli.verdict.quantities.batch_designs import Values


def worst_checks(
    mechanism: Mechanism, machine: Parts | None = None, parts: bool = True, turned: bool = True
) -> list[Check]:
    """Every check of one design, as ``checks``, each in its worse direction."""
    rows = checks.checks(mechanism, machine, parts, turned)
    for other in _others(mechanism):
        rows = worse_of(rows, checks.checks(other, None, parts, turned))
    return rows


def values_before_turn(parts: Parts) -> Values:
    """The value of each check but those of the turn."""
    rows = worst_checks(parts.mechanism, parts, turned=False)
    return {c.name: c.value for c in rows if c.name in BEFORE_TURN}


def check_values(parts: Parts) -> Values:
    """The value of each check of the turn, and whether all checks pass."""
    rows = worst_checks(parts.mechanism, parts)
    failed = [c.name for c in rows if c.passes is False]
    values: Values = {c.name: c.value for c in rows if c.name in OF_TURN}
    return values | {"passes": not failed, "failed": " ".join(failed) or None}


def passes(parts: Parts) -> Values:
    """Whether no check fails in any direction, computed until the first that does."""
    own = parts.mechanism
    every = checks.passes(own, parts) and all(map(checks.passes, _others(own)))
    return {"passes": every}


def proved(parts: Parts) -> Values:
    """The gap that is proved."""
    return {c.name: c.value for c in checks.proofs(parts)}


def all_warnings(parts: Parts) -> list[Notice]:
    """Warnings about a machine, and those that appear backwards only."""
    from geneva_cli.parts.parts import parts_of
    from geneva_cli.verdict.warnings import warnings

    out = warnings(parts)
    for other in _others(parts.mechanism):
        own = set(map(str, out))
        # the law's name alone makes no other warning
        more = [
            text for text in warnings(parts_of(other)) if text.replace(", backwards", "") not in own
        ]
        out += [Notice(text.name, f"backwards, {text}") for text in more]
    return [*_own_warnings(parts.mechanism), *out]


def differences(parts: Parts) -> Values:
    """Each number of the report that differs by direction; None if there are no such numbers.

    Places are left out, and what needs the parts: they are the same parts.
    """
    from geneva_cli.parts.parts import parts_of
    from geneva_cli.verdict.quantities.groups import REPORT, values

    groups = [group for group in REPORT if not group.makes_parts and group.own]
    rows: list[tuple[str, float, float]] = []
    for backwards in _others(parts.mechanism):
        back = values(groups, parts_of(backwards))
        for name, one in values(groups, parts).items():
            other = back[name]
            if name.endswith("_deg") or not (isinstance(one, float) and isinstance(other, float)):
                continue
            # searches end within 1e-9 of a peak, and in any unit here 1e-12 is rounding
            if not math.isclose(one, other, rel_tol=1e-6, abs_tol=1e-12):
                rows.append((name, one, other))
    return {"both_ways": rows_table(("quantity", "forwards", "backwards"), rows) if rows else None}


def worse_of(forwards: Sequence[Check], backwards: Sequence[Check]) -> list[Check]:
    """Each check in the direction in which its margin is less.

    >>> from geneva_cli.verdict.checks.check import compared
    >>> both = [compared("horn_mm", value, "at least", 1.0) for value in (3.0, 2.0)]
    >>> worse_of(both[:1], both[1:])[0].direction
    'backwards'
    """
    others = dict(_numbered(backwards))
    rows = [_worse(check, others.pop(key, check)) for key, check in _numbered(forwards)]
    return rows + [check._replace(direction="backwards") for check in others.values()]


def _numbered(rows: Sequence[Check]) -> Iterator[tuple[tuple[str, int], Check]]:
    """Checks by their names, and numbers where two have one name."""
    for i, check in enumerate(rows):
        yield (check.name, sum(other.name == check.name for other in rows[:i])), check


def _worse(one: Check, other: Check) -> Check:
    """The check with the smaller margin, and its direction if they differ."""
    if one.passes == other.passes:
        # outlines are as accurate as their drawings, some 1e-5 of a length
        if (
            one.value is None
            or other.value is None
            or math.isclose(one.value, other.value, rel_tol=1e-4)
        ):
            return one
        first = one.spare <= other.spare
    else:
        first = one.passes is False or (one.passes is None and other.passes is True)
    return (one if first else other)._replace(direction="forwards" if first else "backwards")


def _own_warnings(mechanism: Mechanism) -> Iterator[Notice]:
    """The warnings about motions that differ, and about a law that is tuned for one direction."""
    for other in _others(mechanism):
        difference = _difference(mechanism, other)
        if difference:
            yield Notice(
                "differs-backwards",
                f"{difference}, because of {', '.join(_reasons(mechanism, other))}. Backwards the "
                "wheel starts where it stops forwards: choose drive and load for the harder end",
            )
        if _is_tuned(mechanism) and not _is_tuned(other):
            yield Notice(
                "tuned-forwards-only",
                "the tuned law leaves the load at rest forwards only. Backwards its damping acts "
                "the other way: damping_ratio = 0 in [motion] serves both directions alike",
            )


def _difference(forwards: Mechanism, backwards: Mechanism) -> str:
    """The first end of the motion, or else the law's half-way, that differs; empty if none does."""
    peaks = worst(forwards)
    back = worst(backwards).ends._asdict()
    for key, one in peaks.ends._asdict().items():
        what, _, end = key.partition("_")
        noise = 1e-9 * getattr(peaks, what).max  # an end without a jump is rounding
        if not math.isclose(one, back[key], rel_tol=1e-4, abs_tol=noise):
            return f"the {what} at {end} is {one:.4g} forwards and {back[key]:.4g} backwards"
    half = 0.5 if forwards.law is None else _half_way(forwards, forwards.law)
    if math.isclose(half, 0.5, rel_tol=1e-4):
        return ""
    return (
        f"the wheel is half-way after {half:.4g} of the motion forwards and "
        f"{1.0 - half:.4g} backwards"
    )


def _half_way(mechanism: Mechanism, law: Law) -> float:
    """Fraction of the motion's time after which a law's wheel is half-way."""
    import numpy as np  # machines without a law need none

    one = mechanism.engagements[0]
    at_deg = one.own.entry_deg + law.half_way * one.own.motion_deg
    return float((one.inputs_deg(np.array([at_deg]))[0] - one.entry_deg) / one.motion_deg)


def _is_tuned(mechanism: Mechanism) -> bool:
    law = mechanism.input_law
    return law is not None and law.tuned_to is not None


def _reasons(forwards: Mechanism, backwards: Mechanism) -> Iterator[str]:
    """Keys that have other values in the mirror, and the law if its halves differ."""
    for table in ("wheel", "drive", BEFORE):
        mirrored = backwards.spec.table(table)
        for key, value in forwards.spec.table(table).items():
            if value != mirrored[key] and key != "entry_deg":  # it follows from the others
                yield key
    if forwards.law is not None and forwards.law != backwards.law:
        yield f'the law "{forwards.law.NAME}"'


def _others(mechanism: Mechanism) -> tuple[Mechanism, ...]:
    """The machine backwards, if it must turn both ways and is not its own mirror image."""
    return every_way(mechanism)[1:]
