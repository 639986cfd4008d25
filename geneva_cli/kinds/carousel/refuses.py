"""What a carousel refuses."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.drives.refuses import of_transmission, other_wheels
from geneva_cli.motion.compatible import Conflict
from geneva_cli.motion.machine_spec import Spec


def refuses(spec: Spec) -> Iterator[Conflict]:
    """Rules of wheels on a carrier."""
    yield other_wheels(spec)
    yield from of_transmission(spec)
    drive = spec.drive
    yield Conflict(
        drive.stop_s != 0.0,
        ("drive", "stop_s"),
        'kind = "{spec.drive.NAME}" carries its wheels round at a constant speed: remove stop_s',
    )
    yield Conflict(
        spec.unbalanced,
        ("mass", "radius_mm"),
        'kind = "{spec.drive.NAME}" needs balanced wheels, as a body off the axis would pull in '
        "another direction in each motion: set count to 2 or more, or radius_mm = 0",
    )
    if drive.wheels_on_carrier > 1:
        yield Conflict(
            drive.rollers > 1 or spec.wheel.steps or drive.roller_angles_deg,
            ("drive", "wheels"),
            "several wheels meet one finger, each in turn: remove rollers, roller_angles_deg and "
            "steps_deg, or set wheels = 1",
        )
        yield Conflict(
            spec.wheel.SIGN < 0.0,
            ("drive", "wheels"),
            "an internal wheel surrounds the finger, so that one alone fits: set wheels = 1",
        )
    yield Conflict(
        spec.product.runs_straight,
        ("product", "pitch_mm"),
        'a chain or belt needs a wheel on the ground, not kind = "{spec.drive.NAME}": set '
        "radius_mm instead",
    )
    yield Conflict(
        spec.support.gear_ratio != 1.0,
        ("support", "gear_ratio"),
        'gear_ratio is for a table on the ground, not for kind = "{spec.drive.NAME}": set it to 1',
    )
