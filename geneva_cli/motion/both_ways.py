"""A machine that turns both ways: backwards it is another machine that turns forwards.

Pin path, slot and motion bind the wheel's angle psi to the input's angle theta, whichever way the
input turns. So a machine turns backwards along the same curves. Seen from its other side, in a
mirror about the line of centres, it turns forwards: its psi at theta is -psi at -theta. Its path
and slot at theta are x - iy where the first machine has x + iy at -theta. So entry and exit change
places, slots are offset to the other side, and a law runs from its end: s(u) becomes 1 - s(1 - u).
That machine has a spec, and each of its results is one of the first machine turning backwards.

At one speed velocity, acceleration and jerk keep their sizes at each place, as in a film that runs
backwards. So does the torque of the inertia, but what resists the motion changes its sense: the
torque on the wheel is I w² psi'' + M_r in both machines, with psi'' at theta now -psi'' at -theta.
"""

from __future__ import annotations

from functools import lru_cache

from geneva_cli.errors import marking
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.numerics.arrays import all_true
from geneva_cli.spec.rules import is_array
from geneva_cli.spec.schema import SpecTable


def backwards(mechanism: Mechanism) -> Mechanism:
    """The machine turning backwards: the one that turns forwards, seen from its other side."""
    spec = mechanism.spec
    with marking():  # what is refused in one direction is refused in both
        turned = spec.replace(
            wheel=spec.wheel.backwards,
            drive=spec.drive.backwards(mechanism.plan),
            drive_before=spec.drive_before and spec.drive_before.backwards(mechanism.plan),
            motion=spec.motion and spec.motion.backwards,
            mass=tuple(one.backwards for one in spec.mass),
        )
        return build(turned)._replace(design=mechanism.design)


def every_way(mechanism: Mechanism) -> tuple[Mechanism, ...]:
    """The machine in each direction in which it must serve, the first of them its own."""
    if not mechanism.spec.drive.both_ways:
        return (mechanism,)
    of = _ways.__wrapped__ if is_array(mechanism.design) else _ways
    return of(mechanism)


@lru_cache(maxsize=16)  # sizes, checks and warnings of a design need the same machine
def _ways(mechanism: Mechanism) -> tuple[Mechanism, ...]:
    other, one = backwards(mechanism), mechanism.spec
    same = _alike(one.wheel, other.spec.wheel) and _alike(one.drive, other.spec.drive)
    same = same and one.motion == other.spec.motion and one.mass == other.spec.mass
    if one.drive_before and other.spec.drive_before:
        same = same and _alike(one.drive_before, other.spec.drive_before)
    return (mechanism,) if same else (mechanism, other)


def _alike(one: SpecTable, other: SpecTable) -> bool:
    """True if two tables are equal, in each design of a batch."""
    return all(all_true(value == other.as_dict()[key]) for key, value in one.as_dict().items())
