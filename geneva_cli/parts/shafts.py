"""The crank's hub, and the shafts of wheel and crank with their ends along the axis.

The crank's hub stands on the locking disc, or on the arm if there is no disc. It is drawn if the
spec has one of its sizes; otherwise only its space is kept free. Shafts have the shape of the bores
that they are in, less ``shaft_fit_mm``. They end in the frame's lower face, and above with the part
that they carry; ``turned_shafts`` has those with steps. A wheel with ``wheel_hub_mm = 0`` has its
shaft only above it, unless that carries a gear below.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from geneva_cli.curves.plates import Member, Plate, Stack
from geneva_cli.curves.shapes import ORIGIN, Circle, Shape
from geneva_cli.errors import GenevaError
from geneva_cli.layout.bores import RoundBore, bore_of, fitted
from geneva_cli.layout.held_hubs import held_hub
from geneva_cli.layout.link_positions import links_at
from geneva_cli.layout.reliefs import keyway_direction
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.outlines.crank import crank_circles, is_whole
from geneva_cli.outlines.outlines import Outlines
from geneva_cli.outlines.wheel_hub import HUB, about_axis, wheel_hub
from geneva_cli.parts.arm import has_arm, shaft_bore
from geneva_cli.parts.turned_shafts import Seat, turned_shaft
from geneva_cli.spec.tables import Size

SHAFT = "SHAFT"


def crank_hub(parts: Outlines) -> Plate | None:
    """Return the crank's hub above the locking disc or the arm; None if omitted or not higher.

    Raises GenevaError, naming the key, if there is neither disc nor arm to carry it, and for a set
    screw that it does not hold.
    """
    assembly = parts.assembly
    direction = keyway_direction(assembly)
    return held_hub(assembly.mechanism.spec.size, "crank", _crank_hub(parts), direction)


def _crank_hub(parts: Outlines) -> Plate | None:
    size, sizes = parts.assembly.mechanism.spec.size, parts.sizes
    requested = size.crank_hub_mm is not None or size.crank_hub_length_mm is not None
    if not requested or sizes.crank_hub <= sizes.crank_bore:
        return None
    on_arm = 0.0 - size.allowances.pin_gap_mm  # no -0.0
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


def shafts(
    parts: Outlines, frame: tuple[float, float], stop: float | None = None
) -> Iterator[Member]:
    """Yield the shafts of wheel and crank at their positions.

    ``frame`` has the frame's lower and upper face. The crank's shaft ends at ``stop`` if links
    block it (``turn.planes``). Raises GenevaError where a shaft's lower end is not below its upper
    one.
    """
    assembly, still = parts.assembly, np.zeros(1)
    size, lowest = assembly.mechanism.spec.size, frame[0]
    if parts.sizes.wheel_bore:
        bore = bore_of(size, "wheel", parts.sizes.wheel_bore)
        ends = wheel_shaft_ends(parts, lowest)
        one = Seat("wheel", bore, assembly.rests[0], *_on_wheel(parts), False, frame[1])
        turn = float(assembly.wheel(still)[0])
        yield Member(shaft_in(size, one, ends, lowest), turn=0.0 if bore.is_plain else turn)
    radius = crank_shaft_radius(parts)
    if radius:
        bore = bore_of(size, "crank", radius)
        ends = crank_shaft_ends(parts, lowest if stop is None else stop)
        at = _on_crank(parts)
        through = parts.sizes.crank_bore > 0.0
        one = Seat("crank", bore, keyway_direction(assembly), *at, not through, frame[1])
        turn = float(assembly.crank(still)[0])
        plate = shaft_in(size, one, ends, lowest)
        yield Member(plate, (assembly.L, 0.0), 0.0 if bore.is_plain else turn)


def shaft_in(size: Size, seat: Seat, ends: tuple[float, float], lowest: float) -> Plate | Stack:
    """Return a shaft of wheel or crank; one that ends above the frame is always plain."""
    if size.shafts == "turned" and ends[0] <= lowest:
        return turned_shaft(size, seat, SHAFT)
    return shaft(seat.part, fitted(size, seat.bore).section(SHAFT, seat.direction), ends)


def _on_wheel(parts: Outlines) -> tuple[float, float]:
    """Return the lower and upper face of the wheel with its hub, along the axis."""
    hub = wheel_hub(parts.assembly, parts.sizes)
    return hub.low if hub else 0.0, parts.sizes.wheel_thickness


def _on_crank(parts: Outlines) -> tuple[float, float]:
    """Return the lower and upper end of what the crank's shaft carries, along the axis."""
    size, sizes = parts.assembly.mechanism.spec.size, parts.sizes
    on_arm = 0.0 - size.allowances.pin_gap_mm  # no -0.0
    high = on_arm
    if sizes.crank_bore:
        hub = crank_hub(parts)
        high = hub.high if hub else on_arm + sizes.lock_thickness
    return on_arm - (sizes.arm_thickness if has_arm(parts) else 0.0), high


def wheel_shaft_radius(parts: Outlines) -> float:
    """Return the radius around the wheel's shaft; 0 without one."""
    bore = parts.sizes.wheel_bore
    return bore_of(parts.assembly.mechanism.spec.size, "wheel", bore).around if bore else 0.0


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
    return shaft_ends(parts.assembly.mechanism.spec.size, "crank", lowest, _on_crank(parts)[1])


def shaft_ends(size: Size, part: str, low: float, high: float) -> tuple[float, float]:
    """Return the ends of a part's shaft: those of the spec, or else the heights low and high."""
    values = vars(size)
    ends = values.get(f"{part}_shaft_low_mm"), values.get(f"{part}_shaft_high_mm")
    return low if ends[0] is None else ends[0], high if ends[1] is None else ends[1]


def round_section(size: Size, radius: float) -> Shape:
    """Return the section of a round shaft for bores of a radius.

    Raises GenevaError where ``shaft_fit_mm`` leaves nothing of it.
    """
    return fitted(size, RoundBore(radius)).section(SHAFT, 0.0)


def shaft(part: str, section: Shape, ends: tuple[float, float], what: str = "shaft") -> Plate:
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
    return Plate(f"{part}'s {what}", SHAFT, section, (), low, high)
