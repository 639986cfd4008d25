"""Gear sectors: steps at a constant ratio."""

from geneva_cli.motion.kind import Kind

KINDS = (
    Kind(
        "gear-sector",
        drive="kinds.gear_sector.motion:GearSector",
        gearings=("external",),
        refuses="motion.compatible:of_pin_path",
        families={"straight": "kinds.gear_sector.family:sectors"},
    ),
)
