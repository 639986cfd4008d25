"""The crank's hub, and the shafts of wheel and crank: where they end along the axis.

The crank's hub stands on the locking disc, or on the arm where there is no disc. It is drawn where
the spec gives a size of its; else only room is kept for it. Shafts are as wide as the bores that
they are in. They end in the frame's lower face, and above where what they carry does; a wheel with
``wheel_hub_mm = 0`` has its shaft above it alone, unless that carries a gear below.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from geneva_cli.curves.plates import Member, Plate
from geneva_cli.curves.shapes import Circle
from geneva_cli.errors import GenevaError
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.arm import has_arm, shaft_bore
from geneva_cli.parts.crank import crank_circles, is_whole
from geneva_cli.parts.link_positions import links_at
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.wheel_hub import AXIS, HUB, about_axis
from geneva_cli.spec.tables import Size

SHAFT = "SHAFT"


def crank_hub(found: Outlines) -> Plate | None:
    """The crank's hub above the locking disc, or the arm; None where it is not given, or lower.

    Raises GenevaError, naming the key, where there is neither disc nor arm for it to stand on.
    """
    given, sizes = found.assembly.mechanism.spec.size, found.sizes
    asked = given.crank_hub_mm is not None or given.crank_hub_length_mm is not None
    if not asked or sizes.crank_hub <= sizes.crank_bore:
        return None
    on_arm = 0.0 - given.pin_gap_mm  # no -0.0
    disc = bool(found.crank) and is_whole(found.assembly, sizes)
    if not (disc or has_arm(found)):
        key = "crank_hub_length_mm" if given.crank_hub_mm is None else "crank_hub_mm"
        raise GenevaError(
            f"{key}: a hub stands on the locking disc or on the crank arm, and there is neither; "
            "remove it",
            ("size", key),
        )
    low = on_arm + (sizes.lock_thickness if disc else 0.0)
    high = sizes.wheel_thickness
    if given.crank_hub_length_mm is not None:
        high = on_arm + given.crank_hub_length_mm
    if high <= low:
        return None
    bores = about_axis(crank_circles(found.assembly, sizes) if sizes.crank_bore else [])
    return Plate("crank's hub", HUB, Circle(HUB, AXIS, sizes.crank_hub), bores, low, high)


def shafts(found: Outlines, lowest: float, stop: float | None = None) -> Iterator[Member]:
    """The shafts of wheel and crank at their places.

    ``lowest`` is the frame's lower face; the crank's ends at ``stop`` where links are in the way of
    it (``turn.planes``). Raises GenevaError as ``shaft`` does.
    """
    radius = wheel_shaft_radius(found)
    if radius:
        yield Member(shaft("wheel", radius, wheel_shaft_ends(found, lowest)))
    radius = crank_shaft_radius(found)
    if radius:
        ends = crank_shaft_ends(found, lowest if stop is None else stop)
        yield Member(shaft("crank", radius, ends), (found.assembly.L, 0.0))


def wheel_shaft_radius(found: Outlines) -> float:
    """The radius of the wheel's shaft, which is that of its bore; 0 without one."""
    return found.sizes.wheel_bore


def wheel_shaft_ends(found: Outlines, lowest: float) -> tuple[float, float]:
    """Where the wheel's shaft ends along the axis."""
    sizes = found.sizes
    low = lowest if sizes.wheel_hub or _has_gear(found) else 0.0
    return shaft_ends(found.assembly.mechanism.spec.size, "wheel", low, sizes.wheel_thickness)


def _has_gear(found: Outlines) -> bool:
    """Whether the wheel's shaft carries a gear below the wheel."""
    near = SAME_LENGTH * found.assembly.L
    return any(
        link.radius_mm and math.hypot(float(x[0]), float(y[0])) < near
        for link in links_at(found.assembly.given, np.zeros(1))
        for x, y in link.joints
    )


def crank_shaft_radius(found: Outlines) -> float:
    """The radius of the shaft that carries arm and locking disc; 0 where it carries links alone."""
    return shaft_bore(found) if has_arm(found) else found.sizes.crank_bore


def crank_shaft_ends(found: Outlines, lowest: float) -> tuple[float, float]:
    """Where that shaft ends: above, in the arm, or through the locking disc where that is bored."""
    given, sizes = found.assembly.mechanism.spec.size, found.sizes
    high = 0.0 - given.pin_gap_mm
    if sizes.crank_bore:
        hub = crank_hub(found)
        high = hub.high if hub else high + sizes.lock_thickness
    return shaft_ends(given, "crank", lowest, high)


def shaft_ends(size: Size, part: str, low: float, high: float) -> tuple[float, float]:
    """Where the shaft of a part ends: as the spec says of wheel or crank, or at these heights."""
    given = vars(size)
    ends = given.get(f"{part}_shaft_low_mm"), given.get(f"{part}_shaft_high_mm")
    return low if ends[0] is None else ends[0], high if ends[1] is None else ends[1]


def shaft(part: str, radius: float, ends: tuple[float, float], what: str = "shaft") -> Plate:
    """The shaft of a part about the origin; ``what`` is its last word.

    Raises GenevaError, naming the key, where its lower end is not below its upper one.
    """
    low, high = ends
    if not low < high:
        raise GenevaError(
            f"{part}_shaft_low_mm: the {part}'s shaft would reach from {low:g} up to {high:g} mm "
            f"(0 is the wheel's lower face); its lower end must be below, or {part}_shaft_high_mm "
            "above",
            ("size", f"{part}_shaft_low_mm"),
        )
    return Plate(f"{part}'s {what}", SHAFT, Circle(SHAFT, AXIS, radius), (), low, high)
