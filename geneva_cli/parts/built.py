"""The machine as it is built: all its parts at input angle 0.

One place for its drawing, its sheet, its list of parts and the checks of what passes beside shafts.
The wheel's axis is the origin, the crank's is on the x axis.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.curves.plates import Member
from geneva_cli.curves.shapes import Contour
from geneva_cli.parts.arm import CrankArm, crank_arm, has_arm
from geneva_cli.parts.first_pair import first_members
from geneva_cli.parts.frame import lowest, standing_plates
from geneva_cli.parts.gear_drawings import driver_shaft
from geneva_cli.parts.groove_plate import TOLERANCE
from geneva_cli.parts.link_shafts import link_shafts
from geneva_cli.parts.links import Links, drawn_links
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.plates import crank_group, wheel_part
from geneva_cli.parts.proof import Proof
from geneva_cli.parts.shafts import crank_shaft_radius, shafts
from geneva_cli.parts.turn.planes import crank_stop


class Built(NamedTuple):
    """The parts of a machine where they are."""

    wheel: Member
    crank: Member  # locking disc, arm, rollers on their pins, hub
    arm: CrankArm | None
    links: Links
    first: tuple[Member, ...]  # of two wheels in series, the first and its locking disc
    shafts: tuple[Member, ...]
    standing: tuple[Member, ...]  # a cam's groove plate, if there is one, and then the frame

    @property
    def members(self) -> tuple[Member, ...]:
        """All of them."""
        links = *self.links.cut, *self.links.joined
        return (self.wheel, self.crank, *links, *self.first, *self.shafts, *self.standing)


def built(
    found: Outlines,
    contour: Contour | None = None,
    tolerance: float = TOLERANCE,
    curves: str = "arcs",
) -> Built:
    """All parts of a flat machine; ``contour`` is the wheel's, if it is drawn finer or coarser.

    Raises GenevaError, naming the key, for sizes that leave no arm, no links or no shafts.
    """
    assembly = found.assembly
    given, at = assembly.given, np.zeros(1)
    bars = drawn_links(given, found)
    arm = crank_arm(found) if has_arm(found) else None
    standing = tuple(standing_plates(found, bars, tolerance, curves))
    low, stop = lowest(standing), crank_stop(found, bars)
    own = crank_shaft_radius(found) > 0.0
    return Built(
        Member(wheel_part(found, contour or found.wheel), turn=float(assembly.wheel(at)[0])),
        Member(
            crank_group(found, arm, bars.pin_low),
            (assembly.L, 0.0),
            float(assembly.crank(at)[0]),
        ),
        arm,
        bars,
        tuple(first_members(given, bars)),
        (
            *shafts(found, low, stop),
            *link_shafts(given, bars, low, stop, own),
            *driver_shaft(Proof(given, found), low),
        ),
        standing,
    )
