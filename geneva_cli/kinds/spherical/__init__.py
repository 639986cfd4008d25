"""Spherical machines: the parts of wheels whose shafts meet at an angle."""

from geneva_cli.motion.kind import Kind

KINDS = (
    Kind(
        "shells",
        adds_to="spherical",
        parts="kinds.spherical.parts:SphereParts",
        drawings={
            "wheel": "kinds.spherical.drawings:wheel",
            "crank": "kinds.spherical.drawings:crank",
            "assembly": "kinds.spherical.drawings:assembly",
        },
        dimensions="kinds.spherical.drawings:dimensions",
        sizes="kinds.spherical.sizes:key_sizes",
        details="kinds.spherical.parts:screw_sizes",
        stressed="kinds.spherical.sizes:stressed",
        wheel_body="kinds.spherical.parts:shell_body",
        locks="kinds.spherical.locking:sphere_locks",
        horn_sizes="kinds.spherical.sizes:horn_sizes",
        horns="kinds.spherical.horn:sphere_horns",
        roller="kinds.spherical.roller:ball_roller",
        parts_checks={
            "wall_between_slots_mm": "kinds.spherical.checks:standing",
            "horn_mm": "kinds.spherical.checks:standing",
            "wheel_bore_wall_mm": "kinds.spherical.checks:standing",
            "beside_shafts_mm": "kinds.spherical.checks:standing",
            "arm_wall_mm": "kinds.spherical.checks:standing",
            "cut_plate_mm": "kinds.spherical.checks:standing",
            "cut_slot_mm": "kinds.spherical.checks:standing",
            "parts": "verdict.checks.part_checks:built",
        },
    ),
)
