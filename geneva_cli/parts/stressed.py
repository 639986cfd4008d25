"""The dimensions of the parts that their strength depends on: pin, shafts, arm and keys."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.loads.strength.arm_and_key import NO_ARM, NO_KEY, ArmDimensions, KeyDimensions
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.arrays import half_or, value_or
from geneva_cli.parts.assembly import Assembly, gear_plane, is_bridged, links_at
from geneva_cli.parts.outlines.crank_outline import is_whole
from geneva_cli.parts.outlines.outlines import wheel_hub_length
from geneva_cli.parts.shafts.bores import reach_or_bore
from geneva_cli.parts.sizes import Sizes, arm_hub, bridge_low, plane_span
from geneva_cli.spec.defaults import eye_about, key


class Unloaded(NamedTuple):
    """The parts of a machine as they are without a load."""

    assembly: Assembly
    sizes: Sizes
    space: float  # radius about the crank's axis inside the relief, mm
    lock: Lock | None  # as it is cut, which no load changes


class ShaftSize(NamedTuple):
    """Diameter and overhang of a shaft, mm; NaN for none.

    The bearing is in the middle of the frame, or of a bridge above the crank, and the overhang is
    from there to the middle of the wheel's thickness, unless the spec has one.
    """

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
    spec, machine, size = assembly.full.spec, assembly.full, assembly.full.spec.size
    thick, wide, gap = sizes.arm_thickness, sizes.wheel_thickness, size.allowances.pin_gap_mm
    contact, hub_mm = value_or(size.face_width_mm, wide), 0.0
    if size.has_hub("wheel") and sizes.wheel_hub > sizes.wheel_bore:
        hub_mm = wheel_hub_length(size, sizes)
    # the lowest face of what is below the wheel; a groove's plate has its base below the groove
    lowest, planes = min(-hub_mm, -gap - (thick if sizes.arm_bore else 0.0)), []
    for link in links_at(machine, np.zeros(1)):
        planes.append((link.plane, 0.0))
    if spec.gears:
        planes.append((gear_plane(machine), 0.0))
    if machine.engagements[0].groove is not None:
        planes.append((3, 0.0) if spec.drive_before else (2, thick))
    first = thick if spec.drive.ONE_ARM else sizes.link_thickness
    for plane, base in planes:
        low, _ = plane_span(plane, gap, first, sizes.link_thickness, size.washer_mm)
        lowest = min(lowest, low - base)
    # from the middle of the wheel's thickness to the frame's upper face
    on_wheel = on_crank = 0.5 * wide - lowest + size.washer_mm, thick
    if sizes.crank_bore and is_bridged(machine):
        on_crank = bridge_low(size, sizes) - 0.5 * wide, thick
    arm = NO_ARM
    if sizes.arm_bore and sizes.pin:
        _, long = sizes.reaches
        hole = sizes.pin - 0.5 * size.allowances.press_fit_mm
        bored = reach_or_bore(size, "crank", sizes.arm_bore)
        standing = 0.0 if is_whole(assembly, sizes) else sizes.lock
        hub = arm_hub(size, bored, sizes.arm_bore, sizes.wall_min, standing)
        passing = sizes.passing_eye(assembly.L - long)
        eye = half_or(size.arm_eye_mm, eye_about(hole, sizes.wall_min, passing))
        arm = ArmDimensions(long, hub, eye, bored, hole, thick, 0.5 * (contact + thick) + gap)
    return Stressed(
        contact,
        2.0 * sizes.pin,
        shaft_of(spec, "wheel", sizes.wheel_bore, *on_wheel),
        shaft_of(spec, "crank", sizes.arm_bore or sizes.crank_bore, *on_crank),
        arm,
        key_of(size.wheel_keyway, sizes.wheel_bore, wide + hub_mm) if size.wheel_keyway else NO_KEY,
        key_of(size.crank_keyway, sizes.arm_bore, thick) if size.crank_keyway else NO_KEY,
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
        fitted = key(standard, bore) if bore and standard else None
    except GenevaError:  # reported where the part is cut
        fitted = None
    if fitted is None:
        return NO_KEY
    return KeyDimensions(2.0 * bore, fitted.width, fitted.height - fitted.in_shaft, length)
