"""What a stop refuses, and which keys are a stop's only."""

from collections.abc import Iterator

from geneva_cli.motion.compatible import HORNS, Conflict, unset
from geneva_cli.motion.machine_spec import Spec


def refuses(spec: Spec) -> Iterator[Conflict]:
    """Rules of a recess that stops the crank; without one, of the keys of its load and limit."""
    if not spec.wheel.stopped:
        why = "is for a stop; set stop = true in [wheel] of an external wheel, or"
        yield from unset(spec, "load.winding_torque_Nm limits.stop_stress_max_MPa", why)
        return
    drive = spec.drive
    plain = drive.crank and not drive.first_wheel(spec.given_distance_mm) and not spec.motion
    one = drive.rollers == 1 and not drive.roller_angles_deg
    text = "stop needs equal radial slots and a plain crank with one roller: remove law, kind, "
    text += "rollers, roller_angles_deg, offset_mm and steps_deg"
    yield not (plain and one) or spec.wheel.skewed, ("wheel", "stop"), text
    text = "stop needs the locking disc, which meets the convex face: remove lock_radius_mm = 0"
    yield spec.size.lock_radius_mm == 0.0, ("size", "lock_radius_mm"), text
    yield from unset(spec, HORNS, "is for wheels with a recess behind every slot; remove stop, or")
