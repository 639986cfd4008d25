"""A Geneva stop: it blocks the crank at both ends, on the face, and nothing touches before."""

from __future__ import annotations

from geneva_cli.loads.strength.stop import stop_contact
from geneva_cli.outlines.stop import WheelStop, clearances_before, wheel_stop
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.verdict.checks.check import Check, compared


def turns(name: str, parts: FlatParts) -> Check | None:
    """The turns from stop to stop: a degree beyond each of them disc and face overlap."""
    stop = _stop(parts)
    if stop is None:
        return None
    outlines, z = parts.outlines, parts.mechanism.spec.wheel.z
    beyond = clearances_before(outlines, stop, past_deg=1.0)[:, -1]
    blocks = bool((beyond < -outlines.contact).all())
    text = (
        f"the face blocks the crank at {stop.first_deg:.4g} and {stop.last_deg:.6g} deg from the "
        f"middle of its first engagement: {stop.turns:.4f} turns"
        if blocks
        else f"the disc slips past the face: {-beyond.max():.4g} mm of overlap a degree beyond it"
    )
    return Check(name, stop.turns, "at most", float(z), blocks, text)


def gap(name: str, parts: FlatParts) -> Check | None:
    """The smallest gap of disc and wheel in the half turn before each stop."""
    stop = _stop(parts)
    if stop is None:
        return None
    smallest = float(clearances_before(parts.outlines, stop).min())
    return compared(name, smallest, "at least", 0.0, noise=parts.outlines.contact)


def face(name: str, parts: FlatParts) -> Check | None:
    """The length of the face from the contact to the nearer mouth."""
    stop = _stop(parts)
    if stop is None:
        return None
    return compared(name, stop.face_mm, "at least", parts.outlines.sizes.wall_min)


def stress(name: str, parts: FlatParts) -> Check | None:
    """The Hertz stress of disc and face, where ``lock_stress_max_MPa`` bounds it."""
    stop, spec = _stop(parts), parts.mechanism.spec
    limit = spec.limits.lock_stress_max_MPa
    if stop is None or limit is None or spec.load.winding_torque_Nm is None:
        return None
    value = stop_contact(parts.mechanism, stop.lever_mm, parts.outlines.sizes.rim)
    if value.contact_stress_MPa is None:
        why = "not known: it needs face_width_mm and lock_edge_mm in [size]"
        return Check(name, None, "at most", limit, None, why)
    return compared(name, value.contact_stress_MPa, "at most", limit)


def _stop(parts: FlatParts) -> WheelStop | None:
    return wheel_stop(parts.outlines) if parts.mechanism.spec.is_flat else None
