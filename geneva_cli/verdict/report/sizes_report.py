"""Sizes in mm or, on a sphere, in degrees; the keys that the numbers of a report depend on."""

from __future__ import annotations

import math
from contextlib import suppress

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import scalar
from geneva_cli.parts.parts import Parts
from geneva_cli.verdict.quantities.batch_designs import Values, single
from geneva_cli.verdict.quantities.groups import ECHOED, only
from geneva_cli.verdict.quantities.load_quantities import pressure


def sizes(parts: Parts) -> Values:
    """Sizes of a flat wheel as cut, or of a spherical wheel as turned.

    The rim is None if the spec's sizes leave no wheel; the slots too if no wheel is drawn.
    """
    if not parts.mechanism.axes:
        return _sphere_sizes(parts.mechanism)
    return _flat_sizes(parts)


def _flat_sizes(parts: Parts) -> Values:
    mechanism = parts.mechanism
    spec = mechanism.spec
    L, r = mechanism.center_distance_mm, mechanism.roller_radius_mm
    return {
        "center_distance_mm": L,
        "crank_radius_mm": mechanism.ratio * L,
        "ratio": mechanism.ratio,
        "roller_radius_mm": r,
        "slot_width_mm": 2.0 * (r + spec.size.allowances.slot_clearance_mm),
        "clearances_from": spec.size.allowances.source,
        **_cut_radii(parts),
        "pressure_angle_max_deg": (
            only(single(mechanism).columns(pressure)["max_deg"])
            if mechanism.engagements[0].slot.curved
            else None
        ),
        "rollers_max": mechanism.rollers_max,
    }


def _cut_radii(parts: Parts) -> Values:
    """Radii of slots and rim as cut, mm."""
    mouth = bottom = rim = None
    spec = parts.mechanism.spec
    inside = spec.wheel.SIGN < 0.0
    if spec.is_flat:
        from geneva_cli.parts.assembly import assembly
        from geneva_cli.parts.machine_sizes import machine_sizes
        from geneva_cli.parts.slots.roller_paths import roller_paths

        where = assembly(parts.mechanism)
        ends = roller_paths(where).ends
        mouth = max(where.L * scalar(s.entry_reach) for s in where.kinds)
        bottom = max(ends) if inside else min(ends)
        with suppress(GenevaError):  # ``parts.none`` gives the reason
            rim = machine_sizes(parts.mechanism)[1].rim
    return {
        "slot_mouth_radius_mm": mouth,
        "slot_bottom_radius_mm": bottom,
        "wheel_radius_mm": None if inside else rim,
        "rim_radius_mm": rim if inside else None,
    }


def _sphere_sizes(mechanism: Mechanism) -> Values:
    """Sizes of a spherical wheel: the slot is a meridian between two polar angles."""
    engagement, L = mechanism.engagements[0], mechanism.center_distance_mm
    mouth, bottom = (engagement.slot(x, 0)[0].c[0] for x in (engagement.entry_deg, 0.0))
    return {
        **mechanism.spec.wheel.own_sizes,
        "sphere_radius_mm": L,
        "crank_arm_mm": mechanism.ratio * L,
        "roller_radius_mm": mechanism.roller_radius_mm,
        "clearances_from": mechanism.spec.size.allowances.source,
        "slot_mouth_polar_deg": math.degrees(mouth),
        "slot_bottom_polar_deg": math.degrees(bottom),
        "rollers_max": mechanism.rollers_max,
    }


def inputs(parts: Parts) -> Values:
    """The values of the keys that the numbers of a report depend on."""
    spec = parts.mechanism.spec
    known = {  # if a key is left out
        "wheel": {"held_by": spec.wheel.held_by},
        "size": spec.size.allowances._asdict(),
    }
    values: Values = {}
    for table, names in ECHOED.items():
        keys = spec.table(table) | known.get(table, {})
        values |= {f"{table}.{key}": keys[key] for key in names}
    return values
