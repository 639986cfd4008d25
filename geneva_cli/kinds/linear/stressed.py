"""The dimensions of the parts of a rack's machine that their strength depends on.

The rack has no shaft and no key. The crank's shaft is borne in the frame, and its overhang is the
distance of that bearing from the middle of the rack's thickness.
"""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.linear.arm import crank_arm, rack_bore
from geneva_cli.kinds.linear.frame import has_arm, rack_frame, shaft_radius
from geneva_cli.kinds.linear.rack import rack_sizes
from geneva_cli.loads.strength.arm_strength import NO_ARM, ArmDimensions
from geneva_cli.loads.strength.key_strength import NO_KEY
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.shafts.bores import reach_or_bore
from geneva_cli.parts.sizes import pin_radius
from geneva_cli.parts.stressed import ShaftSize, Stressed, key_of, shaft_of
from geneva_cli.spec.default_sizes import value_or


def rack_stressed(mechanism: Mechanism) -> Stressed:
    """Return the dimensions of a machine's parts. Raises GenevaError where they do not fit."""
    size, heights = mechanism.spec.size, rack_frame(mechanism)
    contact = value_or(size.face_width_mm, heights.rack)
    bore = shaft_radius(mechanism)
    thick = heights.stands - heights.arm
    to_frame = 0.5 * heights.rack - (heights.low - size.washer_mm)
    end = (to_frame, thick, 2.0 * mechanism.center_distance_mm)  # shoulders as on L = 2 R
    return Stressed(
        contact,
        2.0 * pin_radius(size, mechanism.roller_radius_mm),
        ShaftSize(math.nan, math.nan),
        shaft_of(mechanism.spec, "crank", bore, *end),
        _arm(mechanism, contact),
        NO_KEY,
        key_of(size.crank_keyway, bore, thick),
    )


def _arm(mechanism: Mechanism, contact: float) -> ArmDimensions:
    """Return the arm's dimensions; NaN without an arm."""
    if not has_arm(mechanism):
        return NO_ARM
    size, arm, heights = mechanism.spec.size, crank_arm(mechanism), rack_frame(mechanism)
    thick, hole = heights.stands - heights.arm, arm.pins[0].radius
    bored = reach_or_bore(size, "crank", rack_bore(mechanism))
    offset = 0.5 * (contact + thick) - heights.stands
    length = mechanism.center_distance_mm
    return ArmDimensions(length, arm.hub, arm.eye, bored, hole, thick, offset)


def horn_sizes(mechanism: Mechanism) -> tuple[float, float]:
    """Return half the slot's width and the recess's radius, NaN for a rack that cannot be cut."""
    try:
        sizes = rack_sizes(mechanism)
    except GenevaError:  # the check of the parts reports the error
        return math.nan, math.nan
    return sizes.half_width, sizes.recess
