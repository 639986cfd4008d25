"""The crank arm, which carries the rollers' pins, and the crank's solids, in the crank's frame.

The arm's outline is the convex hull of a hub about the crank's shaft, and of eyes about pins and
bolts. An internal wheel's shaft ends in the arm, whose hub carries the locking sectors.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import Plate, least_wall
from geneva_cli.geometry.shapes import ORIGIN, Circle, Contour, Shape, convex_hull, polar
from geneva_cli.parts.outlines.crank_outline import (
    crank_circles,
    is_whole,
    keyway_direction,
    reliefs,
    sectors,
)
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.bores import bore_of, has_shape
from geneva_cli.parts.shafts.screws import bolt_radius, refuse_no_screw, tapped
from geneva_cli.parts.sizes import hub_and_eye, lock_bolt_directions, pin_hole, wall_of_bolts
from geneva_cli.parts.slots.roller_paths import roller_centres
from geneva_cli.spec.defaults import eye_about


class CrankArm(NamedTuple):
    """The arm as it is cut, and the radii of its hub and of the widest eye about a pin."""

    outline: Contour
    bore: Shape
    pins: list[Circle]
    bolts: list[Circle]  # tapped, for the screws of the locking disc
    hub: float
    eye: float
    hub_gap: float  # from the arm's end to the wheel's shaft or hub; infinite if internal


def crank_arm(parts: Outlines) -> CrankArm:
    """Return the arm of a machine."""
    assembly, sizes, drive = parts.assembly, parts.sizes, parts.assembly.full.spec.drive
    size, radius, wall = assembly.full.spec.size, sizes.arm_bore, sizes.wall_min
    if not drive.ONE_ARM:
        raise GenevaError(
            f'--part arm: kind = "{drive.NAME}" carries its roller on no crank arm; '
            "--part parts lists its links",
            ("drive", "kind"),
        )
    centres, hole = roller_centres(assembly), pin_hole(size, sizes.pin)
    away = [math.hypot(*c) for c in centres]
    # the wheel's hub stands on the roller's side, where the arm's end passes below the wheel
    passing = sizes.passing_eye(assembly.L - max(away))
    free = 0.0 if size.has_hub("wheel") else max(sizes.wheel_hub - sizes.wheel_bore, 0.0)
    standing = 0.0 if is_whole(assembly, sizes) else sizes.lock  # the sectors stand on the hub
    form = bore_of(size, "crank", radius)
    hub, eye = hub_and_eye(size, wall, hole, radius, passing, standing)
    if form.reach + hole >= min(away):
        raise GenevaError(
            f"arm_bore_mm = {2.0 * radius:g}: the bore cuts the pin's hole; with its keyway it "
            f"must be below {2.0 * (min(away) - hole):.6g}",
            ("size", "arm_bore_mm"),
        )
    screwed, bolted = bolts(parts), wall_of_bolts(size, wall)
    about = [Circle("ARM", (0.0, 0.0), hub), *(Circle("ARM", c, eye) for c in centres)]
    about += [Circle("ARM", c.centre, eye_about(c.radius, bolted)) for c in screwed]
    return CrankArm(
        convex_hull("ARM", about),
        form.shape("BORE", keyway_direction(assembly)),
        [Circle("BORE", c, hole) for c in centres],
        [tapped(one) for one in screwed],
        hub,
        eye,
        passing + free - eye,
    )


def bolts(parts: Outlines) -> list[Circle]:
    """Return the holes of bolts that fix the locking disc to the arm, evenly in each sector.

    By default there are as many as leave walls in disc and arm, up to two in each sector, where the
    arm passes the wheel's hub, unless a key, a flat or a hexagon holds both.
    """
    assembly, sizes = parts.assembly, parts.sizes
    size = assembly.mechanism.spec.size
    if size.lock_bolts is not None:
        return _bolts(parts, size.lock_bolts)
    held = has_shape(size, "crank") and sizes.crank_bore > 0.0
    if held or not (parts.crank and parts.has_arm):
        return []
    wall = wall_of_bolts(size, sizes.wall_min)
    pins = [Circle("BORE", c, pin_hole(size, sizes.pin)) for c in roller_centres(assembly)]
    shaft = Circle("BORE", (0.0, 0.0), bore_of(size, "crank", sizes.arm_bore).reach)
    for count in (2, 1):
        screwed = _bolts(parts, count)
        reach = max(
            (math.hypot(*c.centre) + eye_about(c.radius, wall) for c in screwed), default=0.0
        )
        passing = (
            assembly.L - max(sizes.wheel_bore, sizes.wheel_hub) >= reach or assembly.sign < 0.0
        )
        apart = bool(screwed) and least_wall([shaft, *pins, *screwed]) >= wall
        if passing and apart and least_wall(screwed, parts.crank) >= wall:
            return screwed
    return []


def _bolts(parts: Outlines, count: int) -> list[Circle]:
    """Return the holes of so many bolts in each sector, all of one size."""
    size, L = parts.assembly.mechanism.spec.size, parts.assembly.L
    spans = sectors(reliefs(parts.assembly)) if parts.crank and count else []
    directions = lock_bolt_directions([(start, end - start) for start, end in spans], count)
    rings = [_widest(parts, at) for at in directions]
    r = bolt_radius(size.lock_bolt_mm, L, min((half for _, half in rings), default=0.0))
    if directions:
        refuse_no_screw("lock_bolt", size.lock_bolts or 0, r)
    return [
        Circle("BORE", polar(ORIGIN, far, turn), r)
        for (far, _), at in zip(rings, directions, strict=True)
        for turn in at
        if r
    ]


def _widest(parts: Outlines, at: list[float]) -> tuple[float, float]:
    """Return the radius at which bolts leave the widest walls in the disc, and half of these."""
    own = parts.assembly.mechanism.spec.size.lock_bolt_circle_mm
    # 400 radii: their spacing is far below a wall
    radii = np.linspace(0.0, parts.sizes.lock, 400) if own is None else np.array([0.5 * own])
    points = [np.outer(radii, f(np.asarray(at))).ravel() for f in (np.cos, np.sin)]
    walls = -Polyarc(parts.crank).signed(np.column_stack(points)).reshape(len(radii), len(at))
    inner = parts.sizes.arm_bore if parts.has_arm else parts.sizes.crank_bore
    nearest = np.minimum(walls, radii[:, None] - inner).min(axis=1)
    best = int(nearest.argmax())
    return float(radii[best]), max(0.0, float(nearest[best]))


def walls(arm: CrankArm, parts: Outlines) -> float:
    """Return the least wall around the arm's holes, and around the disc's bolts and keyway."""
    in_disc: list[Shape] = [*bolts(parts)]
    if parts.sizes.crank_bore and is_whole(parts.assembly, parts.sizes):
        in_disc += [s for s in crank_circles(parts.assembly, parts.sizes) if s.layer == "BORE"]
    return min(
        least_wall([arm.bore, *arm.pins, *arm.bolts], [arm.outline]),
        least_wall(in_disc, parts.crank),
    )


def arm_plate(parts: Outlines, arm: CrankArm) -> Plate:
    """Return the crank arm below the wheel, at a distance of ``pin_gap_mm``."""
    high = -parts.assembly.mechanism.spec.size.allowances.pin_gap_mm
    holes = (arm.bore, *arm.pins, *arm.bolts)
    low = high - parts.sizes.arm_thickness
    return Plate("arm", arm.outline.layer, arm.outline, holes, low, high)


def locking_plates(parts: Outlines) -> list[Plate]:
    """Return the crank's locking disc, or its sectors, with bolts and bore."""
    assembly, sizes = parts.assembly, parts.sizes
    low = -assembly.mechanism.spec.size.allowances.pin_gap_mm  # the disc stands on the arm
    high = low + sizes.lock_thickness
    whole = is_whole(assembly, sizes)
    bores = [c for c in crank_circles(assembly, sizes) if c.layer == "BORE" and whole]
    screwed = bolts(parts)
    each = len(screwed) // max(1, len(parts.crank))
    name = "locking disc" if whole else "locking sector"
    return [
        Plate(
            name, contour.layer, contour, (*bores, *screwed[k * each : (k + 1) * each]), low, high
        )
        for k, contour in enumerate(parts.crank)
    ]


def roller_plates(
    radius: float, pin_radius: float, low: float, high: float, fit: float
) -> list[Plate]:
    """Return a roller in the wheel's plane, up to ``high``, and its pin from ``low`` to there.

    The roller's bore is wider than the pin by ``fit`` mm of the diameter.
    """
    outline = Circle("ROLLER", ORIGIN, radius)
    if not pin_radius:
        return [Plate("roller", "ROLLER", outline, (), 0.0, high)]
    pin, bore = (Circle("ROLLER", ORIGIN, r) for r in (pin_radius, pin_radius + 0.5 * fit))
    return [
        Plate("roller", "ROLLER", outline, (bore,), 0.0, high),
        Plate("pin", "ROLLER", pin, (), low, high),
    ]
