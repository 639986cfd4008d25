"""A bridge over the crank that bears its shaft from above, where links block its way down.

The input crank of a side-crank turns below the coulisse, over the axis of the crank's shaft. That
shaft leaves the machine through the locking disc. The bridge lies on two posts on the frame, beside
all that turns about the crank's axis, at right angles to the line of centres: there the wheel does
not reach the posts.
"""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.geometry.distance import Polyarc, farthest
from geneva_cli.geometry.hull import convex_hull
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import ORIGIN, Circle, as_contour
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.preferred import rounded_radius
from geneva_cli.parts.arm import crank_arm
from geneva_cli.parts.links.link_positions import is_bridged, links_at, turn_deg
from geneva_cli.parts.links.link_sizes import places
from geneva_cli.parts.links.links import Links
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.screws import SCREWS, bolt_radius
from geneva_cli.parts.shafts.shaft import Shaft
from geneva_cli.parts.sizes import HUB, bridge_low
from geneva_cli.spec.least_wall import wall_min


def bearing_bridge(
    mechanism: Mechanism, parts: Outlines, bars: Links, shaft: Shaft, thick: float
) -> Plate | None:
    """Return the bridge about the crank's axis; None where there is no place for one."""
    if not (parts.sizes.crank_bore and is_bridged(mechanism)):
        return None
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    wall = wall_min(size, L)
    bore = shaft.bore.around + 0.5 * size.allowances.shaft_fit_mm
    half = max(rounded_radius(HUB * bore), bore + wall)
    # also a machine that is too small for screws has those of the bridge
    screw = bolt_radius(None, L, half) or 0.5 * SCREWS[0].through
    away = swept_mm(mechanism, parts, bars) + wall + max(half, 2.0 * screw)
    away = 0.5 * math.ceil(2.0 * away)  # mm: to half a millimetre, for the drill
    ends = (0.0, -away), (0.0, away)
    outline = convex_hull("FRAME", [Circle("FRAME", at, half) for at in ends])
    holes = Circle("BORE", ORIGIN, bore), *(Circle("BORE", at, screw) for at in ends)
    low = bridge_low(size, parts.sizes)
    return Plate("bearing bridge", "FRAME", outline, holes, low, low + thick)


def swept_mm(mechanism: Mechanism, parts: Outlines, bars: Links) -> float:
    """Return a radius about the crank's axis that no part of crank and drive turns beyond."""
    L, sizes = mechanism.center_distance_mm, parts.sizes
    far = [sizes.lock, sizes.crank_hub]
    if parts.has_arm:
        arm = crank_arm(parts)
        eye = max(arm.eye, sizes.roller)
        far += [arm.hub, *(math.hypot(*pin.centre) + eye for pin in arm.pins)]
    links = {link.name: link for link in links_at(mechanism, turn_deg(mechanism))}
    for plate in bars.plates:
        if plate.name in links:  # a block stays in its link
            reach = float(farthest(Polyarc([as_contour(plate.outline)]), 0.0, 0.0).max())
            first = places(links[plate.name])[0]
            far.append(float(np.abs(first - L).max()) + reach)
    return max(far)
