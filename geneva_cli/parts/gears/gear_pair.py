"""The noncircular gears in front of a crank: their pitch curves, whether they can be cut, shafts.

The ratio is i = crank speed / input speed, and the axes are C apart. The pitch curves meet on the
line of centres, at r1 = C i/(1+i) from the driver and r2 = C/(1+i) from the driven gear. Convex
curves can be hobbed. With derivatives by the driver's angle, the curves are convex where

    driver:  1 + 1/i + (1/i)'' > 0,    driven gear:  1 + i + (i i'' - i'²)/i³ > 0

Gears are drawn at input angle 0, up to their pitch curves. The driven gear is on the crank's axis.
"""

from collections.abc import Iterator
from functools import partial

import numpy as np

from geneva_cli.errors import GenevaError, refuse_size
from geneva_cli.geometry import chords
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Point, closed
from geneva_cli.motion import registry
from geneva_cli.motion.drive import Gears
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, array
from geneva_cli.numerics.jet import Jet
from geneva_cli.numerics.tolerances import bore_radius
from geneva_cli.parts.assembly import gear_plane, same
from geneva_cli.parts.links.link_plates import drawn_links
from geneva_cli.parts.links.links import link_sizes
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.parts import EdgedParts
from geneva_cli.parts.shafts.arm_and_shafts import Shaft, bore_at, shaft_ends
from geneva_cli.parts.shafts.bores import Bore, round_bore
from geneva_cli.table import Table

NAMES = (
    *("input_deg", "crank_deg", "ratio", "driver_radius_mm", "driver_x_mm", "driver_y_mm"),
    *("driven_radius_mm", "driven_x_mm", "driven_y_mm", "driver_convexity", "driven_convexity"),
)
GEARS = "driven gear", "driver gear"
TURN = np.linspace(-np.pi, np.pi, 721)  # input angles at which ratio and radii are computed
THIN = 1e-6  # of the axes' distance: a pitch curve nearer to its axis encloses no shaft
# Of the axes' distance: coarsest tolerance of the fitted curves, which roll on each other, so that
# their lengths must agree to better than 1e-9.
FINE = {"arcs": 8e-9, "cubics": 2e-9}


def gears_table(mechanism: Mechanism, tolerance_mm: float, samples: int | None) -> Table:
    """Return both pitch curves: for a chord tolerance, or at ``samples`` even input angles.

    Each is in its own gear's frame, with x along the line of centres at input angle 0. A curve is
    listed as it is cut, so its angle runs against the gear's rotation.
    """
    gears = required_gears(mechanism)
    # one turn; the curves' frames are at input angle 0
    phi = np.linspace(-np.pi, np.pi, samples or 3)
    if samples is None:
        curves = partial(pitch_curve, gears, 1.0, True), partial(pitch_curve, gears, 1.0, False)
        ends = -np.pi, 0.0, np.pi
        phi = chords.nodes(lambda at: [curve(at)[0] for curve in curves], ends, tolerance_mm)
    return Table(NAMES, _columns(gears, phi))


def _columns(gears: Gears, phi: Array) -> list[Array]:
    """Return the columns of the table at the input's angles, radians, over a turn."""
    ratio, turned = ratio_and_turn(gears, phi)
    # the crank's angle ahead of the input is 0 at input angle 0
    ahead = np.unwrap(np.angle(turned * np.exp(-1j * phi)))
    middle = float(ahead[np.argmin(np.abs(phi))])
    turn = phi + ahead - np.round(middle / (2.0 * np.pi)) * 2.0 * np.pi
    C, (i, i1, i2) = gears.distance_mm, map(array, ratio.derivatives())
    inverse, _, bend = map(array, (1.0 / ratio).derivatives())
    r1, r2 = C * i / (1.0 + i), C / (1.0 + i)
    driver, driven = (r1 * np.cos(phi), -r1 * np.sin(phi)), (-r2 * np.cos(turn), -r2 * np.sin(turn))
    convex = 1.0 + inverse + bend, 1.0 + i + (i * i2 - i1 * i1) / i**3
    return [np.degrees(phi), np.degrees(turn), i, r1, *driver, r2, *driven, *convex]


def required_gears(mechanism: Mechanism) -> Gears:
    """Return the noncircular gears of a machine; raises GenevaError if it has none."""
    gears, kind = mechanism.spec.gears, mechanism.spec.drive.NAME
    if gears is None:
        geared = [*registry.drives_with("gears"), *registry.drives_with("round_gears")]
        text = f'--part gears: kind = "{kind}" has no gears with a table of their pitch curves; '
        text += f"{', '.join(geared)} have gears, of which the round ones are only drawn"
        raise GenevaError(text)
    return gears


def convexity(gears: Gears) -> tuple[float, float]:
    """Return the least convexity of driver and driven gear in a turn; not above 0 if hollow."""
    *_, driver, driven = _columns(gears, TURN)
    return float(driver.min()), float(driven.min())


def pitch_radii(pair: Gears) -> list[tuple[float, float]]:
    """Return least and greatest radius of the pitch curves of driven gear and driver, mm."""
    C, (_, _, _, driver, _, _, driven, *_) = pair.distance_mm, _columns(pair, TURN)
    for name, r in zip(GEARS, (driven, driver), strict=True):
        if r.min() < THIN * C:
            text = f"the pitch curve of the {name} comes within {r.min():.3g} mm of its axis: that "
            text += f"is no gear. A smaller change of the ratio keeps it at {THIN * C:.3g} mm"
            raise GenevaError(text, ("drive", "kind"))
    return [(float(r.min()), float(r.max())) for r in (driven, driver)]


