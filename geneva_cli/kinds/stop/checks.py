"""A Geneva stop: it blocks the crank at both ends, and the face bears the torque."""

from __future__ import annotations

from geneva_cli.kinds.stop.parts import WheelStop, clearances_before, stop_contact, wheel_stop
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.verdict.checks.check import Check, compared


def turns(name: str, parts: FlatParts) -> Check | None:
    """The turns from stop to stop: nothing touches before, and a degree beyond parts overlap."""
    stop = _stop(parts)
    if stop is None:
        return None
    outlines, z = parts.outlines, parts.mechanism.spec.wheel.z
    before = float(clearances_before(outlines, stop).min())
    beyond = float(clearances_before(outlines, stop, past_deg=1.0)[:, -1].max())
    if stop.face_mm < 0.0:
        text = "the disc meets the mouth of a slot, not the face"
    elif before < -parts.contact:
        text = f"disc and wheel overlap by {-before:.4g} mm before the stop"
    elif beyond > -parts.contact:
        text = "the disc slips past the face: a degree beyond the stop they do not overlap"
    else:
        text = (
            f"the face blocks the crank at {stop.first_deg:.4g} and {stop.last_deg:.6g}° from "
            f"the middle of its first engagement: {stop.turns:.4f} turns"
        )
        return Check(name, stop.turns, "at most", float(z), True, text)
    return Check(name, stop.turns, "at most", float(z), False, text)


def overlap(name: str, parts: FlatParts) -> Check | None:
    """How far the circles of disc and face overlap, so that wear does not free the crank."""
    stop = _stop(parts)
    if stop is None:
        return None
    return compared(name, stop.overlap_mm, "at least", parts.outlines.sizes.wall_min)


def stress(name: str, parts: FlatParts) -> Check | None:
    """The Hertz stress of disc and face, where ``[limits]`` bounds it."""
    stop, limit = _stop(parts), parts.mechanism.spec.limits.stop_stress_max_MPa
    if stop is None or limit is None:
        return None
    force, value = stop_contact(parts.mechanism, stop.lever_mm, parts.outlines.sizes.rim)
    if value is None:
        needs = "lock_edge_mm in [size]: the end of the disc is sharp"
        if force is None:
            needs = "winding_torque_Nm in [load]"
        why = f"not known: it needs {needs}"
        return Check(name, None, "at most", limit, None, why)
    return compared(name, value, "at most", limit)


def _stop(parts: FlatParts) -> WheelStop | None:
    return wheel_stop(parts.outlines) if parts.mechanism.spec.is_flat else None
