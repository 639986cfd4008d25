"""The crank's hub, and the shafts of wheel and crank with their ends along the axis.

The crank's hub stands on the locking disc, or on the arm if there is no disc. It is drawn if the
spec has one of its sizes; otherwise only its space is kept free. Shafts are as wide as the bores
that they are in. They end in the frame's lower face, and above with the part that they carry. A
wheel with ``wheel_hub_mm = 0`` has its shaft only above it, unless that carries a gear below.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from geneva_cli.curves.plates import Member, Plate
from geneva_cli.curves.shapes import ORIGIN, Circle
from geneva_cli.errors import GenevaError
from geneva_cli.layout.link_positions import links_at
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.outlines.crank import crank_circles, is_whole
from geneva_cli.outlines.outlines import Outlines
from geneva_cli.outlines.wheel_hub import HUB, about_axis
from geneva_cli.parts.arm import has_arm, shaft_bore
from geneva_cli.spec.tables import Size

SHAFT = "SHAFT"


def crank_hub(parts: Outlines) -> Plate | None:
    """Return the crank's hub above the locking disc or the arm; None if omitted or not higher.

    Raises GenevaError, naming the key, if there is neither disc nor arm to carry it.
    """
    size, sizes = parts.assembly.mechanism.spec.size, parts.sizes
    requested = size.crank_hub_mm is not None or size.crank_hub_length_mm is not None
    if not requested or sizes.crank_hub <= sizes.crank_bore:
        return None
    on_arm = 0.0 - size.pin_gap_mm  # no -0.0
    disc = bool(parts.crank) and is_whole(parts.assembly, sizes)
    if not (disc or has_arm(parts)):
        key = "crank_hub_length_mm" if size.crank_hub_mm is None else "crank_hub_mm"
        raise GenevaError(
            f"{key}: a hub needs the locking disc or the crank arm to stand on, and there is "
            "neither; remove it",
            ("size", key),
        )
    low = on_arm + (sizes.lock_thickness if disc else 0.0)
    high = sizes.wheel_thickness
    if size.crank_hub_length_mm is not None:
        high = on_arm + size.crank_hub_length_mm
    if high <= low:
        return None
    bores = about_axis(crank_circles(parts.assembly, sizes) if sizes.crank_bore else [])
    return Plate("crank's hub", HUB, Circle(HUB, ORIGIN, sizes.crank_hub), bores, low, high)


def shafts(parts: Outlines, lowest: float, stop: float | None = None) -> Iterator[Member]:
    """Yield the shafts of wheel and crank at their positions.

    ``lowest`` is the frame's lower face. The crank's shaft ends at ``stop`` if links block it
    (``turn.planes``). Raises GenevaError where a shaft's lower end is not below its upper one.
    """
    radius = wheel_shaft_radius(parts)
    if radius:
        yield Member(shaft("wheel", radius, wheel_shaft_ends(parts, lowest)))
    radius = crank_shaft_radius(parts)
    if radius:
        ends = crank_shaft_ends(parts, lowest if stop is None else stop)
        yield Member(shaft("crank", radius, ends), (parts.assembly.L, 0.0))


def wheel_shaft_radius(parts: Outlines) -> float:
    """Return the radius of the wheel's shaft, which is that of its bore; 0 without one."""
    return parts.sizes.wheel_bore


def wheel_shaft_ends(parts: Outlines, lowest: float) -> tuple[float, float]:
    """Return the ends of the wheel's shaft along the axis."""
    sizes = parts.sizes
    low = lowest if sizes.wheel_hub or _has_gear(parts) else 0.0
    return shaft_ends(parts.assembly.mechanism.spec.size, "wheel", low, sizes.wheel_thickness)


def _has_gear(parts: Outlines) -> bool:
    """Return True if the wheel's shaft carries a gear below the wheel."""
    near = SAME_LENGTH * parts.assembly.L
    return any(
        link.radius_mm and math.hypot(float(x[0]), float(y[0])) < near
        for link in links_at(parts.assembly.full, np.zeros(1))
        for x, y in link.joints
    )


def crank_shaft_radius(parts: Outlines) -> float:
    """Return the radius of the shaft of arm and locking disc; 0 if it carries only links."""
    return shaft_bore(parts) if has_arm(parts) else parts.sizes.crank_bore


def crank_shaft_ends(parts: Outlines, lowest: float) -> tuple[float, float]:
    """Return the ends of the crank's shaft: upper end in the arm, or in a bored locking disc."""
    size, sizes = parts.assembly.mechanism.spec.size, parts.sizes
    high = 0.0 - size.pin_gap_mm
    if sizes.crank_bore:
        hub = crank_hub(parts)
        high = hub.high if hub else high + sizes.lock_thickness
    return shaft_ends(size, "crank", lowest, high)


def shaft_ends(size: Size, part: str, low: float, high: float) -> tuple[float, float]:
    """Return the ends of a part's shaft: those of the spec, or else the heights low and high."""
    values = vars(size)
    ends = values.get(f"{part}_shaft_low_mm"), values.get(f"{part}_shaft_high_mm")
    return low if ends[0] is None else ends[0], high if ends[1] is None else ends[1]


def shaft(part: str, radius: float, ends: tuple[float, float], what: str = "shaft") -> Plate:
    """Return the shaft of a part about the origin; ``what`` is the last word of its name.

    Raises GenevaError, naming the key, where its lower end is not below its upper one.
    """
    low, high = ends
    if not low < high:
        raise GenevaError(
            f"{part}_shaft_low_mm: the {part}'s shaft would reach from {low:g} up to {high:g} mm "
            f"(0 is the wheel's lower face); reduce {part}_shaft_low_mm or increase "
            f"{part}_shaft_high_mm",
            ("size", f"{part}_shaft_low_mm"),
        )
    return Plate(f"{part}'s {what}", SHAFT, Circle(SHAFT, ORIGIN, radius), (), low, high)
