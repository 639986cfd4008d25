"""What a stop refuses, and which keys are a stop's only."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.motion.compatible import Conflict
from geneva_cli.motion.machine_spec import Spec


def refuses(spec: Spec) -> Iterator[Conflict]:
    """Rules of a recess that stops the crank; without one, of the keys of its load and limit."""
    if not spec.wheel.stopped:
        yield (
            spec.load.winding_torque_Nm is not None,
            ("load", "winding_torque_Nm"),
            "winding_torque_Nm acts on a stop: set stop = true in [wheel] of an external wheel",
        )
        yield (
            spec.limits.stop_stress_max_MPa is not None,
            ("limits", "stop_stress_max_MPa"),
            "stop_stress_max_MPa limits a stop: set stop = true in [wheel] of an external wheel",
        )
        return
    drive, key = spec.drive, ("wheel", "stop")
    yield (
        not drive.crank or drive.first_wheel(spec.given_distance_mm) or spec.motion,
        key,
        "stop needs straight slots and a crank without a first wheel: remove stop, or law and kind",
    )
    yield (
        drive.rollers > 1 or drive.roller_angles_deg,
        key,
        "stop needs a crank with one roller: remove rollers and roller_angles_deg",
    )
    yield (
        spec.wheel.skewed,
        key,
        "stop needs radial slots and equal steps: remove offset_mm and steps_deg",
    )
    yield (
        spec.size.lock_radius_mm == 0.0,
        ("size", "lock_radius_mm"),
        "stop needs the locking disc, which meets the convex face: remove lock_radius_mm = 0",
    )
