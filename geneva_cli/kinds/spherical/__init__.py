"""Spherical machines: the parts of wheels whose shafts meet at an angle."""

from geneva_cli.motion.kind import Kind

_CHECKS = """
STATIC kinds.spherical.checks:standing
  wall_between_slots_mm horn_mm wheel_bore_wall_mm beside_shafts_mm arm_wall_mm cut_plate_mm
    cut_slot_mm
"""
KINDS = (
    Kind(
        "shells",
        adds_to="spherical",
        parts="kinds.spherical.parts:SphereParts",
        drawings=dict.fromkeys(("wheel", "crank", "assembly"), "kinds.spherical.drawings"),
        dimensions="kinds.spherical.drawings:dimensions",
        sizes="kinds.spherical.sizes:key_sizes",
        details="kinds.spherical.parts:screw_sizes",
        stressed="kinds.spherical.sizes:stressed",
        wheel_body="kinds.spherical.parts:shell_body",
        locks="kinds.spherical.locking:sphere_locks",
        horn_sizes="kinds.spherical.sizes:horn_sizes",
        horns="kinds.spherical.horn:sphere_horns",
        roller="kinds.spherical.sizes:ball_roller",
        checks=_CHECKS,
    ),
)
