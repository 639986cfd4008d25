"""A machine that turns both ways: backwards it is another machine that turns forwards.

Pin path, slot and motion bind the wheel's angle psi to the input's angle theta, whichever way the
input turns. Backwards both run backwards. Seen from its other side, a mirror image about the line
of centres, such a machine turns forwards: psi'(theta) = -psi(-theta), and x + iy of its path and of
its slot at theta are x - iy at -theta. So entry and exit change places, slots are offset to the
other side, and a law runs from its end: s'(u) = 1 - s(1 - u). That machine has a spec, and every
result of it is the result of the first machine backwards.

At one speed velocities, accelerations and jerks keep their sizes at each place. What acts in one
direction differs: friction, the driving wall, impacts, the jumps at entry, what the play does.
"""

from __future__ import annotations

from functools import lru_cache

from geneva_cli.machine.mechanism import Mechanism, build


def backwards(mechanism: Mechanism) -> Mechanism:
    """The machine turning backwards, as the machine that turns forwards seen from its other side.

    Angles are counted in the direction of rotation, so that it enters where the first one leaves.
    """
    spec = mechanism.spec
    return build(
        spec.replace(
            wheel=spec.wheel.backwards,
            drive=spec.drive.backwards(mechanism.plan),
            motion=spec.motion and spec.motion.backwards,
        )
    )


@lru_cache(maxsize=16)  # checks, sizes and warnings of a design ask for the same one
def every_way(mechanism: Mechanism) -> tuple[Mechanism, ...]:
    """The machine in each direction in which it must serve, forwards first.

    A machine that is its own mirror image is the same both ways, and stands there once.
    """
    if not mechanism.spec.drive.both_ways:
        return (mechanism,)
    other = backwards(mechanism)
    return (mechanism,) if other.spec == mechanism.spec else (mechanism, other)
