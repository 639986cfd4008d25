"""First wheels that turn the crank of an external wheel, in a cycle of several turns."""

from collections.abc import Iterator

from geneva_cli.kinds.series.geneva_pair import GenevaPair
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.study.synth.families.family import Family, is_compatible, natural_deg
from geneva_cli.study.target import BARE, Target


def pairs(target: Target, wheel: Gearing) -> Iterator[Family]:
    """First wheels of any number of slots, which turn the crank once in ``first_z`` turns."""
    for first_z in range(3, int(360.0 / natural_deg(wheel)) + 1):
        spec = BARE.replace(wheel=wheel, drive=GenevaPair(first_z=first_z))
        if not is_compatible(spec):
            return
        natural = build(spec).engagements[0].motion_deg
        m = 1.0 / first_z  # motions in a turn of the input
        if target.motions(m, natural).allows(natural):
            yield Family(target.machine(wheel, GenevaPair(first_z=first_z)))
