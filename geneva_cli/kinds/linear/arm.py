"""The crank of a rack: the arm below the rack's plane, which carries locking sector and roller.

The rack sweeps over the crank's axis. So the shaft ends in the arm, as that of an internal wheel's
crank does, and the hub is a disc on which the locking sector stands.
"""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.hull import convex_hull
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Circle
from geneva_cli.geometry.stacks import least_wall
from geneva_cli.kinds.linear.rack import locking_sector, rack_sizes
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.arm import CrankArm, roller_plates
from geneva_cli.parts.shafts.bores import bore_of
from geneva_cli.parts.shafts.screws import bolt_radius, refuse_no_screw, tapped
from geneva_cli.parts.sizes import (
    arm_bore,
    drawn_thicknesses,
    hub_and_eye,
    lock_bolt_directions,
    pin_hole,
    pin_radius,
)
from geneva_cli.spec.default_sizes import half_or
from geneva_cli.spec.least_wall import wall_min


def rack_arm(mechanism: Mechanism) -> Plate:
    """Return the arm, whose x is from the crank's axis to the roller.

    Raises GenevaError, naming the key, where the sizes leave no arm around its holes.
    """
    size, sizes = mechanism.spec.size, rack_sizes(mechanism)
    thick, arm = drawn_thicknesses(size, sizes.arm), crank_arm(mechanism)
    outline, holes = arm.outline, (arm.bore, *arm.pins, *arm.bolts)
    least, needed = least_wall(holes, [outline]), wall_min(size, sizes.arm)
    if least < needed:
        raise GenevaError(
            f"--part arm: the least wall around the arm's holes is {least:.4g} mm, below {needed:g}"
            "; use a larger arm_eye_mm or arm_hub_mm, or a smaller arm_bore_mm, pin_mm or "
            "lock_bolt_mm",
            ("size", "arm_bore_mm"),
        )
    high = -size.allowances.pin_gap_mm
    return Plate("arm", "ARM", outline, holes, high - thick.arm, high)


def crank_arm(mechanism: Mechanism) -> CrankArm:
    """Return the arm: its outline about hub and eye, and the holes of shaft, pin and bolts."""
    size, sizes = mechanism.spec.size, rack_sizes(mechanism)
    R = sizes.arm
    hole, bore = pin_hole(size, pin_radius(size, sizes.roller)), rack_bore(mechanism)
    form = bore_of(size, "crank", bore)
    hub, eye = hub_and_eye(size, wall_min(size, R), hole, bore, math.inf, sizes.lock)
    outline = convex_hull("ARM", [Circle("ARM", (0.0, 0.0), hub), Circle("ARM", (R, 0.0), eye)])
    pins, bored = [Circle("BORE", (R, 0.0), hole)], form.shape("BORE", math.pi)
    threads = [tapped(hole) for hole in lock_bolts(mechanism)]
    return CrankArm(outline, bored, pins, threads, hub, eye, math.inf)


def rack_bore(mechanism: Mechanism) -> float:
    """Return the radius of the arm's bore, in which the crank's shaft ends."""
    size, sizes = mechanism.spec.size, rack_sizes(mechanism)
    hole = pin_hole(size, pin_radius(size, sizes.roller))
    # as if R were L/2, as for 6 slots
    return arm_bore(mechanism.spec, 0.0, 2.0 * sizes.arm, sizes.arm - hole)


def lock_bolts(mechanism: Mechanism) -> list[Circle]:
    """Return the holes of the bolts that fix the locking sector to the arm, 2 by default."""
    size, sizes = mechanism.spec.size, rack_sizes(mechanism)
    count = size.lock_bolts
    if count is None:
        count = 2 if sizes.lock else 0
    half_turn = [(0.5 * math.pi, math.pi)] if sizes.lock else []
    away = half_or(size.lock_bolt_circle_mm, 0.5 * (sizes.floor + sizes.lock))
    half_width = min(away - sizes.floor, sizes.lock - away)
    turns = [turn for some in lock_bolt_directions(half_turn, count) for turn in some]
    r = bolt_radius(size.lock_bolt_mm, 2.0 * sizes.arm, half_width)
    refuse_no_screw("lock_bolt", size.lock_bolts or 0, r)
    at = [(away * math.cos(turn), away * math.sin(turn)) for turn in turns if r]
    return [Circle("BORE", centre, r) for centre in at]


def rack_crank(mechanism: Mechanism) -> tuple[Member, ...]:
    """Return locking sector, roller and pin in the arm's frame; the sector stands on the arm."""
    size, sizes = mechanism.spec.size, rack_sizes(mechanism)
    thick = drawn_thicknesses(size, sizes.arm)
    sector, stands = locking_sector(sizes), -size.allowances.pin_gap_mm
    pin, fit = pin_radius(size, sizes.roller), size.allowances.shaft_fit_mm
    turned = roller_plates(sizes.roller, pin, stands - thick.arm, thick.wheel, fit)
    members = [Member(one, (sizes.arm, 0.0)) for one in turned]
    if sector is not None:
        holes, high = tuple(lock_bolts(mechanism)), stands + thick.lock
        members.append(Member(Plate("locking sector", "CRANK", sector, holes, stands, high)))
    return tuple(members)
