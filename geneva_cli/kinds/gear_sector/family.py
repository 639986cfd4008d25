"""Gear sectors between two slots that turn an external wheel, with a longer motion."""

import math
from collections.abc import Callable, Iterator

from geneva_cli.kinds.gear_sector.motion import GearSector
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import N, larger, library
from geneva_cli.numerics.roots import boundary
from geneva_cli.study.synth.families.family import Family, is_compatible, natural_deg
from geneva_cli.study.target import BARE, Target


def sectors(target: Target, wheel: Gearing) -> Iterator[Family]:
    """Gear sectors that take over without a jump, with a free half angle b of the slots."""
    span = target.free_motions(1, natural_deg(wheel))
    example = BARE.replace(wheel=wheel, drive=GearSector(sector_deg=90.0))
    if span is None or not is_compatible(example):
        return
    z = wheel.z

    def slot(angle: Callable[[int, float], float], least: float) -> float:
        """The half angle of slots at which a decreasing angle reaches ``least``."""
        return boundary(lambda b: angle(z, b) >= least, 0.0, wheel.step.b)

    ends = (slot(sector_motion, span.high), slot(sector_motion, span.low))
    # gear sectors drive the crank by 0.001 to 330 degrees
    low = max(ends[0], slot(sector_deg, 330.0))
    high = min(ends[1], slot(sector_deg, 1e-3))
    if low <= high:
        spec, plain = target.machine(wheel, example.drive), wheel.step.b
        yield Family(
            spec, lambda b: {"drive.sector_deg": sector_deg(z, b)}, low, high, plain, plain
        )


def sector_deg(z: int, b: N) -> N:
    """Return the crank angle that gears drive between slots of half angle b: D = (2 pi/z - 2b)/u.

    Here u = l/(1-l) and l = sin b, with which the gears take over without a jump.
    """
    m = library(b)
    short, l = 2.0 * m.sin(0.5 * (0.5 * math.pi - b)) ** 2, m.sin(b)  # 1 - l, and l
    return 2.0 * (math.pi / z - b) * short / larger(l, 1e-300) / DEGREE


def sector_motion(z: int, b: N) -> N:
    """Return the motion of slots of half angle b with gears between them: 180 deg - 2b + D."""
    return 180.0 - 2.0 * b / DEGREE + sector_deg(z, b)
