"""Two stages that turn an external wheel: gears between two slots, or a first wheel.

Each has a motion that no plain crank has. Gear sectors make it longer. Behind a first wheel it is a
small part of a cycle of several turns.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from geneva_cli.kinds.gear_sector.motion import GearSector
from geneva_cli.kinds.series.geneva_pair import GenevaPair
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.roots import boundary
from geneva_cli.study.synth.families import closed
from geneva_cli.study.synth.families.family import (
    BARE,
    Family,
    allowed_motions,
    allows,
    closed_span,
    is_compatible,
    machine,
    natural_deg,
    only,
)
from geneva_cli.study.target import Target


def sectors(target: Target, wheel: Gearing) -> Iterator[Family]:
    """Gear sectors that take over without a jump, with a free half angle b of the slots.

    At the plain crank's b the gears have nothing to drive.
    """
    span = closed_span(allowed_motions(target, 1, natural_deg(wheel)), 1)
    example = BARE.replace(wheel=wheel, drive=GearSector(sector_deg=90.0))
    if span is None or not is_compatible(example):
        return
    z = wheel.z

    def slot(angle: Callable[[int, float], float], least: float) -> float:
        """The half angle of slots at which a decreasing angle reaches ``least``."""
        return boundary(lambda b: angle(z, b) >= least, 0.0, wheel.step.b)

    ends = (slot(closed.sector_motion, span.high), slot(closed.sector_motion, span.low))
    # gear sectors drive the crank by 0.001 to 330 degrees
    low = max(ends[0], slot(closed.sector_deg, 330.0))
    high = min(ends[1], slot(closed.sector_deg, 1e-3))
    if low <= high:
        make = partial(_with_sectors, target, wheel)
        yield Family(make, low, high, wheel.step.b, wheel.step.b)


def _with_sectors(target: Target, wheel: Gearing, b: float) -> Spec:
    """Gear sectors between slots of half angle b."""
    sector, motion = closed.sector_deg(wheel.z, b), closed.sector_motion(wheel.z, b)
    return machine(target, wheel, lambda n: GearSector(sector_deg=sector, n_rpm=n), 1, motion)


def pairs(target: Target, wheel: Gearing) -> Iterator[Family]:
    """First wheels of any number of slots, which turn the crank once in ``first_z`` turns.

    Their step must be as long as the crank's own motion.
    """
    for first_z in range(3, int(360.0 / natural_deg(wheel)) + 1):
        spec = BARE.replace(wheel=wheel, drive=GenevaPair(first_z=first_z))
        if not is_compatible(spec):
            return
        natural = build(spec).engagements[0].motion_deg
        m = 1.0 / first_z  # motions in a turn of the input
        if allows(allowed_motions(target, m, natural), natural):

            def drive(n: float, first_z: int = first_z) -> GenevaPair:
                return GenevaPair(first_z=first_z, n_rpm=n)

            yield only(machine(target, wheel, drive, m, natural))
