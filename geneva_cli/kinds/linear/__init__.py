"""The linear Geneva: a rack of slots."""

from geneva_cli.motion.kind import Kind

_CHECKS = """
MOTION kinds.linear.checks:rack_horn
  rack_horn_mm
STATIC kinds.linear.checks:standing
  guide_locks beside_shafts_mm gear_gap_mm cut_plate_mm cut_slot_mm
"""
KINDS = (
    Kind(
        "linear",
        synonyms=("rack",),
        wheel="kinds.linear.motion:Linear",
        parts="kinds.linear.parts:RackParts",
        front="parts.flat_parts:FrontParts",
        drawings=dict.fromkeys(("slot", "arm", "guide", "assembly"), "kinds.linear.drawings")
        | dict.fromkeys(("wheel", "crank", "frame"), "drawings.part_drawings")
        | {"plate": "drawings.parts_list"},
        tables={"slot": "parts.slots.slot_profile:profile_table"},
        dimensions="kinds.linear.drawings:dimensions",
        sizes="kinds.linear.rack:key_sizes",
        stressed="kinds.linear.parts:rack_stressed",
        refuses="kinds.linear.motion:refuses",
        no_parts="kinds.linear.motion:no_parts",
        keys=("load.mass_kg", "load.force_N", "load.guide_friction"),
        quantities={
            "parts": "guide - kinds.linear.checks:guide length_mm locks_at_friction force_N at_deg"
        },
        horn_sizes="kinds.linear.parts:horn_sizes",
        load_case="kinds.linear.guide:with_guide",
        scene="kinds.linear.drawings:RackScene",
        checks=_CHECKS,
    ),
)
