"""Geneva stops: a closed recess that blocks the crank."""

from geneva_cli.motion.kind import Kind

_CHECKS = """
STATIC kinds.stop.parts:standing
  stop_turns stop_overlap_mm: lock_radius_mm? SMALLER
  stop_stress_max_MPa: lock_edge_mm*10 WIDER LARGER
"""
KINDS = (
    Kind(
        "stop",
        adds_to="external",
        refuses="kinds.stop.refuses:refuses",
        keys=("wheel.stop", "load.winding_torque_Nm", "limits.stop_stress_max_MPa"),
        quantities={
            "parts": "stop kinds.stop.parts:stop - "
            "turns first_deg last_deg overlap_mm lever_mm force_N contact_stress_MPa"
        },
        scene="kinds.stop.scene:StopScene",
        checks=_CHECKS,
    ),
)