def pitch_curve(gears: Gears, sense: float, driver: bool, phi: Array) -> tuple[Array, Array]:
    """Return points, mm, and unit tangents of a gear's pitch curve about its own axis.

    ``phi`` are angles of the input, radians, ``sense`` that of the crank, 1 for counterclockwise;
    the ``driver`` turns against it.
    """
    ratio, turned = ratio_and_turn(gears, phi)
    i, slope = (array(c) for c in ratio.derivatives()[:2])
    whole, size = gears.distance_mm / (1.0 + i), i if driver else 1.0  # r1 over r2 is i
    r, change = whole * size, whole * slope / (1.0 + i) * (1.0 if driver else -1.0)
    spin = 1j * sense * (1.0 if driver else -i)
    turn = (turned.real - 1j * sense * turned.imag).astype(np.clongdouble)
    direction = -np.exp(1j * sense * phi.astype(np.longdouble)) if driver else turn
    place, speed = r * direction, (change + spin * r) * direction
    tangent = speed / np.abs(speed)
    # as doubles; processors differ in products of complex doubles
    at, along = (np.column_stack((z.real, z.imag)).astype(np.float64) for z in (place, tangent))
    return at, along


def ratio_and_turn(gears: Gears, phi: np.ndarray) -> tuple[Jet, np.ndarray]:
    """Return the ratio with two derivatives by the input's angle, and the driven gear's turn."""
    sine, versine = gears.advance(phi, 3)
    cosine = 1.0 - versine
    ratio = sine.derivative() * cosine.lower + versine.derivative() * sine.lower
    return ratio, array(cosine.c[0]) + 1j * array(sine.c[0])


def gear_span(mechanism: Mechanism, parts: Outlines | None) -> tuple[float, float]:
    """Return lower and upper face of both gears, in a plane below all links."""
    return link_sizes(mechanism, [], parts).span(gear_plane(mechanism))


def gear_pair(
    parts: EdgedParts, drawn: Outlines | None, on_crank: float = 0.0
) -> tuple[Member, ...]:
    """Return both gears up to their pitch curves; none without noncircular gears.

    ``on_crank`` is the radius of the crank's shaft if it does not follow from the outlines
    ``drawn``.
    """
    mechanism, pair = parts.mechanism, parts.mechanism.spec.gears
    if pair is None:
        return ()
    write, span = parts.writer(FINE["cubics"] * pair.distance_mm), gear_span(mechanism, drawn)
    curves = [partial(pitch_curve, pair, mechanism.gear_shaft.sense, own) for own in (False, True)]
    (axis, wide), (other, own), bored = _shafts(mechanism, drawn, on_crank)
    bores = (axis, wide, "arm_bore_mm"), (other, own if bored else Bore(0.0), "link_bore_mm")
    rows, members = zip(GEARS, curves, pitch_radii(pair), bores, strict=True), []
    for name, curve, (least, _), (at, on, key) in rows:
        text = f"no blank of the {name} is left: its bore of {2.0 * on.reach:.6g} mm must be below "
        text += f"{2.0 * least:.6g}, twice its least radius; reduce {key}"
        refuse_size(on.reach >= least, key, text)
        holes = (on.hole(),) if on.radius else ()
        outline = closed("PITCH", list(write(curve, -np.pi, np.pi)))
        members.append(Member(Plate(name, "PITCH", outline, holes, *span), at))
    return tuple(members)


def gear_shafts(
    mechanism: Mechanism, parts: Outlines | None, lowest: float, shaft: bool, on_crank: float = 0.0
) -> Iterator[Shaft]:
    """Yield the shafts that carry only gears, from the frame's lower face up; none without gears.

    The driver's shaft goes through it, or ends below one that is too small for a bore. With
    ``shaft`` the crank has its own.
    """
    if mechanism.spec.gears is None:
        return
    (first, wide), (at, own), bored = _shafts(mechanism, parts, on_crank)
    under, over = gear_span(mechanism, parts)
    at_crank = same(first, mechanism.crank_shaft.at, mechanism.center_distance_mm)
    if at_crank and not (shaft or _on_links(mechanism, parts)):
        reach = shaft_ends(mechanism.spec.size, "crank", lowest, over)
        yield Shaft("crank's shaft", "crank", wide, *reach, first)
    top = over if bored else under  # or one piece with it
    yield Shaft("driver gear's shaft", "driver gear", own, lowest, top, at)


def _shafts(
    mechanism: Mechanism, parts: Outlines | None, on_crank: float
) -> tuple[tuple[Point, Bore], tuple[Point, Bore], bool]:
    """Return position and bore of both gears' shafts, and whether the driver is bored for it."""
    pair, L = required_gears(mechanism), mechanism.center_distance_mm
    sizes, ((driven, _), (driver, _)) = link_sizes(mechanism, [], parts), pitch_radii(pair)
    usual, x = bore_radius(L / 20.0), mechanism.gear_shaft.x_mm
    wide = on_crank or _on_links(mechanism, parts) or sizes.crank_shaft
    wide = wide or sizes.bore(driven, L) or usual
    own = sizes.bore(driver, L)
    axis, bore = (x, 0.0), round_bore(mechanism.spec.size, own or usual)
    return (axis, bore_at(mechanism, axis, wide)), ((x + pair.distance_mm, 0.0), bore), own > 0.0


def _on_links(mechanism: Mechanism, parts: Outlines | None) -> float:
    """Return the radius of the driven gear's shaft where links are on it; 0 without links."""
    L = mechanism.center_distance_mm
    return drawn_links(mechanism, parts).shaft(mechanism.gear_shaft.at, L)
