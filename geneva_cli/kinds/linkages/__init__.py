"""Linkages that carry the roller: four-bars and slider-cranks."""

from geneva_cli.motion.kind import Kind

KINDS = (
    Kind(
        "four-bar",
        drive="kinds.linkages.four_bar:FourBar",
        refuses="drives.refuses:of_pin_path",
    ),
    Kind(
        "slider-crank",
        drive="kinds.linkages.slider_crank:SliderCrank",
        refuses="drives.refuses:of_pin_path",
    ),
)
