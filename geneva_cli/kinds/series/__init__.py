"""Drives in series: one machine turns the input shaft of another."""

from geneva_cli.motion.kind import Kind

KINDS = (
    Kind(
        "geneva-pair",
        drive="kinds.series.geneva_pair:GenevaPair",
        refuses="kinds.series.geneva_pair:refuses",
        families={"straight": "kinds.series.family:pairs"},
    ),
)
