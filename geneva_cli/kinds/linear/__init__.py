"""The linear Geneva: a rack of slots."""

from geneva_cli.motion.kind import Kind

KINDS = (
    Kind(
        "linear",
        wheel="kinds.linear.motion:Linear",
        parts="kinds.linear.parts:RackParts",
        front="parts.front_parts:FrontParts",
        drawings={
            "slot": "kinds.linear.drawings:slot",
            "wheel": "drawings.part_drawings:wheel",
            "crank": "drawings.part_drawings:crank",
            "arm": "kinds.linear.drawings:arm",
            "frame": "drawings.part_drawings:frame",
            "guide": "kinds.linear.drawings:guide",
            "assembly": "kinds.linear.drawings:assembly",
            "plate": "drawings.print_plate:plate",
            "sheet": "kinds.linear.sheet:sheet",
        },
        tables={"slot": "parts.slots.slot_sampling:profile_table"},
        dimensions="kinds.linear.drawings:dimensions",
        stressed="kinds.linear.stressed:rack_stressed",
        motion_checks={
            "rack_horn_mm": "kinds.linear.checks:rack_horn",
            "guide_locks": "kinds.linear.checks:guide_locks",
        },
        parts_checks={
            "beside_shafts_mm": "verdict.checks.shafts:passing_rack",
            "gear_gap_mm": "verdict.checks.shafts:passing_rack_gears",
            "cut_plate_mm": "verdict.checks.process:thickest_of_rack",
            "cut_slot_mm": "verdict.checks.process:width_in_rack",
            "parts": "verdict.checks.process:plates_built",
        },
    ),
)
