"""The crank arm: the plate below the wheel's plane that carries the rollers' pins.

Its frame is the crank's, as that of the locking disc, which lies on it. Its outline is the belt
round a hub about the crank's shaft and an eye about each pin and each bolt of the disc: one arm of
two eyes for one roller, a plate that joins all for several. The shaft of an internal wheel's crank
ends in it, below the wheel: the crank is overhung, and its hub is a disc that carries the locking
sectors.
"""

from __future__ import annotations

import math
from itertools import combinations
from typing import NamedTuple

import numpy as np

from geneva_cli.curves.belt import belt
from geneva_cli.curves.distance import Polyarc
from geneva_cli.curves.shapes import Circle, Contour, Shape
from geneva_cli.errors import GenevaError
from geneva_cli.parts.crank import crank_circles, is_whole, roller_centres
from geneva_cli.parts.hole_walls import apart, beyond
from geneva_cli.parts.keyways import bore, key, reach
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.reliefs import keyway_direction, sectors
from geneva_cli.parts.sizes import even

LAYER, HOLES = "ARM", "BORE"
HUB = 1.6  # of the bore: how wide the arm is round it
EYE = 2.0  # of a hole: how wide the arm is round it, where there is room
RADII = 400  # at which the locking disc is looked at for its bolts


class CrankArm(NamedTuple):
    """The arm as it is cut, and the radii of its hub and of the widest eye about a pin."""

    outline: Contour
    bore: Shape
    pins: list[Circle]
    bolts: list[Circle]
    hub: float
    eye: float
    room: float  # between the arm's end and the wheel's shaft or hub; infinite inside


def has_arm(found: Outlines) -> bool:
    """Whether there is an arm: rollers on pins in a crank."""
    return found.assembly.given.spec.drive.ONE_ARM and found.sizes.pin > 0.0


def crank_arm(found: Outlines) -> CrankArm:
    """The arm of a machine.

    Raises GenevaError, naming the key, where the rollers are on no crank, or the sizes leave no
    arm round the holes.
    """
    assembly, sizes = found.assembly, found.sizes
    spec = assembly.given.spec
    if not spec.drive.ONE_ARM:
        raise GenevaError(
            f'--part arm: kind = "{spec.drive.NAME}" carries its roller on no crank arm; '
            "--part parts lists its links",
            ("drive", "kind"),
        )
    hole = sizes.pin - 0.5 * spec.size.allowances.press_fit_mm
    if hole <= 0.0:
        raise GenevaError(
            f"--part arm: there is no hole for a pin of pin_mm = {2.0 * sizes.pin:g} with "
            f"press_fit_mm = {spec.size.allowances.press_fit_mm:g}; the pin must be the larger",
            ("size", "press_fit_mm" if sizes.pin else "pin_mm"),
        )
    centres = roller_centres(assembly)
    far = max(math.hypot(*c) for c in centres)
    radius = shaft_bore(found)
    fitted = key(spec.size.crank_keyway, radius)
    deep = reach(spec.size.crank_keyway, radius)
    wall = sizes.wall_min
    under = 0.0 if is_whole(assembly, sizes) else sizes.lock  # the sectors stand on it
    hub = _half_or(spec.size.arm_hub_mm, max(even(HUB * radius), deep + wall, under))
    # the wheel's hub stands on the roller's side, where the arm's end passes below the wheel
    most = (
        assembly.L - far - max(sizes.wheel_bore, sizes.wheel_hub)
        if assembly.sign > 0.0
        else math.inf
    )
    usual = max(min(EYE * hole, most), hole + wall)
    eye = _half_or(spec.size.arm_eye_mm, usual)
    _refuse(found, radius, deep, hub, hole, eye)
    pins = [Circle(HOLES, c, hole) for c in centres]
    screwed = bolts(found)
    about = [Circle(LAYER, (0.0, 0.0), hub), *(Circle(LAYER, c, eye) for c in centres)]
    about += [Circle(LAYER, c.centre, max(EYE * c.radius, c.radius + wall)) for c in screwed]
    outline = belt(LAYER, about)
    turned = keyway_direction(assembly)
    return CrankArm(
        outline, bore(HOLES, radius, fitted, turned), pins, screwed, hub, eye, most - eye
    )


