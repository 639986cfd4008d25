"""Quantities of the stops of a crank, and the contact of disc and face."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.stop.parts import wheel_stop
from geneva_cli.loads.forces import contact_modulus_GPa, hertz_MPa
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.parts import Parts
from geneva_cli.spec.materials import wheel_material
from geneva_cli.verdict.quantities.batch_designs import Values


def stop(parts: Parts) -> Values:
    """Return the stops of a crank, where the wheel has a convex face."""
    if not (parts.mechanism.spec.wheel.stopped and parts.mechanism.spec.is_flat):
        return {}
    try:
        outlines = parts.outlines
    except GenevaError:  # ``parts.none`` gives the reason
        return {}
    stops = wheel_stop(outlines)
    assert stops is not None  # the wheel has a convex face
    contact = stop_contact(parts.mechanism, stops.lever_mm, outlines.sizes.rim)
    return {
        "turns": stops.turns,
        "first_deg": stops.first_deg,
        "last_deg": stops.last_deg,
        "overlap_mm": stops.overlap_mm,
        "lever_mm": stops.lever_mm,
        **contact._asdict(),
    }


class StopContact(NamedTuple):
    """Force and Hertz stress at a stop; None where a key is missing."""

    force_N: float | None
    contact_stress_MPa: float | None


def stop_contact(mechanism: Mechanism, lever_mm: float, face_radius_mm: float) -> StopContact:
    """Return the contact under ``winding_torque_Nm``; a sharp end of the disc has no stress.

    The face is an arc about the wheel's axis. So the force between the end of the disc and the face
    passes through that axis, turns no wheel, and loads no roller. About the crank's axis its lever
    is h = L sin delta, where delta is the contact's direction from the line of centres, seen from
    the wheel's axis: F = T/h.
    """
    size, torque = mechanism.spec.size, mechanism.spec.load.winding_torque_Nm
    if torque is None:
        return StopContact(None, None)
    force = 1e3 * torque / lever_mm
    if size.face_width_mm is None or size.lock_edge_mm is None:
        return StopContact(force, None)
    material = wheel_material(mechanism.spec)
    modulus = contact_modulus_GPa(material, material)
    radius = 1.0 / (1.0 / size.lock_edge_mm + 1.0 / face_radius_mm)
    return StopContact(force, hertz_MPa(modulus, force / size.face_width_mm, radius))
