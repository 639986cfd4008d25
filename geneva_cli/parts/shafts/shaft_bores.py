"""The bore of all that a shaft carries: its shape, and its direction in the machine."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.shapes import ORIGIN, Point, Shape
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.assembly import assembled
from geneva_cli.parts.links.link_positions import same
from geneva_cli.parts.outlines.reliefs import keyway_direction
from geneva_cli.parts.shafts.bores import Bore, bore_of, has_shape, round_bore


class ShaftBore(NamedTuple):
    """A bore, and the direction of its keyway, flat or side at input angle 0, radians."""

    bore: Bore = Bore(0.0)
    direction: float = 0.0
    part: str = ""  # "wheel" or "crank", whose keys of [size] give its shape; "" for neither

    def hole(self, turn: float = 0.0) -> Shape:
        """Return the hole about the origin of a part that stands turned by an angle."""
        return self.bore.shape("BORE", self.direction - turn)


def bore_at(mechanism: Mechanism, at: Point, radius: float) -> ShaftBore:
    """Return the bore of what is on the shaft at a point: as in wheel or crank, or a round one."""
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    part = "crank" if same(at, (L, 0.0), L) else "wheel" if same(at, ORIGIN, L) else ""
    if not (part and has_shape(size, part)):
        return ShaftBore(round_bore(size, radius), 0.0, part)
    own, still = assembled(mechanism), np.zeros(1)
    if part == "wheel":
        direction, turn = own.rests[0], own.wheel(still)
    else:
        direction, turn = keyway_direction(own), own.crank(still)
    return ShaftBore(bore_of(size, part, radius), direction + float(turn[0]), part)
