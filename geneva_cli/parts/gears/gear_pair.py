"""The noncircular gears in front of a crank, at input angle 0, up to their pitch curves.

The driven gear is on the crank's axis, the driver at the distance C from it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Point, closed
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import bore_radius
from geneva_cli.parts.assembly import gear_plane, same
from geneva_cli.parts.gears.gear_curves import GEARS, pitch_curves, pitch_radii, required_gears
from geneva_cli.parts.links.link_plates import drawn_links
from geneva_cli.parts.links.link_sizes import link_sizes
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.arm_and_shafts import Shaft, bore_at, shaft_ends
from geneva_cli.parts.shafts.bores import Bore, round_bore

if TYPE_CHECKING:
    from geneva_cli.geometry.fit import Writer

# Of the axes' distance: coarsest tolerance of the fitted curves, which roll on each other, so that
# their lengths must agree to better than 1e-9.
FINE = {"arcs": 8e-9, "cubics": 2e-9}


def gear_span(mechanism: Mechanism, parts: Outlines | None) -> tuple[float, float]:
    """Return lower and upper face of both gears, in a plane below all links."""
    return link_sizes(mechanism, [], parts).span(gear_plane(mechanism))


def gear_pair(
    mechanism: Mechanism,
    parts: Outlines | None,
    writer: Callable[[float], Writer],
    on_crank: float = 0.0,
) -> tuple[Member, ...]:
    """Return both gears up to their pitch curves; none without noncircular gears.

    ``on_crank`` is the radius of the crank's shaft if it does not follow from the outlines
    ``parts``. ``writer`` returns a function that fits curves within a tolerance, mm.
    """
    pair = mechanism.spec.gears
    if pair is None:
        return ()
    write, span = writer(FINE["cubics"] * pair.distance_mm), gear_span(mechanism, parts)
    curves = pitch_curves(pair, mechanism.gear_shaft.sense)
    (axis, wide), (other, radius), bored = _shafts(mechanism, parts, on_crank)
    own = round_bore(mechanism.spec.size, radius if bored else 0.0)
    bores = (axis, bore_at(mechanism, axis, wide)), (other, own)
    keys, members = ("arm_bore_mm", "link_bore_mm"), []
    for name, curve, (at, on), (least, _), key in zip(
        GEARS, curves, bores, pitch_radii(pair), keys, strict=True
    ):
        if on.reach >= least:
            raise GenevaError(
                f"no blank of the {name} is left: its bore of {2.0 * on.reach:.6g} mm must be "
                f"below {2.0 * least:.6g}, twice its least radius; reduce {key}",
                ("size", key),
            )
        holes = (on.hole(),) if on.radius else ()
        outline = closed("PITCH", list(write(curve, -np.pi, np.pi)))
        members.append(Member(Plate(name, "PITCH", outline, holes, *span), at))
    return tuple(members)


def gear_shafts(
    mechanism: Mechanism,
    parts: Outlines | None,
    lowest: float,
    crank_has_one: bool,
    on_crank: float = 0.0,
) -> Iterator[Shaft]:
    """Yield the shafts that carry only gears, from the frame's lower face up; none without gears.

    The driver's shaft goes through it, or ends below one that is too small for a bore. The crank's
    is included if neither arm, locking disc nor links have one.
    """
    if mechanism.spec.gears is None:
        return
    (first, wide), (at, radius), bored = _shafts(mechanism, parts, on_crank)
    under, over = gear_span(mechanism, parts)
    at_crank = same(first, mechanism.crank_shaft.at, mechanism.center_distance_mm)
    if at_crank and not (crank_has_one or _on_links(mechanism, parts)):
        reach = shaft_ends(mechanism.spec.size, "crank", lowest, over)
        on = bore_at(mechanism, first, wide)
        yield Shaft("crank's shaft", "crank", on, *reach, first)
    top = over if bored else under  # or one piece with it
    yield Shaft("driver gear's shaft", "driver gear", Bore(radius), lowest, top, at)


def _shafts(
    mechanism: Mechanism, parts: Outlines | None, on_crank: float
) -> tuple[tuple[Point, float], tuple[Point, float], bool]:
    """Return position and radius of both gears' shafts, and whether the driver has a bore.

    The first is the crank's, or that of another drive. Otherwise driver and shaft are one piece.
    """
    pair, L = required_gears(mechanism), mechanism.center_distance_mm
    sizes, ((driven, _), (driver, _)) = link_sizes(mechanism, [], parts), pitch_radii(pair)
    usual, x = bore_radius(L / 20.0), mechanism.gear_shaft.x_mm
    wide = on_crank or _on_links(mechanism, parts) or sizes.crank_shaft
    wide = wide or sizes.bore(driven, L) or usual
    own = sizes.bore(driver, L)
    return ((x, 0.0), wide), ((x + pair.distance_mm, 0.0), own or usual), own > 0.0


def _on_links(mechanism: Mechanism, parts: Outlines | None) -> float:
    """Return the radius of the driven gear's shaft where links are on it; 0 without links."""
    L = mechanism.center_distance_mm
    return drawn_links(mechanism, parts).shaft(mechanism.gear_shaft.at, L)
