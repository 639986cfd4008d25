"""Geneva stops: a closed recess that blocks the crank."""

from geneva_cli.motion.kind import Kind

KINDS = (
    Kind(
        "stop",
        adds_to="external",
        scene="kinds.stop.scene:StopScene",
        parts_checks={
            "stop_turns": "kinds.stop.checks:turns",
            "stop_overlap_mm": "kinds.stop.checks:overlap",
            "stop_stress_max_MPa": "kinds.stop.checks:stress",
        },
    ),
)
