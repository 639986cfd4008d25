"""All warnings about a design in one list, and those about a machine that differs backwards.

Every command and format shows this list.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from geneva_cli.errors import Notice
from geneva_cli.motion.both_ways import every_way
from geneva_cli.motion.laws.law import Law
from geneva_cli.motion.machine_spec import BEFORE
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peaks import worst
from geneva_cli.parts.parts import Parts, parts_of
from geneva_cli.parts.wheel_body import known_wheel_body
from geneva_cli.verdict.carried_warnings import carried_warnings, unlikely_warnings
from geneva_cli.verdict.motion_warnings import motion_warnings
from geneva_cli.verdict.parts_warnings import bearing_warnings, process_warnings, turn_warnings


def warnings(parts: Parts) -> list[Notice]:
    """Warnings about the motion, the loads and the parts of a machine, in this order.

    A machine that turns both ways also has those that appear backwards only.
    """
    mechanism = parts.mechanism
    out = one_way_warnings(parts)
    for other in every_way(mechanism)[1:]:
        own = set(map(str, out))
        # the law's name alone makes no other warning
        more = [
            text
            for text in one_way_warnings(parts_of(other))
            if text.replace(", backwards", "") not in own
        ]
        out += [Notice(text.name, f"backwards, {text}") for text in more]
    return [*direction_warnings(mechanism), *out]


def one_way_warnings(parts: Parts) -> list[Notice]:
    """Warnings about a machine in its own direction, in the order of ``warnings``."""
    mechanism = parts.mechanism
    is_loaded = mechanism.spec.is_loaded
    return [
        *motion_warnings(mechanism),
        *(_of_loads(mechanism) if is_loaded else ()),
        *unlikely_warnings(mechanism),
        *carried_warnings(mechanism, known_wheel_body(mechanism)),
        *(_of_strength(mechanism) if is_loaded else ()),
        *turn_warnings(parts),
        *bearing_warnings(parts),
        *process_warnings(parts),
    ]


# Machines without a load do not import what these two need.


def _of_strength(mechanism: Mechanism) -> list[Notice]:
    from geneva_cli.verdict.strength import strength

    return strength(mechanism).warnings()


def _of_loads(mechanism: Mechanism) -> list[Notice]:
    from geneva_cli.loads.cycle import cycle_of
    from geneva_cli.loads.summary import summaries
    from geneva_cli.verdict.cycle_warnings import cycle_warnings, load_warnings

    cycle = cycle_of(mechanism)
    return [*load_warnings(mechanism), *cycle_warnings(cycle, summaries(cycle))]


def direction_warnings(mechanism: Mechanism) -> Iterator[Notice]:
    """The warnings about motions that differ, and about a law that is tuned for one direction."""
    for other in every_way(mechanism)[1:]:
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
    law = mechanism.engagements[0].motion.law
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