def bolts(found: Outlines) -> list[Circle]:
    """The holes of the bolts that fix the locking disc to the arm, evenly in each of its sectors.

    Raises GenevaError where there is no disc to fix.
    """
    size = found.assembly.mechanism.spec.size
    if not size.lock_bolts:
        return []
    if not found.crank:
        raise GenevaError(
            "lock_bolts: there is no locking disc to fix; remove it", ("size", "lock_bolts")
        )
    r = _half_or(size.lock_bolt_mm, found.assembly.L / 80.0)
    made = []
    for start, end in sectors(found.assembly):
        at = [start + (end - start) * (k + 0.5) / size.lock_bolts for k in range(size.lock_bolts)]
        far = _half_or(size.lock_bolt_circle_mm, 0.0) or _widest(found, at)
        made += [Circle(HOLES, (far * math.cos(a), far * math.sin(a)), r) for a in at]
    return made


def _widest(found: Outlines, at: list[float]) -> float:
    """The radius at which bolts in some directions leave the widest walls in the disc."""
    radii = np.linspace(0.0, found.sizes.lock, RADII)
    a = np.asarray(at)
    points = [np.outer(radii, f(a)).ravel() for f in (np.cos, np.sin)]
    walls = -Polyarc(found.crank).signed(np.column_stack(points)).reshape(RADII, len(at))
    if found.sizes.crank_bore:
        walls = np.minimum(walls, radii[:, None] - found.sizes.crank_bore)
    return float(radii[int(walls.min(axis=1).argmax())])


def shaft_bore(found: Outlines) -> float:
    """The radius of the shaft's bore, through the disc or ending below the wheel."""
    spec = found.assembly.given.spec
    if spec.size.arm_bore_mm is not None:
        return 0.5 * spec.size.arm_bore_mm
    if found.sizes.crank_bore:
        return found.sizes.crank_bore
    if spec.shaft.crank_diameter_mm is not None:
        return 0.5 * spec.shaft.crank_diameter_mm
    hole = found.sizes.pin - 0.5 * spec.size.allowances.press_fit_mm
    room = min(math.hypot(*c) for c in roller_centres(found.assembly)) - hole
    return even(min(found.assembly.L / 20.0, 0.35 * room))


def _half_or(diameter: float | None, default: float) -> float:
    return default if diameter is None else 0.5 * diameter


def _refuse(
    found: Outlines, radius: float, deep: float, hub: float, hole: float, eye: float
) -> None:
    """Raise GenevaError, naming the key, for sizes that leave no plate round a hole."""
    if hub <= deep:
        raise GenevaError(
            f"arm_hub_mm = {2.0 * hub:g}: the hub must be above {2.0 * deep:.6g}, its bore and "
            "keyway",
            ("size", "arm_hub_mm"),
        )
    if eye <= hole:
        raise GenevaError(
            f"arm_eye_mm = {2.0 * eye:g}: the eye must be above {2.0 * hole:.6g}, the pin's hole",
            ("size", "arm_eye_mm"),
        )
    least = min(math.hypot(*c) for c in roller_centres(found.assembly))
    if deep + hole >= least:
        raise GenevaError(
            f"arm_bore_mm = {2.0 * radius:g}: the bore runs into the pin's hole; with its keyway "
            f"it must be below {2.0 * (least - hole):.6g}",
            ("size", "arm_bore_mm"),
        )


def walls(made: CrankArm, found: Outlines) -> float:
    """The least wall round the arm's holes, and round bolts and keyway in the locking disc."""
    holes = [made.bore, *made.pins, *made.bolts]
    outline = Polyarc([made.outline])
    least = [-beyond(outline, hole) for hole in holes]
    least += [apart(one, two) for one, two in combinations(holes, 2)]
    in_disc: list[Shape] = [*made.bolts]
    if found.sizes.crank_bore:
        in_disc += [s for s in crank_circles(found.assembly, found.sizes) if s.layer == HOLES]
        least += [apart(in_disc[-1], bolt) for bolt in made.bolts]
    if found.crank:
        disc = Polyarc(found.crank)
        least += [-beyond(disc, hole) for hole in in_disc]
    return min(least)
