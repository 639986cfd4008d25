"""The dimensions of the parts that their strength depends on: pin, shafts, arm and keys.

A shaft's bearing is in the middle of the frame, or of a bridge above the crank. Its overhang is the
distance from there to the middle of the wheel's thickness, unless the spec has one.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.loads.strength.arm_and_key import NO_ARM, NO_KEY, ArmDimensions, KeyDimensions
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.parts.assembly import Assembly, gear_plane, is_bridged, links_at
from geneva_cli.parts.outlines.crank_outline import is_whole
from geneva_cli.parts.outlines.outlines import wheel_hub_length
from geneva_cli.parts.shafts.bores import reach_or_bore
from geneva_cli.parts.sizes import Sizes, arm_hub, bridge_low, hole_radius, plane_span
from geneva_cli.spec.default_sizes import half_or, value_or
from geneva_cli.spec.keyways import key
from geneva_cli.spec.least_wall import eye_about


class Unloaded(NamedTuple):
    """The parts of a machine as they are without a load."""

    assembly: Assembly
    sizes: Sizes
    space: float  # radius about the crank's axis inside the relief, mm
    lock: Lock | None  # as it is cut, which no load changes


class ShaftSize(NamedTuple):
    """Diameter and overhang of a shaft, mm; NaN for none."""

    diameter: float
    overhang: float


class Stressed(NamedTuple):
    """Dimensions of stressed parts, mm; NaN where a part does not exist."""

    contact: float  # length of the contact line, by default the wheel's thickness
    pin: float  # diameter; 0 for a roller that is its own pin
    wheel_shaft: ShaftSize
    crank_shaft: ShaftSize
    arm: ArmDimensions
    wheel_key: KeyDimensions
    crank_key: KeyDimensions


def stressed(assembly: Assembly, sizes: Sizes) -> Stressed:
    """Return the dimensions of a machine's parts, for parts of these sizes."""
    spec, L = assembly.full.spec, assembly.L
    size, thick, wide = spec.size, sizes.arm_thickness, sizes.wheel_thickness
    contact = value_or(size.face_width_mm, wide)
    hub_mm = 0.0  # length of the wheel's hub
    if size.has_hub("wheel") and sizes.wheel_hub > sizes.wheel_bore:
        hub_mm = wheel_hub_length(size, sizes)
    gap, washer, machine = size.allowances.pin_gap_mm, size.washer_mm, assembly.full
    first = thick if spec.drive.ONE_ARM else sizes.link_thickness

    def low(plane: int) -> float:
        return plane_span(plane, gap, first, sizes.link_thickness, washer)[0]

    lows = [-hub_mm, -gap - (thick if sizes.arm_bore else 0.0)]
    lows += [low(link.plane) for link in links_at(machine, np.zeros(1))]
    if spec.gears:
        lows.append(low(gear_plane(machine)))
    if machine.engagements[0].groove is not None:  # as ``groove_plate`` has its base
        lows.append(low(3) if spec.drive_before else low(2) - thick)
    # from the middle of the wheel's thickness to the frame's upper face
    on_wheel = on_crank = 0.5 * wide - min(lows) + washer, thick
    if sizes.crank_bore and is_bridged(machine):
        on_crank = bridge_low(size, sizes) - 0.5 * wide, thick
    arm = NO_ARM
    if sizes.arm_bore and sizes.pin:
        _, long = sizes.reaches
        standing = 0.0 if is_whole(assembly, sizes) else sizes.lock
        hole = hole_radius(size, sizes.pin)
        bored = reach_or_bore(size, "crank", sizes.arm_bore)
        hub = arm_hub(size, bored, sizes.arm_bore, sizes.wall_min, standing)
        passing = sizes.passing_eye(L - long)
        eye = half_or(size.arm_eye_mm, eye_about(hole, sizes.wall_min, passing))
        offset = 0.5 * (contact + thick) + gap
        arm = ArmDimensions(long, hub, eye, bored, hole, thick, offset)
    return Stressed(
        contact,
        2.0 * sizes.pin,
        shaft_of(spec, "wheel", sizes.wheel_bore, *on_wheel),
        shaft_of(spec, "crank", sizes.arm_bore or sizes.crank_bore, *on_crank),
        arm,
        key_of(size.wheel_keyway, sizes.wheel_bore, wide + hub_mm),
        key_of(size.crank_keyway, sizes.arm_bore, thick),
    )


def shaft_of(spec: Spec, part: str, bore: float, to_frame: float, thick: float) -> ShaftSize:
    """Return a shaft of the spec's dimensions, or else as it is in its bearing; NaN for none.

    It is as wide as its bore, and borne in the middle of a frame ``thick`` mm, whose upper face is
    ``to_frame`` mm from the contact's middle.
    """
    table = vars(spec.shaft)
    diameter, overhang = 2.0 * bore or math.nan, to_frame + 0.5 * thick
    own = table[f"{part}_diameter_mm"], table[f"{part}_overhang_mm"]
    return ShaftSize(value_or(own[0], diameter), value_or(own[1], overhang))


def key_of(standard: str | None, bore: float, length: float) -> KeyDimensions:
    """Return the dimensions of a key in a bore; NaN without one."""
    try:
        fitted = key(standard, bore) if bore else None
    except GenevaError:  # reported where the part is cut
        fitted = None
    if fitted is None:
        return NO_KEY
    bearing = fitted.height - fitted.in_shaft
    return KeyDimensions(2.0 * bore, fitted.width, bearing, length)
